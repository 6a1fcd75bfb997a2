//! What a palette can do: how its paints hide, tint, mix, and change with the
//! light.
//!
//! Every recipe here is a list of `(pigment index, share)`. In a library of
//! relative amounts a recipe is a film that hides. In one of absolute amounts
//! the paper is the white: shares are of each pigment's own wash (see
//! [`Palette::wash`]), and a recipe of shares below 1 is thinned with water.
//!
//! A pigment whose scattering is not identified takes no part in any mixture.

mod cards;

mod paints;

mod samples;

mod hiding_power;

mod tinting_strength;

mod mixing_chart;

mod between;

mod gamut;

mod constancy;

mod metamers;

mod graded;

pub use cards::Cards;
pub use constancy::{ColorShift, TestLight, color_shifts, test_lights};
pub use gamut::{Boundary, Gamut, GamutSample, sampled_gamut, spectral_locus, srgb_primaries};
pub use graded::{GradedMixture, GradedStep, MixingRow, PainterRules, default_pairs, graded};
pub use hiding_power::{HIDING_CONTRAST, Hides, HidingPower, hiding_powers};
pub use metamers::{Metamers, metamers};
pub use mixing_chart::{
    CHART_TINT, Drawdown, DrawdownStep, MixingChart, TINTS, TintLadder, drawdowns, mixing_chart,
    tint_ladders,
};
pub use paints::{Appearance, Palette, PaletteError, Recipe};
pub use samples::MeasuredSample;
pub use tinting_strength::{TINT_DEPTH, TINT_PARTS, TintingStrength, tinting_strengths};
