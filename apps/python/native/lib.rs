//! The native part of the Python package `impasto`: it passes arrays, names and JSON to the
//! libraries. You use the typed package in `impasto/`, which is Python and calls this.

use pyo3::prelude::*;

mod failure;
mod running;
mod arrays;
mod light;
mod color;
mod library;
mod readings;
mod residuals;
mod fitting;
mod matching;
mod planning;
mod quadrature;
mod report;
mod cube;
mod survey;

/// The native part of the package `impasto`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::color::{delta_e, rgb, xyz};
    #[pymodule_export]
    use crate::cube::Cube;
    #[pymodule_export]
    use crate::fitting::{Fit, Validation, compare, film, fit, validate};
    #[pymodule_export]
    use crate::library::Library;
    #[pymodule_export]
    use crate::light::Light;
    #[pymodule_export]
    use crate::matching::{BookColor, color_book, recipes_for};
    #[pymodule_export]
    use crate::planning::plan;
    #[pymodule_export]
    use crate::quadrature::quadrature;
    #[pymodule_export]
    use crate::readings::Readings;
    #[pymodule_export]
    use crate::report::report;
    #[pymodule_export]
    use crate::residuals::Residuals;
    #[pymodule_export]
    use crate::survey::{Survey, identify};

    /// Version of the libraries and of the package.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "Python's name")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
