//! Tones of one hue: mixtures in even steps of L*, from dark to light.

use std::sync::Arc;

use documents::Task;
use documents::hint::Explain;
use paint::layer::{SLOTS, Slots};
use pigment::library::AmountKind;
use pigment::matching::{RecipeSearch, TargetColor, USUAL_TOLERANCE};
use pigment::palette::{Cards, Palette, PaletteError};
use pigment::{ColorTarget, MatchError, MatchRequest, PigmentId, PigmentLibrary, Recipe, Viewing};
use spectra::color::{ColorCode, ColorCodeError, Lab};

/// You can ask for this many tones.
pub const TONES: std::ops::RangeInclusive<usize> = 2..=12;

/// The mixture of the hue has at most this many pigments.
const HUE_PIGMENTS: usize = 3;
/// This many dark paints, besides the darkest one, may take part.
const DARKS: usize = 2;
/// A paint is dark if the L* of its masstone is at most this. We chose it by eye.
const DARK: f64 = 45.0;
/// Least share of a pigment in a mixture. Strong pigments tint at far less than a fiftieth.
const LEAST_SHARE: f64 = 0.002;
/// Greatest CIELAB hue difference at which a mixture still has the hue. We chose it by eye.
const HUE_TOLERANCE: f64 = 3.0;
/// Least chroma at which a mixture still has the hue, relative to an even shade or tint. We chose
/// it by eye.
const LEAST_CHROMA: f64 = 0.35;
/// A mixture may deviate from the L* that it should have by this.
const LIGHTNESS_TOLERANCE: f64 = 0.5;
/// We lower the chroma of a colour up to this many times, until paints reach it.
const FADINGS: usize = 12;
const BISECTIONS: usize = 7;
const SHARE_BISECTIONS: usize = 30;

/// A mixture of the ladder.
#[derive(Debug, Clone, PartialEq)]
pub struct Tone {
    /// Colour of the opaque mixture under D65 for the 1931 observer.
    pub lab: Lab,
    /// Shares of the pigments by slot, sum 1.
    pub shares: [f64; SLOTS],
}

/// Mixtures of one hue from the darkest to the lightest. They share one table of pigments.
#[derive(Debug, Clone)]
pub struct ToneLadder {
    library: Arc<PigmentLibrary>,
    slots: Slots,
    /// The darkest mixture, the tones in even steps, the lightest mixture.
    rungs: Vec<Tone>,
    viewing: Viewing,
}

impl ToneLadder {
    /// Finds `count` tones of `hue` (`#rrggbb` or `L,a,b`) in even steps of L*.
    ///
    /// The range goes from the darkest to the lightest mixture that keep the hue. The tones lie
    /// within it, `margin` L* from both ends, so that strokes may be darker or lighter than their
    /// tone. We search recipes for all mixtures among these masstones of the library: the pigments
    /// of the mixture nearest to the hue, the white, the darkest paint, and dark paints of a like
    /// hue. Chroma falls in proportion towards black and white, as in shades and tints, and
    /// further where the paints reach less.
    ///
    /// # Errors
    /// [`TonesError`] for a hue that is not a colour, a count out of range, a library that cannot
    /// be mixed or has no white, and a hue with mixtures that span less than the margins.
    pub fn new(
        library: Arc<PigmentLibrary>,
        hue: &str,
        count: usize,
        margin: f64,
    ) -> Result<Self, TonesError> {
        if !TONES.contains(&count) {
            return Err(TonesError::Count(count));
        }
        let code: ColorCode = hue.parse()?;
        if library.amounts != AmountKind::Relative {
            return Err(TonesError::Absolute(library.title.clone()));
        }
        let viewing = Viewing::default();
        let palette = Palette::new(&library, &viewing, Cards::standard(library.grid))?;
        let table = pigments(&palette, code.lab())?;
        let names = table.iter().map(|&pigment| library[pigment].name.clone());
        let options = MatchRequest {
            only: names.collect(),
            least_share: Some(LEAST_SHARE),
            count: 1,
            tolerance: Some(USUAL_TOLERANCE),
            ..MatchRequest::default()
        };
        let traces = MatchRequest { least_share: Some(0.0), ..options.clone() };
        let searches = [library.recipe_search(&options)?, library.recipe_search(&traces)?];
        let base = matched(&searches[0], code.lab())?.0;
        let darkest = farthest(&searches[0], base, 0.0)?;
        let lightest = farthest(&searches[0], base, 100.0)?;
        let span = lightest - darkest - 2.0 * margin;
        if span <= count as f64 {
            return Err(TonesError::Narrow { hue: hue.to_owned(), darkest, lightest, margin });
        }
        let wanted = std::iter::once(darkest)
            .chain(
                (0..count)
                    .map(|at: usize| darkest + margin + span * at as f64 / (count - 1) as f64),
            )
            .chain([lightest]);
        let mut slots = Slots::default();
        for (slot, &pigment) in slots.iter_mut().zip(&table) {
            *slot = Some(pigment);
        }
        let rungs = wanted.map(|lightness| {
            let (lab, recipe) = mixture_at(&searches, base, lightness)?;
            let total = recipe.total();
            let shares = slots.map(|slot| slot.map_or(0.0, |id| recipe.parts_of(id) / total));
            Ok(Tone { lab, shares })
        });
        let rungs = rungs.collect::<Result<_, TonesError>>()?;
        drop(palette);
        Ok(Self { library: Arc::clone(&library), slots, rungs, viewing })
    }

