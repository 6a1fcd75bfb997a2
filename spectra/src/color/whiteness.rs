//! CIE whiteness and tint.

use super::xyz::Xyz;
use crate::illuminant::{Illuminant, Observer};
use documents::hint::Explain;

/// The formula applies from this whiteness on, up to 5 Y - 280.
const LEAST_WHITENESS: f64 = 40.0;
/// The formula applies to tints in this range.
const TINTS: [f64; 2] = [-4.0, 2.0];

/// Whiteness W and tint T of the CIE (CIE 15:2018, section 9.4).
///
/// ```
/// use spectra::color::{Whiteness, Xyz};
/// use spectra::{Illuminant, Observer};
///
/// let white = Xyz { x: 95.047, y: 100.0, z: 108.883 };
/// let (light, observer) = (Illuminant::d65(), Observer::Cie1931Deg2);
/// let paper = Xyz { x: 86.0, y: 90.0, z: 102.0 };
/// let found = Whiteness::of(paper, white, &light, observer).unwrap();
/// assert!(found.whiteness > 100.0 && found.tint.abs() < 2.0);
/// let ochre = Xyz { x: 30.0, y: 28.0, z: 12.0 };
/// assert!(Whiteness::of(ochre, white, &light, observer).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Whiteness {
    /// Whiteness W: 100 for the perfect diffuser, more for bluish whites.
    pub whiteness: f64,
    /// Tint T: above 0 greenish, below 0 reddish.
    pub tint: f64,
}

impl Whiteness {
    /// Whiteness of `xyz` under the white point `white` of `light` for `observer`.
    ///
    /// # Errors
    /// [`WhitenessError`] if the light is not D65 or C, if the CIE has no formula for the observer,
    /// or if the CIE does not call this colour white.
    pub fn of(
        xyz: Xyz,
        white: Xyz,
        light: &Illuminant,
        observer: Observer,
    ) -> Result<Self, WhitenessError> {
        if !["D65", "C"].contains(&light.name()) {
            return Err(WhitenessError::Light(light.name().to_owned()));
        }
        // The tint of the 10 degree observer has a smaller coefficient of x.
        let of_x = match observer {
            Observer::Cie1931Deg2 => 1000.0,
            Observer::Cie1964Deg10 => 900.0,
            Observer::Cie2015Deg2 | Observer::Cie2015Deg10 => {
                return Err(WhitenessError::Observer(observer));
            }
        };
        let own = xyz.to_xyy(white);
        let perfect = white.to_xyy(white);
        let x = perfect.x - own.x;
        let y = perfect.y - own.y;
        let whiteness = xyz.y + 800.0 * x + 1700.0 * y;
        let tint = of_x * x - 650.0 * y;
        let most = 5.0 * xyz.y - 280.0;
        if !(whiteness > LEAST_WHITENESS && whiteness < most) {
            return Err(WhitenessError::NotWhite { whiteness, most });
        }
        if !(tint > TINTS[0] && tint < TINTS[1]) {
            return Err(WhitenessError::Tinted(tint));
        }
        Ok(Self { whiteness, tint })
    }
}

/// A colour that has no CIE whiteness.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum WhitenessError {
    /// The CIE made the formula for daylight only.
    #[error("whiteness is defined under D65 and C, not under {0}")]
    #[hint("choose [illuminant=D65]")]
    #[fault(Setting)]
    Light(String),
    /// The CIE made the formula for the observers of 1931 and 1964 only.
    #[error("whiteness is defined for the observers 1931-2 and 1964-10, not for {0}")]
    #[hint("choose [observer=10]")]
    #[fault(Setting)]
    Observer(Observer),
    /// The colour is too dark, too yellow or too blue.
    #[error(
        "not white: W {whiteness:.1} is not between {LEAST_WHITENESS} and 5 Y - 280 = {most:.1}"
    )]
    NotWhite {
        /// Result of the formula. It has no meaning here.
        whiteness: f64,
        /// Greatest whiteness at this luminance factor.
        most: f64,
    },
    /// The colour is greenish or reddish.
    #[error("not white: T {tint:.1} is not between {} and {}", TINTS[0], TINTS[1], tint = .0)]
    Tinted(f64),
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(xyz: [f64; 3], light: &str, observer: Observer) -> Result<Whiteness, WhitenessError> {
        let white = Xyz { x: 95.047, y: 100.0, z: 108.883 };
        Whiteness::of(xyz.into(), white, &Illuminant::named(light).unwrap(), observer)
    }

    #[test]
    fn the_perfect_diffuser_has_whiteness_100_and_no_tint() {
        for observer in [Observer::Cie1931Deg2, Observer::Cie1964Deg10] {
            let found = of([95.047, 100.0, 108.883], "D65", observer).unwrap();
            assert!((found.whiteness - 100.0).abs() < 1e-9 && found.tint.abs() < 1e-9, "{found:?}");
        }
    }

    #[test]
    fn what_is_not_white_is_reported_with_its_reason() {
        let deg2 = Observer::Cie1931Deg2;
        let dark = message([30.0, 31.0, 33.0], "D65", deg2);
        assert!(dark.contains("not white: W ") && dark.contains("5 Y - 280 = -125.0"), "{dark}");
        let green = message([80.0, 88.0, 94.0], "D65", deg2);
        assert!(green.contains("not white: T "), "{green}");
        assert!(message([90.0, 95.0, 100.0], "A", deg2).contains("not under A"));
        let deg2015 = message([90.0, 95.0, 100.0], "D65", Observer::Cie2015Deg2);
        assert!(deg2015.contains("2015-2"), "{deg2015}");
    }

    fn message(xyz: [f64; 3], light: &str, observer: Observer) -> String {
        of(xyz, light, observer).unwrap_err().to_string()
    }
}
