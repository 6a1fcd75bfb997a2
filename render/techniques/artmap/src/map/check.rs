//! Checks of a map: figures that you can measure without the samples, and the faults that these
//! show.

use std::cmp::Ordering;

use documents::hint::Explain;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::ArtMap;
use crate::map::Between;
use crate::measures::{Texture, coherence, contrast, stroke_length, usual_wrap_ratio, wrap_ratio};

/// We measure in-betweens at these shares of the way to the lighter tile.
const SHARES: [f32; 3] = [0.25, 0.5, 0.75];

/// Unevenness over a longer distance than this does not count as strokes. In distances of
/// neighbouring strokes.
const LEVELLED: f64 = 4.0;

/// Figures of a map, as [`MapFigures::of`] measures them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MapFigures {
    /// Index of the tile that the others follow.
    pub first: usize,
    /// Figures of the key tiles, in their order.
    pub keys: Vec<KeyFigures>,
    /// Figures of the tiles at 25, 50 and 75 % between each two neighbours, which strokes dissolve
    /// into.
    pub betweens: Vec<BetweenFigures>,
}

/// Figures of a key tile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeyFigures {
    /// Name of the sample.
    pub name: String,
    /// Mean L*, as the map stores it.
    pub tone: f64,
    /// Standard deviation of L*.
    pub contrast: f64,
    /// Length of the strokes along y in texels. We level the tile over four spacings first.
    pub stroke_length: f64,
    /// Correlation of its detail with the first tile's, -1 to 1. The first tile has 1.
    pub coherence: f64,
    /// Correlation of its detail with the neighbouring tile's, on the side of the first tile, -1
    /// to 1.
    ///
    /// Use this for line art: strokes are added from tone to tone, so that only neighbours agree.
    pub neighbour_coherence: f64,
    /// Steps of L* across the borders over the steps within the tile. If this is 1, no seam shows.
    pub wrap_ratio: f64,
    /// 95 of 100 places within the tile stay below this ratio.
    pub usual_wrap_ratio: f64,
}

/// Figures of a tile between two key tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BetweenFigures {
    /// Index of the darker key tile.
    pub lower: usize,
    /// Share of the way to the lighter one, 0 to 1.
    pub share: f64,
    /// Contrast relative to the key tiles, weighted by the share. `None` where they have no
    /// contrast.
    pub contrast: Option<f64>,
    /// Mean L*.
    pub tone: f64,
    /// Mean L* of the key tiles, weighted by the share.
    pub wanted_tone: f64,
}

fn between_figures(map: &ArtMap, lower: usize, keys: &[KeyFigures]) -> Vec<BetweenFigures> {
    let Some(transition) = map.transition(lower, Between::Dissolve) else {
        return Vec::new();
    };
    let darker = &keys[lower];
    let lighter = &keys[lower + 1];
    SHARES
        .map(|at: f32| {
            let tile = transition.at(at);
            let share = f64::from(at);
            fn mean(dark: f64, light: f64, share: f64) -> f64 {
                dark + share * (light - dark)
            }
            let of_keys = mean(darker.contrast, lighter.contrast, share);
            let found = contrast(&Texture::tiled(&tile.color));
            BetweenFigures {
                lower,
                share,
                contrast: (of_keys > 0.0).then(|| found / of_keys),
                tone: tile.tone(),
                wanted_tone: mean(darker.tone, lighter.tone, share),
            }
        })
        .to_vec()
}

/// Least coherence of a tile with the first tile, or with the next tile towards the first. For
/// comparison, independent synthesis stays below 0.15.
const COHERENCE: f64 = 0.60;
/// Largest step across the borders over the steps within a tile, unless places within it vary
/// more.
const WRAP: f64 = 1.05;
/// Least contrast of an in-between, relative to its key tiles.
const CONTRAST: f64 = 0.93;
/// The tone of an in-between may differ by this from the weighted mean, in L*.
const TONE: f64 = 0.5;
/// Least distance of neighbouring tones in L*. This is the step k of Yan and others (2008, equation
/// 7), which is 5 of 255 levels: for closer tones they make no tile in between.
const STEP: f64 = 5.0 / 2.55;
/// Least distance of the darkest from the lightest tone in L*. We chose this ourselves: with less,
/// you can hardly tell light and shade of a model apart.
const SPREAD: f64 = 20.0;

