//! How curves are brought to other wavelengths, as `merge` and `convert` share it.

use clap::{Args, ValueEnum};
use spectra::{Extrapolation, Grid, Interpolation};

use crate::failure::{Failure, Result};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum InterpolationName {
    /// Straight lines, which never overshoot
    Linear,
    /// Sprague's polynomial, for smooth curves; cut off at 0
    Sprague,
}

/// How curves are brought to another grid.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct ResamplingOptions {
    /// How K and S are brought to another grid [default: sprague, linear below six wavelengths]
    #[arg(long, value_enum)]
    interpolation: Option<InterpolationName>,
    /// Hold the end values beyond a library's band rather than refuse
    #[arg(long)]
    hold_ends: bool,
}

impl ResamplingOptions {
    /// `None` if not told.
    pub(super) fn method(self) -> Option<Interpolation> {
        self.interpolation.map(|name| match name {
            InterpolationName::Linear => Interpolation::Linear,
            InterpolationName::Sprague => Interpolation::Sprague,
        })
    }

    pub(super) fn ends(self) -> Extrapolation {
        if self.hold_ends { Extrapolation::Hold } else { Extrapolation::Refuse }
    }
}

/// The grid `START,END,STEP` in nm.
pub(super) fn grid(text: &str) -> Result<Grid> {
    let wrong = || {
        Failure::usage(
            format!(
                "--grid takes START,END,STEP in nm, END a whole number of steps on, found `{text}`"
            ),
            "try --grid 400,700,10",
        )
    };
    let numbers = text.split(',').map(|part| part.trim().parse::<f64>());
    let numbers = numbers.collect::<Result<Vec<f64>, _>>().map_err(|_| wrong())?;
    let &[start, end, step] = numbers.as_slice() else { return Err(wrong()) };
    let steps = (end - start) / step;
    if !(0.0..=100_000.0).contains(&steps) || (steps - steps.round()).abs() > 1e-6 {
        return Err(wrong());
    }
    Ok(Grid::from_nm(start, step, steps.round() as usize + 1)?)
}
