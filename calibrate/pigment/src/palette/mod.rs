//! Properties of a palette: how its paints hide, tint, mix, and change with the light.
//!
//! In a library of relative amounts a recipe stands for a film that hides. In one of absolute amounts the
//! paper is the white: a share of 1 is one wash of the pigment (see [`Palette::wash`]), and a recipe whose
//! shares sum to less than 1 is thinned with water.
//!
//! Pigments whose scattering is not identified take no part in any mixture.

mod cards;
mod paints;
mod samples;
mod hiding_power;
mod tinting_strength;
mod mixing_chart;
mod between;
mod gamut;
mod wheel;
mod constancy;
mod metamers;
mod graded;

pub use crate::appearance::Appearance;
pub use crate::recipe::Recipe;
pub use cards::Cards;
pub use constancy::{ColorShift, TestLight, color_shifts, test_lights};
pub use gamut::{Boundary, Gamut, GamutSample, sampled_gamut, spectral_locus, srgb_primaries};
pub use graded::{GradedMixture, GradedStep, MixingRow, PainterRules, default_pairs, graded};
pub use hiding_power::{HIDING_CONTRAST, Hides, HidingPower, hiding_powers, scattering_per_mm};
pub use metamers::{Metamers, metamers};
pub use mixing_chart::{
    CHART_TINT, Drawdown, DrawdownStep, MixingChart, TINTS, TintLadder, drawdowns, mixing_chart,
    tint_ladders,
};
pub use paints::{Palette, PaletteError};
pub use samples::MeasuredSample;
pub use tinting_strength::{TINT_DEPTH, TINT_PARTS, TintingStrength, tinting_strengths};
pub use wheel::{ColorWheel, MixingLine, NearestMixture, color_wheel};
