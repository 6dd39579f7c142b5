//! A still scene as the target: scans of it from several places, brought together.
//!
//! ```text
//! camera_j_from_camera_i = X⁻¹ A_ij X    with A_ij the mount's motion, X = mount_from_camera
//! ```
//!
//! Scans that follow one another are registered without any start. Of their motions, those that turn by
//! other angles than the robot did are wrong; the others tell about where the camera sits (`motions`), and
//! that predicts where every scan lies in every other. All pairs that overlap are registered from there, and
//! one adjustment over all of them places every scan in the scene (`graph`). The scene's frame is that of
//! the first scan that is placed. What comes out are poses of a target, with their covariances.

pub mod graph;
mod motions;

use nalgebra::{Isometry3, Matrix6};

use crate::{
    Camera, Pose, Target, TargetPose, Verdict,
    register::{Dense, DenseConfig, Surface, register_surfaces, scene::graph::Link},
};
use motions::Motion;

/// Scans are registered with so many that follow them, without a start.
const FOLLOWING: usize = 2;
/// Pairs of which less is predicted to overlap are not tried.
const OVERLAP: f64 = 0.15;
/// Each scan is registered with so many others at most.
const PARTNERS: usize = 8;
/// Windows that predict the overlap.
const ASKED: f64 = 300.0;

/// Where scans lie in their scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// For each scan; `None` where it could not be connected with the others.
    pub poses: Vec<Option<TargetPose>>,
    /// All pairs that were registered.
    pub links: Vec<Link>,
}

/// Places scans in the still scene that they show.
///
/// `anchor_from_mount` is where the camera's mount was at each scan; `guess`, if there is one, about where the
/// camera sits on it. `progress` is told how many pairs of how many are done.
pub fn place(
    surfaces: &[Surface],
    anchor_from_mount: &[Isometry3<f64>],
    guess: Option<&Isometry3<f64>>,
    config: &DenseConfig,
    progress: &dyn Fn(usize, usize),
) -> Placed {
    let motion = |i: usize, j: usize| anchor_from_mount[j].inv_mul(&anchor_from_mount[i]);
    let mut links = vec![];
    let mut mount_from_camera = guess.copied();
    if guess.is_none() {
        links = without_start(surfaces, config, progress);
        mount_from_camera = leave_out_wrong(&mut links, &motion);
    }
    if let Some(x) = mount_from_camera {
        let predicted = |i: usize, j: usize| x.inverse() * motion(i, j) * x;
        links = from_predictions(surfaces, &predicted, config, progress);
        leave_out_wrong(&mut links, &motion);
    }
    let poses = graph::adjust(surfaces.len(), &mut links);
    let pose = |placed: (Isometry3<f64>, Matrix6<f64>)| TargetPose {
        camera_from_target: Pose::<Camera, Target>::claim(placed.0),
        covariance: Some(placed.1),
    };
    Placed { poses: poses.into_iter().map(|placed| placed.map(pose)).collect(), links }
}

/// Leaves out links that are not accepted, or not the robot's motion; what those that agree tell of where the
/// camera sits.
fn leave_out_wrong(
    links: &mut [Link],
    motion: &dyn Fn(usize, usize) -> Isometry3<f64>,
) -> Option<Isometry3<f64>> {
    let mut all = vec![];
    for link in links.iter_mut() {
        let a = motion(link.source, link.target);
        link.left_out = why_not(&link.found).or_else(|| motions::contradiction(&a, link.at()));
        if link.left_out.is_none() {
            all.push(Motion { a, b: *link.at() });
        }
    }
    let x = motions::camera(&all)?;
    for link in links.iter_mut().filter(|link| link.left_out.is_none()) {
        let predicted = x.inverse() * motion(link.source, link.target) * x;
        if !motions::agrees(&predicted.inv_mul(link.at())) {
            link.left_out = Some("the robot did not move so, as the other pairs have it".into());
        }
    }
    Some(x)
}

