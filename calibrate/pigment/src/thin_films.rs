//! Thin films of paints that were measured only in films that hide.
//!
//! Such a library does not know S of a thin film of a strong blue. By its figures, a film of some thousandths
//! of a mm over white has far more chroma than any tint. We assume that paint does not make films so thin: hair
//! and knife leave it in furrows and crumbs, and you see them beside the bare ground.

use spectra::TristimulusWeights;

use crate::evaluate::{Viewing, lab};
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::PigmentId;

/// Maximum of [`least_films`], as S d of the reference white. It is 0.012 mm in paint from the tube, of which the white
/// hides from 0.05 mm on. We chose it by eye: with 12, thin strokes of blue no longer look like paint.
pub const MOST_FILM: f64 = 5.0;
/// Thinnest film that we try.
const LEAST_FILM: f64 = 0.05;
/// We try this many thicknesses below [`MOST_FILM`], each smaller than the one before by the same factor.
const STEPS: i32 = 48;
/// We also check films that cover these parts of a white ground.
const SHARES: [f64; 4] = [0.2, 0.4, 0.6, 0.8];
/// We compare with this many tints, from 1 part of paint in 1000 to paint alone.
const TINTS: i32 = 60;
/// A film may have this much more chroma than a tint of the same lightness. You hardly see it.
const MORE_CHROMA: f64 = 3.0;
/// Tints within this lightness of a film count.
const SAME_LIGHTNESS: f64 = 2.0;

/// Thickness of each pigment, in the library's unit and order, from which on its films over the reference white have no
/// more chroma under D65 than its tints of the same lightness, 0 to [`MOST_FILM`]. If such a film covers a part of the
/// white, what you see of both together has no more chroma either.
///
/// Lakes and strong blues have more chroma in any film that does not hide. They get [`MOST_FILM`]. All pigments of a
/// library of absolute amounts get 0, since its thin films were measured, and so do those of a library without a
/// reference white.
#[must_use]
pub fn least_films(library: &PigmentLibrary) -> Vec<f64> {
    match Films::of(library) {
        Some(films) => library.ids().map(|pigment| films.least(pigment)).collect(),
        None => vec![0.0; library.pigments.len()],
    }
}

struct Films<'a> {
    library: &'a PigmentLibrary,
    white: PigmentId,
    weights: TristimulusWeights,
}

impl<'a> Films<'a> {
    fn of(library: &'a PigmentLibrary) -> Option<Self> {
        let white = library.reference_id().filter(|_| library.amounts == AmountKind::Relative)?;
        let weights = Viewing::default().weights(library.grid).ok()?;
        Some(Self { library, white, weights })
    }

    /// Reflectance of a tint with this share of a pigment.
    fn tint(&self, pigment: PigmentId, share: f64) -> Vec<f64> {
        let parts = [(pigment, share), (self.white, 1.0 - share)];
        let mixture = self.library.mix(parts).expect("parts of a mixture");
        mixture.hiding(self.library.saunderson)
    }

    fn least(&self, pigment: PigmentId) -> f64 {
        let film = self.library.film();
        let tints = (0..=TINTS).map(|step| 1000f64.powf(-f64::from(step) / f64::from(TINTS)));
        let tints: Vec<_> =
            tints.map(|share| self.lightness_and_chroma(&self.tint(pigment, share))).collect();
        let is_within = |reflectance: &[f64]| {
            let [lightness, chroma] = self.lightness_and_chroma(reflectance);
            let near = tints.windows(2).filter(|pair| {
                let darker = pair[0][0].min(pair[1][0]);
                let lighter = pair[0][0].max(pair[1][0]);
                (darker - SAME_LIGHTNESS..=lighter + SAME_LIGHTNESS).contains(&lightness)
            });
            let most = near.flatten().fold(0.0, |most: f64, tint| most.max(tint[1]));
            chroma <= most + MORE_CHROMA
        };
        let bare = self.tint(pigment, 0.0);
        let paint = self.library.mix([(pigment, 1.0)]).expect("one part is a mixture");
        let whole = (0..=STEPS).take_while(|&step| {
            let seen = paint.film(thickness(step), &bare, film);
            is_within(&seen)
                && SHARES.iter().all(|share| {
                    let pairs = seen.iter().zip(&bare);
                    let beside = pairs.map(|(film, bare)| share * film + (1.0 - share) * bare);
                    is_within(&beside.collect::<Vec<_>>())
                })
        });
        thickness(whole.last().unwrap_or(0))
    }

    fn lightness_and_chroma(&self, reflectance: &[f64]) -> [f64; 2] {
        let lab = lab(&self.weights, reflectance);
        [lab.lightness, lab.a.hypot(lab.b)]
    }
}

/// Thickness of a step from the greatest least film to the thinnest.
fn thickness(step: i32) -> f64 {
    MOST_FILM * (LEAST_FILM / MOST_FILM).powf(f64::from(step) / f64::from(STEPS))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strong_blues_need_thicker_films_than_whites_and_earths() {
        let oils = PigmentLibrary::van_gogh_oils();
        let least = least_films(&oils);
        let [blue, white, red, black] = ["Ultramarine", "Lead White", "Vermilion", "Bone Black"]
            .map(|name| least[oils.find(name).unwrap().index()]);
        assert_eq!([blue, white], [MOST_FILM, LEAST_FILM]);
        assert!((1.0..4.0).contains(&red), "{red}");
        assert!(black < 1.0, "{black}");
    }

    #[test]
    fn a_film_from_the_least_one_on_has_the_chroma_of_tints_and_thinner_ones_have_more() {
        let oils = PigmentLibrary::van_gogh_oils();
        let films = Films::of(&oils).unwrap();
        let vermilion = oils.find("Vermilion").unwrap();
        let least = least_films(&oils)[vermilion.index()];
        let bare = films.tint(vermilion, 0.0);
        let paint = oils.mix([(vermilion, 1.0)]).unwrap();
        let beyond = |thickness: f64| {
            let film = paint.film(thickness, &bare, oils.film());
            let [lightness, chroma] = films.lightness_and_chroma(&film);
            let tints = (0..=4000).map(|step| films.tint(vermilion, 0.9985f64.powi(step)));
            let tints = tints.map(|tint| films.lightness_and_chroma(&tint));
            let near = tints.min_by(|a, b| {
                let [a, b] = [a, b].map(|tint| (tint[0] - lightness).abs());
                a.total_cmp(&b)
            });
            chroma - near.unwrap()[1]
        };
        for factor in [1.0, 1.5, 3.0] {
            assert!(beyond(factor * least) < 5.0, "{factor}: {}", beyond(factor * least));
        }
        assert!(beyond(0.3 * least) > 8.0, "{}", beyond(0.3 * least));
    }

    #[test]
    fn libraries_of_absolute_amounts_have_measured_films() {
        let mut oils = PigmentLibrary::van_gogh_oils();
        oils.amounts = AmountKind::Absolute;
        assert!(least_films(&oils).iter().all(|least| *least == 0.0));
        oils.amounts = AmountKind::Relative;
        oils.reference = None;
        assert!(least_films(&oils).iter().all(|least| *least == 0.0));
    }
}
