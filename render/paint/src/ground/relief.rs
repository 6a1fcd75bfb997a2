//! Reliefs of grounds: linen, panel, paper and wood from a seed, and the grey values of a picture.

use graphics::field::Field;
use graphics::noise::{Hills, random};
use graphics::picture_formats::small_picture;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::primer::{ColorPrimer, Primer};
use super::{GroundError, check_range};
use crate::optics::Gloss;

/// Range of the relief of linen, paper, panels and wood, in mm.
const RELIEF_MM: [f64; 2] = [0.0, 2.0];

/// Random stream of each kind of ground, so that you get different grounds from one seed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Stream {
    Linen = 0,
    Paper = 1,
    Panel = 2,
    Wood = 3,
}

/// Checks a relief and starts the random numbers of its ground. Returns the relief in mm
/// and the generator.
pub(super) fn set_up(
    relief_mm: f64,
    seed: u64,
    stream: Stream,
) -> Result<(f32, ChaCha8Rng), GroundError> {
    let relief = check_range("relief_mm", " mm", relief_mm, RELIEF_MM)?;
    Ok((relief as f32, random(seed, stream as u64)))
}

/// Evaluates `height_mm(x, y)` for every cell. We count negative heights as 0.
pub(super) fn heights_mm(
    width: usize,
    height: usize,
    height_mm: impl Fn(usize, usize) -> f32 + Sync,
) -> Field<f32> {
    let mut heights = Field::filled(width, height, 0.0_f32);
    heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
        *out = height_mm(index % width, index / width).max(0.0);
    });
    heights
}

/// Settings of primed linen. Warp (along y) and weft (along x) cross in plain weave. The threads
/// have slubs and uneven distances, and the priming fills the gaps.
///
/// Painters' canvases have about 8 to 25 threads per centimetre. When you prime them, their relief
/// is 0.1 to 0.2 mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Linen {
    /// Seed of the cloth's irregularities, 1 by default.
    pub seed: u64,
    /// Threads per centimetre in both directions, 2 to 60. 14 by default.
    pub threads_per_cm: f64,
    /// Height from the gaps to the top of an average thread in mm, 0 to 2. 0.12 by default.
    pub relief_mm: f64,
    /// How much threads differ in height, from each other and along their length, 0 to 1. 0 by default, so
    /// files from before this setting keep their weave. New canvases have [`Linen::UNEVENNESS`].
    #[serde(skip_serializing_if = "is_even")]
    pub unevenness: f64,
}

fn is_even(unevenness: &f64) -> bool {
    *unevenness == 0.0
}

impl Default for Linen {
    fn default() -> Self {
        Self { seed: 1, threads_per_cm: 14.0, relief_mm: 0.12, unevenness: 0.0 }
    }
}

/// Vertical deflection of a thread in the weave, as a share of the relief (chosen by eye).
/// The round profile of the thread takes up the rest.
const SWING: f32 = 0.45;

/// Depth up to which the priming fills the gaps, as a share of the relief (chosen by eye).
const FILLED: f32 = 0.25;

impl Linen {
    /// Unevenness of new canvases (chosen by eye).
    pub const UNEVENNESS: f64 = 0.5;

    /// Heights in mm of `width` x `height` cells, each `cell_mm` wide.
    ///
    /// # Errors
    /// [`GroundError::OutOfRange`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let (relief, mut random) = set_up(self.relief_mm, self.seed, Stream::Linen)?;
        let count = check_range("threads_per_cm", "", self.threads_per_cm, [2.0, 60.0])?;
        let pitch = 10.0 / count / cell_mm;
        let warp = Threads::new(width, height, pitch, &mut random);
        let weft = Threads::new(height, width, pitch, &mut random);
        let grain = Hills::new(&mut random);
        let grain_step = (cell_mm / 0.25) as f32;
        let uneven = check_range("unevenness", "", self.unevenness, [0.0, 1.0])? as f32;
        let weft_heights = weft.heights(uneven, &mut random);
        let warp_heights = warp.heights(uneven, &mut random);
        Ok(heights_mm(width, height, |x, y| {
            // Where the warp is up, the weft is down.
            let upper = warp.top(x, y, weft.swing[y], &warp_heights);
            let top = upper.max(weft.top(y, x, -warp.swing[x], &weft_heights));
            let rough = 0.03 * grain.at(x as f32 * grain_step, y as f32 * grain_step);
            let filled = soft_max(top, FILLED) + rough;
            relief * (filled - FILLED) / (1.0 - FILLED)
        }))
    }
}

