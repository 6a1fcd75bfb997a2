//! Charts of a palette as you make them by hand: hiding power, tinting strength, mixing charts, tints,
//! drawdowns, and mixtures of two paints in steps.
//!
//! We compute the steps in five ways, after Baxter, Wendt and Lin 2004, figure 10: measured swatches,
//! Kubelka-Munk mixing over the whole spectrum, at eight and at three wavelengths, and mixing of linear
//! RGB.

use spectra::color::{Lab, Xyz, delta_e_ciede2000};

use super::paints::{Cards, MeasuredSample, Palette, crossing};
use crate::color::Appearance;
use crate::evaluate::Viewing;
use crate::library::{AmountKind, PigmentLibrary};
use crate::quadrature::{Quadrature, QuadratureFailure};
use crate::recipe::{Curves, PigmentId, Recipe};

/// We say that a film hides from this contrast ratio Yb / Yw on (ISO 6504-3).
pub const HIDING_CONTRAST: f64 = 0.98;

/// A film also hides if the luminance factors Y over both cards differ by at most this. For a black film
/// the ratio is meaningless, and a difference of 0.02 (Y = 100 for white) is 0.2 of L*, which you cannot
/// see.
const UNSEEN: f64 = 0.02;

/// K d + S d of the strongest paint at the greatest thickness that we try. We chose it by eye.
const THICKEST: f64 = 1e5;
/// We try this many thicknesses per decade.
const STEPS: usize = 8;
/// We try this many decades.
const DECADES: usize = 9;

/// A film of white oil paint hides from this thickness in mm on. With a brush you lay 0.05 mm at least.
const WHITE_HIDES_MM: f64 = 0.05;

/// Whether a film can hide its ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hides {
    /// It hides from this thickness on, in the library's unit (for absolute amounts, an amount).
    From(f64),
    /// It does not hide at any thickness that we try.
    Never {
        /// Contrast ratio Yb / Yw of the thickest film.
        contrast: f64,
    },
}

/// Hiding power of one paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HidingPower {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Least thickness that hides.
    pub hides: Hides,
}

impl Hides {
    /// Thickness from which on the film hides, if there is one.
    #[must_use]
    pub fn thickness(self) -> Option<f64> {
        match self {
            Self::From(thickness) => Some(thickness),
            Self::Never { .. } => None,
        }
    }
}

/// Computes the hiding power of every paint, under the palette's light and observer. This is the least
/// thickness from which on the luminance of the film over the black card is at least 0.98 of its luminance
/// over the white card, Yb / Yw (ISO 6504-3:2019).
///
/// A film so dark that Y over the two cards differs by at most 0.02 (Y = 100 for white) hides as well. We
/// try thicknesses from the thickest down, eight per decade, and then bisect the crossing, because the
/// ratio may fall with thickness in a film that is clear at some wavelengths.
#[must_use]
pub fn hiding_powers(palette: &Palette<'_>) -> Vec<HidingPower> {
    palette
        .paints()
        .iter()
        .map(|&paint| HidingPower { paint, hides: hides(palette, paint) })
        .collect()
}

/// S of the library's reference white per mm of height, chosen so that its film hides from 0.05 mm on
/// under D65 (see [`hiding_powers`]). It is rounded to a whole number. `None` if no pigment is the
/// reference white, or it does not hide at any thickness.
#[must_use]
pub fn scattering_per_mm(library: &PigmentLibrary) -> Option<f64> {
    let white = library.reference_id().filter(|&white| library[white].identified)?;
    let viewing = Viewing::default();
    let palette = Palette::new(library, &viewing, Cards::standard(library.grid)).ok()?;
    let per_mm = (hides(&palette, white).thickness()? / WHITE_HIDES_MM).round();
    (per_mm >= 1.0).then_some(per_mm)
}

fn hides(palette: &Palette<'_>, paint: PigmentId) -> Hides {
    let library = palette.library();
    let mixture = library.mix([(paint, 1.0)]).expect("one part is a mixture");
    let film = library.film();

    let over_cards = |thickness: f64| {
        let cards = palette.cards();
        [&cards.black, &cards.white]
            .map(|card| palette.weights().xyz(&mixture.film(thickness, card, film)).y)
    };

    let strongest = palette.strongest();
    if strongest <= 0.0 {
        return Hides::Never { contrast: contrast(over_cards(0.0)) };
    }
    let thickest = THICKEST / strongest;
    let step = |index: usize| thickest * 10f64.powf(-(index as f64) / STEPS as f64);
    let hiding = |thickness: f64| {
        let [black, white] = over_cards(thickness);
        black >= HIDING_CONTRAST * white || white - black <= UNSEEN
    };
    match (0..=STEPS * DECADES).find(|&index| !hiding(step(index))) {
        Some(0) => Hides::Never { contrast: contrast(over_cards(thickest)) },
        Some(index) => Hides::From(crossing(step(index), step(index - 1), hiding)),
        // The film hides at every thickness: the two cards themselves are alike.
        None => Hides::From(0.0),
    }
}

