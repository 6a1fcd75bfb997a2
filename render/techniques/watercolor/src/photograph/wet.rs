//! Wet-in-wet: neighbouring washes that run into each other.
//!
//! The steps of a smooth gradient run together where the photograph has no outline, so that
//! a sky has no hard arcs. At random places weak outlines are painted wet: colours flow
//! across them along a turbulent displacement, which makes feathers.

use rayon::prelude::*;

use crate::effects::edges_on_cpu;
use crate::settings::WetSettings;
use crate::textures::Quantiles;
use graphics::field::{Field, blurred};
use graphics::noise::{Hills, random};
use graphics::smoothstep;

/// Standard deviation of the blur before outlines of the photograph are looked for, as a share
/// of [`WetSettings::tone_px`].
const OUTLINE_BLUR: f32 = 0.08;

/// Contrast below which the photograph counts as smooth: noise of a sensor.
const SMOOTH: f32 = 0.015;

/// Contrasts at which an outline begins to stay, and stays wholly, where steps run together.
const STAYS: [f32; 2] = [0.04, 0.12];

/// Contrasts at which an outline begins to stay, and stays wholly, where the paper is wet.
const STAYS_WET: [f32; 2] = [0.3, 0.6];

/// Colours that run into each other, and where they do.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Running {
    /// Encoded sRGB and coverage of the colours that ran.
    pub(super) color: Field<[f32; 4]>,
    /// Share of them in the picture, 0 to 1.
    pub(super) share: Field<[f32; 1]>,
}

/// The colours of `flat` that run into each other. `original` is the photograph in this size.
/// `None` if nothing runs.
pub(super) fn running(
    original: &Field<[f32; 4]>,
    flat: &Field<[f32; 4]>,
    settings: &WetSettings,
) -> Option<Running> {
    let steps = settings.tone_px > 0.0;
    let wet = settings.amount > 0.0 && settings.reach_px > 0.0;
    if !(steps || wet) || flat.values().is_empty() {
        return None;
    }
    let length = if steps { settings.tone_px } else { settings.reach_px };
    let contrast = contrast(original, length);
    let mut color = flat.clone();
    let mut share = Field::filled(flat.width(), flat.height(), [0.0_f32]);
    if steps {
        let sigma = settings.tone_px / 2.5;
        let near = spread(&contrast, sigma, OUTLINE_BLUR * length);
        color = covered_blur(flat, sigma);
        share = mapped(&near, |[near]| [1.0 - smoothstep(STAYS, near)]);
        // Where an outline stays, the flat colour stays.
        let all = color.values_mut().par_iter_mut().zip(flat.values()).zip(share.values());
        all.for_each(|((color, flat), share)| *color = mixed(*flat, *color, share[0]));
    }
    if wet {
        let sigma = settings.reach_px / 2.0;
        let near = spread(&contrast, sigma, OUTLINE_BLUR * length);
        let places = wet_places(flat.width(), flat.height(), settings);
        let ran = covered_blur(&displaced(&color, settings), settings.reach_px / 4.0);
        let all = color.values_mut().par_iter_mut().zip(share.values_mut()).zip(ran.values());
        all.zip(places.values()).zip(near.values()).for_each(
            |((((color, share), ran), place), near)| {
                let own = place * (1.0 - smoothstep(STAYS_WET, near[0]));
                *color = mixed(*color, *ran, own);
                share[0] = 1.0 - (1.0 - share[0]) * (1.0 - own);
            },
        );
    }
    Some(Running { color, share })
}

/// Contrast of the outlines of the photograph at each pixel, without the noise of a sensor.
fn contrast(original: &Field<[f32; 4]>, length: f32) -> Field<[f32; 1]> {
    let sigma = (OUTLINE_BLUR * length).max(0.6);
    let edges = edges_on_cpu(original, sigma);
    let values = edges.values().par_iter();
    // A step of contrast c has a gradient of 0.8 c / sigma in its middle.
    let values = values.map(|edge| [(edge * sigma / 0.8 - SMOOTH).max(0.0)]).collect();
    Field::from_values(edges.width(), edges.height(), values)
}

