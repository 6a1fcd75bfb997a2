//! Advice on faults of measurement files.

use documents::hint::{Explain, Hint};
use spectra::csv_table::CsvTableError;
use spectra::instrument::MeasuredQuantity;

use super::error::{MeasurementError, k1_below};

impl Explain for MeasurementError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new(match self {
            Self::Instrument(error) => return error.hint(),
            Self::Sheet(CsvTableError::MissingColumn { .. }) => {
                "one row names the columns: sample (or Name, Sample ID ..), film, backing, one per pigment, then wavelengths such as 400".into()
            }
            Self::RepeatedColumn { .. } | Self::RepeatedWavelength { .. } => {
                "remove or rename one of the two columns".into()
            }
            Self::UnorderedWavelength { .. } => {
                "order the wavelength columns from short to long".into()
            }
            Self::Sheet(CsvTableError::RowLength { wanted, found, .. }) if found > wanted => {
                "numbers take a decimal point; a decimal comma splits a cell in two".into()
            }
            Self::Sheet(CsvTableError::RowLength { .. }) => {
                "the row may be cut off; write empty cells as `,,`".into()
            }
            Self::Sheet(CsvTableError::Cell { text, .. }) if text.contains(',') => {
                "numbers have a decimal point, or a decimal comma in every reading of the file".into()
            }
            Self::Sheet(CsvTableError::Cell { wanted: "a reflectance", text, .. })
                if text.is_empty() =>
            {
                "fill in the reading, or remove the row of a sample that was not read".into()
            }
            Self::Sheet(CsvTableError::Cell { wanted: "an amount of pigment", .. }) => {
                "a column that is neither known nor a wavelength is read as a pigment; if it is none, name those that are: [pigments=NAME]".into()
            }
            Self::NoTable { .. } => {
                "a pigment library is read by mix, quadrature and library; fit, validate and color read CSV".into()
            }
            Self::Contradiction { .. } => {
                "one name is one sample; rename one of the two, or give both the same amounts".into()
            }
            Self::WavelengthRange { .. } => "a pigment's name must not be a number".into(),
            Self::Grid { .. } => "fit files of different wavelengths one by one".into(),
            Self::MixedScale { .. } => {
                "write all readings in one unit, or set [percent] if this sample really is that dark".into()
            }
            Self::Reflectance { .. } => {
                "set [percent] or [fraction] if the unit was recognised wrongly; a dark reading below 0 means that the instrument's zero is off".into()
            }
            Self::Noise { .. } => {
                "the file may hold a detector's counts ([white_reading=FILE] [dark_reading=FILE]), or another unit ([percent], [fraction])".into()
            }
            Self::BelowSurface { least, k2, .. } => format!(
                "give a k1 below every reading, such as [saunderson={:.3},{k2}], or read such samples as black: [below_surface=floor]",
                k1_below(*least)
            ),
            Self::MostBelowSurface { below_all, .. } => format!(
                "readings in fractions (white near 1) take [fraction]; for a surface that reflects less, give its k1 and k2, such as [saunderson={below_all}]"
            ),
            Self::DarkerOverBrighter(film) => format!(
                "paint cannot do this; {} and {} may be exchanged in the column `backing`, or leave the sample out: [exclude={}]",
                film.bright, film.dark, film.sample
            ),
            Self::NoPigmentColumn { .. } => {
                "[pigments=NAME] takes the heading of a column, once for each pigment".into()
            }
            Self::NoBareBacking { backing, .. } if backing.is_empty() => {
                "add a row with the reading of the bare card or paper, and a column `film` with `none` in it and `paint` in the others; more than one card takes a column `backing` too. A file of recipes may have these columns instead: [recipes=FILE.csv]".into()
            }
            Self::NoBareBacking { backing, .. } => format!(
                "add a row with film `none` and backing `{backing}`: the card without paint"
            ),
            Self::NoFilms => {
                "a film has `paint` (or nothing) in the column film, and amounts in the pigment columns".into()
            }
            Self::NoRecipe { has_cards: false, .. } => {
                "if it is a bare card or paper, say so in a column `film`: `none` for it, `paint` for the others; else write its amounts in the pigment columns. A file of recipes may have both: [recipes=FILE.csv]".into()
            }
            Self::NoRecipe { .. } => {
                "write the amounts in the pigment columns, or in a file of recipes ([recipes=FILE.csv]); film `none` is a bare card".into()
            }
            Self::NoReflectance { quantity, .. } => match quantity {
                MeasuredQuantity::Counts => {
                    "counts need a white and a dark reading: [white_reading=FILE] [dark_reading=FILE]"
                }
                MeasuredQuantity::Power => "the light of a lamp is read by [illuminant=FILE]",
                MeasuredQuantity::Transmittance => {
                    "if it was read over a white tile, set [as_reflectance]"
                }
                _ => "export reflectance from the instrument's program",
            }
            .into(),
            Self::Apart { .. } => "read them as files of their own".into(),
            Self::AboveWhite { .. } => {
                "set [percent] or [fraction] if the unit was recognised wrongly".into()
            }
            Self::Sheet(CsvTableError::Cell { .. })
            | Self::Empty { .. }
            | Self::UnnamedColumn { .. }
            | Self::Band { .. } => return None,
        }))
    }
}
