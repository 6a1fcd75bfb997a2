//! Formats of measurement files, and options of reading them.

use spectra::instrument::Format;
use spectra::referencing::ReferenceFiles;

use crate::measurement::ScaleChoice;

/// Format of a measurement file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReadingFormat {
    /// The measurement CSV: columns `sample`, `film`, `backing`, one for each pigment, wavelengths.
    Csv,
    /// A file as an instrument writes it.
    Instrument(Format),
}

impl ReadingFormat {
    /// Name of the CSV among the formats.
    pub const CSV_NAME: &'static str = "csv";

    /// Names of all formats.
    pub fn names() -> impl Iterator<Item = &'static str> {
        std::iter::once(Self::CSV_NAME).chain(Format::ALL.into_iter().map(Format::name))
    }

    /// The format with this name; `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name == Self::CSV_NAME {
            return Some(Self::Csv);
        }
        Format::named(name).map(Self::Instrument)
    }
}

/// Options of [`Readings::open_all`](crate::Readings::open_all). The defaults read every file as it describes itself.
#[derive(Debug, Clone, Default)]
pub struct ReadingOptions {
    /// Format of the files. Default: detected from the content of each.
    pub format: Option<ReadingFormat>,
    /// Percent or fraction. Default: what the file states, else what its largest value suggests.
    pub scale: ScaleChoice,
    /// Headings of the columns that are pigments. Default: every column of a CSV that is not known as
    /// something else and holds amounts.
    pub pigments: Option<Vec<String>>,
    /// Whether transmittance counts as reflectance, for spectrometers that measured in transmission
    /// mode over a white tile. Counts and powers of lamps never do.
    pub transmittance_is_reflectance: bool,
    /// White, dark and tile with which counts are converted to reflectances. Default: the files hold
    /// reflectances.
    pub references: Option<ReferenceFiles>,
}