/// The contrast of the nearest outlines, falling with the distance: an outline of a blur of
/// `own` px keeps about its contrast in its middle.
fn spread(contrast: &Field<[f32; 1]>, sigma: f32, own: f32) -> Field<[f32; 1]> {
    let gain = 2.5 * sigma / own.max(0.6);
    mapped(&blurred(contrast, f64::from(sigma)), |[near]| [gain * near])
}

/// A blur in which bare paper does not count.
fn covered_blur(color: &Field<[f32; 4]>, sigma: f32) -> Field<[f32; 4]> {
    let weighted = mapped(color, |[r, g, b, a]| [r * a, g * a, b * a, a]);
    let sum = blurred(&weighted, f64::from(sigma));
    mapped(&sum, |[r, g, b, a]| match a > 1e-6 {
        true => [r / a, g / a, b / a, a.min(1.0)],
        false => [1.0, 1.0, 1.0, 0.0],
    })
}

/// Where the paper is wet, 0 to 1, over the share of the picture that the settings say.
fn wet_places(width: usize, height: usize, settings: &WetSettings) -> Field<f32> {
    let mut noise = random(settings.seed, 41);
    let octaves = [Hills::new(&mut noise), Hills::new(&mut noise)];
    let step = 1.0 / (8.0 * settings.reach_px.max(1.0));
    let mut places = Field::filled(width, height, 0.0_f32);
    places.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let x = x as f32 * step;
            let y = y as f32 * step;
            *out = octaves[0].at(x, y) + 0.5 * octaves[1].at(2.0 * x, 2.0 * y);
        }
    });
    let dry = Quantiles::of(&places).at(1.0 - settings.amount);
    let whole = settings.amount >= 1.0;
    places.values_mut().par_iter_mut().for_each(|place| {
        *place = if whole { 1.0 } else { smoothstep([dry - 0.05, dry + 0.1], *place) };
    });
    places
}

/// The picture displaced by turbulence, at most by about the reach.
fn displaced(color: &Field<[f32; 4]>, settings: &WetSettings) -> Field<[f32; 4]> {
    let width = color.width();
    let height = color.height();
    let mut noise = random(settings.seed, 43);
    let hills: [Hills; 6] = std::array::from_fn(|_| Hills::new(&mut noise));
    let step = 1.0 / (1.2 * settings.reach_px.max(1.0));
    let mut moved = Field::filled(width, height, [0.0; 4]);
    moved.values_mut().par_chunks_mut(width).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let at = |axis: usize| -> f32 {
                let octave = |octave: usize| {
                    let finer = (1 << octave) as f32 * step;
                    hills[3 * axis + octave].at(x as f32 * finer, y as f32 * finer)
                        / (1 << octave) as f32
                };
                settings.reach_px * (octave(0) + octave(1) + octave(2))
            };
            let place = |from: usize, by: f32, size: usize| {
                (from as f32 + by).round().clamp(0.0, (size - 1) as f32) as usize
            };
            *out = color[(place(x, at(0), width), place(y, at(1), height))];
        }
    });
    moved
}

/// The mean of two colours, weighted by share and coverage.
pub(super) fn mixed(from: [f32; 4], to: [f32; 4], share: f32) -> [f32; 4] {
    if share <= 0.0 {
        return from;
    }
    let own = (1.0 - share) * from[3];
    let other = share * to[3];
    let covered = own + other;
    let by = if covered > 0.0 { other / covered } else { 0.0 };
    let color: [f32; 3] = std::array::from_fn(|i| from[i] + (to[i] - from[i]) * by);
    [color[0], color[1], color[2], covered]
}

fn mapped<const N: usize, const M: usize>(
    field: &Field<[f32; N]>,
    of: impl Fn([f32; N]) -> [f32; M] + Sync,
) -> Field<[f32; M]> {
    let values = field.values().par_iter().map(|value| of(*value)).collect();
    Field::from_values(field.width(), field.height(), values)
}
