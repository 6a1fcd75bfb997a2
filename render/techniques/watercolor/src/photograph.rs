//! The wash of a photograph: its flat colours after the effects that only photographs have.
//!
//! Washes run into their neighbours while they are wet. The steps of a smooth gradient run together
//! where the photograph has no outline, for example in a sky, which then has no hard arcs. At
//! random places colours flow across weak outlines along a turbulent displacement. This makes
//! feathers. Then we lift darks and leave whites as bare paper. Brush strokes end in a ragged
//! margin before the border.
//!
//! We find flat regions in a smaller picture and enlarge them. Each pixel weighs the colours around
//! it by a cubic B-spline and takes the heaviest one, so that outlines are smooth curves. Where the
//! two heaviest are nearly equal they mix, over about a pixel.
//!
//! We do all this on the processor, before the effects of water and paper. It is the same for
//! colours and for glazes of pigments.

use graphics::blurred;
use graphics::field::Field;
use graphics::noise::{Hills, random};
use graphics::smoothstep;
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::effects::edges_on_cpu;
use crate::settings::{MarginSettings, Settings, WetSettings};
use crate::textures::Quantiles;

/// The wash in `width` x `height` pixels. You pass the photograph as `original` and its flat
/// colours as `flat`, both in the size of abstraction, which is at most the size of the wash.
/// `abstraction` are the settings for that size, `settings` the ones for the picture.
pub(super) fn photograph_wash(
    (original, flat): (&Field<[f32; 4]>, &Field<[f32; 4]>),
    (width, height): (usize, usize),
    abstraction: &Settings,
    settings: &Settings,
) -> Field<[f32; 4]> {
    let running = running(original, flat, &abstraction.wet);
    let margin = Margin::new(width, height, &settings.margin);
    let dark = Rgb::from_hex(&settings.tones.dark).unwrap_or(Rgb([0.0; 3]));
    let dark = dark.0.map(|value| value as f32);
    let reserve = settings.tones.reserve;
    let enlarged = Enlarged::new(flat, width, height);
    let same = (flat.width(), flat.height()) == (width, height);
    let mut wash = Field::filled(width, height, [0.0; 4]);
    wash.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        for (x, out) in row.iter_mut().enumerate() {
            let mut color = if same { flat[(x, y)] } else { enlarged.at(x, y) };
            if let Some(running) = &running {
                let (ran, share) = match same {
                    true => (running.color[(x, y)], running.share[(x, y)]),
                    false => (
                        enlarged.smooth(&running.color, x, y),
                        enlarged.smooth(&running.share, x, y),
                    ),
                };
                color = mixed(color, ran, share[0]);
            }
            let [r, g, b, covered] = color;
            let mut covered = covered;
            if reserve < 1.0 {
                let bare = [reserve, reserve + (1.0 - reserve) / 2.0];
                covered *= 1.0 - smoothstep(bare, r.min(g).min(b));
            }
            if let Some(margin) = &margin {
                covered *= margin.painted(x, y);
            }
            let [r, g, b] = [0, 1, 2].map(|i| dark[i] + (1.0 - dark[i]) * color[i]);
            *out = [r, g, b, covered];
        }
    });
    wash
}

struct Margin {
    width_px: f32,
    ragged_px: f32,
    size: [f32; 2],
    hills: [Hills; 3],
}

impl Margin {
    /// The margin of a picture of `width` x `height` pixels. This is `None` if the picture is
    /// painted to its borders.
    fn new(width: usize, height: usize, settings: &MarginSettings) -> Option<Self> {
        let MarginSettings { width_px, ragged_px, seed } = *settings;
        let mut noise = random(seed, 47);
        let hills = std::array::from_fn(|_| Hills::new(&mut noise));
        let size = [width as f32, height as f32];
        (width_px > 0.0).then_some(Self { width_px, ragged_px, size, hills })
    }

