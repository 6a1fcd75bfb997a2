//! Lights measured by an instrument.

use crate::grid::Grid;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::instrument::{
    ChoiceError, Format, InstrumentError, MeasuredQuantity, MeasuredSpectrum, choose_spectrum, read,
};
use crate::irregular::IrregularSpectrum;
use documents::hint::{Explain, Hint};

/// Negative power down to minus this fraction of the peak counts as noise of the spectrometer
/// (chosen by eye).
const NEGATIVE_NOISE: f64 = 0.01;

/// Band in nm that a lamp must be measured in: it holds nearly all of the luminance and chroma.
const NEEDED_NM: [f64; 2] = [420.0, 680.0];

/// A light from `bytes`, the content of `file`, in any format of [`Format`] or as two columns
/// `nm, power`. The format is detected from the content.
///
/// Power may be in any unit, at any wavelengths from 420 nm or less to 680 nm or more; outside them the
/// end values are held. From
/// 360 to 830 nm negative power down to -1 % of the peak is set to 0 as noise. `spectrum`
/// selects one of several spectra by name. The light is called `file`, or `file#spectrum`.
///
/// # Errors
/// [`LampError`] if the file is faulty or does not hold exactly one such spectrum of power.
///
/// ```
/// let lamp = spectra::lamp_from_bytes("desk.csv", b"nm,power\n400,1\n700,3\n", None).unwrap();
/// assert_eq!(lamp.name(), "desk.csv");
/// ```
pub fn lamp_from_bytes(
    file: &str,
    bytes: &[u8],
    spectrum: Option<&str>,
) -> Result<Illuminant, LampError> {
    let spectra = match read(file, bytes, None) {
        // Very short files are not recognised as columns; reading them as such gives a better
        // error.
        Err(InstrumentError::Unrecognised { .. }) => read(file, bytes, Some(Format::Columns)),
        known => known,
    }?
    .spectra;
    let measured = choose_spectrum(file, &spectra, spectrum)?;
    let name = spectrum.map_or_else(|| file.to_owned(), |spectrum| format!("{file}#{spectrum}"));
    Ok(Illuminant::from_samples(&name, &power(file, measured)?)?)
}

fn power(file: &str, measured: &MeasuredSpectrum) -> Result<IrregularSpectrum, LampError> {
    let file = file.to_owned();
    let name = measured.name.clone();
    let found = match measured.quantity {
        MeasuredQuantity::Unstated if measured.is_relative_to_white() => {
            MeasuredQuantity::Reflectance
        }
        stated => stated,
    };
    if !matches!(found, MeasuredQuantity::Power | MeasuredQuantity::Unstated) {
        return Err(LampError::Quantity { file, name, found });
    }
    let nm = &measured.wavelengths_nm;
    if nm.len() < 2 {
        return Err(LampError::TooShort { file, count: nm.len() });
    }
    let start_nm = nm[0];
    let end_nm = nm[nm.len() - 1];
    let band = Grid::cie();
    let within = || nm.iter().zip(&measured.values).filter(|(nm, _)| band.covers(**nm));
    let peak = within().fold(0.0, |most: f64, (_, &power)| most.max(power));
    if let Some((&nm, &power)) = within().find(|(_, power)| **power < -NEGATIVE_NOISE * peak) {
        return Err(LampError::Power { file, name, nm, power });
    }
    if start_nm > NEEDED_NM[0] || end_nm < NEEDED_NM[1] {
        return Err(LampError::Band { file, start_nm, end_nm });
    }
    let values = measured.values.iter().map(|power| power.max(0.0)).collect();
    Ok(IrregularSpectrum::new(nm.clone(), values).map_err(IlluminantError::from)?)
}

/// The file of a lamp that cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LampError {
    /// The file cannot be read as any format.
    #[error(transparent)]
    Instrument(#[from] InstrumentError),
    /// The file has several spectra and none is selected, or none of the selected name.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// The spectrum is not that of a light.
    #[error("{file}: `{name}` must be the power of a lamp, found `{found}`")]
    Quantity {
        /// Path of the file.
        file: String,
        /// Name of the spectrum.
        name: String,
        /// Quantity of the spectrum.
        found: MeasuredQuantity,
    },
    /// A power is negative by more than noise.
    #[error("{file}: power of `{name}` at {nm} nm must be 0 and up, found `{power}`")]
    Power {
        /// Path of the file.
        file: String,
        /// Name of the spectrum.
        name: String,
        /// Wavelength in nm.
        nm: f64,
        /// Power at the wavelength, in the unit of the file.
        power: f64,
    },
    /// The spectrum has fewer than two wavelengths.
    #[error("{file}: a lamp needs at least 2 wavelengths, found `{count}`")]
    TooShort {
        /// Path of the file.
        file: String,
        /// Number of wavelengths.
        count: usize,
    },
    /// Much of the visible band is not measured; the file may use another unit.
    #[error(
        "{file}: a lamp must be measured from {} to {} nm or beyond, found `{start_nm}` to `{end_nm}` nm", NEEDED_NM[0], NEEDED_NM[1]
    )]
    Band {
        /// Path of the file.
        file: String,
        /// First wavelength in nm.
        start_nm: f64,
        /// Last wavelength in nm.
        end_nm: f64,
    },
    /// The values do not form a light.
    #[error(transparent)]
    Light(#[from] IlluminantError),
}

