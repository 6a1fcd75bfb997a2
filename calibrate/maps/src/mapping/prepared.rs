//! Library, bands and noise of a scan, ready for its pixels.

use pigment::library::PigmentLibrary;

use crate::films::bands::{Bands, MOST_BANDS};
use crate::films::film::{Films, Pixel};
use crate::films::ground::{BareGround, Ground};
use crate::films::noise::{ModelError, Noise};
use crate::films::paints::Paints;
use crate::films::settings::MapSettings;
use crate::films::whitening::WhiteningNoise;
use crate::map_error::MapError;
use crate::pixel_maps::Mask;
use crate::search::engine::Engine;
use crate::search::nearest::Point;
use crate::search::scores::Scores;
use crate::search::table::Table;

/// Reflectances of a band that a scan can have; others show raw counts, percent or a wrong white.
const REFLECTANCES: std::ops::RangeInclusive<f32> = -0.2..=1.5;

/// All that does not change from pixel to pixel.
#[derive(Debug, Clone)]
pub(crate) struct Prepared {
    pub(crate) bands: Bands,
    pub(crate) paints: Paints,
    pub(crate) noise: Noise,
    pub(crate) engine: Engine,
    /// Bands of the scan that take part.
    used: Vec<usize>,
    /// Rows of the folded bands: ends in `terms`.
    ends: Vec<usize>,
    terms: Vec<(u32, f32)>,
    ground: Option<BareGround>,
    /// Pigments by place, those that the bands cannot tell apart together.
    pub(crate) entries: Vec<Vec<usize>>,
}

/// A pixel on the folded bands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Folded {
    pub(crate) pixel: Pixel,
    pub(crate) point: Point,
}

impl Prepared {
    /// Prepares `library`, whose predictions err by `model`.
    pub(crate) fn new(
        library: &PigmentLibrary,
        wavelengths: &[f64],
        settings: &MapSettings,
        model: &ModelError,
    ) -> Result<Self, MapError> {
        let bands = Bands::new(wavelengths, library.grid)?;
        let paints = Paints::new(library, &settings.palette, &bands)?;
        let noise = Noise::new(&bands, settings.sensor_noise, model);
        let films = Films::new(&paints);
        let table = Table::new(&paints, &films, &noise);
        let engine = Engine {
            films,
            table,
            noise: WhiteningNoise::new(&noise),
            at_most: settings.at_most.min(paints.count()),
            scores: Scores::new((paints.count(), bands.count()), settings.penalty, noise.tail),
            strength_sd: 0.0,
        };
        let mut ends = Vec::new();
        let mut terms = Vec::new();
        let mut used = Vec::new();
        for row in &bands.from_scan {
            terms.extend(row.terms.iter().map(|&(band, weight)| (band as u32, weight as f32)));
            used.extend(row.terms.iter().map(|&(band, _)| band));
            ends.push(terms.len());
        }
        used.sort_unstable();
        used.dedup();
        let bare = |ground: &Ground| BareGround::new(ground, wavelengths, &bands, &noise.sensor);
        let ground = settings.ground.as_ref().map(bare).transpose()?;
        let entries = (0..paints.count()).map(|pigment| vec![pigment]).collect();
        Ok(Self { bands, paints, noise, engine, used, ends, terms, ground, entries })
    }

    /// Folds a pixel of the scan.
    ///
    /// # Errors
    /// The reason why it cannot be mapped.
    pub(crate) fn fold(&self, scan: &[f32]) -> Result<Folded, Mask> {
        for &band in &self.used {
            let value = scan[band];
            if !value.is_finite() {
                return Err(Mask::NotFinite);
            }
            if !REFLECTANCES.contains(&value) {
                return Err(Mask::OutOfRange);
            }
        }
        let mut folded = [0.0; MOST_BANDS];
        let mut start = 0;
        for (value, &end) in folded.iter_mut().zip(&self.ends) {
            for &(band, weight) in &self.terms[start..end] {
                *value += weight * scan[band as usize];
            }
            start = end;
        }
        let folded = &folded[..self.bands.count()];
        let mean = folded.iter().sum::<f32>() / folded.len() as f32;
        if mean <= self.paints.surface.floor() as f32 {
            return Err(Mask::TooDark);
        }
        if self.ground.as_ref().is_some_and(|ground| ground.explains(folded)) {
            return Err(Mask::Ground);
        }
        let point = self.engine.table.projection.of(folded);
        Ok(Folded { pixel: self.engine.films.pixel(&self.engine.noise, folded), point })
    }
}
