//! Size and numbers of one picture of a stack.

use std::path::Path;

use crate::cube::error::CubeError;
use crate::numbers::NumberType;

/// Size and numbers of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Plane {
    pub(crate) samples: usize,
    pub(crate) lines: usize,
    /// Numbers of a pixel.
    pub(crate) bands: usize,
    pub(crate) number_type: NumberType,
}

impl Plane {
    /// Checks that this picture is like the first of its stack. `place` names the picture.
    pub(crate) fn check_like(self, first: Self, path: &Path, place: &str) -> Result<(), CubeError> {
        if self == first {
            return Ok(());
        }
        let words = |plane: Self| {
            let bands = match plane.bands {
                1 => String::new(),
                bands => format!("{bands} "),
            };
            format!("{} x {} pixels of {bands}{:?}", plane.samples, plane.lines, plane.number_type)
        };
        let problem =
            format!("{place} has {}, the first picture of the stack {}", words(self), words(first));
        Err(CubeError::format(path, problem, "export all pictures at one size and one depth"))
    }
}

/// The error for a picture of several colours.
pub(crate) fn not_gray(path: &Path, place: &str, found: impl std::fmt::Debug) -> CubeError {
    CubeError::format(
        path,
        format!("{place} is of kind {found:?}, expected one gray value a pixel"),
        "export one gray picture a wavelength",
    )
}
