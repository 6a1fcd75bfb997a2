//! The numbers of a colour, as cells of a table.

use calibrate::palette::Appearance;

use crate::style::Color;
use crate::table::{Cell, Column};

/// Columns of L*, a*, b* and sRGB.
pub(super) fn color_columns() -> [Column; 5] {
    [
        Column::quantity("L*", "1", 2),
        Column::quantity("a*", "1", 2),
        Column::quantity("b*", "1", 2),
        Column::words("sRGB"),
        Column::words("outside sRGB"),
    ]
}

/// A colour under [`color_columns`].
pub(super) fn color_cells(look: &Appearance) -> [Cell; 5] {
    let outside = if look.srgb.in_gamut() { "no" } else { "yes" };
    let [l, a, b] = look.lab.to_array();
    [l.into(), a.into(), b.into(), Color::shown(look.srgb).into(), outside.into()]
}

/// Columns of one figure and of a colour.
pub(super) fn columns(own: impl Into<Vec<Column>>) -> Vec<Column> {
    let mut all: Vec<Column> = own.into();
    all.extend(color_columns());
    all
}

/// A row under [`columns`].
pub(super) fn row(own: impl Into<Vec<Cell>>, look: &Appearance) -> Vec<Cell> {
    let mut all: Vec<Cell> = own.into();
    all.extend(color_cells(look));
    all
}
