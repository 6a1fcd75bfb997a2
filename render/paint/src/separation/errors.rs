//! Colour error of a separation.

use pigment::evaluate::percentile;
use rayon::prelude::*;
use spectra::color::delta_e_ciede2000;

use super::film::PaintFilm;
use super::table::{OUT_OF_GAMUT, Separation};
use crate::layer::SLOTS;
use graphics::field::Field;
use graphics::picture::Picture;

/// Picture that films of the given heights (in mm, by slot) make over the ground, in
/// linear sRGB: Kubelka-Munk for every pixel, independent of the separation's table.
#[must_use]
pub fn rebuild_picture(film: &PaintFilm, heights_mm: &Field<[f32; SLOTS]>) -> Picture {
    let colors = heights_mm.values().par_iter().with_min_len(256).map(|at| film.rgb(at));
    Field::from_values(heights_mm.width(), heights_mm.height(), colors.collect())
}

/// Statistics of CIEDE2000 over the pixels of a picture.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ColorErrors {
    /// Arithmetic mean of CIEDE2000.
    pub mean: f64,
    /// Median of CIEDE2000.
    pub median: f64,
    /// 95th percentile of CIEDE2000.
    pub p95: f64,
    /// Largest CIEDE2000 of all pixels.
    pub max: f64,
    /// Mean CIEDE2000 over the pixels within the palette's gamut; 0 if there are none.
    pub mean_in_gamut: f64,
    /// Share of pixels outside the palette's gamut, 0..1.
    pub out_of_gamut: f64,
}

impl ColorErrors {
    /// Errors of `painted` against `target` under the light of `separation`, which also
    /// decides which colours are out of gamut.
    ///
    /// # Panics
    /// If the pictures differ in size, or are empty.
    #[must_use]
    pub fn between(separation: &Separation, target: &Picture, painted: &Picture) -> Self {
        assert_eq!(target.bounds(), painted.bounds(), "pictures differ in size");
        let film = separation.film();
        let pairs = target.values().par_iter().zip(painted.values()).with_min_len(256);
        let errors: Vec<(f64, bool)> = pairs
            .map(|(&target, &painted)| {
                let labs = (film.lab_from_rgb(target), film.lab_from_rgb(painted));
                let error = delta_e_ciede2000(labs.0, labs.1);
                // A colour painted within `OUT_OF_GAMUT` is in gamut, which saves the
                // slower check.
                (error, error > OUT_OF_GAMUT && separation.is_out_of_gamut(target))
            })
            .collect();
        let all: Vec<f64> = errors.iter().map(|(error, _)| *error).collect();
        let within: Vec<f64> = errors.iter().filter(|(_, out)| !out).map(|(e, _)| *e).collect();
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