/// A fault of a map: where, the figure found, and the one wanted.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum MapFault {
    /// Strokes of a tile do not stand where the strokes of the first tile stand.
    #[error("tile `{name}`: coherence with the first tile is {found:.2}, wanted at least {wanted}")]
    #[hint("raise [follow], or choose a sample with clearer strokes as [first]")]
    Coherence {
        /// Name of the tile.
        name: String,
        /// Correlation of the detail.
        found: f64,
        /// Least correlation.
        wanted: f64,
    },
    /// A seam shows where a tile repeats.
    #[error(
        "tile `{name}`: steps across its border are {found:.2} of those inside, wanted at most {wanted:.2}"
    )]
    #[hint("build the map with another [seed], or mark a larger passage")]
    Seam {
        /// Name of the tile.
        name: String,
        /// Ratio of steps.
        found: f64,
        /// Largest ratio.
        wanted: f64,
    },
    /// Two neighbouring tiles are in the wrong order, or too alike in tone.
    #[error(
        "tones of `{darker}` and `{lighter}` rise by {found:.1} L*, wanted at least {wanted:.1}"
    )]
    #[hint("leave one of the two samples out")]
    Step {
        /// Name of the tile that stands first.
        darker: String,
        /// Name of the next tile.
        lighter: String,
        /// Difference of their tones.
        found: f64,
        /// Least difference.
        wanted: f64,
    },
    /// The darkest and the lightest tile are too alike in tone.
    #[error("tones spread over {found:.1} L*, wanted at least {wanted}")]
    #[hint("add a darker or a lighter sample")]
    Spread {
        /// Difference of the outermost tones.
        found: f64,
        /// Least difference.
        wanted: f64,
    },
    /// An in-between has less contrast than its key tiles.
    #[error(
        "{:.0} % between `{darker}` and `{lighter}`: contrast is {found:.2} of theirs, wanted at \
         least {wanted}",
        100.0 * .share
    )]
    #[hint("add a sample of a tone between them")]
    BetweenContrast {
        /// Name of the darker tile.
        darker: String,
        /// Name of the lighter tile.
        lighter: String,
        /// Share of the way to the lighter tile.
        share: f64,
        /// Contrast over theirs.
        found: f64,
        /// Least ratio.
        wanted: f64,
    },
    /// The tone of an in-between is not in proportion.
    #[error(
        "{:.0} % between `{darker}` and `{lighter}`: L* is {found:.1}, wanted {wanted:.1}",
        100.0 * .share
    )]
    #[hint("add a sample of a tone between them")]
    BetweenTone {
        /// Name of the darker tile.
        darker: String,
        /// Name of the lighter tile.
        lighter: String,
        /// Share of the way to the lighter tile.
        share: f64,
        /// Mean L*.
        found: f64,
        /// Weighted mean of the tones of both tiles.
        wanted: f64,
    },
}

impl MapFigures {
    /// Measures a map.
    ///
    /// # Panics
    /// If the tiles differ in size, or `first` is not the index of a tile.
    #[must_use]
    pub fn of(map: &ArtMap) -> Self {
        let textures: Vec<Texture> =
            map.keys.par_iter().map(|key| Texture::tiled(&key.tile.color)).collect();
        let agreement = |index: usize, other: usize| {
            if index == other {
                return 1.0;
            }
            coherence(&textures[other], &textures[index], map.spacing)
        };
        let keys: Vec<KeyFigures> = (0..map.keys.len())
            .into_par_iter()
            .map(|index: usize| KeyFigures {
                name: map.keys[index].name.clone(),
                tone: map.keys[index].tone,
                contrast: contrast(&textures[index]),
                stroke_length: stroke_length(&textures[index].levelled(LEVELLED * map.spacing)),
                coherence: agreement(index, map.first),
                neighbour_coherence: match index.cmp(&map.first) {
                    Ordering::Less => agreement(index, index + 1),
                    Ordering::Equal => 1.0,
                    Ordering::Greater => agreement(index, index - 1),
                },
                wrap_ratio: wrap_ratio(&textures[index]),
                usual_wrap_ratio: usual_wrap_ratio(&textures[index]),
            })
            .collect();
        let lower = 0..map.keys.len().saturating_sub(1);
        let betweens: Vec<Vec<BetweenFigures>> =
            lower.into_par_iter().map(|lower| between_figures(map, lower, &keys)).collect();
        Self { first: map.first, keys, betweens: betweens.concat() }
    }

    /// Faults that these figures show: first of tiles, then of pairs of neighbours. If you get an
    /// empty list, the map is good.
    #[must_use]
    pub fn faults(&self) -> Vec<MapFault> {
        let keys = self.keys.iter().flat_map(of_key);
        let pairs = self.keys.windows(2).filter_map(|pair| of_step(&pair[0], &pair[1]));
        let betweens = self.betweens.iter().flat_map(|figures| self.of_between(figures));
        keys.chain(self.of_spread()).chain(pairs).chain(betweens).collect()
    }

    fn of_spread(&self) -> Option<MapFault> {
        let [darkest, .., lightest] = self.keys.as_slice() else { return None };
        let found = lightest.tone - darkest.tone;
        (found < SPREAD).then_some(MapFault::Spread { found, wanted: SPREAD })
    }

    fn of_between(&self, figures: &BetweenFigures) -> Vec<MapFault> {
        let BetweenFigures { lower, share, contrast, tone, wanted_tone } = *figures;
        let [darker, lighter] = [lower, lower + 1].map(|index| self.keys[index].name.clone());
        let mut faults = Vec::new();
        if let Some(found) = contrast.filter(|found| *found < CONTRAST) {
            let darker = darker.clone();
            let lighter = lighter.clone();
            let wanted = CONTRAST;
            faults.push(MapFault::BetweenContrast { darker, lighter, share, found, wanted });
        }
        if (tone - wanted_tone).abs() > TONE {
            let found = tone;
            let wanted = wanted_tone;
            faults.push(MapFault::BetweenTone { darker, lighter, share, found, wanted });
        }
        faults
    }
}

