//! Libraries of known K and S, and the oils.

use calibrate::comparison::Comparable;
use calibrate::evaluate::Viewing;
use calibrate::fit::Method;
use calibrate::library::{AmountKind, Pigment, PigmentLibrary};
use calibrate::palette::{MeasuredSample, Palette};
use calibrate::{PigmentId, Recipe};
use spectra::Grid;
use spectra::optics::Surface;
use suite::oils::{SURFACE, fitted, swatches};

/// A pigment with K and S as functions of the wavelength in nm.
pub(crate) fn pigment(name: &str, k: impl Fn(f64) -> f64, s: impl Fn(f64) -> f64) -> Pigment {
    Pigment {
        name: name.to_owned(),
        color_index: None,
        absorption: grid().wavelengths_nm().map(k).collect(),
        scattering: grid().wavelengths_nm().map(s).collect(),
        absorption_sd: Vec::new(),
        scattering_sd: Vec::new(),
        identified: true,
        guessed: false,
        measured_amounts: None,
        notes: Vec::new(),
    }
}

/// A pigment with the same K and S at every wavelength.
pub(crate) fn even(name: &str, k: f64, s: f64) -> Pigment {
    pigment(name, |_| k, |_| s)
}

/// A pigment that absorbs in a band around `middle` nm.
pub(crate) fn band(name: &str, height: f64, middle: f64, s: f64) -> Pigment {
    pigment(name, |nm| 0.01 + height * (-0.5 * ((nm - middle) / 45.0).powi(2)).exp(), |_| s)
}

pub(crate) fn grid() -> Grid {
    Grid::from_nm(400.0, 10.0, 31).unwrap()
}

/// A library without a surface. Relative amounts refer to its first pigment.
pub(crate) fn library(pigments: Vec<Pigment>, amounts: AmountKind) -> PigmentLibrary {
    let relative = amounts == AmountKind::Relative;
    PigmentLibrary {
        title: String::new(),
        licence: String::new(),
        source: String::new(),
        grid: grid(),
        amounts,
        reference: relative.then(|| pigments[0].name.clone()),
        saunderson: Surface::NONE,
        unevenness: 0.0,
        inputs: Vec::new(),
        settings: None,
        pigments,
        evidence: None,
    }
}

/// A library of made-up white, red, yellow, blue and black.
pub(crate) fn five() -> PigmentLibrary {
    let pigments = vec![
        even("white", 0.001, 1.0),
        band("red", 3.0, 520.0, 0.4),
        band("yellow", 2.0, 430.0, 0.6),
        band("blue", 3.0, 610.0, 0.2),
        even("black", 5.0, 0.1),
    ];
    library(pigments, AmountKind::Relative)
}

/// The Van Gogh oils: fitted library, viewing condition and measured swatches.
pub(crate) struct Oils {
    pub(crate) library: PigmentLibrary,
    pub(crate) viewing: Viewing,
    pub(crate) comparable: Comparable,
}

impl Oils {
    pub(crate) fn fitted() -> Self {
        let library = fitted(Method::Refined, SURFACE).library;
        let comparable = Comparable::of(&swatches().0, &library).unwrap();
        Self { library, viewing: Viewing::default(), comparable }
    }

    pub(crate) fn palette(&self) -> Palette<'_> {
        let weights = self.viewing.weights(self.library.grid).unwrap();
        Palette::new(&self.library, &self.viewing, self.comparable.set.cards(&weights)).unwrap()
    }

    pub(crate) fn measured(&self, palette: &Palette<'_>) -> Vec<MeasuredSample> {
        self.comparable.with(&self.library, &self.viewing).unwrap().measured_samples(palette)
    }
}

/// A recipe of pigments, given by their indices in the library.
pub(crate) fn recipe<const N: usize>(parts: [(usize, f64); N]) -> Recipe {
    parts.into_iter().map(|(place, part)| (PigmentId(place), part)).collect()
}
