//! The target colour of a recipe search.

use std::sync::Arc;

use pigment::evaluate::{Viewing, lab};
use pigment::matching::{Target, ViewingCondition};
use spectra::color::{Adaptation, ColorCode, Lab, Rgb, RgbSpace, Xyz};
use spectra::{Grid, TristimulusWeights};

/// A colour in one of three forms.
#[derive(Debug, Clone, PartialEq)]
pub enum Color {
    /// Screen colour in linear sRGB, to be matched in appearance under any light.
    Screen([f64; 3]),
    /// CIELAB relative to the light of the painting.
    Lab(Lab),
    /// Reflectance on the library's wavelength grid, 0 to 1.
    Reflectance(Arc<Vec<f64>>),
}

/// A target colour and its description.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetColor {
    /// Origin of the colour, shown in the panel.
    pub name: String,
    /// Colour to be matched.
    pub color: Color,
}

impl TargetColor {
    /// Creates a target from a screen colour in linear sRGB.
    #[must_use]
    pub fn screen(name: &str, linear: [f64; 3]) -> Self {
        Self { name: name.to_owned(), color: Color::Screen(linear) }
    }

    /// Parses `#rrggbb` or `L,a,b`.
    #[must_use]
    pub fn from_text(text: &str) -> Option<Self> {
        Some(match text.trim().parse().ok()? {
            ColorCode::Srgb(rgb) => Self::screen(&rgb.to_hex(), rgb.linear().0),
            ColorCode::Lab(lab) => {
                let [l, a, b] = lab.to_array();
                Self { name: format!("Lab {l} {a} {b}"), color: Color::Lab(lab) }
            }
        })
    }

    /// CIELAB of the target under a light.
    #[must_use]
    pub fn lab(&self, grid: Grid, viewing: &Viewing) -> Lab {
        match &self.color {
            Color::Screen(linear) => {
                let white = weights(grid, viewing).white();
                Lab::from_xyz(from_screen(*linear, white), white)
            }
            Color::Lab(lab) => *lab,
            Color::Reflectance(values) => lab(&weights(grid, viewing), values),
        }
    }

    /// Encoded sRGB of the target under a light, not clipped to the gamut.
    #[must_use]
    pub fn shown(&self, grid: Grid, viewing: &Viewing) -> Rgb {
        match &self.color {
            Color::Screen(linear) => Rgb(*linear).encoded(),
            _ => screen_rgb(self.lab(grid, viewing), weights(grid, viewing).white()),
        }
    }

    /// Converts to the target of a recipe search under the given viewing conditions.
    #[must_use]
    pub fn match_target(&self, grid: Grid, conditions: &[ViewingCondition]) -> Target {
        let lab = conditions.iter().map(|condition| self.lab(grid, &condition.viewing)).collect();
        Target { name: self.name.clone(), lab, spectrum: None }
    }
}

/// Encoded sRGB of a colour under `white`, adapted as the painting is displayed.
pub(super) fn screen_rgb(lab: Lab, white: Xyz) -> Rgb {
    RgbSpace::Srgb.encoded_from_xyz(lab.to_xyz(white), white, Adaptation::Bradford)
}

/// XYZ under `white` of a screen colour in linear sRGB.
fn from_screen(linear: [f64; 3], white: Xyz) -> Xyz {
    RgbSpace::Srgb.xyz_from_encoded(Rgb(linear).encoded(), white, Adaptation::Bradford)
}

/// Tristimulus weights of a light for reflectances on `grid`.
pub(super) fn weights(grid: Grid, viewing: &Viewing) -> TristimulusWeights {
    viewing.weights(grid).expect("the tristimulus method fits every library grid")
}

#[cfg(test)]
mod tests {
    use super::*;
    use spectra::{Illuminant, Observer};

    fn grid() -> Grid {
        Grid::from_nm(380.0, 10.0, 36).unwrap()
    }

    fn tungsten() -> Viewing {
        let illuminant = Illuminant::named("A").unwrap();
        Viewing { illuminant, observer: Observer::default() }
    }

    #[test]
    fn only_hexadecimal_and_lab_are_parsed() {
        let hex = TargetColor::from_text(" #2a5caa ").unwrap();
        assert_eq!(hex.name, "#2a5caa");
        assert_eq!(hex.shown(grid(), &tungsten()).to_hex(), "#2a5caa", "whatever the light");
        let lab = TargetColor::from_text("52,-10.5,8").unwrap();
        assert_eq!(lab.name, "Lab 52 -10.5 8");
        let found = lab.lab(grid(), &tungsten());
        assert_eq!(found, Lab { lightness: 52.0, a: -10.5, b: 8.0 });
        for text in ["", "blue", "1,2", "#12345"] {
            assert_eq!(TargetColor::from_text(text), None, "{text}");
        }
    }

    #[test]
    fn a_screen_color_round_trips_through_lab() {
        let wanted = TargetColor::screen("sky", [0.2, 0.4, 0.7]);
        for viewing in [Viewing::default(), tungsten()] {
            let lab = wanted.lab(grid(), &viewing);
            let back = screen_rgb(lab, weights(grid(), &viewing).white()).linear().0;
            for (found, wanted) in back.into_iter().zip([0.2, 0.4, 0.7]) {
                assert!((found - wanted).abs() < 1e-9, "{back:?}");
            }
        }
    }

    #[test]
    fn a_reflectance_has_the_lab_of_the_library() {
        let values: Vec<f64> = (0..36).map(|i| 0.1 + 0.02 * f64::from(i)).collect();
        let viewing = tungsten();
        let wanted = TargetColor {
            name: String::new(),
            color: Color::Reflectance(Arc::new(values.clone())),
        };
        assert_eq!(wanted.lab(grid(), &viewing), lab(&viewing.weights(grid()).unwrap(), &values));
        let perfect =
            TargetColor { name: String::new(), color: Color::Reflectance(vec![1.0; 36].into()) };
        assert_eq!(perfect.shown(grid(), &viewing).to_hex(), "#ffffff");
    }
}
