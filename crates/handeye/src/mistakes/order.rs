//! Images and robot poses in different orders: one list shifted against the other, or reversed.
//!
//! Orders are sifted by the invariants of `A X = X B`, which need no fit: the motions of robot and camera have the same
//! angle and the same pitch (H. Chen, CVPR 1991). The best few are fitted.

use nalgebra::Vector3;

use super::{
    evidence::{Evidence, Explanation},
    score::scored,
    thresholds::{FEWEST, UNIT},
};
use crate::{
    PosePair,
    findings::{CaptureFinding, captures::ListedOrder},
    math::{lie, linalg::median},
    solve::{consensus::Readings, motions},
};

/// Orders that are fitted in full, best invariants first.
const MOST_FITTED: usize = 3;
/// Least rotation whose axis tells a pitch, rad.
const LEAST_ROTATION: f64 = 0.05;

/// How the order of one list against the other is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Order {
    /// Image `i` belongs to robot pose `i + k`, counted round.
    Shifted(usize),
    /// The last image belongs to the first robot pose.
    Reversed,
}

impl Order {
    /// Robot pose of image `i` of `n`.
    fn robot_of(self, i: usize, n: usize) -> usize {
        match self {
            Self::Shifted(k) => (i + k) % n,
            Self::Reversed => n - 1 - i,
        }
    }

    /// Said the shorter way round, with the image and the robot pose of an example.
    fn listed(self, n: usize) -> (ListedOrder, [usize; 2]) {
        match self {
            Self::Shifted(k) if 2 * k > n => (ListedOrder::Before(n - k), [n - k, 0]),
            Self::Shifted(k) => (ListedOrder::After(k), [0, k]),
            Self::Reversed => (ListedOrder::Reversed, [0, n - 1]),
        }
    }
}

/// The likeliest orders with their scores.
pub(super) fn orders(evidence: &Evidence) -> Vec<Explanation> {
    let n = evidence.declared.len();
    if n < FEWEST {
        return vec![];
    }
    let all = (1..n).map(Order::Shifted).chain([Order::Reversed]);
    let mut all: Vec<(f64, Order)> =
        all.map(|order| (invariant_residual(&evidence.declared, order), order)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all.iter().take(MOST_FITTED).filter_map(|(_, order)| fitted(evidence, *order)).collect()
}

fn fitted(evidence: &Evidence, order: Order) -> Option<Explanation> {
    let n = evidence.declared.len();
    let (after, _) = scored(&reordered(&evidence.declared, order))?;
    let (order, example) = order.listed(n);
    let finding = CaptureFinding::OutOfOrder {
        order,
        example: example.map(|i| evidence.names[i].clone()),
        agreeing: after.agree,
        of: n,
        within_mm: after.translation_mm,
    };
    Some(Explanation::new(finding, Some(after)))
}

/// Median residual of both invariants in units of the score; the first pose candidates alone.
fn invariant_residual(captures: &[Readings], order: Order) -> f64 {
    let first = |c: Readings| {
        let camera_from_target = *c.camera_from_target.first()?;
        Some(PosePair { anchor_from_mount: c.anchor_from_mount, camera_from_target })
    };
    let pairs: Vec<PosePair> = reordered(captures, order).into_iter().filter_map(first).collect();
    median(motions::motions(&pairs).iter().map(residual_of_motion))
}

fn residual_of_motion(m: &motions::Motion) -> f64 {
    let (robot, camera) = (lie::so3_log(&m.a.rotation), lie::so3_log(&m.b.rotation));
    let angle = robot.norm() - camera.norm();
    let pitch = pitch(&robot, &m.a.translation.vector) - pitch(&camera, &m.b.translation.vector);
    (angle / UNIT.angle).hypot(pitch / UNIT.distance)
}

/// Translation along the axis of a rotation; none where the rotation is too small to have one.
fn pitch(rotation: &Vector3<f64>, translation: &Vector3<f64>) -> f64 {
    rotation.try_normalize(LEAST_ROTATION).map_or(0.0, |axis| axis.dot(translation))
}

/// Captures with their robot poses in another order.
fn reordered(captures: &[Readings], order: Order) -> Vec<Readings> {
    let n = captures.len();
    let with = |i: usize| Readings {
        anchor_from_mount: captures[order.robot_of(i, n)].anchor_from_mount,
        camera_from_target: captures[i].camera_from_target.clone(),
    };
    (0..n).map(with).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        findings::Finding,
        mistakes::tests::{in_order, with_robot},
    };

    fn best(evidence: &Evidence) -> (ListedOrder, [String; 2], f64) {
        let found = orders(evidence);
        let best = found.iter().min_by(|a, b| a.score().total_cmp(&b.score())).unwrap();
        let Finding::Captures(CaptureFinding::OutOfOrder { order, example, .. }) = &best.finding
        else {
            panic!("{best:?}")
        };
        (*order, example.clone(), best.score())
    }

    #[test]
    fn shifted_and_reversed_lists_are_found_with_an_example() {
        let right = in_order(10, 4);
        let listed = |of: &dyn Fn(usize) -> usize| {
            with_robot(&right, |k, _| right.declared[of(k)].anchor_from_mount)
        };
        let (order, example, score) = best(&listed(&|k| (k + 1) % 10));
        assert_eq!((order, example), (ListedOrder::Before(1), ["001".into(), "000".into()]));
        assert!(score < 3.0, "{score}");
        let (order, example, _) = best(&listed(&|k| (k + 7) % 10));
        assert_eq!((order, example), (ListedOrder::After(3), ["000".into(), "003".into()]));
        assert_eq!(best(&listed(&|k| 9 - k)).0, ListedOrder::Reversed);
    }

    #[test]
    fn no_other_order_fits_a_list_in_order() {
        let (_, _, score) = best(&in_order(10, 4));
        assert!(score > 20.0, "{score}");
    }

    #[test]
    fn three_captures_have_no_order() {
        assert_eq!(orders(&in_order(3, 4)), []);
        assert_eq!(FEWEST, 4);
    }
}
