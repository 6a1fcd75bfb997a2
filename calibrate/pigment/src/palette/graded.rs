//! Mixtures of two paints in steps from the first paint to the second, computed in five ways.
//!
//! After Baxter, Wendt and Lin 2004, figure 10: measured swatches, Kubelka-Munk mixing over the whole
//! spectrum, at eight and at three wavelengths, and mixing of linear RGB.

use spectra::color::{Lab, Xyz, delta_e_ciede2000};

use super::paints::Palette;
use super::samples::MeasuredSample;
use crate::appearance::Appearance;
use crate::curves::Curves;
use crate::library::AmountKind;
use crate::quadrature::{Quadrature, QuadratureFailure};
use crate::recipe::{PigmentId, Recipe};

/// A measured share replaces a regular step within this distance, which is just below half a step.
const NEAR: f64 = 0.045;

/// Two sets of wavelengths that painting could use in place of the spectrum. Both are fitted to the library
/// (method `library`), so that they differ only in number.
#[derive(Debug, Clone, PartialEq)]
pub struct PainterRules {
    /// Rule of eight wavelengths.
    pub eight: Quadrature,
    /// Rule of three wavelengths.
    pub three: Quadrature,
}

impl PainterRules {
    /// Fits both rules to the library of `palette`, for its light and observer.
    ///
    /// # Errors
    /// None in practice: both numbers of wavelengths are valid.
    pub fn of(palette: &Palette<'_>) -> Result<Self, QuadratureFailure> {
        let rule = |count| Quadrature::library(palette.viewing(), palette.library(), count);
        let (eight, three) = rayon::join(|| rule(8), || rule(3));
        Ok(Self { eight: eight?, three: three? })
    }
}

/// The way in which a row of swatches is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum MixingRow {
    /// Measured swatches, at the ratios that were painted.
    Measured,
    /// Kubelka-Munk mixing at every wavelength of the library.
    Spectrum,
    /// Kubelka-Munk mixing at eight wavelengths.
    EightNodes,
    /// Kubelka-Munk mixing at three wavelengths.
    ThreeNodes,
    /// Linear interpolation in linear RGB between the two masstones.
    LinearRgb,
}

impl MixingRow {
    /// All rows, in the order of a figure.
    pub const ALL: [Self; 5] =
        [Self::Measured, Self::Spectrum, Self::EightNodes, Self::ThreeNodes, Self::LinearRgb];

    /// Name of the row in figures and tables.
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

/// One mixing ratio, computed in every way.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedStep {
    /// Share of the second paint, 0 to 1; the measured share where there is a measured sample.
    pub share: f64,
    /// Name of the measured sample with this share.
    pub sample: Option<String>,
    /// Colours in the order of [`MixingRow::ALL`]; `None` where nothing was measured.
    pub colors: [Option<Appearance>; 5],
    /// CIEDE2000 of each row against the measured colour or, where there is none, against the full
    /// spectrum.
    pub errors: [Option<f64>; 5],
}

/// Two paints, graded from the first to the second.
#[derive(Debug, Clone, PartialEq)]
pub struct GradedMixture {
    /// The first and the second paint.
    pub pair: (PigmentId, PigmentId),
    /// Steps in rising order of the second paint's share.
    pub steps: Vec<GradedStep>,
}

impl GradedMixture {
    /// Mean error of a row over the mixed steps, with their number: over the measured steps if
    /// `measured`, else over those that were not measured. `None` if there is no such step.
    #[must_use]
    pub fn mean_error(&self, row: MixingRow, measured: bool) -> Option<(f64, usize)> {
        let mixed = self.steps.iter().filter(|step| step.share > 0.0 && step.share < 1.0);
        let chosen = mixed.filter(|step| step.sample.is_some() == measured);
        let errors: Vec<f64> = chosen.filter_map(|step| step.errors[row as usize]).collect();
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        (!errors.is_empty()).then_some((mean, errors.len()))
    }
}