/// Y over the black card divided by Y over the white one.
fn contrast([black, white]: [f64; 2]) -> f64 {
    if white > 0.0 { black / white } else { 1.0 }
}

/// We compare tints with this many parts of white to one of paint. That is 10 % of paint, which most sets
/// of swatches contain.
pub const TINT_PARTS: f64 = 9.0;

/// We choose [`TintingStrength::white_parts`] so that K/S of the tint is this where it absorbs most. It is
/// an internal reflectance of 0.27.
pub const TINT_DEPTH: f64 = 1.0;

/// Tinting strength of one paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TintingStrength {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Wavelength in nm at which K/S of the tint exceeds K/S of the white most. For absolute amounts, the
    /// wavelength of the greatest K.
    pub wavelength_nm: f64,
    /// Increase of K/S over the white at this wavelength. For absolute amounts, K per unit of amount. 0 if
    /// K/S rises at no wavelength.
    pub strength: f64,
    /// `strength` in percent of the strength of the standard paint.
    pub percent: f64,
    /// Parts of white to one of paint that you mix to get a tint of K/S = 1 at that wavelength. `None` for
    /// a paint that is lighter than that by itself, or for absolute amounts.
    pub white_parts: Option<f64>,
}

/// Computes the tinting strength of every paint but the white, relative to `standard` (by default
/// the strongest paint).
///
/// ISO 787-24 compares tints by K/S where the tint of one part in nine parts of the reference white absorbs
/// most. We subtract the white's own K/S, so that a paint of twice the absorption has twice the strength.
/// In a library of absolute amounts you have no white paint, and we take K of one unit of amount as the
/// strength.
#[must_use]
pub fn tinting_strengths(
    palette: &Palette<'_>,
    standard: Option<PigmentId>,
) -> Vec<TintingStrength> {
    let paints = palette.paints().iter().filter(|&&p| Some(p) != palette.white());
    let mut strengths: Vec<TintingStrength> = paints.map(|&p| strength(palette, p)).collect();
    let named = standard.and_then(|wanted| strengths.iter().find(|s| s.paint == wanted));
    let strongest = strengths.iter().map(|s| s.strength).fold(0.0, f64::max);
    let whole = named.map_or(strongest, |s| s.strength);
    for strength in &mut strengths {
        strength.percent = if whole > 0.0 { 100.0 * strength.strength / whole } else { 0.0 };
    }
    strengths
}

fn strength(palette: &Palette<'_>, paint: PigmentId) -> TintingStrength {
    let library = palette.library();
    let pigment = &library[paint];
    let added: Vec<f64> = match (library.amounts, palette.white()) {
        (AmountKind::Relative, Some(white)) => {
            let tint = palette.mixture(&palette.tint(paint, TINT_PARTS));
            let white = palette.mixture(&Recipe::single(white));
            (0..library.grid.count())
                .map(|i| {
                    ratio(tint.absorption[i], tint.scattering[i])
                        - ratio(white.absorption[i], white.scattering[i])
                })
                .collect()
        }
        _ => pigment.absorption.clone(),
    };
    let most = added.iter().enumerate();
    let (at, most) =
        most.fold((0, f64::NEG_INFINITY), |m, (i, &v)| if v > m.1 { (i, v) } else { m });
    let white_parts = palette.white().and_then(|white| {
        let white = &library[white];
        // (K + n Kw) / (S + n Sw) = depth, solved for n.
        let own = pigment.absorption[at] - TINT_DEPTH * pigment.scattering[at];
        let per_part = TINT_DEPTH * white.scattering[at] - white.absorption[at];
        (own >= 0.0 && per_part > 0.0).then(|| own / per_part)
    });
    TintingStrength {
        paint,
        wavelength_nm: library.grid.nm(at),
        strength: most.max(0.0),
        percent: 0.0,
        white_parts,
    }
}

fn ratio(k: f64, s: f64) -> f64 {
    if s > 0.0 { k / s } else { 0.0 }
}

/// A ladder of tints has these parts of white (or of water) to one of paint.
pub const TINTS: [f64; 5] = [0.0, 1.0, 3.0, 9.0, 27.0];

