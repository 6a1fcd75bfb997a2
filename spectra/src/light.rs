//! Lights by name, temperature or file: daylight of any correlated colour temperature, black-body radiators
//! (Planck's law), and lamps measured by an instrument.

use std::path::Path;
use std::sync::OnceLock;

use documents::file::{self, FileError};
use documents::hint::Explain;

use crate::grid::Grid;
use crate::illuminant;
use crate::illuminant::{Illuminant, IlluminantError};
use crate::instrument::{
    ChoiceError, FileOptions, Format, InstrumentError, MeasuredQuantity, MeasuredSpectrum,
    bytes_of, choose_spectrum, read_with, split_file_and_name, split_file_and_sheet,
};
use crate::interpolate::Extrapolation;
use crate::spectrum::IrregularSpectrum;

/// Returns the light that `text` names.
///
/// | text | light |
/// |---|---|
/// | `D65`, `FL11`, `LED-B3` .. | a CIE illuminant, [`Illuminant::named`] |
/// | `5600K` | a black body, [`black_body`] |
/// | `D5600K` | CIE daylight, [`daylight`] |
/// | `FILE`, `FILE#NAME` | a file of an instrument, [`lamp_from_bytes`] |
///
/// # Errors
/// [`LightError`] if `text` is none of these, or the file is faulty.
///
/// ```
/// let bulb = spectra::light_from_text("5600K").unwrap();
/// assert_eq!(bulb.name(), "black body 5600 K");
/// ```
pub fn light_from_text(text: &str) -> Result<Illuminant, LightError> {
    light_from_text_with(text, &FileOptions::default())
}

/// Returns the light that `text` names, as [`light_from_text`], with what you know about the file of a lamp.
///
/// # Errors
/// [`LightError`] if `text` is none of these, or the file is faulty.
pub fn light_from_text_with(text: &str, options: &FileOptions) -> Result<Illuminant, LightError> {
    if let Ok(known) = Illuminant::named(text) {
        return Ok(known);
    }
    if let Some(number) = text.strip_suffix(['K', 'k']) {
        if let Ok(kelvin) = number.parse() {
            return Ok(black_body(kelvin)?);
        }
        if let Some(Ok(kelvin)) = number.strip_prefix(['D', 'd']).map(str::parse) {
            return Ok(daylight(kelvin)?);
        }
    }
    let (file, spectrum) = split_file_and_name(text);
    if !file::is_there(Path::new(split_file_and_sheet(file).0)) {
        if file::looks_like_path(text) {
            file::read(Path::new(file))?;
        }
        return Err(LightError::Unknown(text.to_owned()));
    }
    Ok(lamp_from_bytes_with(file, &bytes_of(file)?, spectrum, options)?)
}

