//! Why a picture cannot be written.

/// Data that make no picture.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// A size that the format has not.
    #[error("a picture has 1 to 1073741822 cells a side, found `{width} x {height}`")]
    Size {
        /// Cells in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Planes of several sizes in one picture.
    #[error("`{plane}` has another size than the picture of {width} x {height}")]
    Differs {
        /// The plane.
        plane: String,
        /// Cells in a row of the first plane.
        width: usize,
        /// Rows of the first plane.
        height: usize,
    },
    /// A cell without a colour.
    #[error("{what} at x {x}, y {y} is no finite number, found `{found}`")]
    NotFinite {
        /// What should have stood there.
        what: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// What stands there.
        found: f32,
    },
    /// An amount below nothing.
    #[error("{what} at x {x}, y {y} is 0 and up, found `{found}`")]
    Negative {
        /// The pigment.
        what: String,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
        /// What stands there.
        found: f32,
    },
    /// Cells of no size.
    #[error("a cell is 0.0001 to 100 mm wide, found `{cell_mm}`")]
    Cell {
        /// The width in mm.
        cell_mm: f64,
    },
    /// A wavelength, or two that are the same.
    #[error(
        "wavelengths rise, in nm above 0, one for each plane; found `{found}` for plane {plane}"
    )]
    Wavelength {
        /// Which plane.
        plane: usize,
        /// What it was given.
        found: String,
    },
    /// The encoder gave up.
    #[error("no {format} could be made: {reason}")]
    Encoder {
        /// The format.
        format: &'static str,
        /// As the encoder tells it.
        reason: String,
    },
}

/// Whether cells are of a size that PNG and OpenEXR can tell.
pub fn check_cell(cell_mm: f64) -> Result<(), ExportError> {
    if (1e-4..=100.0).contains(&cell_mm) { Ok(()) } else { Err(ExportError::Cell { cell_mm }) }
}

/// Whether a picture of this size can be written.
pub fn check_size(width: usize, height: usize) -> Result<(), ExportError> {
    let sides = 1..=1_073_741_822;
    if sides.contains(&width) && sides.contains(&height) {
        Ok(())
    } else {
        Err(ExportError::Size { width, height })
    }
}
