//! Which row goes with which column so that the sum of what they are worth is largest.

/// The column of each row, or none where no pair is worth anything; no column twice. `worth[row][column] >= 0`.
///
/// Hungarian method with potentials, O(n^3). Taking the best pair first, and so on, is the same as long as no shape is
/// like two others; with few points shapes are alike, and then the best pair may cost two others more than it is
/// worth. Source: Kuhn, The Hungarian method for the assignment problem, Naval Research Logistics Quarterly 2
/// (1955) 83-97.
pub(super) fn assignment(worth: &[Vec<f64>]) -> Vec<Option<usize>> {
    let rows = worth.len();
    let columns = worth.iter().map(Vec::len).max().unwrap_or(0);
    let size = rows.max(columns);
    let value =
        |row: usize, column: usize| -> f64 { worth.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0) };
    // least cost over a square filled up with zeros; row 0 and column 0 stand for "none yet"
    let (mut row_price, mut column_price) = (vec![0.0; size + 1], vec![0.0; size + 1]);
    let mut row_of = vec![0_usize; size + 1];
    for row in 1..=size {
        row_of[0] = row;
        let mut column = 0;
        let mut reach = vec![f64::INFINITY; size + 1];
        let mut from = vec![0_usize; size + 1];
        let mut visited = vec![false; size + 1];
        // a path that changes partners alternately, until a column is free
        while row_of[column] != 0 {
            visited[column] = true;
            let current = row_of[column];
            let (mut step, mut next) = (f64::INFINITY, 0);
            for other in (1..=size).filter(|&other| !visited[other]) {
                let slack = -value(current - 1, other - 1) - row_price[current] - column_price[other];
                if slack < reach[other] {
                    (reach[other], from[other]) = (slack, column);
                }
                if reach[other] < step {
                    (step, next) = (reach[other], other);
                }
            }
            if next == 0 {
                break; // worths that are not finite: leave the row without a partner
            }
            for other in 0..=size {
                if visited[other] {
                    row_price[row_of[other]] += step;
                    column_price[other] -= step;
                } else {
                    reach[other] -= step;
                }
            }
            column = next;
        }
        while column != 0 {
            let before = from[column];
            row_of[column] = row_of[before];
            column = before;
        }
    }
    let mut found = vec![None; rows];
    for (column, &row) in row_of.iter().enumerate().skip(1) {
        if row > 0 && value(row - 1, column - 1) > 0.0 {
            found[row - 1] = Some(column - 1);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::assignment;

    #[test]
    fn the_best_pair_is_given_up_for_two_good_ones() {
        // best first takes 0.9 and is left with 0.0
        let worth = [vec![0.9, 0.8], vec![0.8, 0.0]];
        assert_eq!(assignment(&worth), [Some(1), Some(0)]);
    }

    #[test]
    fn what_is_worth_nothing_stays_alone() {
        let worth = [vec![0.0, 0.7, 0.0], vec![0.0, 0.6, 0.0]];
        assert_eq!(assignment(&worth), [Some(1), None]);
        assert!(assignment(&[]).is_empty());
        assert_eq!(assignment(&[vec![], vec![]]), [None, None]);
    }

    /// Against all orders of five rows.
    #[test]
    fn no_order_is_worth_more() {
        fn best(worth: &[Vec<f64>], used: &mut Vec<bool>) -> f64 {
            let Some((row, rest)) = worth.split_first() else {
                return 0.0;
            };
            let mut largest = 0.0_f64;
            for column in 0..row.len() {
                if !used[column] {
                    used[column] = true;
                    largest = largest.max(row[column] + best(rest, used));
                    used[column] = false;
                }
            }
            largest
        }
        let mut state = 7_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state) / f64::from(u32::MAX)
        };
        for _ in 0..200 {
            let worth: Vec<Vec<f64>> = (0..5).map(|_| (0..6).map(|_| random()).collect()).collect();
            let found = assignment(&worth);
            let sum: f64 = found.iter().zip(&worth).filter_map(|(column, row)| column.map(|column| row[column])).sum();
            assert!((sum - best(&worth, &mut vec![false; 6])).abs() < 1e-12);
        }
    }
}