/// A text that does not name a light.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum LightError {
    /// The text is neither a name, a temperature nor the path of a file.
    #[error("neither a CIE illuminant, a temperature nor a file of a lamp: `{0}`")]
    #[hint(
        verbatim,
        "{}use a name such as D65, A, FL11 or LED-B3, a black body as 5600K, daylight as D5600K (4000 to 25000), or the path of a lamp's file (an instrument's, or two columns `nm,power`)",
        did_you_mean(_0)
    )]
    #[fault(Setting)]
    Unknown(String),
    /// The file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// The file of the lamp is faulty.
    #[error(transparent)]
    Lamp(#[from] LampError),
    /// The temperature is outside the defined range.
    #[error(transparent)]
    #[fault(Setting)]
    Illuminant(#[from] IlluminantError),
}

/// Names of lights that sellers and older tables use, each with its CIE name or temperature. TL84,
/// TL83, CWF and the like are lamps of viewing booths. The lamp U35 has 3500 K, between FL12 and
/// FL11.
const OTHER_NAMES: [(&str, &str); 15] = [
    ("TL84", "FL11"),
    ("TL83", "FL12"),
    ("TL85", "FL10"),
    ("U30", "FL12"),
    ("U40", "FL11"),
    ("U50", "FL10"),
    ("CWF", "FL2"),
    ("WWF", "FL4"),
    ("INCA", "A"),
    ("INC", "A"),
    ("TUNGSTEN", "A"),
    ("DAYLIGHT", "D65"),
    ("HORIZON", "2300K"),
    ("LED", "LED-B3"),
    ("CIE A", "A"),
];

/// The question whether you mean another light, with a space behind it. It is empty if no name is
/// similar.
fn did_you_mean(text: &str) -> String {
    let letters = text.trim().to_uppercase();
    if let Ok(kelvin) = text.trim().parse::<f64>()
        && (500.0..=25_000.0).contains(&kelvin)
    {
        let daylight = if kelvin >= 4000.0 { format!(" or D{kelvin}K") } else { String::new() };
        let d65 = if kelvin == 6500.0 { " or D65" } else { "" };
        return format!("did you mean {kelvin}K{daylight}{d65}? ");
    }
    let known = OTHER_NAMES.iter().find(|(other, _)| *other == letters);
    // A path is not a name.
    let is_name = !text.contains(['/', '\\', '.', '#']);
    // F1 to F12 are FL1 to FL12 since CIE 15:2018.
    let fluorescent = letters.strip_prefix('F').map(|number| format!("FL{number}"));
    let fluorescent = fluorescent.filter(|name| Illuminant::names().any(|known| known == name));
    let question = match known {
        _ if fluorescent.is_some() => fluorescent.map(|name| format!("did you mean {name}?")),
        Some((_, name)) => Some(format!("did you mean {name}?")),
        None if is_name => documents::did_you_mean(text, Illuminant::names()),
        None => None,
    };
    question.map_or_else(String::new, |question| question + " ")
}

/// We take negative power down to minus this fraction of the peak for noise of the spectrometer
/// (chosen by eye).
const NEGATIVE_NOISE: f64 = 0.01;

/// You must measure a lamp in this band in nm, which holds nearly all of the luminance and chroma.
const NEEDED_NM: [f64; 2] = [420.0, 680.0];

/// A light from `bytes`, the content of `file`, in any format of [`Format`] or as two columns
/// `nm, power`. This detects the format from the content.
///
/// Power may be in any unit, or a number of photons, which we divide by wavelength, at any wavelengths from 420 nm or less to 680 nm or more. Outside them
/// the end values count. Between them we interpolate by smoothness ([`Illuminant::from_lamp`]). From 360 to 830 nm we set negative power down to -1 % of the peak to 0,
/// because it is noise. If the file holds several spectra, name one in `spectrum`. The light is
/// called `file`, or `file#spectrum`.
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
    lamp_from_bytes_with(file, bytes, spectrum, &FileOptions::default())
}

/// A light from `bytes`, the content of `file`, as [`lamp_from_bytes`], with what you know about the file.
///
/// # Errors
/// [`LampError`] if the file is faulty or does not hold exactly one such spectrum of power.
pub fn lamp_from_bytes_with(
    file: &str,
    bytes: &[u8],
    spectrum: Option<&str>,
    options: &FileOptions,
) -> Result<Illuminant, LampError> {
    let spectra = match read_with(file, bytes, options) {
        // Very short files are not recognised as columns. Reading them as such gives a better
        // error.
        Err(InstrumentError::Unrecognised(..)) => {
            let format = Some(Format::Columns);
            read_with(file, bytes, &FileOptions { format, ..options.clone() })
        }
        known => known,
    }?
    .spectra;
    let measured = choose_spectrum(file, &spectra, spectrum)?;
    let name = spectrum.map_or_else(|| file.to_owned(), |spectrum| format!("{file}#{spectrum}"));
    let mut remarks: Vec<String> =
        measured.remarks.iter().map(|remark| format!("{name}: {remark}")).collect();
    if measured.quantity == MeasuredQuantity::Photons {
        remarks.push(format!("{name}: numbers of photons are divided by wavelength to give power"));
    }
    Ok(Illuminant::from_lamp(&name, &power(file, measured)?)?.with_remarks(remarks))
}