    /// Pigments of all mixtures by slot.
    #[must_use]
    pub fn slots(&self) -> &Slots {
        &self.slots
    }

    /// Library of the pigments.
    #[must_use]
    pub fn library(&self) -> &Arc<PigmentLibrary> {
        &self.library
    }

    /// The tones from dark to light.
    #[must_use]
    pub fn tones(&self) -> &[Tone] {
        &self.rungs[1..self.rungs.len() - 1]
    }

    /// L* of the darkest and of the lightest mixture.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [&self.rungs[0], &self.rungs[self.rungs.len() - 1]].map(|rung| rung.lab.lightness)
    }

    /// Shares by slot of a mixture with this L*. We blend it from the two nearest mixtures of the
    /// ladder. If you ask for an L* beyond the range, you get the mixture at its end.
    #[must_use]
    pub fn shares_at(&self, lightness: f64) -> [f64; SLOTS] {
        let above = self.rungs.partition_point(|rung| rung.lab.lightness < lightness);
        if above == 0 || above == self.rungs.len() {
            return self.rungs[above.min(self.rungs.len() - 1)].shares;
        }
        let [dark, light] = [&self.rungs[above - 1], &self.rungs[above]];
        fn blended(share: f64, dark: &Tone, light: &Tone) -> [f64; SLOTS] {
            std::array::from_fn(|slot| {
                dark.shares[slot] + share * (light.shares[slot] - dark.shares[slot])
            })
        }
        let mut low = 0.0;
        let mut high = 1.0;
        for _ in 0..SHARE_BISECTIONS {
            let middle = (low + high) / 2.0;
            let under = self
                .lab_of(&blended(middle, dark, light))
                .is_some_and(|lab| lab.lightness < lightness);
            if under { low = middle } else { high = middle }
        }
        blended((low + high) / 2.0, dark, light)
    }

    /// Two mixtures `spread` L* below and above a mean. If you blend them in equal parts, they
    /// have this L*. Near the ends of the range they lie closer together.
    ///
    /// Dark paint outweighs light paint in a blend. If strokes are as often darker as lighter than
    /// their tone, they would darken it where they run into each other. Blends of these two
    /// mixtures do not.
    #[must_use]
    pub fn shares_about(&self, lightness: f64, spread: f64) -> [[f64; SLOTS]; 2] {
        let pair = |middle: f64| [middle - spread, middle + spread].map(|l| self.shares_at(l));
        let mut low = lightness - spread;
        let mut high = lightness + spread;
        for _ in 0..SHARE_BISECTIONS {
            let middle = (low + high) / 2.0;
            let [dark, light] = pair(middle);
            let mean = std::array::from_fn(|slot| (dark[slot] + light[slot]) / 2.0);
            let under = self.lab_of(&mean).is_some_and(|lab| lab.lightness < lightness);
            if under { low = middle } else { high = middle }
        }
        pair((low + high) / 2.0)
    }

    fn lab_of(&self, shares: &[f64; SLOTS]) -> Option<Lab> {
        let parts = self.slots.iter().zip(shares);
        let parts: Recipe = parts.filter_map(|(slot, &share)| Some(((*slot)?, share))).collect();
        let film = self.library.mix(&parts).ok()?.hiding(self.library.saunderson);
        let weights = self.viewing.weights(self.library.grid).ok()?;
        Some(Lab::from_xyz(weights.xyz(&film), weights.white()))
    }
}

/// Pigments for mixtures of a hue. There is at most one for each slot of a layer.
fn pigments(palette: &Palette<'_>, hue: Lab) -> Result<Vec<PigmentId>, TonesError> {
    let library = palette.library();
    let options = MatchRequest {
        at_most: HUE_PIGMENTS,
        least_share: Some(LEAST_SHARE),
        count: 1,
        tolerance: Some(USUAL_TOLERANCE),
        ..MatchRequest::default()
    };
    let (_, recipe) = matched(&library.recipe_search(&options)?, hue)?;
    let white = palette.white().ok_or_else(|| TonesError::Absolute(library.title.clone()))?;
    let mut chosen: Vec<PigmentId> = recipe.pigments().chain([white, palette.black()]).collect();
    let mut darks: Vec<(f64, PigmentId)> = palette
        .paints()
        .iter()
        .map(|&paint| (palette.color(&Recipe::single(paint)).lab, paint))
        .filter(|(lab, _)| lab.lightness < DARK)
        .map(|(lab, paint)| (turn(lab, hue), paint))
        .collect();
    darks.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    chosen.extend(darks.iter().take(DARKS).map(|(_, paint)| paint));
    chosen.sort_unstable();
    chosen.dedup();
    Ok(chosen)
}

