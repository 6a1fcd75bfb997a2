//! Samples of strokes made by code, for tests.

use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Sample;

/// A sample of `size` x `size` texels covered by upright strokes `spacing` texels wide and about
/// four times as long, around a linear grey of `tone`. If you pass equal seeds, you get strokes at
/// equal places.
pub(crate) fn strokes(name: &str, size: usize, spacing: usize, tone: f32, seed: u64) -> Sample {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut color = Field::filled(size, size, [tone; 3]);
    let mut height = Field::filled(size, size, 0.0);
    let count = 3 * size * size / (4 * spacing * spacing);
    for _ in 0..count {
        let x = random.random_range(0..size + spacing);
        let y = random.random_range(0..size + 4 * spacing);
        let length = random.random_range(3 * spacing..5 * spacing);
        let shade = 1.0 + 0.35 * (random.random::<f32>() - 0.5);
        let bend = 0.15 * (random.random::<f32>() - 0.5);
        for along in 0..length {
            let Some(v) = y.checked_sub(along) else { break };
            let middle = x as f32 + bend * along as f32 - spacing as f32 / 2.0;
            for across in 0..spacing {
                let u = middle + across as f32 - spacing as f32 / 2.0;
                if u < 0.0 || u as usize >= size || v >= size {
                    continue;
                }
                // A ridge in the middle of the stroke, furrows at its sides.
                let profile = (across as f32 + 0.5) / spacing as f32 * std::f32::consts::PI;
                let ridge = profile.sin();
                color[(u as usize, v)] = [tone * shade * (0.7 + 0.3 * ridge); 3];
                height[(u as usize, v)] = 0.2 * ridge;
            }
        }
    }
    Sample {
        name: name.to_owned(),
        color,
        paint: None,
        height_mm: Some(height),
        mask: Field::filled(size, size, true),
        spacing: spacing as f64,
        mm_per_texel: Some(0.2),
        guessed_relief: false,
    }
}