fn soft_max(a: f32, b: f32) -> f32 {
    let d = a - b;
    0.5 * (a + b + (d * d + 0.02).sqrt())
}

/// All threads of one direction. `across` counts cells perpendicular to the threads,
/// `along` cells in their direction.
struct Threads {
    /// Distance between threads, in cells.
    pitch: f32,
    nearest: Vec<usize>,
    /// Vertical deflection of threads of the other direction, for each cell across: 1 over
    /// the middle of a thread of sign 1, -1 over one of sign -1.
    swing: Vec<f32>,
    threads: Vec<Thread>,
}

struct Thread {
    /// Middle and half width of the thread, in cells across, for each cell along.
    course: Vec<[f32; 2]>,
    /// 1 and -1 for neighbouring threads, which deflect in opposite directions.
    sign: f32,
}

impl Threads {
    fn new(across: usize, along: usize, pitch: f64, random: &mut ChaCha8Rng) -> Self {
        // We add two threads beyond each edge, as neighbours of the outermost threads that you see.
        let mut middles = vec![-2.0 * pitch * random.random_range(0.8..1.0)];
        while middles[middles.len() - 1] < across as f64 + 2.0 * pitch {
            let step = pitch * random.random_range(0.82..1.18);
            middles.push(middles[middles.len() - 1] + step);
        }
        let wander = Hills::new(random);
        let thickness = Hills::new(random);
        let pitch = pitch as f32;
        let threads = middles.iter().enumerate().map(|(number, middle)| {
            let row = number as f32 * 7.31;
            let usual = 0.5 * random.random_range(0.92..1.1f32);
            let course = (0..along).map(|cell| {
                let place = cell as f32 / pitch;
                let aside = 0.12 * wander.at(place / 9.0, row);
                // Slubs: thick stretches, some dozen threads long.
                let slub = (thickness.at(place / 14.0, row) - 0.45).max(0.0);
                let width = usual + 0.05 * thickness.at(place / 3.0, row + 3.0) + 0.45 * slub;
                [*middle as f32 + pitch * aside, pitch * width]
            });
            Thread { course: course.collect(), sign: if number % 2 == 0 { 1.0 } else { -1.0 } }
        });
        let threads: Vec<Thread> = threads.collect();
        let mut nearest = Vec::with_capacity(across);
        let mut swing = Vec::with_capacity(across);
        let mut index = 1;
        for cell in 0..across {
            let place = cell as f64;
            while place > f64::midpoint(middles[index], middles[index + 1]) {
                index += 1;
            }
            nearest.push(index);
            // A cosine from the middle of one thread to the next.
            let from = if place < middles[index] { index - 1 } else { index };
            let share = (place - middles[from]) / (middles[from + 1] - middles[from]);
            let sign = f64::from(threads[from].sign);
            swing.push((sign * (std::f64::consts::PI * share).cos()) as f32);
        }
        Self { pitch, nearest, swing, threads }
    }

    /// Heights of these threads.
    fn heights(&self, uneven: f32, random: &mut ChaCha8Rng) -> ThreadHeights {
        let usual = self.threads.iter().map(|_| random.random_range(-0.3..0.3)).collect();
        ThreadHeights { usual, along: Hills::new(random), uneven, pitch: self.pitch }
    }

