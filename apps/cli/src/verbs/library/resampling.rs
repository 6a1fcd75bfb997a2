//! Options of `merge` and `convert` for resampling curves to another grid.

use clap::{Args, ValueEnum};
use spectra::{Extrapolation, Interpolation};

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
