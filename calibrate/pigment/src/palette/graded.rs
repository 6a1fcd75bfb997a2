//! Mixtures of two paints from one to the other, five ways.
//!
//! After Baxter, Wendt and Lin 2004, figure 10: what is measured, Kubelka-Munk
//! over the whole spectrum, at eight and at three wavelengths, and mixing of
//! RGB.

use spectra::color::{Lab, Xyz, delta_e_ciede2000};

use super::paints::{Appearance, Palette};
use super::samples::MeasuredSample;
use crate::library::AmountKind;
use crate::mixture::Mixture;
use crate::quadrature::{Quadrature, QuadratureFailure};

/// A regular step gives way to a measured share as near as this.
const NEAR: f64 = 0.045;

/// The few wavelengths that painting may use in place of the spectrum, both
/// fitted to the library (method `library`), so that they differ by their number
/// alone.
#[derive(Debug, Clone, PartialEq)]
pub struct PainterRules {
    /// Eight wavelengths.
    pub eight: Quadrature,
    /// Three wavelengths.
    pub three: Quadrature,
}

impl PainterRules {
    /// The rules for a palette.
    ///
    /// # Errors
    /// [`QuadratureFailure`]: never for three or eight wavelengths.
    pub fn of(palette: &Palette<'_>) -> Result<Self, QuadratureFailure> {
        let rule = |count| Quadrature::library(palette.viewing(), palette.library(), count);
        let (eight, three) = rayon::join(|| rule(8), || rule(3));
        Ok(Self { eight: eight?, three: three? })
    }
}

/// How a row of swatches is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MixingRow {
    /// Measured swatches.
    Measured,
    /// Kubelka-Munk at every wavelength of the library.
    Spectrum,
    /// Kubelka-Munk at eight wavelengths.
    EightNodes,
    /// Kubelka-Munk at three wavelengths.
    ThreeNodes,
    /// Straight lines in linear RGB between the two masstones.
    LinearRgb,
}

impl MixingRow {
    /// Every way, in the order of a figure.
    pub const ALL: [Self; 5] =
        [Self::Measured, Self::Spectrum, Self::EightNodes, Self::ThreeNodes, Self::LinearRgb];

    /// The name of the row.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Spectrum => "full spectrum",
            Self::EightNodes => "8 wavelengths",
            Self::ThreeNodes => "3 wavelengths",
            Self::LinearRgb => "linear RGB",
        }
    }
}

/// One mixing ratio, made in every way.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedStep {
    /// The share of the second paint, 0..1: the measured one where there is one.
    pub share: f64,
    /// The measured sample of this share.
    pub sample: Option<String>,
    /// In the order of [`MixingRow::ALL`]; none where nothing was measured.
    pub colors: [Option<Appearance>; 5],
    /// CIEDE2000 of each from the measured colour; where there is none, from the
    /// full spectrum.
    pub errors: [Option<f64>; 5],
}

/// Two paints, graded from the first to the second.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedMixture {
    /// The paints.
    pub pair: (usize, usize),
    /// By rising share of the second.
    pub steps: Vec<GradedStep>,
}

impl GradedMixture {
    /// The mean of a row's errors over the mixed steps, and how many they are;
    /// with `measured` only over those that were measured.
    #[must_use]
    pub fn mean_error(&self, row: MixingRow, measured: bool) -> Option<(f64, usize)> {
        let mixed = self.steps.iter().filter(|step| step.share > 0.0 && step.share < 1.0);
        let told = mixed.filter(|step| step.sample.is_some() == measured);
        let errors: Vec<f64> = told.filter_map(|step| step.errors[row as usize]).collect();
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        (!errors.is_empty()).then_some((mean, errors.len()))
    }
}

/// The first paint of `pair` to the second in steps of a tenth. Where a swatch
/// of the two was measured, its share takes the place of the nearest step (a
/// step is added if none is within 4.5 %).
///
/// Linear RGB is not cut off at the gamut of sRGB, so its ends are the masstones
/// whatever their colour.
#[must_use]
pub fn graded(
    palette: &Palette<'_>,
    pair: (usize, usize),
    measured: &[MeasuredSample],
    rules: &PainterRules,
) -> GradedMixture {
    let ends = [pair.0, pair.1].map(|paint| palette.look(&[(paint, 1.0)]).xyz.to_array());
    let step = |(share, sample): (f64, Option<&MeasuredSample>)| {
        let recipe = [(pair.0, 1.0 - share), (pair.1, share)];
        let mixture = palette.mixture(&recipe);
        // Linear RGB and XYZ are linear in each other.
        let straight: [f64; 3] =
            std::array::from_fn(|i| (1.0 - share) * ends[0][i] + share * ends[1][i]);
        let white = palette.weights().white();
        let colors = [
            sample.map(|sample| palette.appearance(&sample.reflectance)),
            Some(palette.look(&recipe)),
            Some(at_nodes(palette, &rules.eight, &mixture)),
            Some(at_nodes(palette, &rules.three, &mixture)),
            Some(Appearance::of(Xyz::from(straight), white)),
        ];
        let own = |row: MixingRow| colors[row as usize].map(|color: Appearance| color.lab);
        let (truth, row) = own(MixingRow::Measured).map_or_else(
            || (own(MixingRow::Spectrum), MixingRow::Spectrum),
            |lab| (Some(lab), MixingRow::Measured),
        );
        let error = |other: MixingRow| {
            let lab: Lab = own(other).filter(|_| other != row)?;
            Some(delta_e_ciede2000(truth?, lab))
        };
        GradedStep {
            share,
            sample: sample.map(|sample| sample.sample.clone()),
            errors: MixingRow::ALL.map(error),
            colors,
        }
    };
    GradedMixture { pair, steps: shares(pair, measured).into_iter().map(step).collect() }
}

