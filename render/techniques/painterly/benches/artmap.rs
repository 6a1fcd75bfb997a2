//! Benchmarks of art maps: samples painted in a style, and maps of seven samples.

#![expect(clippy::unwrap_used, reason = "a bench may panic")]

use std::sync::OnceLock;

use artmap::map::ArtMap;
use artmap::painted::{PaintedSettings, Style, painted_samples};
use artmap::sample::SampleSet;
use artmap::synthesis::SynthesisSettings;
use divan::{Bencher, black_box};

/// Seven tones in the strokes of a style. If `nested`, all tones have the same strokes. If not,
/// each tone has its own seed.
fn samples(name: &str, nested: bool) -> SampleSet {
    let mut style = Style::named(name).unwrap();
    style.strokes.nested = nested;
    painted_samples(&style, &PaintedSettings::default()).unwrap()
}

/// Paints samples of seven tones in each style.
#[divan::bench(args = Style::ALL, sample_count = 2)]
fn painted(bencher: Bencher<'_, '_>, name: &str) {
    bencher.bench_local(|| samples(black_box(name), true));
}

/// Synthesises a map with tiles of 256 x 256 texels from samples.
fn map(set: &SampleSet) -> ArtMap {
    ArtMap::of(black_box(set), &SynthesisSettings::default()).unwrap()
}

/// Seven samples of the same strokes.
#[divan::bench(sample_count = 2)]
fn map_of_nested_samples(bencher: Bencher<'_, '_>) {
    static SET: OnceLock<SampleSet> = OnceLock::new();
    let set = SET.get_or_init(|| samples("oil-flat", true));
    bencher.bench_local(|| map(set));
}

/// Seven samples with different strokes, so that all tiles but the first have to be found.
#[divan::bench(sample_count = 2)]
fn map_of_unlike_samples(bencher: Bencher<'_, '_>) {
    static SET: OnceLock<SampleSet> = OnceLock::new();
    let set = SET.get_or_init(|| samples("oil-flat", false));
    bencher.bench_local(|| map(set));
}

fn main() {
    divan::main();
}