    /// The share of the pixel at `x`, `y` that is painted, 0 to 1.
    fn painted(&self, x: usize, y: usize) -> f32 {
        let x = x as f32 + 0.5;
        let y = y as f32 + 0.5;
        let [width, height] = self.size;
        let sides = [x.min(width - x), y.min(height - y)];
        let most = self.width_px + 2.0 * self.ragged_px;
        if sides[0].min(sides[1]) > most {
            return 1.0;
        }
        let ragged = self.ragged_px.max(1.0);
        let [strokes, bristles, wander] = &self.hills;
        // Strokes run from side to side: they end at different places to the left and right,
        // and their sides wander a little at the top and bottom.
        let side = if x < width - x { 0.0 } else { 511.5 };
        let end = 0.7 * strokes.at(side + x / (12.0 * ragged), y / (5.0 * ragged))
            + 0.12 * bristles.at(side + x / (4.0 * ragged), y / (1.2 * ragged));
        let row = if y < height - y { 0.0 } else { 511.5 };
        let edge = 0.5 * wander.at(x / (7.0 * ragged), row + y / (7.0 * ragged))
            + 0.12 * strokes.at(x / ragged, row + y / ragged);
        let across = sides[0] + self.ragged_px * 1.6 * end;
        let along = sides[1] + self.ragged_px * 1.6 * edge;
        (across.min(along) - self.width_px + 0.5).clamp(0.0, 1.0)
    }
}

/// The picture `flat`, enlarged to `width` x `height` pixels. These are at least as many as it has.
pub(crate) fn enlarged(flat: &Field<[f32; 4]>, width: usize, height: usize) -> Field<[f32; 4]> {
    if (flat.width(), flat.height()) == (width, height) {
        return flat.clone();
    }
    let enlarged = Enlarged::new(flat, width, height);
    let mut picture = Field::filled(width, height, [0.0; 4]);
    picture.values_mut().par_chunks_mut(width.max(1)).enumerate().for_each(|(y, row)| {
        row.iter_mut().enumerate().for_each(|(x, out)| *out = enlarged.at(x, y));
    });
    picture
}

/// A flat picture, seen on a grid of another size.
struct Enlarged<'a> {
    flat: &'a Field<[f32; 4]>,
    /// Pixels of the flat picture per pixel of the enlarged one.
    step: [f32; 2],
}

impl<'a> Enlarged<'a> {
    /// The picture `flat` on a grid of `width` x `height` pixels. These are at least as many as it
    /// has.
    fn new(flat: &'a Field<[f32; 4]>, width: usize, height: usize) -> Self {
        let step = [
            flat.width() as f32 / width.max(1) as f32,
            flat.height() as f32 / height.max(1) as f32,
        ];
        Self { flat, step }
    }

    fn at(&self, x: usize, y: usize) -> [f32; 4] {
        let [(columns, across), (rows, down)] = self.taps(x, y);
        let middle = self.flat[(columns[1], rows[1])];
        let mut colors = [(middle, 0.0_f32); 16];
        let mut count = 0;
        for (row, down) in rows.into_iter().zip(down) {
            for (column, across) in columns.into_iter().zip(across) {
                let color = self.flat[(column, row)];
                let weight = across * down;
                match colors[..count].iter_mut().find(|(own, _)| *own == color) {
                    Some((_, sum)) => *sum += weight,
                    None => {
                        colors[count] = (color, weight);
                        count += 1;
                    }
                }
            }
        }
        if count == 1 {
            return colors[0].0;
        }
        let [mut first, mut second] = [(middle, 0.0_f32); 2];
        for &own in &colors[..count] {
            if own.1 > first.1 {
                (first, second) = (own, first);
            } else if own.1 > second.1 {
                second = own;
            }
        }
        // The difference of the weights grows by about 4/3 in a pixel of the flat picture.
        let apart = (first.1 - second.1) / (4.0 / 3.0 * self.step[0]);
        let share = (0.5 - apart).clamp(0.0, 0.5);
        mixed(first.0, second.0, share)
    }

    /// Value of a smooth picture at a pixel of the enlarged grid, interpolated linearly. The
    /// picture has the size of the flat one.
    fn smooth<const N: usize>(&self, picture: &Field<[f32; N]>, x: usize, y: usize) -> [f32; N] {
        let (left, right, a) = linear_taps(x, self.step[0], picture.width());
        let (above, below, b) = linear_taps(y, self.step[1], picture.height());
        let corners = [(left, above), (right, above), (left, below), (right, below)];
        let [p, q, r, s] = corners.map(|corner| picture[corner]);
        std::array::from_fn(|i| {
            let upper = p[i] + (q[i] - p[i]) * a;
            let lower = r[i] + (s[i] - r[i]) * a;
            upper + (lower - upper) * b
        })
    }