/// Grades from the first paint of `pair` to the second in steps of one tenth. Where a swatch of the
/// two was measured, its share replaces the nearest step (a step is added if none lies within 4.5 %).
///
/// Linear RGB is not clipped to the gamut of sRGB, so its ends are the masstones' own colours.
#[must_use]
pub fn graded(
    palette: &Palette<'_>,
    pair: (PigmentId, PigmentId),
    measured: &[MeasuredSample],
    rules: &PainterRules,
) -> GradedMixture {
    let ends = [pair.0, pair.1].map(|paint| palette.color(&Recipe::single(paint)).xyz.to_array());
    let step = |(share, sample): (f64, Option<&MeasuredSample>)| {
        let recipe = Recipe::from([(pair.0, 1.0 - share), (pair.1, share)]);
        let mixture = palette.mixture(&recipe);
        // Linear RGB is a linear map of XYZ, so XYZ can be interpolated instead.
        let straight: [f64; 3] =
            std::array::from_fn(|i| (1.0 - share) * ends[0][i] + share * ends[1][i]);
        let white = palette.weights().white();
        let colors = [
            sample.map(|sample| palette.appearance(&sample.reflectance)),
            Some(palette.color(&recipe)),
            Some(at_nodes(palette, &rules.eight, &mixture)),
            Some(at_nodes(palette, &rules.three, &mixture)),
            Some(Appearance::of(Xyz::from(straight), white)),
        ];
        let own = |row: MixingRow| colors[row as usize].map(|color: Appearance| color.lab);
        let (truth, row) = own(MixingRow::Measured).map_or_else(
            || (own(MixingRow::Spectrum), MixingRow::Spectrum),
            |lab| (Some(lab), MixingRow::Measured),
        );
        GradedStep {
            share,
            sample: sample.map(|sample| sample.sample.clone()),
            errors: MixingRow::ALL.map(|other: MixingRow| {
                let lab: Lab = own(other).filter(|_| other != row)?;
                Some(delta_e_ciede2000(truth?, lab))
            }),
            colors,
        }
    };
    GradedMixture { pair, steps: shares(pair, measured).into_iter().map(step).collect() }
}

/// Chooses up to three pairs of paints: the two pairs with the most measured steps, and the paint of the
/// highest b* with that of the lowest (each as masstone or tint), whose mixtures linear interpolation
/// predicts poorly.
#[must_use]
pub fn default_pairs(
    palette: &Palette<'_>,
    measured: &[MeasuredSample],
) -> Vec<(PigmentId, PigmentId)> {
    let mut pairs: Vec<(usize, (PigmentId, PigmentId))> = palette
        .pairs()
        .map(|(a, b)| {
            (steps_of((a, b), measured).filter(|(s, _)| *s > 0.0 && *s < 1.0).count(), (a, b))
        })
        .filter(|(count, _)| *count > 0)
        .collect();
    // The sort is stable: pairs with equal counts stay in the library's order.
    pairs.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    // If one of the two paints is the white, it comes second.
    let ordered = |(a, b)| if palette.white() == Some(a) { (b, a) } else { (a, b) };
    let mut chosen: Vec<(PigmentId, PigmentId)> =
        pairs.iter().take(2).map(|(_, p)| ordered(*p)).collect();
    let tinted = |paint: PigmentId, parts: f64| palette.color(&palette.tint(paint, parts)).lab.b;
    let extreme = |sign: f64| {
        let most = palette
            .paints()
            .iter()
            .map(|&p: &PigmentId| (p, [0.0, 3.0, 9.0].map(|n| sign * tinted(p, n))));
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

/// Colour of a mixture from its K and S at a few wavelengths.
fn at_nodes(palette: &Palette<'_>, rule: &Quadrature, mixture: &Curves) -> Appearance {
    let grid = palette.library().grid;
    let absorption = rule.at_nodes(grid, &mixture.absorption);
    let scattering = rule.at_nodes(grid, &mixture.scattering);
    let card = match palette.library().amounts {
        AmountKind::Relative => Vec::new(),
        AmountKind::Absolute => rule.at_nodes(grid, &palette.cards().white),
    };
    Appearance::of(
        rule.xyz(&palette.film_reflectance((&absorption, &scattering), &card)),
        rule.white,
    )
}

/// Measured samples of exactly these two paints, each with the share of the second.
fn steps_of(
    pair: (PigmentId, PigmentId),
    measured: &[MeasuredSample],
) -> impl Iterator<Item = (f64, &MeasuredSample)> {
    measured.iter().filter_map(move |sample| {
        let first = sample.recipe.parts_of(pair.0);
        let second = sample.recipe.parts_of(pair.1);
        (first + second > 1.0 - 1e-9).then_some((second, sample))
    })
}

/// Tenths and measured shares in rising order. Of several samples with the same share, the first is kept.
fn shares(
    pair: (PigmentId, PigmentId),
    measured: &[MeasuredSample],
) -> Vec<(f64, Option<&MeasuredSample>)> {
    let mut steps: Vec<(f64, Option<&MeasuredSample>)> =
        (0..=10).map(|tenth| (f64::from(tenth) / 10.0, None)).collect();
    for (share, sample) in steps_of(pair, measured) {
        let free = |(place, kept): &(f64, Option<&MeasuredSample>)| {
            // The ends are masstones; a mixture must not replace them.
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
