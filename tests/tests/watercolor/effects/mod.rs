//! Effects, textures and settings of watercolour, on CPU and GPU.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

use graphics::compute::Compute;
use graphics::field::Field;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use suite::adapter::device;
use watercolor::Settings;

mod on_fields;
mod definitions;
mod twins;
mod textures;
mod settings;
mod whole;
mod glazes;
mod photographs;

/// A random picture of small patches whose coverage is 0, 1 or between.
fn any_picture(width: usize, height: usize, seed: u64) -> Field<[f32; 4]> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let patches: Vec<[f32; 4]> = (0..64)
        .map(|i| {
            let mut color: [f32; 4] = std::array::from_fn(|_| random.random_range(0.0..1.0));
            color[3] = [0.0, 1.0, 1.0, color[3]][i % 4];
            color
        })
        .collect();
    Field::from_values(
        width,
        height,
        (0..width * height)
            .map(|i: usize| patches[(i % width / 5 + i / width / 4 * 7) % 64])
            .collect(),
    )
}

/// `settings` with all effects switched off, on smooth white paper.
fn without_effects(mut settings: Settings) -> Settings {
    settings.wash.density = 1.0;
    settings.wobble.amount_px = 0.0;
    settings.edges.strength = 0.0;
    settings.flow.strength = 0.0;
    settings.back_runs.strength = 0.0;
    settings.dispersion.strength = 0.0;
    settings.paper.strength = 0.0;
    settings.paper.relief = 0.0;
    "#ffffff".clone_into(&mut settings.paper.color);
    settings.dry_brush.amount = 0.0;
    settings
}

fn any_grey(width: usize, height: usize, seed: u64) -> Field<f32> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let values = (0..width * height).map(|_| random.random_range(0.0..1.0)).collect();
    Field::from_values(width, height, values)
}

fn numbers(field: &Field<[f32; 4]>) -> Vec<f64> {
    field.values().iter().flatten().map(|&value| f64::from(value)).collect()
}

fn greys(field: &Field<f32>) -> Vec<f64> {
    field.values().iter().map(|&value| f64::from(value)).collect()
}

#[test]
fn pictures_survive_upload_and_download() {
    let field = Field::from_values(3, 2, (0..6).map(|i| [i as f32 / 8.0; 4]).collect());
    let mut cpu = Compute::cpu();
    let image = cpu.upload(&field).unwrap();
    assert_eq!(cpu.download(&image).unwrap(), field);
    let Some(mut gpu) = device().map(Compute::gpu) else { return };
    let image = gpu.upload(&field).unwrap();
    assert_eq!(image.size(), (3, 2));
    assert_eq!(gpu.download(&image).unwrap(), field);
}
