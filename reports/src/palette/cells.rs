//! Table cells with the coordinates of a colour.

use calibrate::palette::Appearance;

use crate::style::Color;
use crate::table::{Cell, Column};

/// The columns L*, a*, b*, sRGB, and whether the colour is outside sRGB.
pub(super) fn color_columns() -> [Column; 5] {
    [
        Column::quantity("L*", "1", 2),
        Column::quantity("a*", "1", 2),
        Column::quantity("b*", "1", 2),
        Column::text("sRGB"),
        Column::text("outside sRGB"),
    ]
}

/// The cells of a colour for [`color_columns`].
pub(super) fn color_cells(appearance: &Appearance) -> [Cell; 5] {
    let outside = if appearance.srgb.in_gamut() { "no" } else { "yes" };
    let [l, a, b] = appearance.lab.to_array();
    [l.into(), a.into(), b.into(), Color::from_rgb(appearance.srgb).into(), outside.into()]
}

/// The figure's own columns followed by those of a colour.
pub(super) fn columns(own: impl Into<Vec<Column>>) -> Vec<Column> {
    let mut all: Vec<Column> = own.into();
    all.extend(color_columns());
    all
}

/// A row for [`columns`]: the figure's own cells followed by those of a colour.
pub(super) fn row(own: impl Into<Vec<Cell>>, appearance: &Appearance) -> Vec<Cell> {
    let mut all: Vec<Cell> = own.into();
    all.extend(color_cells(appearance));
    all
}
