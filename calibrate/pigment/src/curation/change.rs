//! Changes of one library: other names, a subset, another reference white, another wavelength grid, and
//! pigments guessed from a colour.

use documents::hint::Explain;
use documents::{excerpt, name_violation};
use spectra::color::{
    Adaptation, ColorCode, ColorCodeError, Lab, RgbSpace, Xyz, delta_e_ciede2000,
};
use spectra::optics::{Layer, absorption_over_scattering};
use spectra::{Absorption, Extrapolation, Grid, InterpolateError, Interpolation, Spectrum};

use crate::evaluate::{Viewing, rounded};
use crate::library::{AmountKind, Pigment, PigmentLibrary, RecipeError};
use crate::recipe::PigmentId;
use crate::smooth_reflectance::smoothest_reflectance;

/// Renames pigments by `(old, new)` pairs, all at once, so you can exchange two names. Everything else
/// stays, including the words of the evidence.
///
/// # Errors
/// [`CurationError`] for an unknown name, and for a new name that is empty or taken.
pub fn renamed(
    file: &str,
    library: &PigmentLibrary,
    names: &[(String, String)],
) -> Result<PigmentLibrary, CurationError> {
    let mut result = library.clone();
    for (old, new) in names {
        let id = find(file, library, old)?;
        let new = new.trim();
        if name_violation(new).is_some() {
            let name = excerpt(new);
            return Err(CurationError::Name { file: file.to_owned(), name });
        }
        new.clone_into(&mut result.pigments[id.index()].name);
        if library.reference.as_ref() == Some(&library[id].name) {
            result.reference = Some(new.to_owned());
        }
    }
    for (index, pigment) in result.pigments.iter().enumerate() {
        if result.pigments[..index].iter().any(|other| other.name == pigment.name) {
            let name = pigment.name.clone();
            return Err(CurationError::Name { file: file.to_owned(), name });
        }
    }
    Ok(result)
}

/// Sets the Colour Index name of pigments by `(pigment, name)` pairs, e.g. `("Cobalt Blue", "PB28")`. An
/// empty name removes it.
///
/// # Errors
/// [`CurationError`] for an unknown pigment.
pub fn with_color_indices(
    file: &str,
    library: &PigmentLibrary,
    indices: &[(String, String)],
) -> Result<PigmentLibrary, CurationError> {
    let mut result = library.clone();
    for (pigment, index_name) in indices {
        let name = index_name.trim();
        let color_index = (!name.is_empty()).then(|| name.to_owned());
        result.pigments[find(file, library, pigment)?.index()].color_index = color_index;
    }
    Ok(result)
}

/// Selects the pigments of `keep` (all, if empty) except those of `without`, in the library's order.
///
/// We drop the errors of single samples, because no library records what a sample contained. The summary
/// stays, with a note that it belongs to the whole fit.
///
/// # Errors
/// [`CurationError`] for an unknown name, if no pigment is left, and if the reference would be left out.
pub fn subset(
    file: &str,
    library: &PigmentLibrary,
    keep: &[String],
    without: &[String],
) -> Result<PigmentLibrary, CurationError> {
    let kept: Vec<PigmentId> =
        keep.iter().map(|name| find(file, library, name)).collect::<Result<_, _>>()?;
    let dropped: Vec<PigmentId> =
        without.iter().map(|name| find(file, library, name)).collect::<Result<_, _>>()?;
    let ids: Vec<PigmentId> = library
        .ids()
        .filter(|id| (keep.is_empty() || kept.contains(id)) && !dropped.contains(id))
        .collect();
    if ids.is_empty() {
        return Err(CurationError::Empty(file.to_owned()));
    }
    if let Some(reference) = &library.reference
        && !ids.iter().any(|&id| library[id].name == *reference)
    {
        return Err(CurationError::ReferenceLeftOut {
            file: file.to_owned(),
            reference: reference.clone(),
        });
    }
    let mut evidence = library.evidence.clone();
    if let Some(evidence) = &mut evidence
        && ids.len() < library.pigments.len()
    {
        evidence.per_sample.clear();
        evidence.warnings.push(format!(
            "{} of {} pigments: the errors are those of the whole fit",
            ids.len(),
            library.pigments.len()
        ));
    }
    let pigments = ids.iter().map(|&id| library[id].clone()).collect();
    Ok(PigmentLibrary { pigments, evidence, ..library.clone() })
}

fn find(file: &str, library: &PigmentLibrary, name: &str) -> Result<PigmentId, CurationError> {
    library.find(name).map_err(|error| CurationError::Pigment(file.to_owned(), error))
}

