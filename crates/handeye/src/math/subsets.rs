//! Small sets of what was measured, to fit a first answer to: the same ones every time.
//!
//! A fit to the fewest measurements that determine it is right where all of these are: of `m` sets of `k`, with a
//! share `e` of all measurements wrong, one is clean with the probability `1 - (1 - (1 - e)ᵏ)ᵐ`. Where there are few,
//! all sets are taken ([`all`]); of many some, by a [`Draw`]. Each follows from the numbers given alone, so that equal
//! measurements give equal answers, however often and in however many threads.
//!
//! M. Fischler and R. Bolles, *Random sample consensus*, CACM 24(6), 1981; P. Rousseeuw, *Least median of squares
//! regression*, JASA 79, 1984.

use crate::math::random::Random;

/// How members are drawn.
#[derive(Debug, Clone)]
pub(crate) enum Draw {
    /// Independently, so that a set may have a member twice: for sets whose fit says so by itself.
    Repeating(Random),
    /// Without repetition, in the order drawn: the first of a shuffle (R. Fisher and F. Yates, 1938).
    Shuffled(Random),
    /// Sorted, drawn again where a member is there twice; by a linear congruential generator (D. Knuth's MMIX).
    Distinct(u64),
    /// Sorted, spread evenly: the fractional parts of multiples of irrational numbers (H. Weyl, *Math. Annalen* 77,
    /// 1916). What has a member twice is passed over, so that there are fewer.
    Even,
}

impl Draw {
    /// [`Draw::Distinct`] from its usual start.
    pub const DISTINCT: Self = Self::Distinct(0x9e37_79b9_7f4a_7c15);
}

/// Their square roots and 1 are linearly independent over the rational numbers: multiples fill a cube evenly.
const PRIMES: [f64; 8] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0];

/// How many sets of `k` there are of `n`; the largest number where that is more.
pub(crate) fn count(n: usize, k: usize) -> usize {
    let next = |sets: usize, i: usize| sets.checked_mul(n - i).map(|sets| sets / (i + 1));
    if k > n { 0 } else { (0..k).try_fold(1, next).unwrap_or(usize::MAX) }
}

/// All sets of `K` of `n`, in the order of a dictionary.
pub(crate) fn all<const K: usize>(n: usize) -> impl Iterator<Item = [usize; K]> {
    let first = (K <= n).then(|| std::array::from_fn(|k| k));
    std::iter::successors(first, move |set| next(set, n))
}

/// The set after this one: the last member that can grow does, and those behind it follow.
fn next<const K: usize>(set: &[usize; K], n: usize) -> Option<[usize; K]> {
    let grows = (0..K).rev().find(|&k| set[k] + K < n + k)?;
    let from = set[grows] + 1 - grows;
    Some(std::array::from_fn(|k| if k < grows { set[k] } else { from + k }))
}

/// So many sets of `K` of `n`, where `n` is `K` or more; else none.
pub(crate) fn drawn<const K: usize>(
    n: usize,
    sets: usize,
    mut draw: Draw,
) -> impl Iterator<Item = [usize; K]> {
    const { assert!(K <= PRIMES.len()) };
    let sets = if K <= n { sets } else { 0 };
    (1..=sets).filter_map(move |number| one(n, number, &mut draw))
}

fn one<const K: usize>(n: usize, number: usize, draw: &mut Draw) -> Option<[usize; K]> {
    match draw {
        Draw::Repeating(random) => Some(std::array::from_fn(|_| below(random, n))),
        Draw::Shuffled(random) => Some(first_of_a_shuffle(n, random)),
        Draw::Distinct(state) => loop {
            let set = sorted(std::array::from_fn(|_| congruential(state) % n));
            if is_distinct(&set) {
                return Some(set);
            }
        },
        Draw::Even => {
            let member = |k: usize| (number as f64 * PRIMES[k].sqrt()).fract() * n as f64;
            let set = sorted(std::array::from_fn(|k| (member(k) as usize).min(n - 1)));
            is_distinct(&set).then_some(set)
        }
    }
}

