//! The next best view, and a route of views: of thousands of candidates those that are reachable and free of collisions,
//! that show the whole target although its pose is not known exactly, and that are most informative.

mod candidates;
mod known;

use std::cmp::Reverse;

use candidates::Offer;
pub use known::Planner;

use super::{
    FIRST, alike, error, finite,
    guess::{Taken, refined},
    log_determinant, moment,
    reach::{Station, Unreached},
    refusals::Refusals,
    travel,
};
use crate::{
    Camera, Error, Pose, Target,
    estimate::predict::PredictedTre,
    math::{linalg::FREE_SIGMA, parallel},
    solve::least_squares::Matrix12,
};

/// A view to take.
#[derive(Debug, Clone, PartialEq)]
pub struct NextView {
    /// Where the robot is to go.
    pub station: Station,
    /// Where the target is to be seen then.
    pub camera_from_target: Pose<Camera, Target>,
    /// Whether the direct way there is blocked, and it goes by way of where the robot stood first.
    pub via_start: bool,
    /// The error of the answer before it; `None` while captures do not determine it.
    pub before: Option<PredictedTre>,
    /// The error once it is taken.
    pub after: Option<PredictedTre>,
}

/// Views to take, in the order in which the robot goes to them.
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// The views.
    pub views: Vec<NextView>,
    /// Directions that all of them do not determine, in words.
    pub undetermined: Vec<String>,
    /// The error once all are taken.
    pub expected: Option<PredictedTre>,
    /// Where the robot stands first, and from where the ways begin.
    pub start: Option<Station>,
    /// Why there are fewer views than were asked for.
    pub stopped: Option<String>,
}

/// A pose on a route: one at which a capture is taken, or the start, by way of which it goes where a way is blocked.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop<'a> {
    /// `view-03`, or `via-03` for what is on the way there.
    pub name: String,
    /// Where the robot is to go.
    pub station: &'a Station,
    /// Whether a capture is taken there.
    pub is_view: bool,
}

impl Route {
    /// All poses in the order in which the robot goes to them: none may be passed over.
    pub fn stops(&self) -> Vec<Stop<'_>> {
        let mut all = vec![];
        for (k, view) in self.views.iter().enumerate() {
            let way = self.start.as_ref().filter(|_| view.via_start);
            all.extend(way.map(|station| Stop {
                name: format!("via-{:02}", k + 1),
                station,
                is_view: false,
            }));
            let name = format!("view-{:02}", k + 1);
            all.push(Stop { name, station: &view.station, is_view: true });
        }
        all
    }
}

/// Poses looked at in vain before no more are tried: the search for joint values takes time.
const MOST_IN_VAIN: usize = 2000;
/// Captures are enough when the calibration states less than this share of the tolerance. Whoever stops at the first one that
/// states less than the tolerance itself, stops too early: errors (95 %) are stated of all points of all such calibrations, and
/// the points of one are off together. Where the robot's noise was declared, the true error (95 %) was below the tolerance in 127
/// of 142 simulated cells then; with nine tenths of it in 130, with this share in 137.
pub const ENOUGH: f64 = 0.8;
/// Nor are fewer captures than this enough, whatever their calibration states: the share was measured with these and more.
pub const FEWEST_ENOUGH: usize = 5;
/// Usual number of candidates.
pub const USUAL_CANDIDATES: usize = 2000;

impl Planner {
    /// # Errors
    /// Values that make no sense.
    pub fn check(&self) -> Result<(), Error> {
        self.setting.check()?;
        self.reach.check()?;
        finite(&self.failed)?;
        let taken: Vec<_> = self.taken.iter().map(|t| t.base_from_flange).collect();
        finite(&taken)?;
        let v = &self.viewing;
        let sound = v.nearest_m > 0.0
            && v.farthest_m.is_finite()
            && v.nearest_m < v.farthest_m
            && (0.0..1.5).contains(&v.steepest)
            && (0.0..0.4).contains(&v.margin);
        let guessed = self.guess.is_none_or(|g| {
            [g.rotation_rad, g.position_m].iter().all(|s| s.is_finite() && *s > 0.0)
        });
        match (sound, guessed) {
            (true, true) => Ok(()),
            (false, _) => Err(Error::Invalid(
                "the distances and the tilt from which the camera may look make no sense".into(),
            )),
            (_, false) => Err(Error::Invalid("a guess needs positive standard deviations".into())),
        }
    }