/// Scales K and S to the S of `reference`, a name that [`PigmentLibrary::find`] accepts. Absolute amounts
/// become shares.
///
/// We divide every K and S by the reference's S at that wavelength, so every mixture keeps its K/S and
/// every film that hides keeps its colour. Films that do not hide change, because thickness 1 now refers to
/// another white. We divide standard deviations too, except for S of the two references. The new one gets
/// 0, and the old one gets the relative deviation that S of the new one had. A pigment with unknown S keeps
/// its K/S with S = 1. We drop the unevenness and the evidence of absolute amounts, because they do not
/// apply to films that hide.
///
/// # Errors
/// [`CurationError`] if the pigment is missing, or its S is unknown or 0.
pub fn with_reference(
    file: &str,
    library: &PigmentLibrary,
    reference: &str,
) -> Result<PigmentLibrary, CurationError> {
    let id =
        library.find(reference).map_err(|error| CurationError::Pigment(file.to_owned(), error))?;
    let white = &library[id];
    if library.reference.as_ref() == Some(&white.name) {
        return Ok(library.clone());
    }
    if !white.identified {
        return Err(CurationError::UnknownScattering {
            file: file.to_owned(),
            pigment: white.name.clone(),
        });
    }
    if let Some(at) = white.scattering.iter().position(|s| *s <= 0.0) {
        return Err(CurationError::NoScattering {
            file: file.to_owned(),
            pigment: white.name.clone(),
            nm: library.grid.nm(at),
            value: white.scattering[at],
        });
    }
    let absolute = library.amounts == AmountKind::Absolute;
    Ok(PigmentLibrary {
        reference: Some(white.name.clone()),
        amounts: AmountKind::Relative,
        unevenness: 0.0,
        evidence: if absolute { None } else { library.evidence.clone() },
        pigments: library
            .pigments
            .iter()
            .map(|pigment| {
                if !pigment.identified && !absolute {
                    return pigment.clone();
                }
                let mut scattering_sd = divided_by_white(white, &pigment.scattering_sd);
                if pigment.name == white.name {
                    scattering_sd.fill(0.0);
                } else if library.reference.as_ref() == Some(&pigment.name) {
                    // 1 / S and S have the same relative deviation.
                    let pairs = white.scattering_sd.iter().zip(&white.scattering);
                    scattering_sd = pairs.map(|(sd, s)| rounded(sd / (s * s))).collect();
                }
                Pigment {
                    absorption: divided_by_white(white, &pigment.absorption),
                    scattering: divided_by_white(white, &pigment.scattering),
                    absorption_sd: divided_by_white(white, &pigment.absorption_sd),
                    scattering_sd,
                    measured_amounts: None,
                    ..pigment.clone()
                }
            })
            .collect(),
        ..library.clone()
    })
}

fn divided_by_white(white: &Pigment, curve: &[f64]) -> Vec<f64> {
    curve.iter().zip(&white.scattering).map(|(value, s)| rounded(value / s)).collect()
}

/// Resamples the library to `grid`: K and S by `method` (clipped at 0), standard deviations by straight
/// lines. The evidence stays, with a note that it belongs to the old grid.
///
/// You lose detail by this. For example, the Van Gogh oils, thinned to 20 nm and brought back to 10 nm,
/// change by 0.05 CIEDE2000 on average with Sprague's polynomial and by 0.39 with linear interpolation (100
/// mixtures with white, as compared by `library diff`).
///
/// # Errors
/// [`CurationError::Grid`] beyond the library's band, unless its end values are held, and for Sprague's
/// polynomial on fewer than six wavelengths.
pub fn on_grid(
    file: &str,
    library: &PigmentLibrary,
    grid: Grid,
    method: Interpolation,
    ends: Extrapolation,
) -> Result<PigmentLibrary, CurationError> {
    if grid == library.grid {
        return Ok(library.clone());
    }
    let pigments = library
        .pigments
        .iter()
        .map(|pigment| -> Result<Pigment, InterpolateError> {
            let linear = Interpolation::Linear;
            Ok(Pigment {
                absorption: curve(library.grid, &pigment.absorption, grid, method, ends)?,
                scattering: curve(library.grid, &pigment.scattering, grid, method, ends)?,
                absorption_sd: curve(library.grid, &pigment.absorption_sd, grid, linear, ends)?,
                scattering_sd: curve(library.grid, &pigment.scattering_sd, grid, linear, ends)?,
                ..pigment.clone()
            })
        })
        .collect::<Result<_, _>>();
    let pigments = pigments.map_err(|error| CurationError::Grid(file.to_owned(), error))?;
    let mut evidence = library.evidence.clone();
    if let Some(evidence) = &mut evidence {
        evidence.warnings.push(format!(
            "fitted on {}, then brought to {grid} ({}); the errors are those of the fit",
            library.grid,
            method.name()
        ));
    }
    Ok(PigmentLibrary { grid, pigments, evidence, ..library.clone() })
}

