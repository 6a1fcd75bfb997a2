//! Properties of a palette: how its paints hide, tint, mix, and change with the light.
//!
//! In a library of relative amounts a recipe stands for a film that hides. In one of absolute amounts the
//! paper is the white. A share of 1 is then one wash of the pigment (see [`Palette::wash`]), and you thin a
//! recipe with water if its shares sum to less than 1.
//!
//! Pigments with unknown scattering take no part in any mixture.

mod paints;
mod charts;
mod gamut;
mod metamers;

pub use crate::color::Appearance;
pub use crate::recipe::Recipe;
pub use charts::{
    CHART_TINT, Drawdown, DrawdownStep, GradedMixture, GradedStep, HIDING_CONTRAST, Hides,
    HidingPower, MixingChart, MixingRow, PainterRules, TINT_DEPTH, TINT_PARTS, TINTS, TintLadder,
    TintingStrength, default_pairs, drawdowns, graded, hiding_powers, mixing_chart,
    scattering_per_mm, tint_ladders, tinting_strengths,
};
pub use gamut::{
    Boundary, ColorWheel, Gamut, GamutSample, MixingLine, NearestMixture, color_wheel,
    sampled_gamut, spectral_locus, srgb_primaries,
};
pub use metamers::{ColorShift, Metamers, TestLight, color_shifts, metamers, test_lights};
pub use paints::{Cards, MeasuredSample, Palette, PaletteError};