/// The pairs that tell most: the two with the most measured steps, then the
/// paint of the highest b* with that of the lowest (each as masstone or tint),
/// mixtures of which no straight line can follow.
#[must_use]
pub fn default_pairs(palette: &Palette<'_>, measured: &[MeasuredSample]) -> Vec<(usize, usize)> {
    let counted =
        |(a, b)| (steps_of((a, b), measured).filter(|(s, _)| *s > 0.0 && *s < 1.0).count(), (a, b));
    let mut pairs: Vec<(usize, (usize, usize))> =
        palette.pairs().map(counted).filter(|(count, _)| *count > 0).collect();
    // A stable sort: of equals, the library's order.
    pairs.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    // The white, where it is one of the two, stands at the end.
    let ordered = |(a, b)| if palette.white() == Some(a) { (b, a) } else { (a, b) };
    let mut chosen: Vec<(usize, usize)> = pairs.iter().take(2).map(|(_, p)| ordered(*p)).collect();
    let tinted = |paint: usize, parts: f64| palette.look(&palette.tint(paint, parts)).lab.b;
    let extreme = |sign: f64| {
        let reach = |&p: &usize| (p, [0.0, 3.0, 9.0].map(|n| sign * tinted(p, n)));
        let most = palette.paints().iter().map(reach);
        most.map(|(p, b)| (p, b.into_iter().fold(f64::NEG_INFINITY, f64::max)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
            .map(|(p, _)| p)
    };
    if let (Some(yellow), Some(blue)) = (extreme(1.0), extreme(-1.0))
        && yellow != blue
        && !chosen.contains(&(yellow, blue))
        && !chosen.contains(&(blue, yellow))
    {
        chosen.push((yellow, blue));
    }
    chosen
}

/// The colour of a mixture from its K and S at a few wavelengths.
fn at_nodes(palette: &Palette<'_>, rule: &Quadrature, mixture: &Mixture) -> Appearance {
    let grid = palette.library().grid;
    let few = Mixture {
        absorption: rule.at_nodes(grid, &mixture.absorption),
        scattering: rule.at_nodes(grid, &mixture.scattering),
    };
    let card = match palette.library().amounts {
        AmountKind::Relative => Vec::new(),
        AmountKind::Absolute => rule.at_nodes(grid, &palette.cards().white),
    };
    Appearance::of(rule.xyz(&palette.seen(&few, &card)), rule.white)
}

/// Measured samples of the two paints and nothing else, with the share of the
/// second.
fn steps_of(
    pair: (usize, usize),
    measured: &[MeasuredSample],
) -> impl Iterator<Item = (f64, &MeasuredSample)> {
    measured.iter().filter_map(move |sample| {
        let share = |paint: usize| {
            // A sum of nothing would be -0.
            sample.recipe.iter().filter(|(p, _)| *p == paint).fold(0.0, |sum, (_, s)| sum + s)
        };
        let (first, second) = (share(pair.0), share(pair.1));
        (first + second > 1.0 - 1e-9).then_some((second, sample))
    })
}

/// Tenths and measured shares, rising. Of samples of one share, the first.
fn shares(
    pair: (usize, usize),
    measured: &[MeasuredSample],
) -> Vec<(f64, Option<&MeasuredSample>)> {
    let mut steps: Vec<(f64, Option<&MeasuredSample>)> =
        (0..=10).map(|tenth| (f64::from(tenth) / 10.0, None)).collect();
    for (share, sample) in steps_of(pair, measured) {
        let free = |(place, kept): &(f64, Option<&MeasuredSample>)| {
            // The ends are masstones; a mixture never takes their place.
            let end = *place == 0.0 || *place == 1.0;
            kept.is_none() && if end { share == *place } else { (place - share).abs() <= NEAR }
        };
        let known = steps.iter().any(|(place, kept)| kept.is_some() && *place == share);
        let near = steps.iter().enumerate().filter(|(_, step)| free(step));
        let nearest = near.min_by(|a, b| (a.1.0 - share).abs().total_cmp(&(b.1.0 - share).abs()));
        match nearest.map(|(at, _)| at) {
            _ if known => {}
            Some(at) => steps[at] = (share, Some(sample)),
            None => steps.push((share, Some(sample))),
        }
    }
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    steps
}
