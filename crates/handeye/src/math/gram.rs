//! Products of all pairs of rows, several pixels at once.

/// Pairs of so many rows.
pub(crate) const fn pairs(rows: usize) -> usize {
    rows * (rows + 1) / 2
}

/// Where the product of rows `m <= n` of `ROWS` is kept.
pub(crate) const fn place<const ROWS: usize>(m: usize, n: usize) -> usize {
    m * ROWS - m * (m + 1) / 2 + n
}

/// Adds the products of rows of `LANES` pixels to `SUMS` sums each, which a processor adds as many at
/// once.
#[inline(always)]
pub(crate) fn accumulate<
    const ROWS: usize,
    const LANES: usize,
    const SUMS: usize,
    const PAIRS: usize,
>(
    products: &mut [[f32; SUMS]; PAIRS],
    rows: &[[f32; LANES]; ROWS],
) {
    let mut next = 0;
    for m in 0..ROWS {
        for n in m..ROWS {
            let mut sum = products[next];
            for from in (0..LANES).step_by(SUMS) {
                for k in 0..SUMS {
                    sum[k] += rows[m][from + k] * rows[n][from + k];
                }
            }
            products[next] = sum;
            next += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_rows_have_a_place_each() {
        let all: Vec<usize> = (0..7).flat_map(|m| (m..7).map(move |n| place::<7>(m, n))).collect();
        assert_eq!(all, (0..pairs(7)).collect::<Vec<_>>());
    }

    #[test]
    fn sums_are_those_of_all_pixels() {
        let rows = [[1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0]];
        let mut products = [[0.0; 2]; pairs(2)];
        (0..2).for_each(|_| accumulate(&mut products, &rows));
        let sums = products.map(|lanes| lanes[0] + lanes[1]);
        assert_eq!(sums, [2.0 * 30.0, 2.0 * 70.0, 2.0 * 174.0]);
    }
}