    /// Columns and rows around a pixel, each with its weights.
    fn taps(&self, x: usize, y: usize) -> [([usize; 4], [f32; 4]); 2] {
        [
            cubic_taps(x, self.step[0], self.flat.width()),
            cubic_taps(y, self.step[1], self.flat.height()),
        ]
    }
}

/// The two cells around the middle of pixel `at` on a line of `size` cells, and the share of the
/// second. A pixel is `step` cells wide.
fn linear_taps(at: usize, step: f32, size: usize) -> (usize, usize, f32) {
    let at = ((at as f32 + 0.5) * step - 0.5).clamp(0.0, (size - 1) as f32);
    let low = at as usize;
    (low, (low + 1).min(size - 1), at - low as f32)
}

/// The four cells around the middle of pixel `at` on a line of `size` cells, with their weights. A
/// pixel is `step` cells wide.
fn cubic_taps(at: usize, step: f32, size: usize) -> ([usize; 4], [f32; 4]) {
    let place = (at as f32 + 0.5) * step - 0.5;
    let low = place.floor();
    let cells = [-1.0, 0.0, 1.0, 2.0].map(|by| (low + by).clamp(0.0, (size - 1) as f32) as usize);
    (cells, b_spline(place - low))
}

/// Weights of the cubic B-spline at the share `t` between the second and third of four cells.
fn b_spline(t: f32) -> [f32; 4] {
    let u = 1.0 - t;
    let [second, third] = [t, u].map(|t| (3.0 * t - 6.0) * t * t + 4.0);
    [u * u * u, second, third, t * t * t].map(|weight| weight / 6.0)
}

/// Standard deviation of the blur of the photograph before we look for outlines, as a share of
/// [`WetSettings::tone_px`].
const OUTLINE_BLUR: f32 = 0.08;

/// Contrast below which the photograph counts as smooth: noise of a sensor.
const SMOOTH: f32 = 0.015;

/// Where steps of a gradient run together, an outline begins to stay at the first contrast and
/// stays wholly from the second on.
const STAYS: [f32; 2] = [0.04, 0.12];

/// Where the paper is wet, an outline begins to stay at the first contrast and stays wholly from
/// the second on.
const STAYS_WET: [f32; 2] = [0.3, 0.6];

/// Colours that run into each other, and where they do.
#[derive(Debug, Clone, PartialEq)]
struct Running {
    /// Encoded sRGB and coverage of the colours that ran.
    color: Field<[f32; 4]>,
    /// Share of these colours in each pixel of the picture, 0 to 1.
    share: Field<[f32; 1]>,
}

/// The colours of `flat` that run into each other, `None` if nothing runs. You pass the photograph
/// in this size as `original`.
fn running(
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

/// The contrast of the nearest outlines. It falls with the distance. `blur_px` is the standard
/// deviation of the blur that `contrast` already has. With it, the middle of an outline keeps about
/// its contrast.
fn spread(contrast: &Field<[f32; 1]>, sigma: f32, blur_px: f32) -> Field<[f32; 1]> {
    let gain = 2.5 * sigma / blur_px.max(0.6);
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

/// How wet the paper is, 0 to 1. The settings say how much of the picture this covers.
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
            let [right, down] = [0, 3].map(|first| {
                let octaves = [0, 1, 2].map(|octave| {
                    let finer = (1 << octave) as f32 * step;
                    hills[first + octave].at(x as f32 * finer, y as f32 * finer)
                        / (1 << octave) as f32
                });
                settings.reach_px * (octaves[0] + octaves[1] + octaves[2])
            });
            *out = color[(moved_by(x, right, width), moved_by(y, down, height))];
        }
    });
    moved
}

/// The index nearest to `from + by` on a line of `size` places.
fn moved_by(from: usize, by: f32, size: usize) -> usize {
    (from as f32 + by).round().clamp(0.0, (size - 1) as f32) as usize
}

/// The mean of two colours, weighted by share and coverage.
fn mixed(from: [f32; 4], to: [f32; 4], share: f32) -> [f32; 4] {
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
