//! Search for the film nearest to a colour. We solve least squares over the amounts of a palette's
//! pigments, and start from sampled films of one to three pigments, thin and thick.
//!
//! Colours have three dimensions and palettes up to eight, so many films match. The cost therefore
//! has further terms. One prefers pigments near the colour: the sum over pigments of the share
//! times the squared distance of the masstone from the colour. With linear mixing this selects the
//! corners of the Delaunay tetrahedron that contains the colour, so you get at most four pigments,
//! and their shares change continuously. The other terms prefer films that hide the ground, and
//! thin films.

use pigment::matching::{Bounds, Cost, UNKNOWNS, descend_within_bounds};
use rayon::prelude::*;
use spectra::color::{Lab, delta_e_cie76};

use super::film::PaintFilm;
use crate::layer::SLOTS;

/// Weights of differences in lightness and hue relative to chroma (chosen by eye): a
/// colour out of gamut keeps its lightness first, then its hue.
const LIGHTNESS: f64 = 3.0;
const HUE: f64 = 1.5;

/// Weight of the preference for pigments near the colour, per squared unit of CIELAB. It
/// decides between films of equal colour and moves the colour by some hundredths of a
/// unit.
const NEARNESS: f64 = 1e-3;

/// Weight of the preference for thin films, per mm (chosen by eye).
const THINNESS: f64 = 0.5;

/// Cost function over the films of a palette.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FilmSearch {
    pub(super) film: PaintFilm,
    least_mm: f64,
    most_mm: f64,
    /// Weight of the colour difference between a film over the ground and over black.
    hiding: f64,
    /// CIELAB of each slot's masstone: the thickest film allowed over the ground.
    masstones: [[f64; 3]; SLOTS],
}

/// A film given by the share of each slot and the total height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FilmMix {
    pub(super) shares: [f64; SLOTS],
    pub(super) height_mm: f64,
}

impl FilmMix {
    pub(super) fn heights_mm(&self) -> [f64; SLOTS] {
        self.shares.map(|share| share * self.height_mm)
    }

    /// Film of these heights. A film of height 0 gets all of slot `fallback`.
    pub(super) fn of(heights_mm: [f64; SLOTS], fallback: usize) -> Self {
        let height_mm: f64 = heights_mm.iter().sum();
        if height_mm <= 0.0 {
            let shares = std::array::from_fn(|i| if i == fallback { 1.0 } else { 0.0 });
            return Self { shares, height_mm };
        }
        Self { shares: heights_mm.map(|height| height / height_mm), height_mm }
    }
}

/// A film to stay close to, with the weight of the squared difference in shares.
#[derive(Debug, Clone, Copy)]
pub(super) struct Anchor {
    pub(super) mixed: FilmMix,
    pub(super) strength: f64,
}

/// A target colour, with the coordinate frame that differences are measured in.
#[derive(Debug, Clone, Copy)]
pub(super) struct TargetColor {
    lab: [f64; 3],
    /// Rows of weighted unit vectors: lightness, chroma, hue.
    frame: [[f64; 3]; 3],
    nearness: [f64; SLOTS],
}

impl TargetColor {
    /// Weighted squared distance of a colour from the target.
    pub(super) fn distance_squared(&self, lab: [f64; 3]) -> f64 {
        self.residuals(lab).iter().map(|r| r * r).sum()
    }

    fn residuals(&self, lab: [f64; 3]) -> [f64; 3] {
        let off: [f64; 3] = std::array::from_fn(|i| lab[i] - self.lab[i]);
        self.frame.map(|row| row[0] * off[0] + row[1] * off[1] + row[2] * off[2])
    }

    /// Cost of the distance between the pigments in use and the target.
    pub(super) fn nearness_cost(&self, shares: &[f64; SLOTS]) -> f64 {
        shares.iter().zip(&self.nearness).map(|(share, cost)| share * cost).sum()
    }
}

