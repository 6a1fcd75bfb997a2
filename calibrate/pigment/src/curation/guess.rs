//! A pigment guessed from a colour.

use spectra::color::RgbSpace;
use spectra::color::{Adaptation, ColorCode, Lab, Xyz, delta_e_ciede2000};
use spectra::optics::{Layer, absorption_over_scattering};

use super::error::CurationError;
use crate::digits::rounded;
use crate::evaluate::Viewing;
use crate::library::{AmountKind, Pigment, PigmentLibrary};
use crate::smooth_reflectance::smoothest_reflectance;

/// S of a glaze, relative to the reference white: it hides little. Chosen by eye.
const GLAZE_SCATTERING: f64 = 0.02;
/// Largest CIEDE2000 between two colours that count as equal. Rounding K and S in a file changes a colour by
/// far less.
const SAME_COLOR: f64 = 0.05;

/// Kind of paint that a guessed pigment makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A paint that hides, with S = 1 as the reference white: a film that hides has the colour.
    Hiding,
    /// A paint that hardly scatters, with S = 0.02: a film of unit thickness over white has the colour.
    Glaze,
}

/// A guessed pigment, with the difference between its colour and the requested one.
#[derive(Debug, Clone, PartialEq)]
pub struct Guess {
    /// The pigment, with its mark `guessed` set.
    pub pigment: Pigment,
    /// CIEDE2000 from the requested colour, with K and S rounded as in a file.
    pub delta_e: f64,
    /// Colour of the film as `#rrggbb` of sRGB.
    pub hex: String,
}

/// Makes a pigment for `library`'s grid and surface whose colour under D65 for the CIE 1931 observer is
/// `wanted`: K and S follow from the smoothest reflectance of that colour
/// ([`smoothest_reflectance`]). `color` describes the colour in the pigment's notes.
///
/// A colour does not determine how a paint mixes; only measurements do.
///
/// # Errors
/// [`CurationError`] for a library of absolute amounts, and where no paint under the library's surface
/// comes within 0.05 CIEDE2000 of the colour, unless `nearest` accepts the nearest colour.
pub fn guessed_pigment(
    library: &PigmentLibrary,
    (name, color): (&str, &str),
    wanted: Xyz,
    body: Body,
    nearest: bool,
) -> Result<Guess, CurationError> {
    if library.amounts == AmountKind::Absolute {
        return Err(CurationError::GuessedAmount);
    }
    let weights = Viewing::default().weights(library.grid).expect("a method for the grid");
    let surface = library.saunderson;
    let recovered = smoothest_reflectance(&weights, surface, wanted);
    let (scattering, words) = match body {
        Body::Hiding => (1.0, "a paint that hides, with S = 1"),
        Body::Glaze => (GLAZE_SCATTERING, "a glaze over white, with S = 0.02"),
    };
    let absorption: Vec<f64> = (recovered.internal.iter())
        .map(|&internal| match body {
            Body::Hiding => rounded(scattering * absorption_over_scattering(internal)),
            Body::Glaze => rounded(glaze_absorption(internal, scattering)),
        })
        .collect();
    let count = absorption.len();
    let pigment = Pigment {
        name: name.to_owned(),
        color_index: None,
        absorption,
        scattering: vec![scattering; count],
        absorption_sd: Vec::new(),
        scattering_sd: Vec::new(),
        identified: true,
        guessed: true,
        measured_amounts: None,
        notes: vec![format!("guessed from {color} as {words}; how it mixes is not known")],
    };
    let film: Vec<f64> = (pigment.absorption.iter())
        .map(|&k| {
            let internal = match body {
                Body::Hiding => spectra::optics::infinite_film(k, scattering),
                Body::Glaze => Layer::new(k, scattering, 1.0).over(1.0),
            };
            surface.measured_from_internal(internal)
        })
        .collect();
    let white = weights.white();
    let xyz = weights.xyz(&film);
    let delta_e = delta_e_ciede2000(Lab::from_xyz(wanted, white), Lab::from_xyz(xyz, white));
    let hex = RgbSpace::Srgb.encoded_from_xyz(xyz, white, Adaptation::Bradford).to_hex();
    if delta_e >= SAME_COLOR && !nearest {
        let k1 = surface.k1;
        let k2 = surface.k2;
        return Err(CurationError::OutOfReach { k1, k2, nearest: hex, delta_e });
    }
    Ok(Guess { pigment, delta_e, hex })
}

/// Adds to `library` a pigment of a colour (`#rrggbb`, or `L,a,b` under D65), see
/// [`guessed_pigment`]. The first paint of an empty library becomes its reference white if it
/// hides.
///
/// # Errors
/// [`CurationError`] for an empty name or one that the library has, a text that is not a colour,
/// and what [`guessed_pigment`] refuses. The library is unchanged then.
pub fn add_guessed(
    library: &mut PigmentLibrary,
    name: &str,
    color: &str,
    body: Body,
    nearest: bool,
) -> Result<Guess, CurationError> {
    let name = name.trim();
    if name.is_empty() || name.contains(char::is_control) {
        return Err(CurationError::Unnamed);
    }
    if library.pigments.iter().any(|pigment| pigment.name == name) {
        return Err(CurationError::NameTaken { name: name.to_owned() });
    }
    let weights = Viewing::default().weights(library.grid).expect("a method for the grid");
    let wanted = color.parse::<ColorCode>()?.xyz(weights.white());
    let guess = guessed_pigment(library, (name, color), wanted, body, nearest)?;
    if library.pigments.is_empty() && body == Body::Hiding {
        library.reference = Some(name.to_owned());
    }
    library.pigments.push(guess.pigment.clone());
    Ok(guess)
}

/// Returns the K of a film of unit thickness with S = `scattering` that reflects `internal` over white,
/// by bisection in the logarithm of K, since the reflectance falls with K.
fn glaze_absorption(internal: f64, scattering: f64) -> f64 {
    let mut low = -25.0f64;
    let mut high = 15.0f64;
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if Layer::new(middle.exp(), scattering, 1.0).over(1.0) > internal {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high).exp()
}
