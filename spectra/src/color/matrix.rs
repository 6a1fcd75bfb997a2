//! The 3 x 3 matrices that transform tristimulus values.

/// A 3 x 3 matrix as an array of rows. Names read target from source: `rgb_from_xyz`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Matrix3(pub [[f64; 3]; 3]);

impl Matrix3 {
    /// The diagonal matrix with the given elements.
    #[must_use]
    pub fn diagonal(diagonal: [f64; 3]) -> Self {
        let mut rows = [[0.0; 3]; 3];
        for (index, value) in diagonal.into_iter().enumerate() {
            rows[index][index] = value;
        }
        Self(rows)
    }

    /// The product of the matrix and a column vector.
    #[must_use]
    pub fn apply(&self, column: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| row[0] * column[0] + row[1] * column[1] + row[2] * column[2])
    }

    /// The matrix product `self * first`, which applies `first` first.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let mut rows = [[0.0; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = (0..3).map(|k| self.0[i][k] * first.0[k][j]).sum();
            }
        }
        Self(rows)
    }

    /// The inverse, by cofactors.
    ///
    /// # Panics
    /// If the matrix is singular. Matrices of independent primaries or cone responses are not.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let m = &self.0;
        let cofactor = |i: usize, j: usize| {
            let a = (i + 1) % 3;
            let b = (i + 2) % 3;
            let c = (j + 1) % 3;
            let d = (j + 2) % 3;
            m[a][c] * m[b][d] - m[a][d] * m[b][c]
        };
        let determinant: f64 = (0..3).map(|j| m[0][j] * cofactor(0, j)).sum();
        assert!(determinant != 0.0, "a colour matrix is never singular: {m:?}");
        let mut rows = [[0.0; 3]; 3];
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                *value = cofactor(j, i) / determinant;
            }
        }
        Self(rows)
    }
}