impl FilmSearch {
    pub(super) fn new(film: PaintFilm, least_mm: f64, most_mm: f64, hiding: f64) -> Self {
        let masstones = std::array::from_fn(|slot| {
            let mut heights = [0.0; SLOTS];
            heights[slot] = most_mm;
            film.lab(&heights).to_array()
        });
        Self { film, least_mm, most_mm, hiding, masstones }
    }

    /// This search, limited to films of one height. The preferences among pigments stay.
    pub(super) fn at_height(&self, height_mm: f64) -> Self {
        Self { least_mm: height_mm, most_mm: height_mm, ..self.clone() }
    }

    /// Least and greatest height of a film, in mm.
    pub(super) fn heights_mm(&self) -> (f64, f64) {
        (self.least_mm, self.most_mm)
    }

    /// Cost of the ground showing through and of the film's height.
    pub(super) fn ground_cost(&self, mixed: &FilmMix) -> f64 {
        let pull = if self.least_mm < self.most_mm { THINNESS * mixed.height_mm } else { 0.0 };
        0.5 * self.ground_residual(mixed).powi(2) + pull
    }

    /// Weighted difference between a film over the ground and over black (CIE 1976). 0 if the
    /// ground may show.
    pub(super) fn ground_residual(&self, mixed: &FilmMix) -> f64 {
        if self.hiding == 0.0 {
            return 0.0;
        }
        let heights = mixed.heights_mm();
        let ground = self.film.lab(&heights);
        let black = self.film.lab_over_black(&heights);
        self.hiding * delta_e_cie76(ground, black)
    }

    /// Target for a colour. Chroma and hue weigh less at high chroma, as in CIE94.
    pub(super) fn target(&self, lab: Lab) -> TargetColor {
        let chroma = lab.a.hypot(lab.b);
        let (cos, sin) = if chroma > 1e-9 { (lab.a / chroma, lab.b / chroma) } else { (1.0, 0.0) };
        let c = 1.0 / (1.0 + 0.045 * chroma);
        // Greys have no hue: both directions count alike.
        let h = (1.0 + (HUE - 1.0) * (chroma / 10.0).min(1.0)) / (1.0 + 0.015 * chroma);
        let frame = [[LIGHTNESS, 0.0, 0.0], [0.0, c * cos, c * sin], [0.0, -h * sin, h * cos]];
        let lab = lab.to_array();
        let nearness = self.masstones.map(|masstone| {
            let squared: f64 = masstone.iter().zip(&lab).map(|(m, w)| (m - w) * (m - w)).sum();
            NEARNESS * squared
        });
        TargetColor { lab, frame, nearness }
    }

    /// Minimises the cost from `start` within `steps` iterations. Returns the cost and the
    /// film.
    pub(super) fn minimize(
        &self,
        target: &TargetColor,
        start: &FilmMix,
        anchor: Option<&Anchor>,
        steps: usize,
    ) -> (f64, FilmMix) {
        let used = self.film.used();
        let shares = used.len();
        let chooses_height = self.least_mm < self.most_mm;
        let mut bounds = Bounds {
            count: shares + usize::from(chooses_height),
            shares,
            lower: [0.0; UNKNOWNS],
            upper: [1.0; UNKNOWNS],
        };
        let mut point = [0.0; UNKNOWNS];
        for (place, &slot) in used.iter().enumerate() {
            point[place] = start.shares[slot];
        }
        if chooses_height {
            (bounds.lower[shares], bounds.upper[shares]) = (self.least_mm.ln(), self.most_mm.ln());
            point[shares] = start
                .height_mm
                .clamp(self.least_mm, self.most_mm)
                .ln()
                .clamp(bounds.lower[shares], bounds.upper[shares]);
        }
        let cost = descend_within_bounds(
            |point| self.cost(target, &self.mixed(point), anchor, chooses_height),
            &mut point,
            &bounds,
            steps,
        );
        (cost.value, self.mixed(&point))
    }

