//! Where the search for a film begins: films of up to three pigments, from a
//! trace to all of each, thin and thick.

use rayon::prelude::*;

use super::film::PaintFilm;
use super::nearest::{Mixed, Nearest, Wanted};
use crate::layer::SLOTS;

/// Parts of one pigment to one of another, as powers of `STEP`.
const PAIR_STEPS: i32 = 8;
/// The same among three.
const TRIPLE_STEPS: i32 = 2;
const STEP: f64 = 1.9;
const TRIPLE_STEP: f64 = 4.0;

/// Films with their colours.
#[derive(Debug, Clone)]
pub(super) struct Mixtures {
    films: Vec<Sampled>,
}

#[derive(Debug, Clone)]
struct Sampled {
    mixed: Mixed,
    lab: [f64; 3],
    /// One bit a slot in use.
    set: u32,
    /// What showing the ground costs.
    showing: f64,
}

impl Mixtures {
    /// The films that start a search of `nearest`.
    pub(super) fn of(nearest: &Nearest) -> Self {
        let (least, most) = nearest.heights_mm();
        let heights =
            if least < most { vec![least, (least * most).sqrt(), most] } else { vec![most] };
        let all = shares(&nearest.film);
        let films = all
            .par_iter()
            .flat_map_iter(|shares| {
                heights.iter().map(|&height_mm| {
                    let mixed = Mixed { shares: *shares, height_mm };
                    let set = (0..SLOTS).filter(|&i| shares[i] > 0.0).map(|i| 1 << i).sum();
                    let lab = nearest.film.lab(&mixed.heights_mm()).to_array();
                    Sampled { mixed, lab, set, showing: nearest.showing_cost(&mixed) }
                })
            })
            .collect();
        Self { films }
    }

    /// The best films of `count` different sets of pigments, best first.
    pub(super) fn nearest_to(&self, wanted: &Wanted, count: usize) -> Vec<Mixed> {
        let mut best: Vec<(f64, &Sampled)> = Vec::with_capacity(count + 1);
        for film in &self.films {
            let worst = if best.len() < count { f64::INFINITY } else { best[count - 1].0 };
            // The distance alone rules most out.
            let distance = 0.5 * wanted.distance_squared(film.lab);
            if distance >= worst {
                continue;
            }
            let cost = distance + film.showing + wanted.nearness_cost(&film.mixed.shares);
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

/// One, two and three pigments.
fn shares(film: &PaintFilm) -> Vec<[f64; SLOTS]> {
    let used = film.used();
    let of = |parts: &[(usize, f64)]| {
        let total: f64 = parts.iter().map(|(_, part)| part).sum();
        let mut shares = [0.0; SLOTS];
        parts.iter().for_each(|&(slot, part)| shares[slot] = part / total);
        shares
    };
    let mut all = Vec::new();
    for (a, &first) in used.iter().enumerate() {
        all.push(of(&[(first, 1.0)]));
        for (b, &second) in used.iter().enumerate().skip(a + 1) {
            for step in -PAIR_STEPS..=PAIR_STEPS {
                all.push(of(&[(first, STEP.powi(step)), (second, 1.0)]));
            }
            for &third in &used[b + 1..] {
                for i in -TRIPLE_STEPS..=TRIPLE_STEPS {
                    for j in -TRIPLE_STEPS..=TRIPLE_STEPS {
                        let parts = [TRIPLE_STEP.powi(i), TRIPLE_STEP.powi(j)];
                        all.push(of(&[(first, parts[0]), (second, parts[1]), (third, 1.0)]));
                    }
                }
            }
        }
    }
    all
}