/// Places a rigid object of known shape in scans of it; links have the scan's number as their target.
///
/// It is looked for everywhere first. Where it was found in enough scans to tell about where the camera sits, it
/// is looked for once more in the others, from where it must be.
pub fn place_object(
    object: &Surface,
    surfaces: &[Surface],
    anchor_from_mount: &[Isometry3<f64>],
    config: &DenseConfig,
    progress: &dyn Fn(usize, usize),
) -> Placed {
    let everywhere = DenseConfig { global: true, ..*config };
    let found = |scan: usize, start: &Isometry3<f64>, config: &DenseConfig| {
        let found = register_surfaces(object, &surfaces[scan], start, config);
        let left_out = why_not(&found);
        Link { source: scan, target: scan, found, left_out }
    };
    let first = |scan: usize| {
        let link = found(scan, &Isometry3::identity(), &everywhere);
        progress(scan + 1, surfaces.len());
        link
    };
    let mut links: Vec<Link> = (0..surfaces.len()).map(first).collect();
    if let Some((x, y)) = camera_and_object(&links, anchor_from_mount) {
        for link in &mut links {
            let predicted = x.inverse() * anchor_from_mount[link.source].inverse() * y;
            let off = link.at().inv_mul(&predicted);
            if link.left_out.is_some() || !motions::agrees(&off) {
                *link = found(link.source, &predicted, config);
                let is_there = motions::agrees(&link.at().inv_mul(&predicted));
                if link.left_out.is_none() && !is_there {
                    link.left_out =
                        Some("it lies elsewhere than robot and other scans have it".into());
                }
            }
        }
    }
    let pose = |link: &Link| {
        let covariance = link.found.covariance.filter(|_| link.left_out.is_none())?;
        let camera_from_target = Pose::<Camera, Target>::claim(*link.at());
        Some(TargetPose { camera_from_target, covariance: Some(covariance) })
    };
    Placed { poses: links.iter().map(pose).collect(), links }
}

/// About where the camera sits on the mount, and the object on the anchor.
fn camera_and_object(
    links: &[Link],
    anchor_from_mount: &[Isometry3<f64>],
) -> Option<(Isometry3<f64>, Isometry3<f64>)> {
    let counted: Vec<&Link> = links.iter().filter(|link| link.left_out.is_none()).collect();
    let mut all = vec![];
    for (k, i) in counted.iter().enumerate() {
        for j in &counted[..k] {
            let a = anchor_from_mount[j.source].inv_mul(&anchor_from_mount[i.source]);
            all.push(Motion { a, b: j.at() * i.at().inverse() });
        }
    }
    let x = motions::camera(&all)?;
    let places: Vec<Isometry3<f64>> =
        counted.iter().map(|link| anchor_from_mount[link.source] * x * link.at()).collect();
    let agreeing = |y: &&Isometry3<f64>| {
        places.iter().filter(|place| motions::agrees(&y.inv_mul(place))).count()
    };
    let y = places.iter().max_by_key(agreeing)?;
    Some((x, *y))
}

impl Link {
    fn at(&self) -> &Isometry3<f64> {
        &self.found.target_from_source
    }
}

fn why_not(found: &Dense) -> Option<String> {
    (found.verdict != Verdict::Accepted).then(|| found.reasons.join("; "))
}

fn without_start(
    surfaces: &[Surface],
    config: &DenseConfig,
    progress: &dyn Fn(usize, usize),
) -> Vec<Link> {
    let config = DenseConfig { global: true, ..*config };
    let following = |j: usize| (j.saturating_sub(FOLLOWING)..j).map(move |i| (i, j));
    let pairs: Vec<_> = (0..surfaces.len()).flat_map(following).collect();
    registered(surfaces, &pairs, &|_, _| Isometry3::identity(), &config, progress)
}

fn from_predictions(
    surfaces: &[Surface],
    predicted: &dyn Fn(usize, usize) -> Isometry3<f64>,
    config: &DenseConfig,
    progress: &dyn Fn(usize, usize),
) -> Vec<Link> {
    let gate = config.max_correspondence_distance_m;
    let mut pairs = vec![];
    for j in 0..surfaces.len() {
        let overlap =
            |i: usize| surfaces[i].share_near(&surfaces[j], &predicted(i, j), gate, ASKED);
        let mut others: Vec<(f64, usize)> = (0..j).map(|i| (overlap(i), i)).collect();
        others.retain(|(share, _)| *share >= OVERLAP);
        others.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        others.truncate(PARTNERS);
        pairs.extend(others.into_iter().map(|(_, i)| (i, j)));
    }
    pairs.sort_unstable();
    registered(surfaces, &pairs, predicted, config, progress)
}

fn registered(
    surfaces: &[Surface],
    pairs: &[(usize, usize)],
    start: &dyn Fn(usize, usize) -> Isometry3<f64>,
    config: &DenseConfig,
    progress: &dyn Fn(usize, usize),
) -> Vec<Link> {
    let link = |(k, &(source, target)): (usize, &(usize, usize))| {
        let start = start(source, target);
        let found = register_surfaces(&surfaces[source], &surfaces[target], &start, config);
        progress(k + 1, pairs.len());
        Link { source, target, found, left_out: None }
    };
    pairs.iter().enumerate().map(link).collect()
}

#[cfg(test)]
mod tests;