fn below(random: &mut Random, n: usize) -> usize {
    (random.unit() * n as f64) as usize
}

fn first_of_a_shuffle<const K: usize>(n: usize, random: &mut Random) -> [usize; K] {
    let mut order: Vec<usize> = (0..n).collect();
    (0..K).for_each(|k| order.swap(k, k + below(random, n - k)));
    std::array::from_fn(|k| order[k])
}

/// The upper half of the next state, whose bits are the better ones.
fn congruential(state: &mut u64) -> usize {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 33) as usize
}

fn sorted<const K: usize>(mut set: [usize; K]) -> [usize; K] {
    set.sort_unstable();
    set
}

fn is_distinct<const K: usize>(sorted: &[usize; K]) -> bool {
    sorted.windows(2).all(|pair| pair[0] != pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn draws() -> [Draw; 4] {
        let random = Random::new(3);
        [Draw::Repeating(random.clone()), Draw::Shuffled(random), Draw::DISTINCT, Draw::Even]
    }

    #[test]
    fn all_sets_are_there_once_and_in_order() {
        for n in 0..9 {
            let sets: Vec<[usize; 3]> = all(n).collect();
            assert_eq!(sets.len(), count(n, 3));
            assert!(sets.windows(2).all(|s| s[0] < s[1]) && sets.iter().all(is_distinct));
            assert!(sets.iter().flatten().all(|member| *member < n));
        }
        assert_eq!(all::<2>(3).collect::<Vec<_>>(), [[0, 1], [0, 2], [1, 2]]);
    }

    #[test]
    fn sets_are_counted_without_overflow() {
        assert_eq!([count(2, 3), count(3, 3), count(5, 0), count(50, 5)], [0, 1, 1, 2_118_760]);
        assert_eq!(count(usize::MAX, 3), usize::MAX);
    }

    #[test]
    fn the_same_sets_are_drawn_whatever_happens() {
        for draw in draws() {
            let some = |sets| drawn::<4>(17, sets, draw.clone()).collect::<Vec<_>>();
            let sets = some(50);
            assert_eq!(sets, some(50));
            // and fewer of them are the first ones
            assert!(sets.starts_with(&some(20)));
        }
        let first = |draw| drawn::<3>(20, 2, draw).collect::<Vec<_>>();
        assert_eq!(first(Draw::DISTINCT), [[4, 9, 18], [6, 7, 13]]);
        assert_eq!(first(Draw::Even), [[4, 8, 14]]); // the second has a member twice
    }

    #[test]
    fn members_are_different_where_that_is_asked_for() {
        for draw in &draws()[1..] {
            let sets: Vec<[usize; 4]> = drawn(6, 60, draw.clone()).collect();
            assert!(sets.iter().all(|set| is_distinct(&sorted(*set))), "{draw:?}");
            assert!(sets.iter().flatten().all(|member| *member < 6));
        }
        let repeating = drawn::<4>(6, 60, draws()[0].clone());
        assert!(repeating.map(sorted).any(|set| !is_distinct(&set)));
    }

    #[test]
    fn every_measurement_is_drawn_about_as_often() {
        for draw in draws() {
            let mut times = [0; 12];
            drawn::<4>(12, 600, draw.clone()).flatten().for_each(|member| times[member] += 1);
            let (least, most) = (times.iter().min().unwrap(), times.iter().max().unwrap());
            assert!(*least > 0 && most - least < most / 2, "{draw:?} {times:?}");
        }
    }

    #[test]
    fn many_different_sets_are_drawn() {
        for draw in draws() {
            let sets: BTreeSet<[usize; 3]> = drawn(40, 200, draw).map(sorted).collect();
            assert!(sets.len() > 150, "{}", sets.len());
        }
    }

    #[test]
    fn of_too_few_there_is_no_set() {
        for draw in draws() {
            assert_eq!(drawn::<4>(3, 10, draw).next(), None);
        }
        assert_eq!(all::<3>(2).next(), None);
    }
}