    /// Height of the threads at a cell, as a share of the relief. `swing` is 1 where
    /// threads of sign 1 are all the way up, -1 where they are down. `heights` has one factor for each thread.
    fn top(&self, across: usize, along: usize, swing: f32, heights: &ThreadHeights) -> f32 {
        let nearest = self.nearest[across];
        let mut top = 0.0f32;
        for index in nearest - 1..=nearest + 1 {
            let thread = &self.threads[index];
            let [middle, half] = thread.course[along];
            let aside = (across as f32 - middle) / half;
            let round = 1.0 - aside * aside;
            if round > 0.0 {
                let lift = 0.5 * SWING * (1.0 + thread.sign * swing);
                top = top.max((lift + (1.0 - SWING) * round.sqrt()) * heights.at(index, along));
            }
        }
        top
    }
}

/// Factors on the heights of threads: each thread has its own, and it changes along the thread.
struct ThreadHeights {
    /// Height of each thread less the mean.
    usual: Vec<f32>,
    /// Change of the heights along the threads.
    along: Hills,
    uneven: f32,
    pitch: f32,
}

impl ThreadHeights {
    fn at(&self, thread: usize, along: usize) -> f32 {
        if self.uneven == 0.0 {
            return 1.0;
        }
        // Tension changes over some threads of the other direction.
        let place = along as f32 / self.pitch;
        let tension = self.along.at(place / 6.0, thread as f32 * 5.17);
        1.0 + self.uneven * (self.usual[thread] + 0.35 * tension)
    }
}

/// Settings of a smooth, nearly flat panel. The brush that primed it left faint marks along x, and
/// sanding wore them down.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Panel {
    /// Seed of the brush marks, 1 by default.
    pub seed: u64,
    /// Height from an average hollow to an average ridge in mm, 0 to 2. 0.012 by default.
    pub relief_mm: f64,
}

impl Default for Panel {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.012 }
    }
}

impl Panel {
    /// Heights in mm of `width` x `height` cells, each `cell_mm` wide.
    ///
    /// # Errors
    /// [`GroundError::OutOfRange`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let (relief, mut random) = set_up(self.relief_mm, self.seed, Stream::Panel)?;
        let [marks, fine, sway, rub] = [(); 4].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        Ok(heights_mm(width, height, |x, y| {
            let x = mm * x as f32;
            let y = mm * y as f32;
            // Strokes are not quite straight. Marks of bristles are long and thin.
            let across = y + 1.5 * sway.at(x / 60.0, y / 25.0);
            let bristles =
                0.6 * marks.at(x / 30.0, across / 0.9) + 0.4 * fine.at(x / 18.0, across / 0.35);
            let left = 0.6 + 0.4 * rub.at(x / 14.0, y / 9.0);
            relief * (0.5 + left * bristles)
        }))
    }
}

/// Finish of watercolour paper: how the mill pressed it. This decides its grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PaperFinish {
    /// Pressed between felts without heat: an even grain.
    #[default]
    ColdPressed,
    /// Hardly pressed: a deep, coarse grain.
    Rough,
    /// Pressed between hot rollers: nearly smooth.
    HotPressed,
}

/// Settings of watercolour paper. The felt in the press leaves its imprint: bumps 0.3 to 3.6 mm
/// wide with flattened tops.
///
/// Profiles of cold-pressed papers are 0.05 to 0.1 mm deep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, from = "PaperFields")]
pub struct Paper {
    /// Seed of the grain, 1 by default.
    pub seed: u64,
    /// Height from an average hollow to an average bump in mm, 0 to 2. If you leave this out, you
    /// get the height of the finish.
    pub relief_mm: f64,
    /// Finish of the paper, cold-pressed by default.
    #[serde(rename = "making", skip_serializing_if = "PaperFinish::is_default")]
    pub finish: PaperFinish,
}

/// Fields of a paper in a file, all optional.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PaperFields {
    seed: Option<u64>,
    relief_mm: Option<f64>,
    making: Option<PaperFinish>,
}

impl From<PaperFields> for Paper {
    fn from(fields: PaperFields) -> Self {
        let default = Self::of(fields.making.unwrap_or_default(), fields.seed.unwrap_or(1));
        Self { relief_mm: fields.relief_mm.unwrap_or(default.relief_mm), ..default }
    }
}