fn of_key(key: &KeyFigures) -> Vec<MapFault> {
    let name = &key.name;
    let mut faults = Vec::new();
    if key.coherence.max(key.neighbour_coherence) < COHERENCE {
        let name = name.clone();
        let found = key.coherence;
        faults.push(MapFault::Coherence { name, found, wanted: COHERENCE });
    }
    let wanted = WRAP.max(key.usual_wrap_ratio);
    if key.wrap_ratio > wanted {
        let name = name.clone();
        let found = key.wrap_ratio;
        faults.push(MapFault::Seam { name, found, wanted });
    }
    faults
}

fn of_step(darker: &KeyFigures, lighter: &KeyFigures) -> Option<MapFault> {
    let found = lighter.tone - darker.tone;
    (found < STEP).then(|| MapFault::Step {
        darker: darker.name.clone(),
        lighter: lighter.name.clone(),
        found,
        wanted: STEP,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{KeyMap, Tile};
    use crate::synthesis::SynthesisSettings;
    use documents::hint::Explain;
    use graphics::field::Field;

    const SIZE: usize = 96;

    /// Waves around a linear grey, `period` texels wide and shifted by `phase` periods. They lean
    /// by one period over the height of the tile.
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
        assert_eq!(MapFigures::of(&map).faults(), []);
        let figures = MapFigures::of(&map);
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
        assert_eq!(MapFigures::of(&single).faults(), []);
        assert!(MapFigures::of(&single).betweens.is_empty());
    }

    #[test]
    fn strokes_at_other_places_are_told_with_the_tile() {
        let moved = map(vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.0, 0.5)]);
        let faults = MapFigures::of(&moved).faults();
        let MapFault::Coherence { name, found, .. } = &faults[0] else { panic!("{faults:?}") };
        assert!(name == "light" && *found < -0.8, "{name} {found}");
        // In line art a tile may agree with its neighbour alone.
        let mut figures = MapFigures::of(&moved);
        figures.keys[1].neighbour_coherence = 0.7;
        let faults = figures.faults();
        assert!(
            !faults.iter().any(|fault| matches!(fault, MapFault::Coherence { .. })),
            "{faults:?}"
        );
        // The first tile is the one that we compare others with.
        let other = ArtMap { first: 1, ..moved };
        let faults = MapFigures::of(&other).faults();
        assert!(
            matches!(&faults[0], MapFault::Coherence { name, .. } if name == "dark"),
            "{faults:?}"
        );
    }

    #[test]
    fn a_seam_is_told_with_the_tile() {
        let map = map(vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.8, 0.25)]);
        let faults = MapFigures::of(&map).faults();
        let seam = faults.iter().find(|fault| matches!(fault, MapFault::Seam { .. })).unwrap();
        assert!(
            seam.to_string().starts_with("tile `light`: steps across its border are 3."),
            "{seam}"
        );
        // Where places inside vary as much, the border does not stand out.
        let mut figures = MapFigures::of(&map);
        figures.keys[1].usual_wrap_ratio = 4.0;
        let faults = figures.faults();
        assert!(!faults.iter().any(|fault| matches!(fault, MapFault::Seam { .. })), "{faults:?}");
    }

    #[test]
    fn tones_that_do_not_rise_or_spread_are_told() {
        fn tones(greys: [f32; 3]) -> ArtMap {
            map(greys.into_iter().zip(["a", "b", "c"]).map(|(g, n)| key(n, g, 12.0, 0.0)).collect())
        }
        let faults = MapFigures::of(&tones([0.2, 0.05, 0.5])).faults();
        let step =
            MapFault::Step { darker: "a".into(), lighter: "b".into(), found: 0.0, wanted: 0.0 };
        assert_eq!(std::mem::discriminant(&faults[0]), std::mem::discriminant(&step), "{faults:?}");
        assert!(
            faults[0].to_string().starts_with("tones of `a` and `b` rise by -"),
            "{}",
            faults[0]
        );
        let alike = MapFigures::of(&tones([0.2, 0.207, 0.5])).faults();
        assert!(matches!(alike[..], [MapFault::Step { .. }]), "{alike:?}");
        let narrow = MapFigures::of(&tones([0.2, 0.23, 0.26])).faults();
        let [MapFault::Spread { found, wanted }] = narrow[..] else { panic!("{narrow:?}") };
        assert!(found < wanted && found > 4.0, "{found}");
    }

    #[test]
    fn weak_and_uneven_in_betweens_are_told_and_every_fault_has_a_way_out() {
        let keys = vec![key("dark", 0.05, 12.0, 0.0), key("light", 0.4, 12.0, 0.0)];
        let mut figures = MapFigures::of(&map(keys));
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
}
