//! Colour shift of paints from one light to another.

use spectra::color::{Adaptation, Lab, Xyz, adapt, delta_e_ciede2000};
use spectra::{Illuminant, TristimulusWeights};

use super::paints::Palette;
use crate::appearance::Appearance;
use crate::evaluate::Viewing;
use crate::recipe::Recipe;

/// Lights that a palette is shown under, besides its own.
const LIGHTS: [&str; 3] = ["D65", "A", "FL11"];

/// A light that a palette is shown under.
#[derive(Debug, Clone, PartialEq)]
pub struct TestLight {
    /// Name of the light.
    pub name: String,
    /// Tristimulus weights on the library's grid, for the palette's observer.
    pub weights: TristimulusWeights,
}

/// Colours of one recipe under several lights.
#[derive(Debug, Clone, PartialEq)]
pub struct ColorShift {
    /// Paints with their shares.
    pub recipe: Recipe,
    /// Colour under each light, relative to that light's white.
    pub colors: Vec<Appearance>,
    /// By light: CIEDE2000 between the colour under the first light and the colour under this one,
    /// adapted to the first light (Bradford); 0 for the first.
    pub shifts: Vec<f64>,
}

/// The palette's own light, followed by those of D65, A and FL11 that differ from it.
#[must_use]
pub fn test_lights(palette: &Palette<'_>) -> Vec<TestLight> {
    let own = palette.viewing();
    let first =
        TestLight { name: own.illuminant.name().to_owned(), weights: palette.weights().clone() };
    let others = LIGHTS.iter().filter(|name| **name != own.illuminant.name()).map(|name| {
        let illuminant = Illuminant::named(name).expect("a CIE illuminant is shipped");
        let viewing = Viewing { illuminant, observer: own.observer };
        let weights = viewing.weights(palette.library().grid).expect("the method fits the grid");
        TestLight { name: (*name).to_owned(), weights }
    });
    std::iter::once(first).chain(others).collect()
}

/// Computes the shift of each recipe from the first of `lights` to each of them: the difference that
/// remains after the eye has adapted, 0 for a paint of constant colour.
#[must_use]
pub fn color_shifts(
    palette: &Palette<'_>,
    lights: &[TestLight],
    recipes: &[Recipe],
) -> Vec<ColorShift> {
    let shift = |recipe: &Recipe| {
        let reflectance = palette.reflectance(recipe);
        let xyz: Vec<Xyz> = lights.iter().map(|light| light.weights.xyz(&reflectance)).collect();
        let whites: Vec<Xyz> = lights.iter().map(|light| light.weights.white()).collect();
        let under_first = |at: usize| {
            let xyz = if at == 0 {
                xyz[0]
            } else {
                adapt(xyz[at], whites[at], whites[0], Adaptation::Bradford)
            };
            Lab::from_xyz(xyz, whites[0])
        };
        let all = 0..lights.len();
        ColorShift {
            recipe: recipe.clone(),
            colors: all.clone().map(|at| Appearance::of(xyz[at], whites[at])).collect(),
            shifts: all.map(|at| delta_e_ciede2000(under_first(0), under_first(at))).collect(),
        }
    };
    recipes.iter().map(shift).collect()
}
