//! Options of `merge` and `convert` for resampling curves to another grid.

use clap::{Args, ValueEnum};
use spectra::{Extrapolation, Grid, Interpolation};

use crate::failure::{Failure, Result};

#[derive(Debug, Clone, Copy, ValueEnum)]
enum InterpolationName {
    /// Straight lines, which never overshoot
    Linear,
    /// Sprague's polynomial, for smooth curves; clipped at 0
    Sprague,
}

/// Options for resampling K and S to another grid.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct ResamplingOptions {
    /// Interpolation of K and S on another grid [default: sprague, linear below six wavelengths]
    #[arg(long, value_enum)]
    interpolation: Option<InterpolationName>,
    /// Continue the end values beyond a library's band instead of failing
    #[arg(long)]
    hold_ends: bool,
}

impl ResamplingOptions {
    /// Interpolation given by the option; `None` if it is absent.
    pub(super) fn method(self) -> Option<Interpolation> {
        self.interpolation.map(|name| match name {
            InterpolationName::Linear => Interpolation::Linear,
            InterpolationName::Sprague => Interpolation::Sprague,
        })
    }

    /// Treatment of wavelengths beyond a library's band.
    pub(super) fn ends(self) -> Extrapolation {
        if self.hold_ends { Extrapolation::Hold } else { Extrapolation::Refuse }
    }
}

/// Parses a grid `START,END,STEP` in nm.
pub(super) fn parse_grid(text: &str) -> Result<Grid> {
    let invalid = || {
        Failure::usage(
            format!(
                "--grid takes START,END,STEP in nm, END a whole number of steps from START, found `{text}`"
            ),
            "try --grid 400,700,10",
        )
    };
    let numbers = text.split(',').map(|part| part.trim().parse::<f64>());
    let numbers = numbers.collect::<Result<Vec<f64>, _>>().map_err(|_| invalid())?;
    let &[start, end, step] = numbers.as_slice() else { return Err(invalid()) };
    let steps = (end - start) / step;
    if !(0.0..=100_000.0).contains(&steps) || (steps - steps.round()).abs() > 1e-6 {
        return Err(invalid());
    }
    Ok(Grid::from_nm(start, step, steps.round() as usize + 1)?)
}
