//! K d and S d of a film at one wavelength, from its reflectances over two cards, and estimates with their
//! deviations.
//!
//! All reflectances are internal, below the surface.

use pigment::digits::rounded;
use serde::Serialize;
use spectra::optics::{Layer, OverBacking, film_over_two_backings};

/// Thinnest and thickest film that we try, relative to the film that was read.
pub(crate) const FACTORS: [f64; 2] = [1e-4, 1e4];
/// Steps of a bisection. They suffice for twelve digits.
const STEPS: usize = 60;

/// A value with its standard deviation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// Most probable value.
    pub value: f64,
    /// Its standard deviation, from the noise of the readings.
    pub deviation: f64,
}

impl Estimate {
    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self { value: self.value * factor, deviation: self.deviation * factor }
    }

    pub(crate) fn rounded(self) -> Self {
        Self { value: rounded(self.value), deviation: rounded(self.deviation) }
    }
}

/// The number between `low` and `high` up to which `is_below` holds.
pub(crate) fn bisected([mut low, mut high]: [f64; 2], is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..STEPS {
        let middle = (low * high).sqrt();
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    (low * high).sqrt()
}

/// K d and S d of the thinnest film with this K/S that shows the cards by no more than `least`.
pub(crate) fn hidden(ratio: f64, [white, black]: [f64; 2], least: f64) -> [f64; 2] {
    let s = bisected(FACTORS, |s| {
        let layer = Layer::new(ratio * s, s, 1.0);
        layer.over(white) - layer.over(black) > least
    });
    [ratio * s, s]
}

/// K d and S d from internal reflectances over two cards. Where noise asks for a negative one, we set it to 0
/// and fit the other.
pub(crate) fn powers_of(films: [f64; 2], cards: [f64; 2]) -> [f64; 2] {
    let [light, dark] = [0, 1].map(|side| OverBacking { film: films[side], backing: cards[side] });
    let optics = film_over_two_backings(light, dark);
    let exact = optics.and_then(|optics| {
        let s = optics.scattering_power.filter(|s| s.is_finite())?;
        Some([optics.ratio * s, s])
    });
    let error = |[k, s]: [f64; 2]| -> f64 {
        let layer = Layer::new(k, s, 1.0);
        films.iter().zip(cards).map(|(film, card)| (layer.over(card) - film).powi(2)).sum()
    };
    let candidates = [
        exact.filter(|powers| powers.iter().all(|power| power.is_finite())),
        Some([0.0, least_square(|s| error([0.0, s]))]),
        Some([least_square(|k| error([k, 0.0])), 0.0]),
    ];
    let best = candidates.into_iter().flatten().min_by(|a, b| error(*a).total_cmp(&error(*b)));
    best.unwrap_or_default()
}

/// Argument with the least value of `error`, by a search over decades and a golden section.
fn least_square(error: impl Fn(f64) -> f64) -> f64 {
    let tried = (0..=80).map(|step| 10f64.powf(f64::from(step) / 10.0 - 5.0));
    let Some(start) = tried.min_by(|a, b| error(*a).total_cmp(&error(*b))) else { return 0.0 };
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let mut low = start.ln() - 0.3;
    let mut high = start.ln() + 0.3;
    for _ in 0..STEPS {
        let left = high - golden * (high - low);
        let right = low + golden * (high - low);
        if error(left.exp()) < error(right.exp()) {
            high = right;
        } else {
            low = left;
        }
    }
    f64::midpoint(low, high).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boundary_films_are_found() {
        for [k, s] in [[0.0, 2.0], [0.7, 0.0], [0.4, 1.5], [3.0, 0.2], [0.0, 0.0]] {
            let layer = Layer::new(k, s, 1.0);
            let cards = [0.85, 0.05];
            let found = powers_of(cards.map(|card| layer.over(card)), cards);
            assert!((found[0] - k).abs() < 1e-4 && (found[1] - s).abs() < 1e-4, "{found:?}");
        }
    }

    #[test]
    fn a_hidden_film_shows_just_as_much_as_is_allowed() {
        let [k, s] = hidden(0.1, [0.8, 0.05], 0.004);
        let layer = Layer::new(k, s, 1.0);
        assert!((layer.over(0.8) - layer.over(0.05) - 0.004).abs() < 1e-9);
        assert!((k / s - 0.1).abs() < 1e-12);
    }
}
