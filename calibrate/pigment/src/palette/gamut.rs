//! The colours that you can mix from a palette, and its colour wheel: tubes, tints and mixing lines in the
//! plane of a* and b*.

use std::collections::BTreeMap;

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use spectra::color::{Adaptation, Lab, RgbSpace, Xyz, adapt, delta_e_ciede2000};

use super::charts::{TintLadder, tint_ladders};
use super::paints::Palette;
use crate::color::Appearance;
use crate::evaluate::Viewing;
use crate::recipe::{PigmentId, Recipe};

/// We mix each pair in this many ratios, evenly spaced in their logarithm, because a little of a strong
/// paint changes a weak one quickly.
const RATIOS: i32 = 21;
/// Largest ratio of the two paints of a pair, chosen by eye.
const FURTHEST: f64 = 150.0;
/// Parts of white to one part of a mixed pair, chosen by eye.
const WHITES: [f64; 7] = [0.0, 0.4, 1.2, 3.0, 7.0, 16.0, 45.0];
/// Parts of black to one part of a mixed pair, chosen by eye.
const BLACKS: [f64; 2] = [0.03, 0.2];
/// Factors by which a wash is made stronger in a library of absolute amounts, chosen by eye.
const STRONGER: [f64; 7] = [1.3, 1.7, 2.2, 3.0, 4.0, 5.5, 8.0];
/// Number of random mixtures of three or four paints. Every other one has white.
const RANDOM: usize = 6000;
const SEED: u64 = 2004;

/// One mixture and its colour.
#[derive(Debug, Clone, PartialEq)]
pub struct GamutSample {
    /// Paints with their shares.
    pub recipe: Recipe,
    /// Colour under the palette's light.
    pub color: Appearance,
}

/// Many mixtures of a palette, with their colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Gamut {
    /// Mixtures in this order: masstones, mixtures with white and black, random ones, those that fill
    /// gaps.
    pub samples: Vec<GamutSample>,
    white: Xyz,
}

/// Outline of a gamut: the outermost sample in each of many equal sectors around a centre.
///
/// Gamuts of paints are not convex, so this is not a convex hull. The outline lies inside the true one,
/// because we do not sample every mixture, and some reach further out.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Centre of the sectors, in the plane's coordinates.
    pub center: [f64; 2],
    /// By sector, counter-clockwise from the first axis: the outermost sample. `None` if the sector holds
    /// no sample.
    pub sectors: Vec<Option<([f64; 2], usize)>>,
}

/// Samples the colours that you can mix from a palette: every paint and pair, alone and with parts of white
/// or of the darkest paint (for washes, also in larger amounts). We add 6000 seeded mixtures of three or
/// four paints, half of them with white. We also add mixtures of two samples if a cell of CIELAB between
/// them is empty.
#[must_use]
pub fn sampled_gamut(palette: &Palette<'_>) -> Gamut {
    let mut recipes: Vec<Recipe> = palette.paints().iter().map(|&p| Recipe::single(p)).collect();
    let masstones = recipes.clone();
    let pairs = palette
        .pairs()
        .flat_map(|(a, b)| shares().map(move |s| Recipe::from([(a, s), (b, 1.0 - s)])));
    let black = palette.black();
    for recipe in masstones.into_iter().chain(pairs) {
        let plain = recipe.len() == 1;
        let whites = WHITES.iter().filter(|&&parts| !(plain && parts == 0.0));
        recipes.extend(whites.map(|&parts| palette.thinned(&recipe, parts)));
        if palette.white().is_none() {
            recipes.extend(STRONGER.iter().map(|&times| recipe.scaled(times)));
        }
        if recipe.pigments().all(|p| p != black) {
            recipes.extend(BLACKS.iter().map(|parts| with_paint(&recipe, black, *parts)));
        }
    }
    recipes.extend(random_recipes(palette));
    let mut samples: Vec<GamutSample> = recipes
        .into_iter()
        .map(|recipe| GamutSample { color: palette.color(&recipe), recipe })
        .collect();
    let filled = mixtures_between(palette, samples.iter().map(|s| (&s.recipe, &s.color)));
    samples.extend(filled.into_iter().map(|(recipe, color)| GamutSample { recipe, color }));
    Gamut { samples, white: palette.weights().white() }
}

