//! Primed linen in plain weave.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use serde::{Deserialize, Serialize};

use super::error::{GroundError, check_range};
use super::relief::{self, Stream};
use graphics::field::Field;
use graphics::noise::Hills;

/// Settings of primed linen: warp (along y) and weft (along x) in plain weave, unevenly
/// spaced threads with slubs, gaps filled by the priming.
///
/// Painters' canvases have about 8 to 25 threads per centimetre; primed, their relief is
/// 0.1 to 0.2 mm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Linen {
    /// Seed of the cloth's irregularities, 1 by default.
    pub seed: u64,
    /// Threads per centimetre in both directions, 2 to 60; 14 by default.
    pub threads_per_cm: f64,
    /// Height from the gaps to the top of an average thread in mm, 0 to 2; 0.12 by default.
    pub relief_mm: f64,
}

impl Default for Linen {
    fn default() -> Self {
        Self { seed: 1, threads_per_cm: 14.0, relief_mm: 0.12 }
    }
}

/// Vertical deflection of a thread in the weave, as a share of the relief (chosen by eye).
/// The round profile of the thread takes up the rest.
const SWING: f32 = 0.45;

/// Depth up to which the priming fills the gaps, as a share of the relief (chosen by eye).
const FILLED: f32 = 0.25;

impl Linen {
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
        let (relief, mut random) = relief::set_up(self.relief_mm, self.seed, Stream::Linen)?;
        let count = check_range("threads_per_cm", "", self.threads_per_cm, [2.0, 60.0])?;
        let pitch = 10.0 / count / cell_mm;
        let warp = Threads::new(width, height, pitch, &mut random);
        let weft = Threads::new(height, width, pitch, &mut random);
        let grain = Hills::new(&mut random);
        let grain_step = (cell_mm / 0.25) as f32;
        Ok(relief::heights_mm(width, height, |x, y| {
            // Where the warp is up, the weft is down.
            let top = warp.top(x, y, weft.swing[y]).max(weft.top(y, x, -warp.swing[x]));
            let rough = 0.03 * grain.at(x as f32 * grain_step, y as f32 * grain_step);
            let filled = soft_max(top, FILLED) + rough;
            relief * (filled - FILLED) / (1.0 - FILLED)
        }))
    }
}

/// Smooth maximum of two values.
fn soft_max(a: f32, b: f32) -> f32 {
    let d = a - b;
    0.5 * (a + b + (d * d + 0.02).sqrt())
}

/// All threads of one direction. `across` counts cells perpendicular to the threads,
/// `along` cells in their direction.
struct Threads {
    /// Index of the nearest thread, for each cell across.
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
        // Two more threads beyond each edge, as neighbours of the outermost visible ones.
        let mut middles = vec![-2.0 * pitch * random.random_range(0.8..1.0)];
        while middles[middles.len() - 1] < across as f64 + 2.0 * pitch {
            let step = pitch * random.random_range(0.82..1.18);
            middles.push(middles[middles.len() - 1] + step);
        }
        let wander = Hills::new(random);
        let thickness = Hills::new(random);
        let pitch = pitch as f32;
        let thread = |(number, middle): (usize, &f64)| {
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
        };
        let threads: Vec<Thread> = middles.iter().enumerate().map(thread).collect();
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
        Self { nearest, swing, threads }
    }

    /// Height of the threads at a cell, as a share of the relief. `swing` is 1 where
    /// threads of sign 1 are all the way up, -1 where they are down.
    fn top(&self, across: usize, along: usize, swing: f32) -> f32 {
        let nearest = self.nearest[across];
        let mut top = 0.0f32;
        for thread in &self.threads[nearest - 1..=nearest + 1] {
            let [middle, half] = thread.course[along];
            let aside = (across as f32 - middle) / half;
            let round = 1.0 - aside * aside;
            if round > 0.0 {
                let lift = 0.5 * SWING * (1.0 + thread.sign * swing);
                top = top.max(lift + (1.0 - SWING) * round.sqrt());
            }
        }
        top
    }
}
