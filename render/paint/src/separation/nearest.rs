//! The film nearest to a colour: least squares over the heights of a palette.
//!
//! Colours have three dimensions and palettes up to eight, so many films match.
//! Of those the one is taken that is mixed of pigments near the colour (the
//! shares' sum of squared distances of their masstones is least; were mixing
//! linear these would be the corners of the tetrahedron of Delaunay's
//! triangulation that holds the colour, so at most four, and they would change
//! without jumps); that hides the ground; and that is no thicker than needed.

use pigment::matching::{Bounds, Cost, UNKNOWNS, descend_inside};
use spectra::color::{Lab, delta_e_cie76};

use super::film::PaintFilm;
use crate::layer::SLOTS;

/// How much a difference of lightness and of hue counts, to one of chroma: a
/// colour out of reach keeps its lightness first, then its hue.
const LIGHTNESS: f64 = 3.0;
const HUE: f64 = 1.5;

/// The pull to pigments near the colour, per squared unit of CIELAB. Of two
/// films of one colour it chooses; it moves the colour by some hundredths.
const NEARNESS: f64 = 1e-3;

/// The pull to thin films, per mm.
const THINNESS: f64 = 0.5;

/// What makes one film better than another.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Nearest {
    pub(super) film: PaintFilm,
    least_mm: f64,
    most_mm: f64,
    /// What the film's difference over ground and over black counts.
    hiding: f64,
    /// CIELAB of each slot's masstone: as thick as is allowed, over the ground.
    masstones: [[f64; 3]; SLOTS],
}

/// A film: each slot's share of it, and its height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mixed {
    pub(super) shares: [f64; SLOTS],
    pub(super) height_mm: f64,
}

impl Mixed {
    pub(super) fn heights_mm(&self) -> [f64; SLOTS] {
        self.shares.map(|share| share * self.height_mm)
    }

    /// The film of these heights; all of `fallback` where there is none.
    pub(super) fn of(heights_mm: [f64; SLOTS], fallback: usize) -> Self {
        let height_mm: f64 = heights_mm.iter().sum();
        if height_mm <= 0.0 {
            let shares = std::array::from_fn(|i| if i == fallback { 1.0 } else { 0.0 });
            return Self { shares, height_mm };
        }
        Self { shares: heights_mm.map(|height| height / height_mm), height_mm }
    }
}

/// A film to stay near to, and how much that counts (of shares, squared).
#[derive(Debug, Clone, Copy)]
pub(super) struct Anchor {
    pub(super) mixed: Mixed,
    pub(super) strength: f64,
}

/// A colour wanted, with the frame in which differences from it count.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    lab: [f64; 3],
    /// Rows: lightness, chroma, hue, each weighted.
    frame: [[f64; 3]; 3],
    nearness: [f64; SLOTS],
}

impl Wanted {
    /// The weighted squared distance of a colour.
    pub(super) fn distance_squared(&self, lab: [f64; 3]) -> f64 {
        self.residuals(lab).iter().map(|r| r * r).sum()
    }

    fn residuals(&self, lab: [f64; 3]) -> [f64; 3] {
        let off: [f64; 3] = std::array::from_fn(|i| lab[i] - self.lab[i]);
        self.frame.map(|row| row[0] * off[0] + row[1] * off[1] + row[2] * off[2])
    }

    /// What the shares' distance from the colour costs.
    pub(super) fn nearness_cost(&self, shares: &[f64; SLOTS]) -> f64 {
        shares.iter().zip(&self.nearness).map(|(share, cost)| share * cost).sum()
    }
}

impl Nearest {
    pub(super) fn new(film: PaintFilm, least_mm: f64, most_mm: f64, hiding: f64) -> Self {
        let masstones = std::array::from_fn(|slot| {
            let mut heights = [0.0; SLOTS];
            heights[slot] = most_mm;
            film.lab(&heights).to_array()
        });
        Self { film, least_mm, most_mm, hiding, masstones }
    }

    /// The lowest and the greatest height of a film, in mm.
    pub(super) fn heights_mm(&self) -> (f64, f64) {
        (self.least_mm, self.most_mm)
    }

    /// What the ground's showing through and the height of a film cost.
    pub(super) fn showing_cost(&self, mixed: &Mixed) -> f64 {
        let pull = if self.least_mm < self.most_mm { THINNESS * mixed.height_mm } else { 0.0 };
        0.5 * self.showing(mixed).powi(2) + pull
    }

    /// The difference of a film over the ground and over black (CIE 1976), times
    /// what that counts; 0 where the ground may show.
    pub(super) fn showing(&self, mixed: &Mixed) -> f64 {
        if self.hiding == 0.0 {
            return 0.0;
        }
        let heights = mixed.heights_mm();
        let (ground, black) = (self.film.lab(&heights), self.film.lab_over_black(&heights));
        self.hiding * delta_e_cie76(ground, black)
    }

    /// A wanted colour; chroma and hue weigh less the more chroma there is
    /// (CIE94).
    pub(super) fn wanted(&self, lab: Lab) -> Wanted {
        let chroma = lab.a.hypot(lab.b);
        let (cos, sin) = if chroma > 1e-9 { (lab.a / chroma, lab.b / chroma) } else { (1.0, 0.0) };
        let c = 1.0 / (1.0 + 0.045 * chroma);
        // Greys have no hue: there both directions count alike.
        let h = (1.0 + (HUE - 1.0) * (chroma / 10.0).min(1.0)) / (1.0 + 0.015 * chroma);
        let frame = [[LIGHTNESS, 0.0, 0.0], [0.0, c * cos, c * sin], [0.0, -h * sin, h * cos]];
        let lab = lab.to_array();
        let nearness = self.masstones.map(|masstone| {
            let squared: f64 = masstone.iter().zip(&lab).map(|(m, w)| (m - w) * (m - w)).sum();
            NEARNESS * squared
        });
        Wanted { lab, frame, nearness }
    }

    /// The least cost found from `start` within `steps`, and its film.
    pub(super) fn descended(
        &self,
        wanted: &Wanted,
        start: &Mixed,
        anchor: Option<&Anchor>,
        steps: usize,
    ) -> (f64, Mixed) {
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
        let cost = descend_inside(
            |point| self.cost(wanted, &self.mixed(point), anchor, chooses_height),
            &mut point,
            &bounds,
            steps,
        );
        (cost.value, self.mixed(&point))
    }

    /// The film that the unknowns mean.
    fn mixed(&self, point: &[f64; UNKNOWNS]) -> Mixed {
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
        Mixed { shares, height_mm }
    }

    fn cost(
        &self,
        wanted: &Wanted,
        mixed: &Mixed,
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
        let residuals = wanted.residuals(over_ground.lab);
        for (row, residual) in wanted.frame.iter().zip(residuals) {
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
        cost.value += wanted.nearness_cost(&mixed.shares);
        for (place, &slot) in used.iter().enumerate() {
            cost.gradient[place] += wanted.nearness[slot];
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

/// A cost while its residuals are added up.
struct Sum<'a> {
    cost: Cost,
    used: &'a [usize],
    mixed: &'a Mixed,
    chooses_height: bool,
}

impl Sum<'_> {
    /// One residual, with its slopes over the slots' mm.
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
