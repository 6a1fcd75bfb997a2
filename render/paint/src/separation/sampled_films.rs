//! Starting points of the search for a film: sampled films of one to three pigments, thin
//! and thick.

use rayon::prelude::*;

use super::film::PaintFilm;
use super::film_search::{FilmMix, FilmSearch, TargetColor};
use crate::layer::SLOTS;

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
                all.push(of(&[(first, PAIR_RATIO.powi(step)), (second, 1.0)]));
            }
            for &third in &used[b + 1..] {
                for i in -TRIPLE_STEPS..=TRIPLE_STEPS {
                    for j in -TRIPLE_STEPS..=TRIPLE_STEPS {
                        let parts = [TRIPLE_RATIO.powi(i), TRIPLE_RATIO.powi(j)];
                        all.push(of(&[(first, parts[0]), (second, parts[1]), (third, 1.0)]));
                    }
                }
            }
        }
    }
    all
}