impl Default for Paper {
    fn default() -> Self {
        Self::of(PaperFinish::ColdPressed, 1)
    }
}

/// One octave of bumps: their width in mm, their share of the relief, and the rotation of their
/// noise lattice in degrees. This rotation hides the axes.
type Bumps = (f64, f32, f64);

impl PaperFinish {
    /// Average relief of papers of this finish, in mm.
    #[must_use]
    pub fn relief_mm(self) -> f64 {
        match self {
            Self::ColdPressed => 0.08,
            Self::Rough => 0.13,
            Self::HotPressed => 0.02,
        }
    }

    fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Octaves of the grain, chosen by eye.
    fn bumps(self) -> [Bumps; 4] {
        match self {
            Self::ColdPressed => {
                [(2.6, 0.30, 17.0), (1.3, 0.42, 41.0), (0.65, 0.25, 68.0), (0.3, 0.10, 5.0)]
            }
            Self::Rough => {
                [(3.6, 0.34, 17.0), (1.9, 0.46, 41.0), (0.9, 0.20, 68.0), (0.4, 0.07, 5.0)]
            }
            Self::HotPressed => {
                [(2.6, 0.20, 17.0), (0.9, 0.30, 41.0), (0.45, 0.30, 68.0), (0.22, 0.20, 5.0)]
            }
        }
    }
}

impl Paper {
    /// Paper with the average relief of its finish.
    #[must_use]
    pub fn of(finish: PaperFinish, seed: u64) -> Self {
        Self { seed, relief_mm: finish.relief_mm(), finish }
    }

    /// Heights in mm of `width` x `height` cells, each `cell_mm` wide.
    ///
    /// # Errors
    /// [`GroundError::OutOfRange`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let (relief, mut random) = set_up(self.relief_mm, self.seed, Stream::Paper)?;
        let octaves = self.finish.bumps().map(|(size_mm, share, degrees)| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let step = cell_mm / size_mm;
            (Hills::new(&mut random), share, [cos * step, sin * step].map(|v| v as f32))
        });
        Ok(heights_mm(width, height, |x, y| {
            let x = x as f32;
            let y = y as f32;
            let sum: f32 = octaves
                .iter()
                .map(|(hills, share, [c, s])| share * hills.at(x * c - y * s, x * s + y * c))
                .sum();
            // Pressing flattens bumps strongly and hollows slightly, so we use a soft limit for
            // each.
            let pressed = if sum > 0.0 { sum / (1.0 + 1.5 * sum) } else { sum / (1.0 - 0.3 * sum) };
            relief * (0.65 + 1.3 * pressed)
        }))
    }
}

/// Settings of varnished walnut, from which painters' palettes are made: long fibres along x,
/// growth rings, and open pores that the varnish has not filled.
///
/// We chose the depth by eye: deep enough to look like wood, too shallow to catch a brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wood {
    /// Seed of the grain, 1 by default.
    pub seed: u64,
    /// Height from the bottom of an average pore to the average surface in mm, 0 to 2. 0.1
    /// by default.
    pub relief_mm: f64,
}

impl Default for Wood {
    fn default() -> Self {
        Self { seed: 1, relief_mm: 0.1 }
    }
}

/// Average distance of growth rings, in mm.
const RING_MM: f32 = 5.0;

impl Wood {
    /// Default colour: walnut brown.
    pub(super) fn walnut() -> Primer {
        Primer::Color(ColorPrimer { rgb: "#7a5433".to_owned() })
    }

    /// Default gloss: varnish.
    pub(super) const VARNISH: Gloss = Gloss { strength: 0.2, exponent: 40.0 };