impl Gamut {
    /// Outline in a* and b* around grey, of samples with L* in `lightness` (both ends included).
    #[must_use]
    pub fn in_lab(&self, lightness: [f64; 2], sectors: usize) -> Boundary {
        let [low, high] = lightness;
        let inside = self
            .samples
            .iter()
            .enumerate()
            .filter(|(_, sample)| (low..=high).contains(&sample.color.lab.lightness));
        let places = inside.map(|(i, sample)| ([sample.color.lab.a, sample.color.lab.b], i));
        Boundary::around([0.0, 0.0], sectors, places)
    }

    /// Outline in chromaticity x, y around the light's white. We leave out samples of Y below 0.5, because
    /// their chromaticity is meaningless.
    #[must_use]
    pub fn in_xy(&self, sectors: usize) -> Boundary {
        let white = chromaticity(self.white);
        let lit = self.samples.iter().enumerate().filter(|(_, s)| s.color.xyz.y >= 0.5);
        let places = lit.map(|(i, sample)| (chromaticity(sample.color.xyz), i));
        Boundary::around(white, sectors, places)
    }
}

impl Boundary {
    fn around(
        center: [f64; 2],
        sectors: usize,
        places: impl Iterator<Item = ([f64; 2], usize)>,
    ) -> Self {
        let mut outer: Vec<Option<([f64; 2], usize)>> = vec![None; sectors.max(1)];
        let mut boundary = Self { center, sectors: Vec::new() };
        for (place, index) in places {
            let sector = boundary.sector(place, outer.len());
            if outer[sector].is_none_or(|(kept, _): ([f64; 2], usize)| {
                boundary.distance(place) > boundary.distance(kept)
            }) {
                outer[sector] = Some((place, index));
            }
        }
        boundary.sectors = outer;
        boundary
    }

    /// Whether the outline reaches at least as far out as `place` in the same sector.
    #[must_use]
    pub fn reaches(&self, place: [f64; 2]) -> bool {
        let outermost = self.sectors[self.sector(place, self.sectors.len())];
        outermost.is_some_and(|(kept, _)| self.distance(kept) >= self.distance(place))
    }

    /// Outline as a closed polygon. It passes through the centre where three or more sectors in a row
    /// hold no sample.
    #[must_use]
    pub fn polygon(&self) -> Vec<[f64; 2]> {
        let count = self.sectors.len();
        let mut held: Vec<(usize, [f64; 2])> = self
            .sectors
            .iter()
            .enumerate()
            .filter_map(|(sector, outer)| Some((sector, (*outer)?.0)))
            .collect();
        held.sort_by(|a, b| self.angle(a.1).total_cmp(&self.angle(b.1)));
        let mut polygon = Vec::new();
        for (at, &(sector, place)) in held.iter().enumerate() {
            polygon.push(place);
            let next = held[(at + 1) % held.len()].0;
            let gap = (next + count - sector) % count;
            if gap > 3 || held.len() == 1 {
                polygon.push(self.center);
            }
        }
        polygon
    }

    /// Area of the polygon, in the square of the plane's unit.
    #[must_use]
    pub fn area(&self) -> f64 {
        let polygon = self.polygon();
        let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
        sides.map(|(a, b)| (a[0] * b[1] - b[0] * a[1]) / 2.0).sum::<f64>().abs()
    }

    fn sector(&self, place: [f64; 2], count: usize) -> usize {
        let turn = self.angle(place) / std::f64::consts::TAU;
        ((turn * count as f64) as usize).min(count - 1)
    }

    /// Angle of `place` around the centre, 0 to one turn.
    fn angle(&self, place: [f64; 2]) -> f64 {
        let angle = (place[1] - self.center[1]).atan2(place[0] - self.center[0]);
        if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
    }

    fn distance(&self, place: [f64; 2]) -> f64 {
        (place[0] - self.center[0]).hypot(place[1] - self.center[1])
    }
}

/// Chromaticities x, y of monochromatic light from 380 to 700 nm at 1 nm, each with its wavelength in nm.
/// We leave out wavelengths where the observer's functions are 0.
#[must_use]
pub fn spectral_locus(viewing: &Viewing) -> Vec<(f64, [f64; 2])> {
    let [x, y, z] = viewing.observer.functions();
    let band = x.grid().wavelengths_nm().enumerate().filter(|(_, nm)| (380.0..=700.0).contains(nm));
    band.filter_map(|(i, nm)| {
        let xyz = Xyz { x: x.values()[i], y: y.values()[i], z: z.values()[i] };
        (xyz.x + xyz.y + xyz.z > 0.0).then(|| (nm, chromaticity(xyz)))
    })
    .collect()
}

