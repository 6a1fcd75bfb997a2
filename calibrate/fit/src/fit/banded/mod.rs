//! Symmetric banded matrices: Cholesky factor, solution, and the band of the inverse.

mod matrix;
mod factor;
mod inverse;
mod solve;

pub(crate) use factor::BandedCholesky;
pub(crate) use matrix::{Banded, ColumnsMut, Spare};
pub(crate) use solve::TOGETHER;

#[cfg(test)]
mod tests {
    use super::factor::LEAST_PARALLEL;
    use super::*;
    use nalgebra::DMatrix;

    fn example() -> (Banded, DMatrix<f64>) {
        let size = 23;
        let reach = 4;
        let mut banded = Banded::zeros(size, reach);
        let mut dense = DMatrix::zeros(size, size);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let value = if row == column {
                    9.0 + (row % 5) as f64
                } else {
                    ((row * 7 + column * 13) % 11) as f64 / 5.0 - 1.0
                };
                banded.add(row, column, value);
                dense[(row, column)] = value;
                dense[(column, row)] = value;
            }
        }
        (banded, dense)
    }

    #[test]
    fn solution_product_and_inverse_band_agree_with_the_dense_matrix() {
        let (banded, dense) = example();
        let right: Vec<f64> = (0..23).map(|i| f64::from(i) - 7.0).collect();
        let product = banded.times(&right);
        let dense_product = &dense * nalgebra::DVector::from_vec(right.clone());
        for (a, b) in product.iter().zip(&dense_product) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let cholesky = banded.cholesky().unwrap();
        let inverse = dense.try_inverse().unwrap();
        let solution = cholesky.solve(&right);
        let dense_solution = &inverse * nalgebra::DVector::from_vec(right);
        for (a, b) in solution.iter().zip(&dense_solution) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
        let band = cholesky.inverse_band();
        for column in 0..23usize {
            for row in column..(column + 5).min(23) {
                let a = band.at(row, column);
                let b = inverse[(row, column)];
                assert!((a - b).abs() < 1e-12, "({row}, {column}): {a} {b}");
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_has_no_factor() {
        let mut banded = Banded::zeros(2, 1);
        banded.add(0, 0, 1.0);
        banded.add(1, 1, 1.0);
        banded.add(1, 0, 2.0);
        assert!(banded.cholesky().is_none(), "eigenvalue -1");
    }

    #[test]
    fn panels_give_the_factor_of_single_columns_to_the_bit() {
        // Larger than a panel, with a reach that is shared out to threads.
        let size = 400;
        let reach = LEAST_PARALLEL + 7;
        let mut banded = Banded::zeros(size, reach);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let off = ((row * 7 + column * 13) % 11) as f64 / 5.0 - 1.0;
                banded.add(row, column, if row == column { 300.0 } else { off });
            }
        }
        let width = reach + 1;
        let mut single = banded.columns.clone();
        for column in 0..size {
            let root = single[column * width].sqrt();
            let own = &mut single[column * width..(column + 1) * width];
            own.iter_mut().for_each(|v| *v /= root);
            let own = own.to_vec();
            for offset in 1..=reach.min(size - 1 - column) {
                let target = &mut single[(column + offset) * width..];
                for (t, v) in target.iter_mut().zip(&own[offset..]) {
                    *t -= own[offset] * v;
                }
            }
        }
        let factor = banded.clone().cholesky().unwrap();
        assert!(factor.factor.columns == single);
        let band = factor.inverse_band();
        let mut dense = DMatrix::zeros(size, size);
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                dense[(row, column)] = banded.at(row, column);
                dense[(column, row)] = banded.at(row, column);
            }
        }
        let inverse = dense.try_inverse().unwrap();
        for column in 0..size {
            for row in column..(column + reach + 1).min(size) {
                let a = band.at(row, column);
                let b = inverse[(row, column)];
                assert!((a - b).abs() < 1e-14, "({row}, {column}): {a} {b}");
            }
        }
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let right: Vec<f64> = (0..size).map(|i| (i % 17) as f64 - 7.0).collect();
        let alone = one.install(|| (banded.clone().cholesky().unwrap(), banded.times(&right)));
        assert!(alone.0.factor.columns == single && alone.1 == banded.times(&right));

        let mut together = vec![[0.0; TOGETHER]; size];
        for (i, row) in together.iter_mut().enumerate() {
            *row = std::array::from_fn(|place| right[i] * (1.0 + place as f64));
        }
        factor.solve_together(&mut together);
        for place in 0..TOGETHER {
            let right: Vec<f64> = right.iter().map(|v| v * (1.0 + place as f64)).collect();
            let solution: Vec<f64> = together.iter().map(|row| row[place]).collect();
            assert!(factor.solve(&right) == solution, "right side {place}");
        }
    }
}
