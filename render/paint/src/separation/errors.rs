//! What a separation costs in colour.

use pigment::evaluate::percentile;
use rayon::prelude::*;
use spectra::color::delta_e_ciede2000;

use super::film::PaintFilm;
use super::table::{OUT_OF_GAMUT, Separation};
use crate::layer::SLOTS;
use graphics::field::Field;
use graphics::picture::Picture;

/// The picture that films of these heights in mm make over the ground: linear
/// sRGB by Kubelka-Munk, not by any table.
#[must_use]
pub fn rebuilt(film: &PaintFilm, heights_mm: &Field<[f32; SLOTS]>) -> Picture {
    let colors = heights_mm.values().par_iter().with_min_len(256).map(|at| film.rgb(at));
    Field::from_values(heights_mm.width(), heights_mm.height(), colors.collect())
}

/// CIEDE2000 over the pixels of a picture.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ColorErrors {
    /// Arithmetic mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Largest.
    pub max: f64,
    /// Mean over the pixels within the palette's gamut; 0 if there are none.
    pub mean_in_gamut: f64,
    /// Share of pixels out of the palette's gamut, 0..1.
    pub out_of_gamut: f64,
}

impl ColorErrors {
    /// The errors of `painted` against `wanted`, seen under the light of
    /// `separation`, which also says which colours are out of gamut.
    ///
    /// # Panics
    /// If the pictures differ in size, or are empty.
    #[must_use]
    pub fn between(separation: &Separation, wanted: &Picture, painted: &Picture) -> Self {
        assert_eq!(wanted.bounds(), painted.bounds(), "pictures of one size");
        let film = separation.film();
        let pairs = wanted.values().par_iter().zip(painted.values()).with_min_len(256);
        let told: Vec<(f64, bool)> = pairs
            .map(|(&wanted, &painted)| {
                let labs = (film.lab_from_rgb(wanted), film.lab_from_rgb(painted));
                let error = delta_e_ciede2000(labs.0, labs.1);
                // What was painted as near as that is within reach.
                (error, error > OUT_OF_GAMUT && separation.is_out_of_gamut(wanted))
            })
            .collect();
        let all: Vec<f64> = told.iter().map(|(error, _)| *error).collect();
        let within: Vec<f64> = told.iter().filter(|(_, out)| !out).map(|(e, _)| *e).collect();
        let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        Self {
            mean: mean(&all),
            median: percentile(&all, 50.0),
            p95: percentile(&all, 95.0),
            max: percentile(&all, 100.0),
            mean_in_gamut: mean(&within),
            out_of_gamut: 1.0 - within.len() as f64 / all.len() as f64,
        }
    }
}