/// Resamples one curve of values from 0 up. An empty curve stays empty.
fn curve(
    from: Grid,
    values: &[f64],
    to: Grid,
    method: Interpolation,
    ends: Extrapolation,
) -> Result<Vec<f64>, InterpolateError> {
    if values.is_empty() {
        return Ok(Vec::new());
    }
    let spectrum = Spectrum::<Absorption>::new(from, values.to_vec());
    let spectrum = spectrum.expect("a library holds figures of 0 and up");
    Ok(spectrum.resampled(to, method, ends)?.into_values().into_iter().map(rounded).collect())
}

/// S of a glaze, relative to the reference white. It hides little. We chose it by eye.
const GLAZE_SCATTERING: f64 = 0.02;
/// We count two colours as equal up to this CIEDE2000. Rounding K and S in a file changes a colour by far
/// less.
const SAME_COLOR: f64 = 0.05;

/// Kind of paint that a guessed pigment makes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// A paint that hides, with S = 1 as the reference white: a film that hides has the colour.
    Hiding,
    /// A paint that hardly scatters, with S = 0.02: a film of unit thickness over white has the colour.
    Glaze,
}

/// A guessed pigment, and how far its colour is from the one that you requested.
#[derive(Debug, Clone, PartialEq)]
pub struct Guess {
    /// The pigment, with its mark `guessed` set.
    pub pigment: Pigment,
    /// CIEDE2000 from the requested colour, with K and S rounded as in a file.
    pub delta_e: f64,
    /// Colour of the film as `#rrggbb` of sRGB.
    pub hex: String,
}

/// Makes a pigment for `library`'s grid and surface with the colour `wanted` under D65 for the CIE 1931
/// observer. We take K and S from the smoothest reflectance of this colour ([`smoothest_reflectance`]).
/// `color` describes the colour in the pigment's notes.
///
/// A colour does not tell you how a paint mixes. Only measurements do.
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