    /// With the place of camera and target that the guess and the captures make most likely.
    pub fn refined(&self) -> Planner {
        let Some(guess) = &self.guess else { return self.clone() };
        Planner { setting: refined(&self.setting, guess, &self.taken), ..self.clone() }
    }

    /// Information of the guess and of the captures taken, and of next to nothing.
    fn information(&self) -> Matrix12 {
        let mut sum = Matrix12::identity() * FREE_SIGMA.powi(-2);
        if let Some(guess) = &self.guess {
            let mut x = sum.fixed_view_mut::<6, 6>(0, 0);
            x += guess.information();
        }
        sum + self.of_taken()
    }

    /// Information of the captures alone.
    pub(super) fn of_taken(&self) -> Matrix12 {
        let of = |t: &Taken| self.setting.information(&t.base_from_flange);
        self.taken.iter().filter_map(of).fold(Matrix12::zeros(), |sum, h| sum + h)
    }

    /// The error that is to be expected of the captures taken so far.
    pub fn expected(&self) -> Option<PredictedTre> {
        let nothing = Matrix12::identity() * FREE_SIGMA.powi(-2);
        self.setting.expected(&(nothing + self.of_taken()), self.taken.len())
    }

    /// The most informative view, to be taken next.
    ///
    /// # Errors
    /// Values that make no sense; [`Error::NoView`], which says why, where there is none.
    pub fn next(&self) -> Result<NextView, Error> {
        self.check()?;
        let here = self.refined();
        let (mut route, refusals) = here.greedy(1, |_| false);
        route.pop().ok_or_else(|| refusals.error())
    }

    /// Views that lower the expected error (95 %) to a tolerance (mm), or so many of them where they do not; in an order
    /// that keeps the way short.
    ///
    /// # Errors
    /// As [`Planner::next`], where not one view is found.
    pub fn route(&self, most: usize, tolerance_mm: Option<f64>) -> Result<Route, Error> {
        self.check()?;
        let here = self.refined();
        let enough = |view: &NextView| {
            let reached =
                |error: &PredictedTre| tolerance_mm.is_some_and(|mm| error.p95 <= ENOUGH * mm);
            view.after.as_ref().is_some_and(reached)
        };
        let (views, refusals) = here.greedy(most, enough);
        if views.is_empty() && most > 0 {
            return Err(refusals.error());
        }
        let is_short = views.len() < most && !views.last().is_some_and(enough);
        let views = here.arranged(views);
        let mut poses: Vec<_> = here.taken.iter().map(|t| t.base_from_flange).collect();
        poses.extend(views.iter().map(|view| view.station.base_from_flange));
        let sum = here.setting.sum(&poses);
        Ok(Route {
            undetermined: here.setting.undetermined(&sum, &poses),
            expected: here.setting.expected(&sum, poses.len()),
            start: here.reach.now(),
            stopped: is_short.then(|| refusals.reason()),
            views,
        })
    }

    /// One view after the other, each the most informative beside those before it.
    fn greedy(&self, most: usize, enough: impl Fn(&NextView) -> bool) -> (Vec<NextView>, Refusals) {
        let mut sum = self.information();
        let mut refusals = Refusals::default();
        let mut offers = self.offers(&sum, &mut refusals);
        let nothing = Matrix12::identity() * FREE_SIGMA.powi(-2);
        let mut of_captures = nothing + self.of_taken();
        let moment = moment(&self.setting.volume);
        let mut stations: Vec<Station> = self.reach.now().into_iter().collect();
        let mut views: Vec<NextView> = vec![];
        while views.len() < most {
            let count = self.taken.len() + views.len();
            let before = self.setting.expected(&of_captures, count);
            let gain = |h: &Matrix12| match count < FIRST {
                true => log_determinant(&(sum + h)),
                false => -error(&(sum + h), &moment),
            };
            let gains = parallel::in_order(offers.len(), self.threads, |k| {
                Reverse(by_total_order(gain(&offers[k].information)))
            });
            offers = sorted_by(gains, offers);
            let Some((station, information)) = self.best(&mut offers, &stations, &mut refusals)
            else {
                break;
            };
            (sum, of_captures) = (sum + information, of_captures + information);
            let view = NextView {
                camera_from_target: self.setting.pair(&station.base_from_flange).camera_from_target,
                after: self.setting.expected(&of_captures, count + 1),
                station: station.clone(),
                via_start: false,
                before,
            };
            offers.retain(|offer| !alike(&offer.base_from_flange, &station.base_from_flange));
            stations.push(station);
            views.push(view);
            if views.last().is_some_and(&enough) {
                break;
            }
        }
        (views, refusals)
    }

