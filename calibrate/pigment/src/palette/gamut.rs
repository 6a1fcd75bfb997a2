//! The colours that a palette can mix.

use rand::seq::index;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Exp1};
use spectra::color::{Adaptation, RgbSpace, Xyz, adapt};

use super::between::between;
use super::paints::Palette;
use crate::appearance::Appearance;
use crate::evaluate::Viewing;
use crate::recipe::{PigmentId, Recipe};

/// Number of mixing ratios of a pair, even in the logarithm of the ratio, since a little of a strong
/// paint changes a weak one quickly.
const RATIOS: i32 = 21;
/// Largest ratio of a pair; chosen by eye.
const FURTHEST: f64 = 150.0;
/// Parts of white to one of a pair; chosen by eye.
const WHITES: [f64; 7] = [0.0, 0.4, 1.2, 3.0, 7.0, 16.0, 45.0];
/// Parts of black to one of a pair; chosen by eye.
const BLACKS: [f64; 2] = [0.03, 0.2];
/// Factors by which a wash is made stronger in a library of absolute amounts; chosen by eye.
const STRONGER: [f64; 7] = [1.3, 1.7, 2.2, 3.0, 4.0, 5.5, 8.0];
/// Number of random mixtures of three or four paints; every other one has white.
const RANDOM: usize = 6000;
/// Seed of the random mixtures.
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
/// because some mixtures that were not sampled reach further out.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Centre of the sectors, in the plane's coordinates.
    pub center: [f64; 2],
    /// By sector, counter-clockwise from the first axis: the outermost sample, `None` if the sector
    /// holds no sample.
    pub sectors: Vec<Option<([f64; 2], usize)>>,
}

/// Samples the colours that a palette can mix: every paint and pair, alone and with parts of white or of the
/// darkest paint (for washes, also in larger amounts); 6000 seeded mixtures of three or four paints, half of
/// them with white; and mixtures of two samples where a cell of CIELAB between them is empty.
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
            recipes.extend(STRONGER.iter().map(|&times: &f64| recipe.scaled(times)));
        }
        if recipe.pigments().all(|p| p != black) {
            recipes.extend(BLACKS.iter().map(|parts| with(&recipe, black, *parts)));
        }
    }
    recipes.extend(random_recipes(palette));
    let sample = |recipe: Recipe| GamutSample { color: palette.color(&recipe), recipe };
    let mut samples: Vec<GamutSample> = recipes.into_iter().map(sample).collect();
    let filled = between(palette, samples.iter().map(|s| (&s.recipe, &s.color)));
    samples.extend(filled.into_iter().map(|(recipe, color)| GamutSample { recipe, color }));
    Gamut { samples, white: palette.weights().white() }
}

impl Gamut {
    /// Outline in a* and b* around grey, of samples whose L* lies in `lightness` (both ends
    /// included).
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

    /// Outline in chromaticity x, y around the light's white. Samples of Y below 0.5, whose
    /// chromaticity is meaningless, are left out.
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

/// Chromaticities x, y of monochromatic light from 380 to 700 nm at 1 nm, each with its wavelength in
/// nm. Wavelengths where the observer's functions are 0 are left out.
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

/// Chromaticities x, y of the sRGB primaries as they appear under `white` (Bradford adaptation from
/// the display's white).
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

/// `recipe` with `parts` parts of `paint` to one part of it.
fn with(recipe: &Recipe, paint: PigmentId, parts: f64) -> Recipe {
    let own = 1.0 / (1.0 + parts);
    let mut mixed = recipe.scaled(own);
    mixed.add(paint, parts * own);
    mixed
}

/// Three or four paints each, with shares uniform over all that sum to 1. Every other recipe has 0.5
/// to 32 parts of white, even in their logarithm.
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
