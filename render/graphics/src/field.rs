//! A value for every cell of a rectangle, row by row.

use crate::tile::Rect;

/// Values over `width` x `height` cells; the first row is the topmost.
#[derive(Debug, Clone, PartialEq)]
pub struct Field<T> {
    width: usize,
    height: usize,
    values: Vec<T>,
}

impl<T: Clone> Field<T> {
    /// A field with `value` in every cell.
    #[must_use]
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Self { width, height, values: vec![value; width * height] }
    }
}

impl<T> Field<T> {
    /// A field of `values`, row by row from the top.
    ///
    /// # Panics
    /// If there are not `width` x `height` values.
    #[must_use]
    pub fn from_values(width: usize, height: usize, values: Vec<T>) -> Self {
        let found = values.len();
        assert_eq!(found, width * height, "{width} x {height} cells, found {found} values");
        Self { width, height, values }
    }

    /// Number of columns.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Number of rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The rectangle of all cells.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        Rect { x: 0, y: 0, width: self.width, height: self.height }
    }

    /// The values, row by row.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The values row by row, to be changed.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The cells `x..x + width` of row `y`.
    #[must_use]
    pub fn row(&self, y: usize, x: usize, width: usize) -> &[T] {
        &self.values[y * self.width + x..][..width]
    }

    /// The cells `x..x + width` of row `y`, to be changed.
    pub fn row_mut(&mut self, y: usize, x: usize, width: usize) -> &mut [T] {
        &mut self.values[y * self.width + x..][..width]
    }
}

impl<T: Copy> Field<T> {
    /// A copy of the cells in `rect`.
    ///
    /// # Panics
    /// If `rect` reaches beyond the field.
    #[must_use]
    pub fn part(&self, rect: Rect) -> Self {
        assert_eq!(rect.intersection(self.bounds()), rect, "a part of {:?}", self.bounds());
        let rows = rect.y..rect.y + rect.height;
        let mut values = Vec::with_capacity(rect.width * rect.height);
        rows.for_each(|y| values.extend_from_slice(self.row(y, rect.x, rect.width)));
        Self::from_values(rect.width, rect.height, values)
    }

    /// Overwrites the cells of a rectangle with `part`. Its upper left cell is (`x`, `y`).
    ///
    /// # Panics
    /// If the rectangle reaches beyond the field.
    pub fn put(&mut self, (x, y): (usize, usize), part: &Self) {
        let rect = Rect { x, y, width: part.width, height: part.height };
        assert_eq!(rect.intersection(self.bounds()), rect, "a part of {:?}", self.bounds());
        for row in 0..part.height {
            self.row_mut(y + row, x, part.width).copy_from_slice(part.row(row, 0, part.width));
        }
    }
}

impl<T> std::ops::Index<(usize, usize)> for Field<T> {
    type Output = T;

    /// The value at `(x, y)`.
    fn index(&self, (x, y): (usize, usize)) -> &T {
        &self.values[y * self.width + x]
    }
}

impl<T> std::ops::IndexMut<(usize, usize)> for Field<T> {
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        &mut self.values[y * self.width + x]
    }
}