    /// The first offer that is reached, and to which the way is free; those before it are given up.
    fn best(
        &self,
        offers: &mut Vec<Offer>,
        stations: &[Station],
        refusals: &mut Refusals,
    ) -> Option<(Station, Matrix12)> {
        let reached = |offer: &Offer| {
            let station = self.reach.station(&offer.base_from_flange, stations)?;
            let start = self.reach.now();
            match start.and_then(|start| self.reach.collision_between(&start, &station)) {
                None => Ok(station),
                Some(collision) => Err(Unreached::Collides(collision)),
            }
        };
        let mut gone = 0;
        let found = offers.iter().find_map(|offer| {
            if gone >= MOST_IN_VAIN {
                return None;
            }
            gone += 1;
            match reached(offer) {
                Ok(station) => Some((station, offer.information)),
                Err(why) => {
                    refusals.note(why);
                    None
                }
            }
        });
        offers.drain(..gone);
        found
    }

    /// The views in an order that keeps the way short, with what is expected after each.
    fn arranged(&self, views: Vec<NextView>) -> Vec<NextView> {
        let Some(start) = self.reach.now() else { return views };
        let stations: Vec<Station> = views.iter().map(|view| view.station.clone()).collect();
        let legs = travel::shortest(&start, &stations, &self.reach);
        let mut of_captures = Matrix12::identity() * FREE_SIGMA.powi(-2) + self.of_taken();
        let mut before = self.setting.expected(&of_captures, self.taken.len());
        let arrange = |(k, leg): (usize, &travel::Leg)| {
            let view = &views[leg.to];
            let told = self.setting.information(&view.station.base_from_flange);
            of_captures += told.unwrap_or_else(Matrix12::zeros);
            let after = self.setting.expected(&of_captures, self.taken.len() + k + 1);
            let before = std::mem::replace(&mut before, after.clone());
            NextView { before, after, via_start: leg.via_start, ..view.clone() }
        };
        legs.iter().enumerate().map(arrange).collect()
    }
}

/// These in the order of their keys; of the same keys, in the order that they have.
fn sorted_by<K: Ord, T>(keys: Vec<K>, all: Vec<T>) -> Vec<T> {
    let mut keyed: Vec<(K, T)> = keys.into_iter().zip(all).collect();
    keyed.sort_by(|a, b| a.0.cmp(&b.0));
    keyed.into_iter().map(|(_, one)| one).collect()
}

/// A number with the order of `x` by [`f64::total_cmp`].
fn by_total_order(x: f64) -> i64 {
    let bits = x.to_bits() as i64;
    bits ^ ((bits >> 63) as u64 >> 1) as i64
}

impl NextView {
    /// Why it is taken: how it looks, and what it brings.
    pub fn reason(&self) -> String {
        let view = &self.camera_from_target;
        let normal = view.rotation().column(2).into_owned();
        let tilt = normal.z.abs().min(1.0).acos().to_degrees();
        // the board turns about the axis of the image that is at right angles to the way its normal leans
        let about = if normal.x.abs() > normal.y.abs() { "y" } else { "x" };
        let look = match tilt < 8.0 {
            true => "straight on".to_owned(),
            false => format!("tilted by {tilt:.0} degrees about the image's {about}"),
        };
        let far = view.translation().z;
        format!("{look}, {far:.2} m away: {}", change(self.before.as_ref(), self.after.as_ref()))
    }
}

/// The expected error before and after a measurement, in words.
pub(super) fn change(before: Option<&PredictedTre>, after: Option<&PredictedTre>) -> String {
    match (before, after) {
        (Some(a), Some(b)) => format!("{:.2} mm → {:.2} mm (95 %)", a.p95, b.p95),
        (None, Some(b)) => format!("then all is determined, to {:.2} mm (95 %)", b.p95),
        _ => "needed to determine all directions".into(),
    }
}

#[cfg(test)]
mod tests;