fn turn(one: Lab, other: Lab) -> f64 {
    let turned = (one.to_lch().hue_degrees - other.to_lch().hue_degrees).abs();
    turned.min(360.0 - turned)
}

/// CIELAB of `base` in another lightness. Chroma falls in proportion towards black and white.
fn shaded(base: Lab, lightness: f64) -> Lab {
    let share = if lightness < base.lightness {
        lightness / base.lightness
    } else {
        (100.0 - lightness) / (100.0 - base.lightness)
    };
    Lab { lightness, a: share * base.a, b: share * base.b }
}

/// The mixture of a hue with this L*, and the colour that it has. We use the first search. If the
/// least share of a strong pigment leaves a gap in L*, we use the second one, which takes traces.
fn mixture_at(
    [usual, traces]: &[RecipeSearch<'_>; 2],
    base: Lab,
    lightness: f64,
) -> Result<(Lab, Recipe), TonesError> {
    let found = faded_mixture(usual, base, lightness)?;
    if (found.0.lightness - lightness).abs() <= LIGHTNESS_TOLERANCE {
        return Ok(found);
    }
    let traced = faded_mixture(traces, base, lightness)?;
    let [off, traced_off] = [&found, &traced].map(|(lab, _)| (lab.lightness - lightness).abs());
    Ok(if traced_off < off { traced } else { found })
}

/// The mixture of a hue near this L*, and the colour that it has. We search for the chroma of an
/// even shade or tint. If paints do not reach it, we lower it.
fn faded_mixture(
    search: &RecipeSearch<'_>,
    base: Lab,
    lightness: f64,
) -> Result<(Lab, Recipe), TonesError> {
    let mut wanted = shaded(base, lightness);
    let mut found = matched(search, wanted)?;
    for _ in 0..FADINGS {
        let [reached, asked] = [found.0, wanted].map(|lab| lab.to_lch().chroma);
        let near = (found.0.lightness - lightness).abs() <= LIGHTNESS_TOLERANCE / 4.0;
        if near || reached >= asked || asked == 0.0 {
            break;
        }
        let share = reached / asked;
        wanted = Lab { lightness, a: share * wanted.a, b: share * wanted.b };
        found = matched(search, wanted)?;
    }
    Ok(found)
}

fn matched(search: &RecipeSearch<'_>, lab: Lab) -> Result<(Lab, Recipe), TonesError> {
    let target = ColorTarget { name: String::new(), color: TargetColor::Lab(lab) };
    let mut found = search.recipes_for(&target, &Task::default())?;
    let best = found.recipes.swap_remove(0);
    Ok((best.lab[0], best.shares))
}

/// Searches from `base` towards `end` for the farthest L* at which a mixture keeps the hue.
fn farthest(search: &RecipeSearch<'_>, base: Lab, end: f64) -> Result<f64, TonesError> {
    let mut kept = base.lightness;
    let mut lost = end;
    for _ in 0..BISECTIONS {
        let lightness = (kept + lost) / 2.0;
        let (found, _) = faded_mixture(search, base, lightness)?;
        fn chroma(lab: Lab) -> f64 {
            lab.to_lch().chroma
        }
        let keeps = hue_difference(found, base) <= HUE_TOLERANCE
            && chroma(found) >= LEAST_CHROMA * chroma(shaded(base, lightness))
            && (found.lightness - lightness).abs() <= LIGHTNESS_TOLERANCE;
        if keeps { kept = lightness } else { lost = lightness }
    }
    Ok(kept)
}

/// Hue difference between a mixture and the hue, as if the hue had the mixture's chroma.
fn hue_difference(found: Lab, base: Lab) -> f64 {
    2.0 * found.to_lch().chroma * (turn(found, base).to_radians() / 2.0).sin()
}

/// Tones of a hue cannot be mixed.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum TonesError {
    /// The hue is not a colour.
    #[error(transparent)]
    #[fault(Setting)]
    Hue(#[from] ColorCodeError),
    /// The number of tones is out of range.
    #[error("a set has {} to {} tones, found `{found}`", TONES.start(), TONES.end(), found = .0)]
    #[hint("leave [tones] out for 7 tones")]
    Count(usize),
    /// The library holds washes, not paints that hide.
    #[error("library {0} has absolute amounts: its paints have no white to be mixed with")]
    #[hint("choose a library of relative amounts with [pigments]")]
    #[fault(Input)]
    Absolute(String),
    /// The library has no pigment that can be mixed.
    #[error(transparent)]
    Palette(#[from] PaletteError),
    /// The search for recipes failed.
    #[error(transparent)]
    Match(#[from] MatchError),
    /// The mixtures that keep the hue are too much alike.
    #[error(
        "mixtures of the hue {hue} reach from L* {darkest:.1} to {lightest:.1}, too little for tones that keep `{margin}` from both ends"
    )]
    #[hint("choose another [hue], fewer [tones] or other [pigments]")]
    Narrow {
        /// The hue as it was given.
        hue: String,
        /// L* of the darkest mixture.
        darkest: f64,
        /// L* of the lightest mixture.
        lightest: f64,
        /// L* between the range and the tones at both ends.
        margin: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ladder(hue: &str, count: usize) -> ToneLadder {
        ToneLadder::new(Arc::new(PigmentLibrary::van_gogh_oils()), hue, count, 6.0).unwrap()
    }

    #[test]
    fn tones_rise_in_even_steps_and_keep_the_hue() {
        for (hue, count) in [("#c9a227", 7), ("#3f6fa8", 5), ("#a04030", 6)] {
            let ladder = ladder(hue, count);
            let tones = ladder.tones();
            assert_eq!(tones.len(), count);
            let steps = tones.windows(2).map(|w| w[1].lab.lightness - w[0].lab.lightness);
            let steps: Vec<f64> = steps.collect();
            let mean = steps.iter().sum::<f64>() / steps.len() as f64;
            assert!(mean > 4.0, "{hue}: steps of {mean}");
            assert!(steps.iter().all(|step| (step - mean).abs() < 1.0), "{hue}: {steps:?}");
            let base = hue.parse::<ColorCode>().unwrap().lab();
            for tone in tones {
                assert!(hue_difference(tone.lab, base) < 2.0 * HUE_TOLERANCE, "{hue}: {tone:?}");
                let even = shaded(base, tone.lab.lightness).to_lch().chroma;
                assert!(tone.lab.to_lch().chroma > 0.3 * even, "{hue}: {tone:?} is too grey");
                assert!((tone.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
                let again = ladder.lab_of(&tone.shares).unwrap();
                assert!((again.lightness - tone.lab.lightness).abs() < 1e-6, "{hue}");
            }
        }
    }

    #[test]
    fn mixtures_between_tones_have_the_lightness_asked_for() {
        let ladder = ladder("#c9a227", 5);
        let [darkest, lightest] = ladder.range();
        for step in 0..=20 {
            let wanted = darkest + (lightest - darkest) * f64::from(step) / 20.0;
            let found = ladder.lab_of(&ladder.shares_at(wanted)).unwrap().lightness;
            assert!((found - wanted).abs() < 0.1, "{wanted}: {found}");
        }
        for tone in ladder.tones() {
            let [dark, light] = ladder.shares_about(tone.lab.lightness, 5.0);
            let mean = std::array::from_fn(|slot| (dark[slot] + light[slot]) / 2.0);
            let [dark, mean, light] = [dark, mean, light].map(|shares| ladder.lab_of(&shares));
            let off = mean.unwrap().lightness - tone.lab.lightness;
            assert!(off.abs() < 0.1, "{tone:?}: {off}");
            let span = light.unwrap().lightness - dark.unwrap().lightness;
            // Near the ends of the range there is less room.
            assert!((8.5..10.2).contains(&span), "{tone:?}: {span}");
        }
        assert_eq!(ladder.shares_at(0.0), ladder.rungs[0].shares);
        assert_eq!(ladder.shares_at(100.0), ladder.rungs[6].shares);
    }

    #[test]
    fn impossible_tones_are_refused_with_a_way_out() {
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        let refused = |hue: &str, count, margin| {
            ToneLadder::new(Arc::clone(&library), hue, count, margin).unwrap_err()
        };
        assert!(matches!(refused("ochre", 7, 5.0), TonesError::Hue(_)));
        assert!(matches!(refused("#c9a227", 1, 5.0), TonesError::Count(1)));
        let narrow = refused("#c9a227", 7, 40.0);
        assert!(matches!(narrow, TonesError::Narrow { .. }), "{narrow}");
        assert!(narrow.hint().unwrap().to_string().contains("`hue`"));
        let mut washes = PigmentLibrary::van_gogh_oils();
        washes.amounts = AmountKind::Absolute;
        let error = ToneLadder::new(Arc::new(washes), "#c9a227", 7, 5.0).unwrap_err();
        assert!(matches!(error, TonesError::Absolute(..)));
    }
}