    fn mixed(&self, point: &[f64; UNKNOWNS]) -> FilmMix {
        let used = self.film.used();
        let mut shares = [0.0; SLOTS];
        for (place, &slot) in used.iter().enumerate() {
            shares[slot] = point[place].max(0.0);
        }
        let height_mm = if self.least_mm < self.most_mm {
            point[used.len()].exp().clamp(self.least_mm, self.most_mm)
        } else {
            self.least_mm
        };
        FilmMix { shares, height_mm }
    }

    fn cost(
        &self,
        target: &TargetColor,
        mixed: &FilmMix,
        anchor: Option<&Anchor>,
        chooses_height: bool,
    ) -> Cost {
        let used = self.film.used();
        let mut sum = Sum {
            cost: Cost {
                value: 0.0,
                gradient: [0.0; UNKNOWNS],
                matrix: [[0.0; UNKNOWNS]; UNKNOWNS],
            },
            used,
            mixed,
            chooses_height,
        };
        let heights = mixed.heights_mm();
        let over_ground = self.film.slopes(&heights, 1.0);
        let residuals = target.residuals(over_ground.lab);
        for (row, residual) in target.frame.iter().zip(residuals) {
            let over_mm: [f64; SLOTS] = std::array::from_fn(|slot| {
                (0..3).map(|j| row[j] * over_ground.over_mm[j][slot]).sum()
            });
            sum.add(residual, &over_mm);
        }
        if self.hiding > 0.0 {
            let over_black = self.film.slopes(&heights, 0.0);
            for j in 0..3 {
                let residual = self.hiding * (over_ground.lab[j] - over_black.lab[j]);
                let over_mm: [f64; SLOTS] = std::array::from_fn(|slot| {
                    self.hiding * (over_ground.over_mm[j][slot] - over_black.over_mm[j][slot])
                });
                sum.add(residual, &over_mm);
            }
        }
        let Sum { mut cost, .. } = sum;
        cost.value += target.nearness_cost(&mixed.shares);
        for (place, &slot) in used.iter().enumerate() {
            cost.gradient[place] += target.nearness[slot];
        }
        if chooses_height {
            let place = used.len();
            let pull = THINNESS * mixed.height_mm;
            cost.value += pull;
            cost.gradient[place] += pull;
            cost.matrix[place][place] += pull;
        }
        if let Some(Anchor { mixed: kept, strength }) = anchor {
            for (place, &slot) in used.iter().enumerate() {
                let off = mixed.shares[slot] - kept.shares[slot];
                cost.value += 0.5 * strength * off * off;
                cost.gradient[place] += strength * off;
                cost.matrix[place][place] += strength;
            }
        }
        cost
    }
}

/// Accumulator of the cost's residuals.
struct Sum<'a> {
    cost: Cost,
    used: &'a [usize],
    mixed: &'a FilmMix,
    chooses_height: bool,
}

impl Sum<'_> {
    /// Adds one residual with its derivatives by the slots' heights in mm.
    fn add(&mut self, residual: f64, over_mm: &[f64; SLOTS]) {
        let count = self.used.len();
        let mut row = [0.0; UNKNOWNS];
        for (place, &slot) in self.used.iter().enumerate() {
            row[place] = over_mm[slot] * self.mixed.height_mm;
        }
        if self.chooses_height {
            row[count] = (0..count).map(|i| row[i] * self.mixed.shares[self.used[i]]).sum();
        }
        let count = count + usize::from(self.chooses_height);
        self.cost.value += 0.5 * residual * residual;
        for i in 0..count {
            self.cost.gradient[i] += residual * row[i];
            for j in 0..count {
                self.cost.matrix[i][j] += row[i] * row[j];
            }
        }
    }
}