/// Chromaticities x, y of the sRGB primaries as you see them under `white` (Bradford adaptation from the
/// display's white).
#[must_use]
pub fn srgb_primaries(white: Xyz) -> [[f64; 2]; 3] {
    let columns = RgbSpace::Srgb.xyz_from_linear();
    std::array::from_fn(|channel| {
        let mut linear = [0.0; 3];
        linear[channel] = 1.0;
        let xyz = columns.apply(linear).into();
        chromaticity(adapt(xyz, RgbSpace::Srgb.white(), white, Adaptation::Bradford))
    })
}

fn chromaticity(xyz: Xyz) -> [f64; 2] {
    let total = xyz.x + xyz.y + xyz.z;
    [xyz.x / total, xyz.y / total]
}

/// Shares of the first paint of a pair, in rising order.
pub(super) fn shares() -> impl Iterator<Item = f64> {
    let step = 2.0 * FURTHEST.ln() / f64::from(RATIOS - 1);
    (0..RATIOS).map(move |at| 1.0 / (1.0 + (FURTHEST.ln() - f64::from(at) * step).exp()))
}

/// `recipe` with `parts` parts of `paint` added to one part of `recipe`.
fn with_paint(recipe: &Recipe, paint: PigmentId, parts: f64) -> Recipe {
    let own = 1.0 / (1.0 + parts);
    let mut mixed = recipe.scaled(own);
    mixed.add(paint, parts * own);
    mixed
}

/// Three or four paints each, with shares uniform over all that sum to 1. Every other recipe has 0.5 to 32
/// parts of white, uniform in their logarithm.
fn random_recipes(palette: &Palette<'_>) -> Vec<Recipe> {
    let paints = palette.paints();
    if paints.len() < 3 {
        return Vec::new();
    }
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    (0..RANDOM)
        .map(|number| {
            let count = (3 + number / 2 % 2).min(paints.len());
            let parts: Recipe = index::sample(&mut random, paints.len(), count)
                .into_iter()
                .map(|place| (paints[place], Exp1.sample(&mut random)))
                .collect();
            let total = parts.total();
            let recipe: Recipe = parts.iter().map(|&(p, part)| (p, part / total)).collect();
            let whites =
                if number % 2 == 0 { 0.0 } else { random.random_range(-1.0..5.0f64).exp2() };
            palette.thinned(&recipe, whites)
        })
        .collect()
}

const SECTORS: usize = 72;

/// We count mixtures within this difference of L* as equally light. We only sample mixtures, so a narrower
/// range would leave gaps.
const BAND: f64 = 5.0;

/// Colours of two paints mixed in all ratios.
#[derive(Debug, Clone, PartialEq)]
pub struct MixingLine {
    /// The two paints, in the library's order.
    pub pair: [PigmentId; 2],
    /// Share of the first paint and the colour, from the second paint alone to the first alone.
    pub colors: Vec<(f64, Appearance)>,
}

/// Everything that you see in a chart of a palette in a* and b*.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorWheel {
    /// Colour of every paint alone, in the library's order.
    pub masstones: Vec<(PigmentId, Appearance)>,
    /// Tints of every paint but the white.
    pub tints: Vec<TintLadder>,
    /// Lines between every pair of paints.
    pub lines: Vec<MixingLine>,
    /// Mixtures of all kinds, with their colours.
    pub gamut: Gamut,
}

/// The mixture of a palette that comes nearest to a colour.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestMixture<'a> {
    /// The sampled mixture.
    pub sample: &'a GamutSample,
    /// CIEDE2000 between the two. You may come nearer with mixtures between the sampled ones.
    pub delta_e: f64,
}

/// Computes masstones, tints, mixing lines and gamut of a palette by Kubelka-Munk.
#[must_use]
pub fn color_wheel(palette: &Palette<'_>) -> ColorWheel {
    ColorWheel {
        masstones: palette
            .paints()
            .iter()
            .map(|&paint| (paint, palette.color(&Recipe::single(paint))))
            .collect(),
        tints: tint_ladders(palette),
        lines: palette
            .pairs()
            .map(|(first, second)| {
                let colors = [0.0].into_iter().chain(shares()).chain([1.0]).map(|share: f64| {
                    let parts = [(first, share), (second, 1.0 - share)];
                    let mixed: Recipe = parts.into_iter().filter(|(_, part)| *part > 0.0).collect();
                    (share, palette.color(&mixed))
                });
                MixingLine { pair: [first, second], colors: colors.collect() }
            })
            .collect(),
        gamut: sampled_gamut(palette),
    }
}

