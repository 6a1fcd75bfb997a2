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
        let all: Vec<f64> = pairs
            .map(|(&target, &painted)| {
                delta_e_ciede2000(film.lab_from_rgb(target), film.lab_from_rgb(painted))
            })
            .collect();
        // A colour painted within `OUT_OF_GAMUT` is in gamut, which saves the slower check.
        let doubtful = all.iter().zip(target.values()).filter(|(error, _)| **error > OUT_OF_GAMUT);
        let outside = Outside::of(separation, doubtful.map(|(_, &target)| target));
        let pixels = all.iter().zip(target.values());
        let is_within = |error: f64, target| error <= OUT_OF_GAMUT || !outside.holds(target);
        let within = pixels.filter(|(error, target)| is_within(**error, **target));
        let within: Vec<f64> = within.map(|(error, _)| *error).collect();
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

/// Colours out of gamut. Finding one film takes long, so all colours that agree in the first 7
/// bits of the fractions of their linear channels, about a step of 8-bit sRGB, are judged by the
/// one in their middle.
struct Outside {
    /// In ascending order.
    colors: Vec<[u16; 3]>,
}

impl Outside {
    /// Those of `colors` that are out of gamut.
    fn of(separation: &Separation, colors: impl Iterator<Item = [f32; 3]>) -> Self {
        let mut colors: Vec<_> = colors.map(leading_bits).collect();
        colors.par_sort_unstable();
        colors.dedup();
        let middle = |bits: u16| f32::from_bits(u32::from(bits) << 16 | 0x8000);
        Self {
            colors: colors
                .into_par_iter()
                .filter(|color: &[u16; 3]| separation.is_out_of_gamut(color.map(middle)))
                .collect(),
        }
    }

    fn holds(&self, color: [f32; 3]) -> bool {
        self.colors.binary_search(&leading_bits(color)).is_ok()
    }
}

/// Sign, exponent and the first 7 bits of the fraction of each channel.
fn leading_bits(color: [f32; 3]) -> [u16; 3] {
    color.map(|channel| (channel.to_bits() >> 16) as u16)
}
