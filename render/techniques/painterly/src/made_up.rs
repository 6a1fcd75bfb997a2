//! A small map made by code, for tests.

use artmap::map::{ArtMap, KeyMap, Tile};
use artmap::synthesis::SynthesisSettings;
use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::splat::StrokeSplat;

/// Width and height of the tiles.
pub(super) const SIZE: usize = 128;

/// Distance of neighbouring strokes in texels.
pub(super) const SPACING: usize = 10;

/// Fine texels along a side of a texel while strokes are drawn.
const FINE: usize = 3;

/// A map of ochre strokes at equal places, in `tones` tones. Strokes run along y.
pub(super) fn map(tones: usize) -> ArtMap {
    let tone = |index: usize| 0.04 + 0.46 * (index as f32 / (tones.max(2) - 1) as f32).powi(2);
    let keys = (0..tones).map(|index| key(&format!("tone {index}"), tone(index))).collect();
    ArtMap {
        keys,
        first: 0,
        paint: None,
        spacing: SPACING as f64,
        mm_per_texel: None,
        guessed_relief: false,
        patch: 16,
        levels: 1,
        settings: SynthesisSettings::default(),
        provenance: "made up".to_owned(),
    }
}

fn key(name: &str, tone: f32) -> KeyMap {
    let tile = tile(tone);
    let sources = Field::filled(SIZE, SIZE, [0; 2]);
    KeyMap { name: name.to_owned(), tone: tile.tone(), tile, sources }
}

/// Strokes that wrap around the edges, each of its own shade, with a ridge along its middle. They
/// are drawn in fine texels and averaged.
fn tile(tone: f32) -> Tile {
    let size = FINE * SIZE;
    let spacing = FINE * SPACING;
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut fine = Field::filled(size, size, [tone, 0.0]);
    for _ in 0..SIZE * SIZE / (SPACING * SPACING) {
        let x = random.random_range(0..size);
        let y = random.random_range(0..size);
        let length = random.random_range(3 * spacing..5 * spacing);
        let shade = 1.0 + 0.9 * (random.random::<f32>() - 0.5);
        let bend = 0.15 * (random.random::<f32>() - 0.5);
        for along in 0..length {
            for across in 0..spacing {
                let u = x as f32 + bend * along as f32 + across as f32;
                let at = ((u as isize).rem_euclid(size as isize) as usize, (y + along) % size);
                let profile = (across as f32 + 0.5) / spacing as f32 * std::f32::consts::PI;
                fine[at] = [tone * shade * (0.6 + 0.4 * profile.sin()), 0.2 * profile.sin()];
            }
        }
    }
    let mean = |index: usize, part: usize| {
        let x = FINE * (index % SIZE);
        let y = FINE * (index / SIZE);
        let all = (0..FINE * FINE).map(|at| fine[(x + at % FINE, y + at / FINE)][part]);
        all.sum::<f32>() / (FINE * FINE) as f32
    };
    let color = |index| [1.0, 0.8, 0.5].map(|share| share * mean(index, 0));
    Tile {
        color: Field::from_values(SIZE, SIZE, (0..SIZE * SIZE).map(color).collect()),
        paint: None,
        height_mm: Some(Field::from_values(
            SIZE,
            SIZE,
            (0..SIZE * SIZE).map(|at| mean(at, 1)).collect(),
        )),
    }
}

/// A splat at a place of the picture with these radii across and along, turned by radians from
/// downwards; flat, in the middle of the depth.
pub(super) fn splat([x, y]: [f32; 2], [across, along]: [f32; 2], turn: f32) -> StrokeSplat {
    let (sin, cos) = turn.sin_cos();
    let reach = |a: f32, b: f32| (a * a * across * across + b * b * along * along).sqrt();
    StrokeSplat {
        x,
        y,
        across: [cos / across, sin / across],
        along: [-sin / along, cos / along],
        reach: [reach(cos, sin), reach(sin, cos)],
        depth: 0.5,
        slope: [0.0; 2],
        tolerance: 0.01,
        weight: 1.0,
        cover: 1.0,
        offset: [0.0; 2],
        extent: [across / SIZE as f32, along / SIZE as f32],
        slice: 0,
        halvings: 0,
        color: [0.0; 3],
    }
}