impl ColorWheel {
    /// Outline of the mixtures with L* within 5 of `lightness`. If you pass `None`, the outline of all
    /// mixtures.
    #[must_use]
    pub fn region(&self, lightness: Option<f64>) -> Boundary {
        let range =
            lightness.map_or([f64::NEG_INFINITY, f64::INFINITY], |at| [at - BAND, at + BAND]);
        self.gamut.in_lab(range, SECTORS)
    }

    /// The sampled mixture nearest to `color`. `None` if there are no samples.
    #[must_use]
    pub fn nearest(&self, color: Lab) -> Option<NearestMixture<'_>> {
        let measured = self.gamut.samples.iter().map(|sample| NearestMixture {
            sample,
            delta_e: delta_e_ciede2000(color, sample.color.lab),
        });
        measured.min_by(|a, b| a.delta_e.total_cmp(&b.delta_e))
    }
}

/// Side of a cell in a* and b*, chosen by eye.
const CELL: f64 = 3.0;
/// Height of a cell in L*, chosen by eye.
const CELL_HEIGHT: f64 = 10.0;
/// We make this many passes. Mixtures of several passes fill a gap of two or three cells.
const PASSES: usize = 4;

/// For each empty cell of CIELAB between two opposite neighbours that hold a sample, returns the mixture of
/// these two in equal parts. The mixtures of one pass are samples for the next.
pub(super) fn mixtures_between<'a>(
    palette: &Palette<'_>,
    samples: impl Iterator<Item = (&'a Recipe, &'a Appearance)>,
) -> Vec<(Recipe, Appearance)> {
    let mut cells: BTreeMap<[i32; 3], Recipe> = BTreeMap::new();
    for (recipe, color) in samples {
        cells.entry(cell(color)).or_insert_with(|| recipe.clone());
    }
    let mut found = Vec::new();
    for _ in 0..PASSES {
        let mut added: BTreeMap<[i32; 3], Recipe> = BTreeMap::new();
        for (&[band, a, b], recipe) in &cells {
            // We look in four of the eight directions. The cell on the other side of the gap covers the
            // opposite ones.
            for (da, db) in [(1, 0), (0, 1), (1, 1), (1, -1)] {
                let gap = [band, a + da, b + db];
                let Some(other) = cells.get(&[band, a + 2 * da, b + 2 * db]) else { continue };
                if cells.contains_key(&gap) || added.contains_key(&gap) {
                    continue;
                }
                let mixed = halves(recipe, other);
                let color = palette.color(&mixed);
                added.entry(cell(&color)).or_insert_with(|| mixed.clone());
                found.push((mixed, color));
            }
        }
        for (place, recipe) in added {
            cells.entry(place).or_insert(recipe);
        }
    }
    found
}

fn cell(color: &Appearance) -> [i32; 3] {
    let lab = color.lab;
    [cell_index(lab.lightness, CELL_HEIGHT), cell_index(lab.a, CELL), cell_index(lab.b, CELL)]
}

fn cell_index(value: f64, side: f64) -> i32 {
    (value / side).floor() as i32
}

fn halves(first: &Recipe, second: &Recipe) -> Recipe {
    let mut mixed = first.scaled(0.5);
    second.iter().for_each(|&(paint, share)| mixed.add(paint, 0.5 * share));
    mixed
}

#[cfg(test)]
mod tests {
    use super::super::Cards;
    use super::*;
    use crate::evaluate::Viewing;
    use crate::library::PigmentLibrary;