fn power(file: &str, measured: &MeasuredSpectrum) -> Result<IrregularSpectrum, LampError> {
    use MeasuredQuantity::{Photons, Power, Reflectance, Unknown, Unstated};
    let file = file.to_owned();
    let name = measured.name.clone();
    let found = match measured.quantity {
        Unstated if measured.is_relative_to_white() => Reflectance,
        stated => stated,
    };
    // Relative power is often exported in arbitrary units.
    if !matches!(found, Photons | Power | Unknown | Unstated) {
        return Err(LampError::Quantity { file, name, found });
    }
    let nm = &measured.wavelengths_nm;
    if nm.len() < 2 {
        return Err(LampError::TooShort { file, count: nm.len() });
    }
    let start_nm = nm[0];
    let end_nm = nm[nm.len() - 1];
    let band = Grid::cie();
    let mut within = nm.iter().zip(&measured.values).filter(|(nm, _)| band.covers(**nm));
    let peak = within.clone().fold(0.0, |most: f64, (_, &power)| most.max(power));
    if let Some((&nm, &power)) = within.find(|(_, power)| **power < -NEGATIVE_NOISE * peak) {
        return Err(LampError::Power { file, name, nm, power });
    }
    if start_nm > NEEDED_NM[0] || end_nm < NEEDED_NM[1] {
        return Err(LampError::Band { file, start_nm, end_nm });
    }
    // A photon has an energy of h c / wavelength. Power is relative, so we leave the constants out.
    let energy = |nm: f64| if found == Photons { 560.0 / nm } else { 1.0 };
    let values = nm.iter().zip(&measured.values);
    let values = values.map(|(&nm, power)| power.max(0.0) * energy(nm)).collect();
    Ok(IrregularSpectrum::new(nm.clone(), values).map_err(IlluminantError::from)?)
}

/// We cannot use the file of a lamp.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum LampError {
    /// The file cannot be read as any format.
    #[error(transparent)]
    #[hint(
        if matches!(_0, InstrumentError::Unrecognised(..) | InstrumentError::Empty { .. }),
        "a lamp is a file of an instrument, or two columns `nm,power`"
    )]
    #[hint(inner)]
    Instrument(#[from] InstrumentError),
    /// The file has several spectra and none is selected, or none of the selected name.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// The spectrum does not belong to a light.
    #[error("{file}: `{name}` must be the power of a lamp, found `{found}`")]
    #[hint(
        if *found == MeasuredQuantity::Counts,
        "counts hold the detector's own response: export irradiance, radiance or power"
    )]
    #[hint(
        "a lamp is a spectrum of power, irradiance or radiance; a reflectance is seen under one; if the heading misleads, set [values=power]"
    )]
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
    #[hint("only noise down to -1 % of the peak is taken as 0: measure again, or cut the file")]
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
    /// The file lacks much of the visible band. It may use another unit.
    #[error(
        "{file}: a lamp must be measured from {} to {} nm or beyond, found `{start_nm}` to `{end_nm}` nm", NEEDED_NM[0], NEEDED_NM[1]
    )]
    #[hint("wavelengths are in nm; only beyond this band are the end values of a file held")]
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

/// CIE daylight of the correlated colour temperature `kelvin`, 4000 to 25000.
///
/// CIE 15:2018, section 4.1.2: the chromaticity gives the weights M1 and M2 of the three tabulated
/// components. We do not round them to three places, as the CIE does for the tabulated D50 to D75
/// (see [`Illuminant::named`]). The temperature is on the present scale: for example, D65 has
/// 6503.616 K (6500 x 1.4388 / 1.4380), about 6504 K.
///
/// # Errors
/// [`IlluminantError::Temperature`] outside 4000 to 25000 K, where the CIE does not define
/// daylight.
pub fn daylight(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let name = format!("daylight {kelvin} K");
    if !(4000.0..=25000.0).contains(&kelvin) {
        return Err(IlluminantError::Temperature(kelvin));
    }
    let (x, y) = daylight_chromaticity(kelvin);
    let m = 0.0241 + 0.2562 * x - 0.7341 * y;
    let m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m;
    let m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m;
    let [s0, s1, s2] = components();
    Illuminant::from_function(&name, |nm| {
        let [s0, s1, s2] =
            [s0, s1, s2].map(|s| s.at_linear(nm, Extrapolation::Hold).unwrap_or(0.0));
        (s0 + m1 * s1 + m2 * s2).max(0.0)
    })
}

/// CIE 1931 chromaticity (x, y) of daylight of temperature `kelvin` (CIE 15:2018, equations 4.1 to
/// 4.3). This is valid from 4000 to 25000 K.
#[must_use]
pub fn daylight_chromaticity(kelvin: f64) -> (f64, f64) {
    let t = 1000.0 / kelvin;
    let x = if kelvin <= 7000.0 {
        ((-4.6070 * t + 2.9678) * t + 0.09911) * t + 0.244063
    } else {
        ((-2.0064 * t + 1.9018) * t + 0.24748) * t + 0.237040
    };
    (x, -3.0 * x * x + 2.87 * x - 0.275)
}