/// Two pigments are mixed in ratios of `PAIR_RATIO` to the powers -8 to 8, from a trace to
/// nearly all.
const PAIR_RATIO: f64 = 1.9;
const PAIR_STEPS: i32 = 8;
/// Three pigments are mixed in ratios of `TRIPLE_RATIO` to the powers -2 to 2.
const TRIPLE_RATIO: f64 = 4.0;
const TRIPLE_STEPS: i32 = 2;

/// Sampled films with their colours.
#[derive(Debug, Clone)]
pub(super) struct SampledFilms {
    films: Vec<SampledFilm>,
}

#[derive(Debug, Clone)]
struct SampledFilm {
    mixed: FilmMix,
    lab: [f64; 3],
    /// Bit set of the slots in use.
    set: u32,
    /// Cost of the ground showing through and of the height.
    showing: f64,
}

impl SampledFilms {
    /// Samples films as starting points of `search`.
    pub(super) fn new(search: &FilmSearch) -> Self {
        let (least, most) = search.heights_mm();
        let heights =
            if least < most { vec![least, (least * most).sqrt(), most] } else { vec![most] };
        let all = shares(&search.film);
        let films = all
            .par_iter()
            .flat_map_iter(|shares| {
                heights.iter().map(|&height_mm| {
                    let mixed = FilmMix { shares: *shares, height_mm };
                    let set = (0..SLOTS).filter(|&i| shares[i] > 0.0).map(|i| 1 << i).sum();
                    let lab = search.film.lab(&mixed.heights_mm()).to_array();
                    SampledFilm { mixed, lab, set, showing: search.ground_cost(&mixed) }
                })
            })
            .collect();
        Self { films }
    }

    /// The film of least cost for each of the `count` best sets of pigments, best first.
    pub(super) fn nearest_to(&self, target: &TargetColor, count: usize) -> Vec<FilmMix> {
        let mut best: Vec<(f64, &SampledFilm)> = Vec::with_capacity(count + 1);
        for film in &self.films {
            let worst = if best.len() < count { f64::INFINITY } else { best[count - 1].0 };
            // The colour term alone excludes most films.
            let distance = 0.5 * target.distance_squared(film.lab);
            if distance >= worst {
                continue;
            }
            let cost = distance + film.showing + target.nearness_cost(&film.mixed.shares);
            if cost >= worst {
                continue;
            }
            match best.iter().position(|(_, other)| other.set == film.set) {
                Some(place) if best[place].0 <= cost => continue,
                Some(place) => {
                    best.remove(place);
                }
                None => {}
            }
            let place = best.partition_point(|(other, _)| *other <= cost);
            best.insert(place, (cost, film));
            best.truncate(count);
        }
        best.into_iter().map(|(_, film)| film.mixed).collect()
    }
}

/// Shares by slot of all sampled mixtures of one, two and three pigments.
fn shares(film: &PaintFilm) -> Vec<[f64; SLOTS]> {
    let used = film.used();
    let mut all = Vec::new();
    for (a, &first) in used.iter().enumerate() {
        all.push(shares_of(&[(first, 1.0)]));
        for (b, &second) in used.iter().enumerate().skip(a + 1) {
            for step in -PAIR_STEPS..=PAIR_STEPS {
                all.push(shares_of(&[(first, PAIR_RATIO.powi(step)), (second, 1.0)]));
            }
            for &third in &used[b + 1..] {
                for i in -TRIPLE_STEPS..=TRIPLE_STEPS {
                    for j in -TRIPLE_STEPS..=TRIPLE_STEPS {
                        let parts = [TRIPLE_RATIO.powi(i), TRIPLE_RATIO.powi(j)];
                        all.push(shares_of(&[(first, parts[0]), (second, parts[1]), (third, 1.0)]));
                    }
                }
            }
        }
    }
    all
}

fn shares_of(parts: &[(usize, f64)]) -> [f64; SLOTS] {
    let total: f64 = parts.iter().map(|(_, part)| part).sum();
    let mut shares = [0.0; SLOTS];
    parts.iter().for_each(|&(slot, part)| shares[slot] = part / total);
    shares
}