    fn with_palette<T>(names: &[&str], use_palette: impl FnOnce(&Palette<'_>) -> T) -> T {
        let library = PigmentLibrary::van_gogh_oils();
        let viewing = Viewing::default();
        let ids: Vec<PigmentId> = names.iter().map(|name| library.find(name).unwrap()).collect();
        let palette = Palette::new(&library, &viewing, Cards::standard(library.grid)).unwrap();
        use_palette(&palette.among(&ids).unwrap())
    }

    fn distance(a: Lab, b: Lab) -> f64 {
        let squares = a.to_array().into_iter().zip(b.to_array()).map(|(a, b)| (a - b) * (a - b));
        squares.sum::<f64>().sqrt()
    }

    #[test]
    fn primaries_of_srgb_stand_where_the_standard_has_them() {
        // IEC 61966-2-1, table 1.
        let wanted = [[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]];
        for (found, wanted) in srgb_primaries(RgbSpace::Srgb.white()).iter().zip(wanted) {
            let off = found.iter().zip(wanted).map(|(a, b): (&f64, f64)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-3, "{found:?} {wanted:?}");
        }
    }

    #[test]
    fn masstones_lie_where_the_library_measures_them_and_lines_end_at_them() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let library = palette.library();
            assert_eq!((wheel.masstones.len(), wheel.lines.len(), wheel.tints.len()), (3, 3, 2));
            for (paint, found) in &wheel.masstones {
                let name = library[*paint].name.as_str();
                let wanted = library.color([(name, 1.0)], palette.viewing()).unwrap();
                assert!(distance(found.lab, wanted.lab) < 1e-6, "{name}: {found:?}");
            }
            for MixingLine { pair, colors } in &wheel.lines {
                let [first, second] = pair.map(|paint| {
                    wheel.masstones.iter().find(|(of, _)| *of == paint).expect("a tube").1.lab
                });
                let start = colors[0].1.lab;
                let end = colors[colors.len() - 1].1.lab;
                assert!(distance(start, second) < 1e-9, "{pair:?}");
                assert!(distance(end, first) < 1e-9, "{pair:?}");
                assert!(colors.windows(2).all(|two| two[0].0 < two[1].0), "shares rise");
            }
        });
    }

    #[test]
    fn a_line_is_curved_and_passes_the_mixtures_of_the_library() {
        with_palette(&["Zinc White", "Prussian Blue"], |palette| {
            let wheel = color_wheel(palette);
            let [line] = wheel.lines.as_slice() else { panic!("one pair") };
            let library = palette.library();
            let [first, second] = line.pair.map(|paint| library[paint].name.clone());
            for (share, found) in &line.colors[1..line.colors.len() - 1] {
                let parts = [(&first, *share), (&second, 1.0 - share)];
                let wanted = library.color(parts, palette.viewing()).unwrap();
                assert!(distance(found.lab, wanted.lab) < 1e-6, "{share}");
            }
            let chromas: Vec<f64> =
                line.colors.iter().map(|(_, color)| color.lab.to_lch().chroma).collect();
            let most = chromas.iter().copied().fold(0.0, f64::max);
            let ends = chromas[0].max(chromas[chromas.len() - 1]);
            assert!(most > ends + 10.0, "white brings the blue out: {most} over {ends}");
        });
    }

    #[test]
    fn greys_reach_a_thin_region_and_primaries_a_wide_one() {
        let greys = area_of(&["Zinc White", "Bone Black"]);
        let primaries = area_of(&["Zinc White", "Chrome Yellow", "Vermilion", "Ultramarine"]);
        assert!(greys < 60.0 && primaries > 2000.0, "{greys} and {primaries}");
    }

    fn area_of(names: &[&str]) -> f64 {
        with_palette(names, |palette| color_wheel(palette).region(None).area())
    }

    #[test]
    fn a_region_of_one_lightness_holds_its_mixtures_only() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let kept = wheel.region(Some(60.0));
            let held: Vec<usize> = kept.sectors.iter().flatten().map(|(_, index)| *index).collect();
            assert!(!held.is_empty());
            for index in held {
                let lightness = wheel.gamut.samples[index].color.lab.lightness;
                assert!((55.0..=65.0).contains(&lightness), "{lightness}");
            }
            assert!(wheel.region(Some(60.0)).area() < wheel.region(None).area());
        });
    }

    #[test]
    fn a_mixture_is_found_again_and_a_colour_out_of_reach_is_far() {
        with_palette(&["Zinc White", "Vermilion", "Ultramarine"], |palette| {
            let wheel = color_wheel(palette);
            let mixed = &wheel.gamut.samples[100];
            let found = wheel.nearest(mixed.color.lab).unwrap();
            assert!(found.delta_e < 1e-9, "{found:?}");
            let green = Lab { lightness: 60.0, a: -60.0, b: 40.0 };
            assert!(wheel.nearest(green).unwrap().delta_e > 20.0, "no green without a yellow");
        });
    }
}