    /// Heights in mm of `width` x `height` cells, each `cell_mm` wide.
    ///
    /// # Errors
    /// [`GroundError::OutOfRange`].
    pub fn heights_mm(
        &self,
        width: usize,
        height: usize,
        cell_mm: f64,
    ) -> Result<Field<f32>, GroundError> {
        let (relief, mut random) = set_up(self.relief_mm, self.seed, Stream::Wood)?;
        let [sway, drift, fibres, fine, pores, open] = [(); 6].map(|()| Hills::new(&mut random));
        let mm = cell_mm as f32;
        Ok(heights_mm(width, height, |x, y| {
            let x = mm * x as f32;
            let y = mm * y as f32;
            // Fibres follow the rings, which sway along the trunk.
            let across =
                y + 9.0 * sway.at(x / 160.0, y / 50.0) + 1.2 * drift.at(x / 45.0, y / 12.0);
            let ring = (across / RING_MM + 0.6 * drift.at(across / 17.0, 0.3)).rem_euclid(1.0);
            // Dense latewood stands higher. The next ring begins abruptly.
            let late = ring * ring * (1.0 - ring.powi(8));
            let grain =
                0.6 * fibres.at(x / 26.0, across / 1.1) + 0.4 * fine.at(x / 11.0, across / 0.55);
            // Pores: more of them in earlywood, each some millimetres long.
            let open = 0.15 * open.at(x / 30.0, across / 4.0) - 0.3 * late - 0.4;
            let depth = (3.0 * (pores.at(x / 5.0, across / 0.45) + open)).clamp(0.0, 1.0);
            relief * (0.7 + 0.4 * grain + 0.35 * late - 0.6 * depth)
        }))
    }
}

/// Relief from a grey picture with 8 or 16 bits, stretched over the canvas. Heights are
/// proportional to the stored values: black is 0, white is `depth_mm`. If the picture is coloured,
/// we convert it to luma.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PictureRelief {
    /// Path of the picture, a PNG, JPEG, TIFF or WebP file.
    pub path: String,
    /// Height of white in mm, 0 to 20. 0.2 by default.
    #[serde(default = "default_depth_mm")]
    pub depth_mm: f64,
}

fn default_depth_mm() -> f64 {
    0.2
}

impl PictureRelief {
    /// Heights in mm of `width` x `height` cells, by bilinear interpolation.
    ///
    /// # Errors
    /// [`GroundError`] for a depth out of range or a picture that cannot be read.
    pub fn heights_mm(&self, width: usize, height: usize) -> Result<Field<f32>, GroundError> {
        let depth = check_range("depth_mm", " mm", self.depth_mm, [0.0, 20.0])? as f32;
        let picture = self.read()?;
        let columns = picture.width() as usize;
        let rows = picture.height() as usize;
        let across = interpolation(width, columns);
        let down = interpolation(height, rows);
        let values = picture.as_raw();
        let scale = depth / f32::from(u16::MAX);
        let mut heights = Field::filled(width, height, 0.0);
        heights.values_mut().par_iter_mut().enumerate().for_each(|(index, out)| {
            let (left, right, share_x) = across[index % width];
            let (top, bottom, share_y) = down[index / width];
            let [above, below] = [top, bottom].map(|y| {
                let [a, b] = [left, right].map(|x| f32::from(values[y * columns + x]));
                a + (b - a) * share_x
            });
            *out = scale * (above + (below - above) * share_y);
        });
        Ok(heights)
    }

    fn read(&self) -> Result<image::ImageBuffer<image::Luma<u16>, Vec<u16>>, GroundError> {
        let rejected = |reason: String| GroundError::Picture { path: self.path.clone(), reason };
        let bytes =
            documents::file::disk::read(&self.path).map_err(|error| rejected(error.to_string()))?;
        let picture = small_picture(&bytes).map_err(rejected)?.into_luma16();
        if picture.is_empty() {
            return Err(rejected("the picture has no pixels".to_owned()));
        }
        Ok(picture)
    }
}

/// For each cell you get two neighbouring pixels, and the share of the second.
fn interpolation(cells: usize, pixels: usize) -> Vec<(usize, usize, f32)> {
    let last = pixels as f64 - 1.0;
    (0..cells)
        .map(|cell: usize| {
            let place = (cell as f64 + 0.5) / cells as f64 * pixels as f64 - 0.5;
            let place = place.clamp(0.0, last);
            let first = place as usize;
            (first, (first + 1).min(pixels - 1), (place - first as f64) as f32)
        })
        .collect()
}