fn components() -> &'static [IrregularSpectrum; 3] {
    static TABLE: OnceLock<[IrregularSpectrum; 3]> = OnceLock::new();
    TABLE.get_or_init(|| {
        let columns = illuminant::columns(include_str!("../data/daylight-components.csv"));
        ["S0", "S1", "S2"].map(|name| {
            let (nm, values) = illuminant::filled(&columns, name).expect("a shipped component");
            IrregularSpectrum::new(nm, values).expect("shipped wavelengths rise")
        })
    })
}

/// The second radiation constant c2 in m K, with the value of CIE 15:2018, section 4.1.1
/// (ITS-90). The exact SI value, 0.014387769, differs by 2 parts in a million.
pub const SECOND_RADIATION_CONSTANT: f64 = 1.4388e-2;

/// A black body of temperature `kelvin`, with relative power 100 at 560 nm. The "5600 K bulb"
/// of Baxter, Wendt and Lin 2004 is `black_body(5600.0)`.
///
/// # Errors
/// [`IlluminantError::Temperature`] unless the temperature is finite and at least 500 K (below,
/// the visible power underflows double precision).
pub fn black_body(kelvin: f64) -> Result<Illuminant, IlluminantError> {
    let name = format!("black body {kelvin} K");
    if !(kelvin.is_finite() && kelvin >= 500.0) {
        return Err(IlluminantError::Temperature(kelvin));
    }
    Illuminant::from_function(&name, |nm| 100.0 * planck(nm, kelvin) / planck(560.0, kelvin))
}

fn planck(nm: f64, kelvin: f64) -> f64 {
    nm.powi(-5) / (SECOND_RADIATION_CONSTANT / (nm * 1e-9 * kelvin)).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_trade_and_bare_temperatures_are_understood() {
        for (text, wanted) in [
            ("F11", "did you mean FL11? use"),
            ("TL84", "did you mean FL11? use"),
            ("cwf", "did you mean FL2? use"),
            ("LED-C3", "did you mean LED-B3 or "),
            ("6500", "did you mean 6500K or D6500K or D65? use"),
            ("5000", "did you mean 5000K or D5000K? use"),
            ("3000", "did you mean 3000K? use"),
            // Neither temperatures of lights nor names.
            ("400", "use a name"),
            ("30000", "use a name"),
            ("no/such/lamp.csv", "check that the file"),
            ("./LED-B3", "check that the file"),
        ] {
            assert!(hint_of(text).starts_with(wanted), "{text}: {}", hint_of(text));
        }
        // There is no FL13.
        assert!(!hint_of("F13").contains("FL13"), "{}", hint_of("F13"));
        for (other, name) in OTHER_NAMES {
            assert!(light_from_text(name).is_ok(), "{name}");
            assert!(hint_of(other).starts_with(&format!("did you mean {name}? ")), "{other}");
        }
    }

    fn hint_of(text: &str) -> String {
        light_from_text(text).unwrap_err().hint().unwrap().to_string()
    }

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
    fn photons_are_divided_by_wavelength_with_a_remark() {
        for heading in ["QNTM", "quanta", "umol/m2/s/nm", "PPFD", "photon flux"] {
            let lamp = lamp(&format!("nm,{heading}\n400,400\n500,500\n700,700\n")).unwrap();
            let found = [360, 400, 450, 700].map(|nm| at(&lamp, nm));
            for power in found {
                assert!((power - 560.0).abs() < 1e-9, "{heading}: {found:?}");
            }
            assert!(lamp.remarks()[0].contains("divided by wavelength"), "{:?}", lamp.remarks());
        }
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

    #[test]
    fn absolute_irradiance_of_a_jaz_is_a_lamp() {
        let text = "Jaz Data File\nReference Spectrum Present: Yes\n\
            >>>>>Begin Processed\nW\tD\tS\tP\n400.0\t1\t50\t0.5\n700.0\t1\t20\t0.7\n>>>>>End\n";
        for file in ["sun.JazIrrad", "b/sun.OVIrrad"] {
            let lamp = lamp_from_bytes(file, text.as_bytes(), None);
            assert!(lamp.is_ok(), "{lamp:?}");
        }
    }
}
