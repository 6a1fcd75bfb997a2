//! Effects on a picture of 750 x 570.

use divan::Bencher;
use render::field::Field;
use render::watercolor::{Backend, OnCpu};

/// Taking a picture in, which every other figure is above.
#[divan::bench]
fn take_in(bencher: Bencher<'_, '_>) {
    let field = Field::filled(750, 570, [0.5f32; 4]);
    bencher.bench_local(|| OnCpu.colour_of(&field).unwrap());
}
