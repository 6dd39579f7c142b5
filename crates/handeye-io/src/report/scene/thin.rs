//! Fewer points, evenly spread in space.
//!
//! Space is cut into cubes, and of every cube the point nearest to its middle stays. The cubes are as small
//! as the number of points allows. Which points stay does not depend on their order.

/// A number of points this little below the most is enough.
const FILLED: f64 = 0.93;
/// Most sizes of cubes that are tried.
const MOST_TRIES: usize = 10;
/// Of so many cubes one is counted, whichever its number says; their sizes are tried on those.
const COUNTED: f64 = 16.0;
/// Where the count of some has misled, cubes are larger by this factor.
const LARGER: f64 = 1.02;
/// Bits of a cube's number along an axis.
const BITS: u32 = 21;

/// Numbers of points that stay, at most `most`, in the order of their places; finite ones only.
pub fn thin(points: &[[f32; 3]], most: usize) -> Vec<u32> {
    let is_finite = |k: &u32| points[*k as usize].iter().all(|x| x.is_finite());
    let mut all: Vec<u32> = (0..points.len() as u32).filter(is_finite).collect();
    if all.len() > most {
        let mut cubes = Cubes::of(points, &all, most);
        let mut kept = cubes.middles(points, &all);
        while kept.len() > most {
            cubes.edge *= LARGER;
            kept = cubes.middles(points, &all);
        }
        all = kept;
    }
    let at = |k: &u32| points[*k as usize].map(ordered);
    all.sort_unstable_by_key(|k| (at(k), *k));
    all
}

/// Numbers in the order of the values, also of negative ones.
fn ordered(x: f32) -> i32 {
    let bits = x.to_bits() as i32;
    bits ^ ((bits >> 31) as u32 >> 1) as i32
}

/// Cubes of space.
pub struct Cubes {
    low: [f64; 3],
    edge: f64,
}

impl Cubes {
    /// The smallest ones of which about `most` hold points, and hardly more.
    fn of(points: &[[f32; 3]], all: &[u32], most: usize) -> Self {
        let (low, extent) = extent(points, all);
        let wanted = most.max(1) as f64;
        let (mut small, mut large) = (extent / f64::from(1u32 << BITS), extent * 1.01);
        let mut edge = extent / wanted.sqrt();
        for _ in 0..MOST_TRIES {
            let count = Self { low, edge }.count(points, all);
            if count > wanted {
                small = edge;
            } else {
                large = edge;
                if count > FILLED * wanted {
                    break;
                }
            }
            // on a surface, their number goes with the square of their edge
            let next = edge * (count / (0.5 * (1.0 + FILLED) * wanted)).sqrt();
            edge = if next > small && next < large { next } else { (small * large).sqrt() };
        }
        Self { low, edge: large }
    }

    /// Of this edge, m, around these points.
    pub fn with_edge(points: &[[f32; 3]], edge: f64) -> Self {
        let all: Vec<u32> = (0..points.len() as u32).collect();
        let (low, extent) = extent(points, &all);
        Self { low, edge: edge.max(extent / f64::from(1u32 << BITS)) }
    }

    /// The number of a point's cube, and how far the point is from its middle, in edges squared.
    pub fn cube(&self, p: &[f32; 3]) -> (u64, f64) {
        let (mut number, mut off) = (0, 0.0);
        for k in 0..3 {
            let place = (f64::from(p[k]) - self.low[k]) / self.edge;
            let cell = (place as u64).min((1 << BITS) - 1);
            number = number << BITS | cell;
            off += (place - cell as f64 - 0.5).powi(2);
        }
        (number, off)
    }

    /// About how many hold points.
    fn count(&self, points: &[[f32; 3]], all: &[u32]) -> f64 {
        let number = |k: &u32| self.cube(&points[*k as usize]).0;
        // the golden ratio spreads numbers over all of 64 bits, of which the first four are zero in one of 16
        let is_counted = |number: &u64| number.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 60 == 0;
        let mut numbers: Vec<u64> = all.iter().map(number).filter(is_counted).collect();
        numbers.sort_unstable();
        numbers.dedup();
        COUNTED * numbers.len() as f64
    }

    fn middles(&self, points: &[[f32; 3]], all: &[u32]) -> Vec<u32> {
        let placed = |k: &u32| {
            let p = points[*k as usize];
            let (number, off) = self.cube(&p);
            (number, off.to_bits(), p.map(ordered), *k)
        };
        let mut placed: Vec<_> = all.iter().map(placed).collect();
        placed.sort_unstable();
        placed.dedup_by_key(|p| p.0);
        placed.into_iter().map(|p| p.3).collect()
    }
}

/// The lowest corner of a box around points, and the longest side.
fn extent(points: &[[f32; 3]], all: &[u32]) -> ([f64; 3], f64) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in all.iter().map(|k| points[*k as usize]).filter(|p| p.iter().all(|x| x.is_finite())) {
        for k in 0..3 {
            low[k] = low[k].min(p[k].into());
            high[k] = high[k].max(p[k].into());
        }
    }
    let longest = (0..3).map(|k| high[k] - low[k]).fold(f64::MIN_POSITIVE, f64::max);
    (low, longest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use handeye::math::random::Random;

    /// A wave, with most of its points in one corner.
    fn wave(count: usize) -> Vec<[f32; 3]> {
        let mut random = Random::new(3);
        let point = |_| {
            let (x, y) = (random.unit().powi(3), random.unit().powi(3));
            [x as f32 - 0.5, y as f32 - 0.5, (0.1 * (9.0 * x).sin()) as f32]
        };
        (0..count).map(point).collect()
    }

    #[test]
    fn nearly_as_many_stay_as_may_and_they_are_evenly_spread() {
        let points = wave(40_000);
        let kept = thin(&points, 2000);
        assert!(kept.len() <= 2000 && kept.len() > 1500, "{}", kept.len());
        let quarter = |k: &&u32| points[**k as usize][0] < -0.25 && points[**k as usize][1] < -0.25;
        let crowded = kept.iter().filter(quarter).count() as f64 / kept.len() as f64;
        assert!(crowded < 0.25, "{crowded}");
    }

    #[test]
    fn the_same_places_stay_whatever_the_order() {
        let points = wave(20_000);
        let mut turned = points.clone();
        turned.reverse();
        turned.swap(3, 8000);
        let places = |all: &[[f32; 3]], most| -> Vec<[f32; 3]> {
            thin(all, most).into_iter().map(|k| all[k as usize]).collect()
        };
        assert_eq!(places(&points, 1000), places(&turned, 1000));
        assert_eq!(places(&points, 50_000), places(&turned, 50_000));
        assert_eq!(places(&points, 50_000).len(), 20_000);
    }

    #[test]
    fn points_at_one_place_far_away_and_missing_ones_are_no_trouble() {
        assert!(thin(&[[f32::NAN; 3]; 5], 2).is_empty());
        assert_eq!(thin(&[[1.0; 3]; 50], 2).len(), 1);
        let mut far = wave(500);
        far.push([f32::MAX, -f32::MAX, 0.0]);
        assert!((1..=100).contains(&thin(&far, 100).len()));
    }

    #[test]
    fn numbers_keep_the_order_of_values() {
        let values = [-f32::MAX, -1.0, -1e-30, -0.0, 0.0, 1e-30, 2.0];
        assert!(values.windows(2).all(|pair| ordered(pair[0]) < ordered(pair[1])));
    }
}
