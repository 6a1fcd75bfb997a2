use documents::hint::Explain;
use graphics::field::Field;

use super::*;
use crate::map::art_map::KeyMap;
use crate::map::tile::Tile;
use crate::synthesis::SynthesisSettings;

const SIZE: usize = 96;

/// Waves around a linear grey, `period` texels wide and shifted by `phase` periods, that lean by
/// one period over the height of the tile.
fn key(name: &str, grey: f32, period: f32, phase: f32) -> KeyMap {
    let color = Field::from_values(
        SIZE,
        SIZE,
        (0..SIZE * SIZE)
            .map(|index: usize| {
                let x = (index % SIZE) as f32;
                let y = (index / SIZE) as f32;
                let turns = x / period + phase + y / SIZE as f32;
                [grey * (1.0 + 0.3 * (turns * std::f32::consts::TAU).sin()); 3]
            })
            .collect(),
    );
    let tile = Tile { color, paint: None, height_mm: None };
    let sources = Field::filled(SIZE, SIZE, [0; 2]);
    KeyMap { name: name.to_owned(), tone: tile.tone(), tile, sources }
}

fn map(keys: Vec<KeyMap>) -> ArtMap {
    ArtMap {
        keys,
        first: 0,
        paint: None,
        spacing: 12.0,
        mm_per_texel: None,
        guessed_relief: false,
        patch: 16,
        levels: 1,
        settings: SynthesisSettings::default(),
        provenance: "waves".to_owned(),
    }
}

#[test]
fn a_good_map_has_no_faults() {
    let map = map(vec![
        key("dark", 0.05, 12.0, 0.0),
        key("middle", 0.2, 12.0, 0.0),
        key("light", 0.5, 12.0, 0.0),
    ]);
    assert_eq!(map.faults(), []);
    let figures = map.figures();
    assert_eq!((figures.keys.len(), figures.betweens.len()), (3, 6));
    assert!(figures.keys[2].coherence > 0.95, "{}", figures.keys[2].coherence);
    assert_eq!(figures.keys[1].tone, map.keys[1].tone);
    // The integral of a cosine of 96 texels until it falls to 0.05.
    let length = figures.keys[0].stroke_length;
    assert!((14.0..17.0).contains(&length), "{length}");
}

#[test]
fn a_single_tone_is_allowed() {
    let single = map(vec![key("only", 0.2, 12.0, 0.0)]);
    assert_eq!(single.faults(), []);
    assert!(single.figures().betweens.is_empty());
}

#[test]
fn strokes_at_other_places_are_told_with_the_tile() {
    let moved = map(vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.0, 0.5)]);
    let faults = moved.faults();
    let MapFault::Coherence { name, found, .. } = &faults[0] else { panic!("{faults:?}") };
    assert!(name == "light" && *found < -0.8, "{name} {found}");
    // In line art a tile may agree with its neighbour alone.
    let mut figures = moved.figures();
    figures.keys[1].neighbour_coherence = 0.7;
    let faults = figures.faults();
    assert!(!faults.iter().any(|fault| matches!(fault, MapFault::Coherence { .. })), "{faults:?}");
    // The first tile is the one that others are compared with.
    let other = ArtMap { first: 1, ..moved };
    let faults = other.faults();
    assert!(matches!(&faults[0], MapFault::Coherence { name, .. } if name == "dark"), "{faults:?}");
}

#[test]
fn a_seam_is_told_with_the_tile() {
    let map = map(vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.8, 0.25)]);
    let faults = map.faults();
    let seam = faults.iter().find(|fault| matches!(fault, MapFault::Seam { .. })).unwrap();
    assert!(seam.to_string().starts_with("tile `light`: steps across its border are 3."), "{seam}");
    // Where places inside vary as much, the border does not stand out.
    let mut figures = map.figures();
    figures.keys[1].usual_wrap_ratio = 4.0;
    let faults = figures.faults();
    assert!(!faults.iter().any(|fault| matches!(fault, MapFault::Seam { .. })), "{faults:?}");
}

#[test]
fn tones_that_do_not_rise_or_spread_are_told() {
    let tones = |greys: [f32; 3]| {
        map(greys.into_iter().zip(["a", "b", "c"]).map(|(g, n)| key(n, g, 12.0, 0.0)).collect())
    };
    let faults = tones([0.2, 0.05, 0.5]).faults();
    let step = MapFault::Step { darker: "a".into(), lighter: "b".into(), found: 0.0, wanted: 0.0 };
    assert_eq!(std::mem::discriminant(&faults[0]), std::mem::discriminant(&step), "{faults:?}");
    assert!(faults[0].to_string().starts_with("tones of `a` and `b` rise by -"), "{}", faults[0]);
    let alike = tones([0.2, 0.207, 0.5]).faults();
    assert!(matches!(alike[..], [MapFault::Step { .. }]), "{alike:?}");
    let narrow = tones([0.2, 0.23, 0.26]).faults();
    let [MapFault::Spread { found, wanted }] = narrow[..] else { panic!("{narrow:?}") };
    assert!(found < wanted && found > 4.0, "{found}");
}

#[test]
fn weak_and_uneven_in_betweens_are_told_and_every_fault_has_a_way_out() {
    let keys = vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.0, 0.0)];
    let mut figures = map(keys).figures();
    figures.betweens[0].contrast = Some(0.9);
    figures.betweens[1].tone += 0.6;
    figures.betweens[2].contrast = None;
    figures.keys[1].coherence = 0.5;
    figures.keys[1].neighbour_coherence = 0.55;
    figures.keys[0].wrap_ratio = 1.2;
    let faults = figures.faults();
    let words: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(words.len(), 4, "{words:?}");
    assert_eq!(
        words[2],
        "25 % between `dark` and `light`: contrast is 0.90 of theirs, wanted at least 0.93"
    );
    assert!(words[3].starts_with("50 % between `dark` and `light`: L* is "), "{}", words[3]);
    assert!(faults.iter().all(|fault| fault.hint().is_some()));
}