/// Adds a pigment of a colour to `library`. Write the colour as `#rrggbb`, or as `L,a,b` under D65, and see
/// [`guessed_pigment`]. The first paint of an empty library becomes its reference white if it hides.
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
    if name_violation(name).is_some() {
        return Err(CurationError::Unnamed);
    }
    if library.pigments.iter().any(|pigment| pigment.name == name) {
        return Err(CurationError::NameTaken(name.to_owned()));
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

/// Returns the K of a film of unit thickness with S = `scattering` that reflects `internal` over white. We
/// bisect the logarithm of K, because the reflectance falls with K.
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

/// A change of libraries that the data do not allow.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum CurationError {
    /// A name does not denote one pigment.
    #[error("{0}: {1}")]
    #[hint(inner = 1)]
    Pigment(String, RecipeError),
    /// The new reference white has an unknown S.
    #[error("{file}: the scattering of `{pigment}` is not known, so it cannot be the reference")]
    #[hint("name a pigment that was measured in mixtures and scatters, such as a white")]
    UnknownScattering {
        /// File of the library.
        file: String,
        /// Name of the pigment.
        pigment: String,
    },
    /// The new reference white has S = 0 at a wavelength.
    #[error("{file}: the reference needs S above 0, and S of {pigment} at {nm} nm is `{value}`")]
    #[hint("name a pigment that was measured in mixtures and scatters, such as a white")]
    NoScattering {
        /// File of the library.
        file: String,
        /// Name of the pigment.
        pigment: String,
        /// Wavelength in nm.
        nm: f64,
        /// S at that wavelength.
        value: f64,
    },
    /// The library cannot be interpolated to the new grid.
    #[error("{0}: {1}")]
    #[hint(if matches!(_1, InterpolateError::TooFew(..)), "straight lines need only two wavelengths: [interpolation=linear]")]
    #[hint("choose wavelengths within the library's, or hold its end values: [hold_ends]")]
    Grid(String, InterpolateError),
    /// One library holds shares, the other amounts on an area.
    #[error("{file} holds {found} amounts and {first} {wanted} ones, which mean different things")]
    #[hint(
        "first convert the absolute library to shares: `impasto library convert` with [reference=WHITE]"
    )]
    Amounts {
        /// File of the first library.
        first: String,
        /// Kind of amounts in the first library.
        wanted: &'static str,
        /// File of the other library.
        file: String,
        /// Kind of amounts in the other library.
        found: &'static str,
    },
    /// Both libraries hold absolute amounts, and no file states their unit.
    #[error("{first} and {file}: K and S are per unit of amount, and no file states the unit")]
    #[hint("if both were measured in the same unit on the same area: [same_unit]")]
    Units {
        /// File of the first library.
        first: String,
        /// File of the other library.
        file: String,
    },
    /// K and S were fitted with different surfaces or film models.
    #[error("{file}: {what} differs, {wanted} in {first}, found `{found}`")]
    #[hint(
        if *keeps_first,
        "K and S are valid only with the surface they were fitted with; fit {file} again with [surface_of={first}], or assume the surface of the first for both: [any_surface]"
    )]
    #[hint(
        "K and S are valid only with the surface they were fitted with; fit {first} again with [surface_of={file}], or assume the surface of the first for both: [any_surface]"
    )]
    Surface {
        /// Name of the property that differs.
        what: &'static str,
        /// Whether the first library has the smaller k1, below which no reading lies. You then fit the other
        /// one again.
        keeps_first: bool,
        /// File of the first library.
        first: String,
        /// Value in the first library.
        wanted: String,
        /// File of the other library.
        file: String,
        /// Value in the other library.
        found: String,
    },
    /// The first library has no reference white.
    #[error("{0}: the library has no reference white, so nothing can be scaled to it")]
    #[hint("name one of its pigments: [reference=WHITE]")]
    NoReference(String),
    /// The other library lacks the reference white of the first.
    #[error("{file}: no pigment is called `{reference}`, the reference of {first}")]
    #[hint("if it has {reference} under another name: [as=NAME]")]
    NoCommonPigment {
        /// File of the first library.
        first: String,
        /// File of the other library.
        file: String,
        /// Name of the reference white.
        reference: String,
    },
    /// One name stands for two different pigments.
    #[error(
        "{first} and {file} both have `{pigment}` with figures that differ, {delta_e:.2} CIEDE2000 between the masstones"
    )]
    #[hint(
        "choose one: [prefer=first] or [prefer=last]; or rename one: impasto library rename {file} \"{pigment}={pigment} (2)\" [output=RENAMED.json]"
    )]
    Clash {
        /// File of the first pigment.
        first: String,
        /// File of the second pigment.
        file: String,
        /// Name of both pigments.
        pigment: String,
        /// CIEDE2000 between their masstones.
        delta_e: f64,
    },
    /// A new name is empty or already taken.
    #[error("{file}: a pigment needs a name of its own, found `{name}`")]
    #[hint("choose another name")]
    Name {
        /// File of the library.
        file: String,
        /// The new name.
        name: String,
    },
    /// A subset would lose its reference white.
    #[error("{file}: the reference `{reference}` would be left out")]
    #[hint("keep {reference}, or choose a new reference: [reference=WHITE]")]
    ReferenceLeftOut {
        /// File of the library.
        file: String,
        /// Name of the reference white.
        reference: String,
    },
    /// A subset would be empty.
    #[error("{0}: no pigment would be left")]
    #[hint("name a pigment to keep")]
    Empty(String),
    /// No paint under the library's surface has the requested colour.
    #[error(
        "no paint under this surface (k1 = {k1}, k2 = {k2}) has this colour; the nearest is {delta_e:.2} CIEDE2000 off, found `{nearest}`"
    )]
    #[hint("accept the nearest colour: [nearest]")]
    OutOfReach {
        /// Share of arriving light that the surface reflects.
        k1: f64,
        /// Share of diffuse light that the surface turns back inside.
        k2: f64,
        /// Nearest possible colour as `#rrggbb` of sRGB.
        nearest: String,
        /// CIEDE2000 from the requested colour to the nearest.
        delta_e: f64,
    },
    /// Tints were requested of a library without a reference white.
    #[error("the library has no reference white to tint with")]
    #[hint("leave out [tints]")]
    NoWhite,
    /// The ratio of a tint is out of range.
    #[error("a tint has more than 0 and up to 1e6 parts of white, found `{0}`")]
    #[hint("try [tints=1,4,9]")]
    #[fault(Setting)]
    TintParts(f64),
    /// A text is not a colour.
    #[error(transparent)]
    #[fault(Setting)]
    Color(#[from] ColorCodeError),
    /// A pigment was to be guessed without a name, or under one that nothing can have.
    #[error("a pigment needs a name of at most 200 letters, without control characters")]
    #[hint("give [name=\"Sky Blue\"]")]
    #[fault(Setting)]
    Unnamed,
    /// A pigment was to be guessed under the name of another.
    #[error("the library has a pigment called `{0}`")]
    #[hint("choose another [name]")]
    NameTaken(String),
    /// A pigment was to be guessed for a library of absolute amounts.
    #[error("a guessed pigment has no unit of amount, and this library is of absolute amounts")]
    #[hint("first convert the library to shares: `impasto library convert` with [reference=WHITE]")]
    GuessedAmount,
}
