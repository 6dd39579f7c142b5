//! The unknowns beside both poses, by fits that are linearised anew until they stay.

use nalgebra::Vector6;

use crate::{
    Error, HandEye, PosePair, Setup,
    calibrate::flow::unknown::{self, Unknown},
    estimate::{self, JointFit, KnownNoise, Problem},
    model::residual::Residual,
    solve::{
        View,
        consensus::{self, Consensus, Readings},
    },
};

/// Where the unknowns stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stand {
    /// Camera time minus robot time (s).
    pub offset: f64,
    /// Measured over metric distances.
    pub scale: f64,
}

/// The captures as they are at some stand, in metres.
pub(crate) struct Captures {
    pub pairs: Vec<PosePair>,
    /// How the mount moves in each; `None` where the clocks agree.
    pub velocities: Option<Vec<Vector6<f64>>>,
}

/// What stays.
pub(crate) struct Settled {
    pub stand: Stand,
    /// The views that agree, and the fit of them.
    pub views: Vec<View>,
    pub fit: JointFit,
}

/// Most rounds; three settle it from a start within a tenth.
const ROUNDS: usize = 12;
/// A move below this part of its standard deviation needs no further look.
const STILL: f64 = 0.03;
/// Unit of the robust residual.
const UNIT: Residual = Residual::of(0.3, 2.0);

/// Fits the unknowns from `start`; `at` gives the captures for a stand.
///
/// # Errors
/// As [`consensus::consensus`].
pub(crate) fn settle(
    start: Stand,
    free_scale: bool,
    setup: Setup,
    known: &KnownNoise,
    at: impl Fn(Stand) -> Captures,
) -> Result<Settled, Error> {
    let mut stand = start;
    let mut round = 0;
    loop {
        let mut settled = settled_about(stand, free_scale, setup, known, at(stand))?;
        let still = take(&mut stand, &settled.fit);
        round += 1;
        if still || round == ROUNDS {
            settled.stand = stand;
            return Ok(settled);
        }
    }
}

fn settled_about(
    stand: Stand,
    free_scale: bool,
    setup: Setup,
    known: &KnownNoise,
    captures: Captures,
) -> Result<Settled, Error> {
    let found = agreement(&captures.pairs)?;
    let used = (0..captures.pairs.len()).filter(|&i| found.agrees[i]);
    let free = Unknown {
        scale: free_scale.then_some(1.0),
        time_offset_s: captures.velocities.as_ref().map(|_| 0.0),
    };
    let velocity = |i: usize| captures.velocities.as_ref().map(|v| &v[i]);
    let view = |i: usize| free.freed(&View::bare(captures.pairs[i]), velocity(i), &found.hand_eye);
    let views: Vec<View> = used.map(view).collect();
    let extras = free.extras();
    let problem = Problem { setup, views, boards: vec![], extras, known_position: None };
    let fit = estimate::fit_joint(&problem, &found.hand_eye, known)?;
    Ok(Settled { stand, views: problem.views, fit })
}

/// What most of these captures agree on.
pub(crate) fn agreement(pairs: &[PosePair]) -> Result<Consensus, Error> {
    consensus::consensus(&pairs.iter().map(readings).collect::<Vec<Readings>>())
}

fn readings(pair: &PosePair) -> Readings {
    Readings {
        anchor_from_mount: pair.anchor_from_mount,
        camera_from_target: vec![pair.camera_from_target],
    }
}

/// Mean of `ln(1 + d²)` over all captures, `d` their residual in units of 0.3 degrees and 2 mm.
pub(crate) fn residual(hand_eye: &HandEye, pairs: &[PosePair]) -> f64 {
    let one = |pair: &PosePair| hand_eye.loop_residual(pair).over(UNIT).powi(2).ln_1p();
    pairs.iter().map(one).sum::<f64>() / pairs.len().max(1) as f64
}

/// Moves to where the fit puts the unknowns; whether they were there already. What the fit leaves
/// open stays.
fn take(stand: &mut Stand, fit: &JointFit) -> bool {
    let mut still = true;
    if let Some((later, sigma)) = unknown::clock(fit) {
        stand.offset += later;
        still &= later.abs() <= STILL * sigma;
    }
    if let Some((factor, sigma)) = unknown::scale(fit) {
        stand.scale *= factor;
        still &= (factor - 1.0).abs() <= STILL * sigma;
    }
    still
}
