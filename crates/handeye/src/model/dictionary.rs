//! The bits of ArUco and AprilTag markers.
//!
//! A marker of `n x n` bits has a border of one black bit around it. Bits are packed row by row
//! from the top left, the first bit the lowest; a set bit is black. The tables are those of OpenCV's
//! predefined dictionaries.
//!
//! S. Garrido-Jurado et al., *Automatic generation and detection of highly reliable fiducial
//! markers under occlusion*, Pattern Recognition 47(6), 2014; E. Olson, *AprilTag*, ICRA 2011.

use std::sync::LazyLock;

/// All markers; the file says how they are written.
const MARKERS: &str = include_str!("dictionary/markers.txt");

/// A family of the table.
struct Family {
    name: &'static str,
    side: usize,
    codes: Vec<u64>,
}

static FAMILIES: LazyLock<Vec<Family>> = LazyLock::new(|| {
    let mut families: Vec<Family> = vec![];
    for line in MARKERS.lines().filter(|line| !line.starts_with('#')) {
        if let [name, side, _] = line.split(' ').collect::<Vec<_>>()[..]
            && name.starts_with("DICT_")
        {
            families.push(Family { name, side: side.parse().unwrap_or(0), codes: vec![] });
        } else if let Some(family) = families.last_mut() {
            family.codes.extend(line.split(' ').filter_map(|c| u64::from_str_radix(c, 16).ok()));
        }
    }
    families
});

/// Sizes of the families that are the first markers of the one of 1000.
const SMALLER: [usize; 3] = [50, 100, 250];

/// A family of markers, by OpenCV's name.
#[derive(Debug, Clone, Copy)]
pub struct Dictionary {
    side: usize,
    codes: &'static [u64],
}

/// A marker that was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reading {
    /// Which marker.
    pub id: u32,
    /// Quarter turns, clockwise in the image, by which the marker is turned.
    pub turns: usize,
    /// Bits that were read wrong.
    pub errors: u32,
}

impl Dictionary {
    /// OpenCV's name, e.g. `DICT_6X6_250`, with or without its `DICT_`.
    pub fn named(name: &str) -> Option<Self> {
        let short = name.strip_prefix("DICT_").unwrap_or(name);
        FAMILIES.iter().find_map(|family| {
            let whole = family.name.strip_prefix("DICT_")?;
            let of = |count: usize| Self { side: family.side, codes: &family.codes[..count] };
            if whole == short {
                return Some(of(family.codes.len()));
            }
            let (first, count) = (whole.strip_suffix("1000")?, short);
            let count = count.strip_prefix(first)?.parse().ok()?;
            SMALLER.contains(&count).then(|| of(count))
        })
    }

    /// Bits along a side, without the border.
    pub fn side(&self) -> usize {
        self.side
    }

    /// Number of markers.
    pub fn len(&self) -> usize {
        self.codes.len()
    }

    /// Whether there are no markers.
    pub fn is_empty(&self) -> bool {
        self.codes.is_empty()
    }

    /// Whether bit `(column, row)` of a marker is black; `false` for a marker that does not exist.
    pub(crate) fn is_black(&self, id: u32, column: usize, row: usize) -> bool {
        let code = self.codes.get(id as usize).copied().unwrap_or(0);
        code >> (row * self.side + column) & 1 == 1
    }

    /// Whether a cell of a marker with its black border, `border` bits wide, is black; a `turned`
    /// marker stands on its head.
    pub(crate) fn is_cell_black(
        &self,
        id: u32,
        border: u32,
        turned: bool,
        (column, row): (usize, usize),
    ) -> bool {
        let (border, last) = (border as usize, self.side - 1);
        let bit = |k: usize| {
            let inner = k.checked_sub(border).filter(|k| *k <= last)?;
            Some(if turned { last - inner } else { inner })
        };
        match (bit(column), bit(row)) {
            (Some(column), Some(row)) => self.is_black(id, column, row),
            _ => true,
        }
    }

    /// The nearest of the markers `ids`, with at most `most_errors` wrong bits.
    pub fn read(
        &self,
        code: u64,
        ids: impl IntoIterator<Item = u32>,
        most_errors: u32,
    ) -> Option<Reading> {
        let mut seen = code; // the code turned back, quarter by quarter
        let turned: [u64; 4] = std::array::from_fn(|_| {
            let now = seen;
            seen = turned_back(seen, self.side);
            now
        });
        let distances = ids.into_iter().filter_map(|id| {
            let wanted = *self.codes.get(id as usize)?;
            let (turns, errors) = (0..4)
                .map(|turns| (turns, (turned[turns] ^ wanted).count_ones()))
                .min_by_key(|&(_, errors)| errors)?;
            Some(Reading { id, turns, errors })
        });
        distances.min_by_key(|reading| reading.errors).filter(|r| r.errors <= most_errors)
    }
}

/// The code after a quarter turn counter-clockwise.
fn turned_back(code: u64, side: usize) -> u64 {
    let bit = |column: usize, row: usize| code >> (row * side + column) & 1;
    let at = |k: usize| bit(side - 1 - k / side, k % side) << k;
    (0..side * side).map(at).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marker_is_read_in_all_four_orientations() {
        let dictionary = Dictionary::named("DICT_6X6_250").unwrap();
        let code = dictionary.codes[17];
        let mut turned = code;
        for turns in [0, 3, 2, 1] {
            let reading = dictionary.read(turned, 0..250, 2).unwrap();
            assert_eq!(reading, Reading { id: 17, turns, errors: 0 });
            turned = turned_back(turned, 6); // three quarter turns clockwise
        }
    }

    #[test]
    fn the_table_is_complete() {
        for family in FAMILIES.iter() {
            let head = MARKERS.lines().find(|line| line.starts_with(family.name)).unwrap();
            assert!(head.ends_with(&format!(" {}", family.codes.len())), "{head}");
            let bits = family.side * family.side;
            assert!(family.codes.iter().all(|code| code >> bits == 0), "{head}");
            let mut codes = family.codes.clone();
            codes.sort_unstable();
            codes.dedup();
            assert_eq!(codes.len(), family.codes.len(), "{head}");
        }
        for (name, side, len) in
            [("DICT_5X5_100", 5, 100), ("7X7_50", 7, 50), ("4X4_1000", 4, 1000)]
        {
            let dictionary = Dictionary::named(name).unwrap();
            assert_eq!((dictionary.side(), dictionary.len()), (side, len), "{name}");
        }
        for name in ["DICT_4X4_60", "DICT_4X4_", "DICT_8X8_50", "4x4_50", "DICT_APRILTAG_36h50", ""]
        {
            assert!(Dictionary::named(name).is_none(), "{name}");
        }
    }

    #[test]
    fn too_many_wrong_bits_are_no_marker() {
        let dictionary = Dictionary::named("APRILTAG_36h11").unwrap();
        let code = dictionary.codes[3] ^ 0b111;
        assert_eq!(dictionary.read(code, 0..587, 3).unwrap().errors, 3);
        assert!(dictionary.read(code, 0..587, 2).is_none());
    }

    #[test]
    fn the_published_marker_zero_of_4x4_is_the_one_we_read() {
        let dictionary = Dictionary::named("DICT_4X4_50").unwrap();
        let white = ["1011", "0101", "0011", "0010"];
        for (row, bits) in white.iter().enumerate() {
            for (column, bit) in bits.bytes().enumerate() {
                assert_eq!(dictionary.is_black(0, column, row), bit == b'0');
            }
        }
    }
}
