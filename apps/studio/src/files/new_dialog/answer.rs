//! Answers of the dialog.

/// Use of a picture file that the painter is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::files) enum CanvasPicture {
    /// Its greys become the relief of the ground.
    Relief,
    /// Its colours become the first dry layer.
    FirstLayer,
}

/// Answer of the painter to the dialog of a new painting.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::files) enum NewAnswer {
    /// Begins the painting.
    Begin,
    /// Closes the dialog.
    Cancelled,
    /// Asks for a picture; the dialog stays.
    Choose(CanvasPicture),
}
