//! Windows that reach over a crease, or from one surface to another behind it.
//!
//! Cameras err along their rays, so points scatter less across a surface that is seen at a slant; where they
//! scatter much more than that, the window is no plane. But its middle may lie on one: it is given the plane
//! of the flattest window beside it on which it lies. So surfaces that are few windows wide, the sides of small
//! things, count up to their edges, and it is those that hold a scan from sliding.
//!
//! M. Kuwahara et al., *Processing of RI-angiocardiographic images*, 1976: the flattest of the windows in which a
//! place lies.

use super::{pair::LEAST, patch::Patch};
use crate::math::linalg;

/// Scatter across a plane above this many times the usual one is that of a crease.
const CREASED: f64 = 4.0;
/// A window lies on a plane within so many standard deviations.
const ON: f64 = 5.0;
/// Above this many times the usual scatter a window is left out.
const ROUGH: f64 = 50.0;
/// The same, seen from a camera, with the usual one at that slant: less separates planes from what reaches from
/// one surface to another.
const ROUGH_AT_SLANT: f64 = 300.0;
/// But where the scatter across is below this share of that along it, nothing is rough.
const FLAT: f64 = 1e-4;

/// How much windows usually scatter across their planes.
#[derive(Debug, Clone, Copy)]
pub struct Scatter {
    /// Whether it follows the slant at which a camera sees.
    from_camera: bool,
    /// Variance, of a surface seen from the front where a camera sees it, m².
    usual: f64,
}

impl Scatter {
    pub fn of(patches: &[Option<Patch>], from_camera: bool) -> Self {
        let own = Self { from_camera, usual: 0.0 };
        let usual = linalg::median(patches.iter().flatten().map(|p| p.across / own.facing(p)));
        Self { usual, ..own }
    }

    fn facing(&self, patch: &Patch) -> f64 {
        if self.from_camera { patch.facing() } else { 1.0 }
    }

    /// Whether it scatters more than so many times the usual.
    fn is_beyond(&self, patch: &Patch, times: f64) -> bool {
        patch.across > (times * self.usual * self.facing(patch)).max(FLAT * patch.along)
    }

    /// Whether a window's middle lies on the plane of another.
    fn is_on(&self, own: &Patch, plane: &Patch) -> bool {
        let off = plane.normal.dot(&(own.mean - plane.mean));
        let variance = self.usual * self.facing(plane) * (1.0 / own.held + 1.0 / plane.held);
        off * off <= ON * ON * (variance + LEAST)
    }

    /// Mends windows across a crease by those that lie `around` each.
    pub(crate) fn mend<I: IntoIterator<Item = usize>>(
        &self,
        patches: &mut [Option<Patch>],
        around: impl Fn(usize) -> I,
    ) {
        let flattest = |own: &Patch, k: usize| {
            let beside = around(k).into_iter().filter_map(|k| patches[k].as_ref());
            let planes = beside.filter(|p| !self.is_beyond(p, CREASED) && self.is_on(own, p));
            let rough = |p: &&Patch| p.across / self.facing(p);
            planes.min_by(|a, b| rough(a).total_cmp(&rough(b)))
        };
        let mended: Vec<(usize, Patch)> = patches
            .iter()
            .enumerate()
            .filter_map(|(k, patch)| Some((k, patch.as_ref()?)))
            .filter(|(_, own)| self.is_beyond(own, CREASED))
            .filter_map(|(k, own)| Some((k, flattest(own, k)?.about(&own.mean, own.held))))
            .collect();
        for (k, patch) in mended {
            patches[k] = Some(patch);
        }
    }

    /// Leaves out windows that are no planes.
    pub(crate) fn leave_out_rough(&self, patches: &mut [Option<Patch>]) {
        let most = if self.from_camera { ROUGH_AT_SLANT } else { ROUGH };
        for patch in patches {
            *patch = patch.filter(|p| !self.is_beyond(p, most));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::register::blocks;
    use crate::{Scan, math::random::Random};
    use nalgebra::Vector3;

    /// A roof whose ridge runs down the middle, 1 m from the camera, with noise of 0.5 mm along its rays.
    fn roof() -> Scan {
        let mut random = Random::new(3);
        let (width, height) = (64, 48);
        let point = |k: usize, random: &mut Random| {
            let ray =
                Vector3::new((k % width) as f64 - 31.7, (k / width) as f64 - 23.5, 400.0) / 400.0;
            // z = 1 + |x|
            let z = 1.0 / (1.0 - ray.x.abs());
            (ray * (z + 5e-4 * random.normal())).map(|x| x as f32).into()
        };
        let points = (0..width * height).map(|k| point(k, &mut random)).collect();
        Scan::new(width, height, points).unwrap()
    }

    #[test]
    fn beside_a_ridge_windows_have_the_plane_on_which_they_lie() {
        let (mut patches, size) = blocks::patches(&roof(), 2, 1, 20.0, 1);
        let off = |p: &Patch| {
            let side = Vector3::new(p.mean.x.signum(), 0.0, -1.0).normalize();
            p.normal.cross(&side).norm().asin().to_degrees()
        };
        let worst = |patches: &[Option<Patch>]| {
            let beside =
                patches.iter().flatten().filter(|p| (0.001..0.006).contains(&p.mean.x.abs()));
            beside.map(off).fold(0.0, f64::max)
        };
        assert!(worst(&patches) > 20.0, "{}", worst(&patches));
        Scatter::of(&patches, true).mend(&mut patches, |k| blocks::around(k, size));
        assert!(worst(&patches) < 8.0, "{}", worst(&patches));
    }
}
