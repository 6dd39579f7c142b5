//! The order of views: a short way through all of them, beginning where the robot stands. The nearest next one first, then
//! pieces are reversed as long as that shortens the way (G. Croes, Operations Research 6, 1958).

use super::reach::{Reach, Station};

/// A part of the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Leg {
    /// The number of the station to which it leads.
    pub to: usize,
    /// Whether the direct way is blocked, and it goes by way of where the robot stood at first.
    pub via_start: bool,
}

/// Lengths of all ways, the start being number 0.
struct Ways {
    long: Vec<Vec<f64>>,
    blocked: Vec<Vec<bool>>,
}

/// What a way that goes by the start is worse than its length says: it is not what anybody wants.
const DETOUR: f64 = 10.0;

impl Ways {
    fn of(start: &Station, stations: &[Station], reach: &Reach) -> Ways {
        let all: Vec<&Station> = std::iter::once(start).chain(stations).collect();
        let mut blocked = vec![vec![false; all.len()]; all.len()];
        for a in 1..all.len() {
            for b in a + 1..all.len() {
                let is_blocked = reach.collision_between(all[a], all[b]).is_some();
                (blocked[a][b], blocked[b][a]) = (is_blocked, is_blocked);
            }
        }
        let direct = |a: usize, b: usize| all[a].way_to(all[b]);
        let long = |a: usize, b: usize| match blocked[a][b] {
            true => direct(a, 0) + direct(0, b) + DETOUR,
            false => direct(a, b),
        };
        let row = |a: usize| (0..all.len()).map(|b| long(a, b)).collect();
        Ways { long: (0..all.len()).map(row).collect(), blocked }
    }

    fn length(&self, order: &[usize]) -> f64 {
        order.windows(2).map(|pair| self.long[pair[0]][pair[1]]).sum()
    }
}

/// All stations, in an order that keeps the way short.
pub fn shortest(start: &Station, stations: &[Station], reach: &Reach) -> Vec<Leg> {
    let ways = Ways::of(start, stations, reach);
    let mut order = vec![0];
    while order.len() <= stations.len() {
        let here = order[order.len() - 1];
        let free = (1..=stations.len()).filter(|k| !order.contains(k));
        let next = free.min_by(|a, b| ways.long[here][*a].total_cmp(&ways.long[here][*b]));
        order.extend(next);
    }
    let mut length = ways.length(&order);
    loop {
        let pieces = (1..order.len()).flat_map(|a| (a + 1..order.len()).map(move |b| (a, b)));
        let shorter = pieces.into_iter().find_map(|(a, b)| {
            let mut other = order.clone();
            other[a..=b].reverse();
            let tried = ways.length(&other);
            (tried < length - 1e-9).then_some((other, tried))
        });
        match shorter {
            Some((other, tried)) => (order, length) = (other, tried),
            None => break,
        }
    }
    let leg = |pair: &[usize]| Leg { to: pair[1] - 1, via_start: ways.blocked[pair[0]][pair[1]] };
    order.windows(2).map(leg).collect()
}
