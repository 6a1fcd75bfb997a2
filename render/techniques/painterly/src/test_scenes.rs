//! Material for the tests. We make a map and its strokes by code, open a graphics device, and
//! measure how far its pictures are from the processor's.

use super::passes::PaintedPicture;
use super::splats::StrokeSplat;
use artmap::map::{ArtMap, KeyMap, Tile};
use artmap::synthesis::SynthesisSettings;
use graphics::compute::Compute;
use graphics::field::Field;
use graphics::gpu::{BackendChoice, choose};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::io::Write;

pub(super) const SIZE: usize = 128;

/// Distance of neighbouring strokes in texels.
pub(super) const SPACING: usize = 10;

/// Fine texels along a side of a texel while strokes are drawn.
const FINE: usize = 3;

/// A map of ochre strokes at equal places, in `tones` tones. Strokes run along y.
pub(super) fn map(tones: usize) -> ArtMap {
    let keys = (0..tones)
        .map(|index| {
            key(
                &format!("tone {index}"),
                0.04 + 0.46 * (index as f32 / (tones.max(2) - 1) as f32).powi(2),
            )
        })
        .collect();
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
    fn mean(index: usize, part: usize, fine: &Field<[f32; 2]>) -> f32 {
        let x = FINE * (index % SIZE);
        let y = FINE * (index / SIZE);
        let all = (0..FINE * FINE).map(|at| fine[(x + at % FINE, y + at / FINE)][part]);
        all.sum::<f32>() / (FINE * FINE) as f32
    }
    let colors =
        (0..SIZE * SIZE).map(|index| [1.0, 0.8, 0.5].map(|share| share * mean(index, 0, &fine)));
    Tile {
        color: Field::from_values(SIZE, SIZE, colors.collect()),
        paint: None,
        height_mm: Some(Field::from_values(
            SIZE,
            SIZE,
            (0..SIZE * SIZE).map(|at| mean(at, 1, &fine)).collect(),
        )),
    }
}

/// A splat at a place of the picture with these radii across and along, turned by radians from
/// downwards, flat, in the middle of the depth.
pub(super) fn splat([x, y]: [f32; 2], [across, along]: [f32; 2], turn: f32) -> StrokeSplat {
    let (sin, cos) = turn.sin_cos();
    let reach = [[cos, sin], [sin, cos]]
        .map(|[a, b]| (a * a * across * across + b * b * along * along).sqrt());
    StrokeSplat {
        x,
        y,
        across: [cos / across, sin / across],
        along: [-sin / along, cos / along],
        reach,
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

/// Cover below which a pixel shows nothing in 8 bits, whatever its colour.
const INVISIBLE: f32 = 1.0 / 255.0;

/// A device, hardware before software. `None` without an adapter, with a note on standard error.
/// Appends the name of the adapter (or `none`) to the file that the environment variable
/// `IMPASTO_GPU_TESTS` names, if it is set.
pub(super) fn device() -> Option<Compute> {
    let device = choose(BackendChoice::Gpu).ok().flatten();
    let name = device.as_ref().map_or("none", |device| &device.adapter().name);
    if let Some(path) = std::env::var_os("IMPASTO_GPU_TESTS") {
        let mut list = std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap();
        writeln!(list, "{name}").unwrap();
    }
    if device.is_none() {
        let _ = writeln!(std::io::stderr(), "no graphics adapter: not tested");
    }
    device.map(Compute::gpu)
}

/// Greatest differences of two pictures: of cover, of encoded colour where it can be seen, and of
/// height, then the number of pixels with a compared colour.
pub(super) fn differences(one: &PaintedPicture, other: &PaintedPicture) -> ([f32; 3], usize) {
    fn size(picture: &PaintedPicture) -> (usize, usize) {
        (picture.color.width(), picture.color.height())
    }
    assert_eq!(size(one), size(other));
    let mut most = [0.0_f32; 3];
    let mut compared = 0;
    for (a, b) in one.color.values().iter().zip(other.color.values()) {
        let off: Vec<f32> = a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect();
        assert!(off.iter().all(|off| off.is_finite()), "{a:?} {b:?}");
        most[0] = most[0].max(off[3]);
        if a[3].min(b[3]) >= INVISIBLE {
            most[1] = off[..3].iter().fold(most[1], |most, &off| most.max(off));
            compared += 1;
        }
    }
    let heights = one.height_mm.values().iter().zip(other.height_mm.values());
    most[2] = heights.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    (most, compared)
}