/// The tinted half of a chart has this many parts of white (or of water) to one of the mixture. There you
/// see the hue of dark mixtures.
pub const CHART_TINT: f64 = 3.0;

/// Colours of every paint mixed with every other, one part to one.
#[derive(Debug, Clone, PartialEq)]
pub struct MixingChart {
    /// The paints, in the library's order.
    pub paints: Vec<PigmentId>,
    /// Colours by row and column of `paints`. Symmetric, with the masstones on the diagonal.
    pub colors: Vec<Vec<Appearance>>,
    /// Colours of the same mixtures with [`CHART_TINT`] parts of white to one.
    pub tinted: Vec<Vec<Appearance>>,
}

/// Computes the mixing chart of a palette.
#[must_use]
pub fn mixing_chart(palette: &Palette<'_>) -> MixingChart {
    MixingChart {
        paints: palette.paints().to_vec(),
        colors: every_pair(palette, 0.0),
        tinted: every_pair(palette, CHART_TINT),
    }
}

fn every_pair(palette: &Palette<'_>, whites: f64) -> Vec<Vec<Appearance>> {
    let paints = palette.paints();
    let mut colors: Vec<Vec<Appearance>> = Vec::with_capacity(paints.len());
    for (row, &first) in paints.iter().enumerate() {
        let mut line: Vec<Appearance> = colors.iter().map(|above| above[row]).collect();
        line.push(palette.color(&palette.tint(first, whites)));
        line.extend(paints[row + 1..].iter().map(|&second| {
            palette.color(&palette.thinned(&Recipe::from([(first, 0.5), (second, 0.5)]), whites))
        }));
        colors.push(line);
    }
    colors
}

/// Tints of one paint from the masstone to the palest.
#[derive(Debug, Clone, PartialEq)]
pub struct TintLadder {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Colours by step of [`TINTS`].
    pub colors: Vec<Appearance>,
}

/// Computes the tints of every paint but the white.
#[must_use]
pub fn tint_ladders(palette: &Palette<'_>) -> Vec<TintLadder> {
    let paints = palette.paints().iter().filter(|&&p| Some(p) != palette.white());
    paints
        .map(|&paint| TintLadder {
            paint,
            colors: TINTS.iter().map(|&parts| palette.color(&palette.tint(paint, parts))).collect(),
        })
        .collect()
}

/// A film of one thickness over both cards.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawdownStep {
    /// Thickness in the library's unit. For absolute amounts, in washes of the paint.
    pub thickness: f64,
    /// Colour over the black card.
    pub over_black: Appearance,
    /// Colour over the white card.
    pub over_white: Appearance,
}

/// A paint drawn down in several thicknesses over a black-and-white card.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawdown {
    /// Pigment of the library.
    pub paint: PigmentId,
    /// Films from thin to thick, that is from undertone to masstone.
    pub steps: Vec<DrawdownStep>,
    /// Colour of the film that hides.
    pub masstone: Appearance,
}

/// Computes drawdowns of every paint at each of `thicknesses`. Give them from 0 up in the library's unit,
/// for absolute amounts in washes of the paint.
#[must_use]
pub fn drawdowns(palette: &Palette<'_>, thicknesses: &[f64]) -> Vec<Drawdown> {
    let film = palette.library().film();
    let cards = palette.cards();
    palette
        .paints()
        .iter()
        .map(|&paint| {
            let mixture = palette.mixture(&Recipe::single(paint));

            Drawdown {
                paint,
                steps: thicknesses
                    .iter()
                    .map(|&thickness| DrawdownStep {
                        thickness,
                        over_black: palette.appearance(&mixture.film(
                            thickness,
                            &cards.black,
                            film,
                        )),
                        over_white: palette.appearance(&mixture.film(
                            thickness,
                            &cards.white,
                            film,
                        )),
                    })
                    .collect(),
                masstone: palette.appearance(&mixture.hiding(film.surface)),
            }
        })
        .collect()
}

/// A measured share replaces a regular step within this distance. It is just below half a step.
const NEAR: f64 = 0.045;