impl Explain for LampError {
    fn hint(&self) -> Option<Hint> {
        let sentence = match self {
            Self::Choice(error) => return error.hint(),
            Self::Instrument(
                InstrumentError::Unrecognised { .. } | InstrumentError::Empty { .. },
            ) => "a lamp is a file of an instrument, or two columns `nm,power`",
            Self::Instrument(error) => return error.hint(),
            Self::Quantity { found: MeasuredQuantity::Counts, .. } => {
                "counts hold the detector's own response: export irradiance, radiance or power"
            }
            Self::Quantity { .. } => {
                "a lamp is a spectrum of power, irradiance or radiance; a reflectance is seen under one"
            }
            Self::Power { .. } => {
                "only noise down to -1 % of the peak is taken as 0: measure again, or cut the file"
            }
            Self::Band { .. } => {
                "wavelengths are in nm; only beyond this band are the end values of a file held"
            }
            Self::Light(error) => return error.hint(),
            Self::TooShort { .. } => return None,
        };
        Some(Hint::new(sentence))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lamp(text: &str) -> Result<Illuminant, LampError> {
        lamp_from_bytes("l", text.as_bytes(), None)
    }

    fn at(lamp: &Illuminant, nm: usize) -> f64 {
        lamp.power().values()[nm - 360]
    }

    #[test]
    fn two_columns_with_header_and_comments_are_read() {
        for text in [
            "# lamp\nnm;power\n400;1\n500;2\n700;4\n",
            "nm\tpower\n400\t1\n500\t2\n700\t4\n",
            "400 , 1\n500 , 2\n700 , 4\n",
            "700,4\n500,2\n400,1\n",
        ] {
            let lamp = lamp(text).unwrap();
            let found = [360, 450, 600, 800].map(|nm| at(&lamp, nm));
            assert_eq!(found, [1.0, 1.5, 3.0, 4.0], "{text}");
        }
    }

    #[test]
    fn faults_name_the_line() {
        for (text, line) in
            [("400,1\n390,2\n420,1\n", 3), ("400,1\n410,x\n", 2), ("400,1\n400\n", 2)]
        {
            let error = lamp(text).unwrap_err().to_string();
            assert!(error.starts_with(&format!("l, line {line}: ")), "{error}");
        }
        assert!(matches!(lamp("400,1\n"), Err(LampError::TooShort { count: 1, .. })));
        let prose = lamp("dear reader\n").unwrap_err();
        assert!(prose.hint().is_some_and(|hint| hint.to_string().contains("nm,power")), "{prose}");
    }

    #[test]
    fn negative_noise_is_set_to_zero_and_more_is_refused() {
        let noisy = lamp("350,-50\n400,-0.9\n500,100\n700,50\n").unwrap();
        assert_eq!((at(&noisy, 400), at(&noisy, 500)), (0.0, 100.0));
        let refused = lamp("400,-1.1\n500,100\n").unwrap_err().to_string();
        assert_eq!(refused, "l: power of `l` at 400 nm must be 0 and up, found `-1.1`");
    }

    #[test]
    fn one_of_several_spectra_is_selected_by_name() {
        let text = b"nm;desk;shop\n400;1;3\n700;2;6\n";
        let error = lamp_from_bytes("l", text, None).unwrap_err();
        assert_eq!(error.hint().unwrap().to_string(), "name one: \"l#desk\" or \"#shop\"");
        let shop = lamp_from_bytes("l", text, Some("shop")).unwrap();
        assert_eq!((at(&shop, 400), shop.name()), (3.0, "l#shop"));
        let error = lamp_from_bytes("l", text, Some("hall")).unwrap_err();
        assert_eq!(error.hint().unwrap().to_string(), "spectra: desk, shop");
    }

    #[test]
    fn other_quantities_than_power_are_refused() {
        for (heading, word) in [("reflectance", "radiance"), ("counts", "export irradiance")] {
            let error = lamp(&format!("nm,{heading}\n400,1\n500,2\n")).unwrap_err();
            assert!(error.to_string().contains(heading), "{error}");
            assert!(error.hint().is_some_and(|hint| hint.to_string().contains(word)), "{error}");
        }
    }

    #[test]
    fn a_lamp_that_is_not_measured_in_the_visible_band_is_refused() {
        for text in [
            "500,1\n510,1\n",
            "801,1\n2499,1\n",
            "300,1\n380,2\n",
            "430,1\n700,1\n",
            "400,1\n670,1\n",
        ] {
            let refused = lamp(text).unwrap_err();
            assert!(matches!(refused, LampError::Band { .. }), "{text}: {refused}");
            assert!(refused.to_string().contains("420 to 680 nm"), "{refused}");
        }
    }

    #[test]
    fn readings_relative_to_a_white_are_no_lamp() {
        let processed = "SpectraSuite Data File\nReference Spectrum Present: Yes\n\
            Number of Pixels in Processed Spectrum: 2\n>>>>>Begin Processed Spectral Data<<<<<\n\
            400\t50\n700\t60\n";
        let table = "BEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_PCT400 SPECTRAL_PCT700\n\
            END_DATA_FORMAT\nBEGIN_DATA\nA 40 50\nEND_DATA\n";
        let printed = "CTI3\nDEVICE_CLASS \"OUTPUT\"\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPEC_400 SPEC_700\n\
            END_DATA_FORMAT\nBEGIN_DATA\nA 40 50\nEND_DATA\n";
        for text in [processed, table, printed, "nm,%R\n400,50\n700,60\n"] {
            let refused = lamp(text).unwrap_err().to_string();
            assert!(refused.contains("found `reflectance`"), "{text}: {refused}");
        }
    }
}
