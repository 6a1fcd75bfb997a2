//! Options that several verbs share, and what they read; for measurements see `readings`.

use std::path::Path;

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;
use calibrate::visible_band::check_visible_band;
use clap::Args;
use spectra::color::{Adaptation, Rgb, RgbSpace, Xyz};
use spectra::{Grid, Observer, TristimulusWeights, light_from_text};

use crate::console::Console;
use crate::failure::Result;

/// Light and observer.
#[derive(Debug, Clone, Args)]
pub(crate) struct ViewingOptions {
    /// Light: a CIE illuminant (D65, A, FL11, LED-B3 ..), a black body (5600K), daylight (D5600K),
    /// or a lamp's file: an instrument's (FILE#NAME for one of several spectra), or lines `nm,power`
    ///
    /// Power of any unit. Noise below zero, down to -1 % of the peak, counts as no power.
    #[arg(long, value_name = "LIGHT", default_value = "D65")]
    illuminant: String,
    /// Observer: 1931-2 (or 2), 1964-10 (or 10), 2015-2, 2015-10
    #[arg(long, value_name = "NAME", default_value = "1931-2")]
    observer: String,
}

impl ViewingOptions {
    pub(crate) fn viewing(&self) -> Result<Viewing> {
        viewing(&self.illuminant, &self.observer)
    }
}

/// A light and an observer by their names.
pub(crate) fn viewing(illuminant: &str, observer: &str) -> Result<Viewing> {
    Ok(Viewing { illuminant: light_from_text(illuminant)?, observer: Observer::named(observer)? })
}

/// sRGB of a colour, for a patch and a hex code.
pub(crate) fn srgb(xyz: Xyz, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford)
}

/// The weights for colours of spectra on `grid`; warns where much of the visible
/// band is not measured.
pub(crate) fn color_weights(
    viewing: &Viewing,
    grid: Grid,
    console: &mut Console<'_>,
) -> Result<TristimulusWeights> {
    remark_coverage(grid, console)?;
    Ok(viewing.weights(grid)?)
}

/// Refuses a grid that misses the visible band, and warns of one that covers
/// little of it.
pub(crate) fn remark_coverage(grid: Grid, console: &mut Console<'_>) -> Result<()> {
    console.remarks(&check_visible_band(grid)?)
}

/// The pigment library in a file.
pub(crate) fn library(path: &Path) -> Result<PigmentLibrary> {
    Ok(PigmentLibrary::open(path)?)
}

/// The oils of Van Gogh's palette that ship with the program.
pub(crate) fn built_in_library() -> PigmentLibrary {
    PigmentLibrary::van_gogh_oils()
}

pub(crate) fn unreadable(path: &Path) -> String {
    format!("{}: cannot be read", path.display())
}