/// Two sets of wavelengths that you could paint with in place of the spectrum. We fit both to the library
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
        let (eight, three) = rayon::join(
            || Quadrature::library(palette.viewing(), palette.library(), 8),
            || Quadrature::library(palette.viewing(), palette.library(), 3),
        );
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
    /// Share of the second paint, 0 to 1. If you measured a sample, this is its share.
    pub share: f64,
    /// Name of the measured sample with this share.
    pub sample: Option<String>,
    /// Colours in the order of [`MixingRow::ALL`]. `None` where nothing was measured.
    pub colors: [Option<Appearance>; 5],
    /// CIEDE2000 of each row against the measured colour. If you measured none, it is against the full
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
    /// Mean error of a row over the mixed steps, with their number. Pass `measured` for the measured steps,
    /// or false for the others. `None` without such steps.
    #[must_use]
    pub fn mean_error(&self, row: MixingRow, measured: bool) -> Option<(f64, usize)> {
        let mixed = self.steps.iter().filter(|step| step.share > 0.0 && step.share < 1.0);
        let chosen = mixed.filter(|step| step.sample.is_some() == measured);
        let errors: Vec<f64> = chosen.filter_map(|step| step.errors[row as usize]).collect();
        let mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        (!errors.is_empty()).then_some((mean, errors.len()))
    }
}

/// Grades from the first paint of `pair` to the second in steps of one tenth. If you measured a swatch of
/// the two, its share replaces the nearest step. We add a step if none lies within 4.5 %.
///
/// We do not clip linear RGB to the gamut of sRGB, so its ends are the masstones' own colours.
#[must_use]
pub fn graded(
    palette: &Palette<'_>,
    pair: (PigmentId, PigmentId),
    measured: &[MeasuredSample],
    rules: &PainterRules,
) -> GradedMixture {
    let ends = [pair.0, pair.1].map(|paint| palette.color(&Recipe::single(paint)).xyz.to_array());
    GradedMixture {
        pair,
        steps: shares(pair, measured)
            .into_iter()
            .map(|(share, sample)| {
                let recipe = Recipe::from([(pair.0, 1.0 - share), (pair.1, share)]);
                let mixture = palette.mixture(&recipe);
                // Linear RGB is a linear map of XYZ, so we can interpolate XYZ instead.
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
                let labs = colors.map(|color| color.map(|color| color.lab));
                let (truth, row) = labs[MixingRow::Measured as usize].map_or_else(
                    || (labs[MixingRow::Spectrum as usize], MixingRow::Spectrum),
                    |lab| (Some(lab), MixingRow::Measured),
                );
                GradedStep {
                    share,
                    sample: sample.map(|sample| sample.sample.clone()),
                    errors: MixingRow::ALL.map(|other| {
                        let lab: Lab = labs[other as usize].filter(|_| other != row)?;
                        Some(delta_e_ciede2000(truth?, lab))
                    }),
                    colors,
                }
            })
            .collect(),
    }
}

/// Chooses up to three pairs of paints: the two pairs with the most measured steps, and the paints of the
/// highest and the lowest b* (each as masstone or tint). This last pair shows how poorly linear
/// interpolation predicts mixtures.
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
    let mut chosen: Vec<(PigmentId, PigmentId)> =
        pairs.iter().take(2).map(|(_, p)| white_second(palette, *p)).collect();

    let [yellow, blue] = [1.0, -1.0].map(|sign: f64| {
        let most = palette.paints().iter().map(|&p| {
            (p, [0.0, 3.0, 9.0].map(|n| sign * palette.color(&palette.tint(p, n)).lab.b))
        });
        most.map(|(p, b)| (p, b.into_iter().fold(f64::NEG_INFINITY, f64::max)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
            .map(|(p, _)| p)
    });
    if let (Some(yellow), Some(blue)) = (yellow, blue)
        && yellow != blue
        && !chosen.contains(&(yellow, blue))
        && !chosen.contains(&(blue, yellow))
    {
        chosen.push((yellow, blue));
    }
    chosen
}

/// The pair in an order in which the white, if it is one of the two, comes second.
fn white_second(palette: &Palette<'_>, (a, b): (PigmentId, PigmentId)) -> (PigmentId, PigmentId) {
    if palette.white() == Some(a) { (b, a) } else { (a, b) }
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

/// Tenths and measured shares in rising order. Of several samples with the same share, we use the first.
fn shares(
    pair: (PigmentId, PigmentId),
    measured: &[MeasuredSample],
) -> Vec<(f64, Option<&MeasuredSample>)> {
    let mut steps: Vec<(f64, Option<&MeasuredSample>)> =
        (0..=10).map(|tenth| (f64::from(tenth) / 10.0, None)).collect();
    for (share, sample) in steps_of(pair, measured) {
        let known = steps.iter().any(|(place, kept)| kept.is_some() && *place == share);
        let near = steps.iter().enumerate().filter(|(_, (place, kept))| {
            // The ends are masstones. A mixture must not replace them.
            let end = *place == 0.0 || *place == 1.0;
            kept.is_none() && if end { share == *place } else { (place - share).abs() <= NEAR }
        });
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
