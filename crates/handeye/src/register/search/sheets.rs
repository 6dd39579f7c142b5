//! The faces of a sheet: two, close behind one another. Where it is not known which way surfaces face, a scan of the one
//! fits onto the other, and a place that is off by the thickness of the sheet is found as easily as the right one.

use nalgebra::Vector3;

use super::shape::Surfel;

/// Faces that are farther from one another are those of a body: share of the part's radius.
const THICKEST: f64 = 0.12;
/// Surfels of both faces lie above one another within this share of the radius.
const ABOVE: f64 = 0.03;
/// Cosines of the angle between normals of two faces, and of one.
const PARALLEL: f64 = 0.95;
const ALIKE: f64 = 0.98;
/// Cosine of the angle between two directions in which faces look.
const OTHER: f64 = 0.8;
/// Surfels that are asked for the face behind them, and the share of those that must have one.
const ASKED: usize = 200;
const SHARE: f64 = 0.3;
/// Directions in which most faces look.
const DIRECTIONS: usize = 3;

/// Steps from one face to the other, along the directions in which most faces look; none where the part is no sheet,
/// or thinner than `least` (m).
pub fn steps(part: &[Surfel], radius: f64, least: f64) -> Vec<Vector3<f64>> {
    let asked: Vec<&Surfel> = part.iter().step_by((part.len() / ASKED).max(1)).collect();
    let behind = |s: &&Surfel| {
        let of = |o: &Surfel| {
            let way = o.p - s.p;
            let depth = way.dot(&s.n).abs();
            let aside = (way.norm_squared() - depth * depth).max(0.0).sqrt();
            let is_face = o.n.dot(&s.n).abs() > PARALLEL
                && aside < ABOVE * radius
                && (least..THICKEST * radius).contains(&depth);
            is_face.then_some(depth)
        };
        part.iter().filter_map(of).min_by(f64::total_cmp)
    };
    let mut depths: Vec<f64> = asked.iter().filter_map(behind).collect();
    if (depths.len() as f64) < SHARE * asked.len() as f64 || depths.is_empty() {
        return vec![];
    }
    depths.sort_by(f64::total_cmp);
    let thickness = depths[depths.len() / 2];
    directions(&asked).iter().flat_map(|n| [n * thickness, n * -thickness]).collect()
}

/// Directions in which most surfels look, either way, the most frequent first.
fn directions(asked: &[&Surfel]) -> Vec<Vector3<f64>> {
    let alike = |n: &Vector3<f64>| asked.iter().filter(|s| s.n.dot(n).abs() > ALIKE).count();
    let mut all: Vec<(usize, Vector3<f64>)> = asked.iter().map(|s| (alike(&s.n), s.n)).collect();
    all.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let mut kept: Vec<Vector3<f64>> = vec![];
    for (_, n) in all {
        if kept.len() < DIRECTIONS && kept.iter().all(|k| k.dot(&n).abs() < OTHER) {
            kept.push(n);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Surfels of two faces of a plate of 100 x 60 mm, so far apart.
    fn plate(thickness: f64) -> Vec<Surfel> {
        let face = |z: f64, n: f64| {
            (0..50).flat_map(move |i| {
                (0..30).map(move |j| Surfel {
                    p: Vector3::new(2e-3 * f64::from(i), 2e-3 * f64::from(j), z),
                    n: Vector3::z() * n,
                })
            })
        };
        face(0.0, -1.0).chain(face(thickness, 1.0)).collect()
    }

    #[test]
    fn a_sheet_has_two_faces() {
        let steps = steps(&plate(2e-3), 0.06, 5e-4);
        assert_eq!(steps.len(), 2);
        assert!((steps[0].z.abs() - 2e-3).abs() < 1e-12 && steps[0] == -steps[1], "{steps:?}");
    }

    #[test]
    fn a_body_and_a_foil_have_none_that_could_be_confused() {
        assert!(steps(&plate(2e-2), 0.06, 5e-4).is_empty());
        assert!(steps(&plate(2e-4), 0.06, 5e-4).is_empty());
    }
}
