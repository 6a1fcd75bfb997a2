//! The search for recipes by name. You pass options and get recipes. If the target is far from all of them,
//! we also search in another way. You can write the recipes as JSON for programs.

use documents::{Task, hint::Hint};
use serde_json::{Map, Value, json};
use spectra::Grid;
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace};

use super::limits::{FilmKind, MatchError, RecipeLimits, USUAL_TOLERANCE};
use super::ranking::{AmountLimit, RecipeMatch, recipes, recipes_and_nearest};
use super::request::{MatchRequest, ToleranceOrigin};
use super::target::{ColorTarget, Metric, SpectralTarget, Target, TargetColor, ViewingCondition};
use crate::color::IlluminantChange;
use crate::evaluate::{Remark, WANTED_NM, check_visible_band};
use crate::library::{AmountKind, PigmentLibrary};
use crate::recipe::PigmentId;

/// We count a target as reached up to this distance, in CIEDE2000 or percent of reflectance. You clearly
/// see larger differences side by side. We chose it by eye.
const REACHED: f64 = 1.0;

/// A recipe with pigments of unknown S must be nearer by this, in CIEDE2000 or percent of reflectance.
/// You see such a difference side by side. We chose it by eye.
const VISIBLE: f64 = 0.5;

/// Least share of the recipes that we search if the usual one keeps a target from being reached: about a
/// drop of a strong colour in a pot.
const SMALLEST_SHARE: f64 = 0.001;
/// Number of recipes with smaller shares among which we take the plainest.
const PLAIN_ONES: usize = 50;

/// If the nearest recipe is further than this in CIEDE2000, we also search recipes by CIE 1976. CIEDE2000
/// was made for differences up to about 5 units (CIE 142:2001).
const FAR: f64 = 5.0;

/// A search for recipes of one library. You prepare it once for any number of targets.
#[derive(Debug, Clone)]
pub struct RecipeSearch<'a> {
    pub(super) library: &'a PigmentLibrary,
    /// Pigments of unknown S, for targets that the allowed ones do not reach.
    unknown: Vec<PigmentId>,
    /// Limits of the recipes.
    pub limits: RecipeLimits,
    /// Origin of the tolerance.
    pub tolerance_origin: ToleranceOrigin,
    /// Choices that we made in preparing the search, and warnings.
    pub remarks: Vec<Remark>,
}

/// Recipes found for one target, at least one.
#[derive(Debug, Clone, PartialEq)]
pub struct RecipeMatches {
    /// Colours that the recipes should have.
    pub target: Target,
    /// Recipes in the order of [`recipes`](super::recipes).
    pub recipes: Vec<RecipeMatch>,
    /// Nearest recipe by CIE 1976, if all recipes differ from the target by more than 5 CIEDE2000.
    /// Otherwise, and for a search by spectrum, it is empty.
    pub by_cie1976: Vec<RecipeMatch>,
    /// Plainest recipe with shares below the least one that reaches the target, or else the nearest such
    /// recipe, if all recipes miss the target by more than the tolerance. Otherwise, and for a search in
    /// whole parts, it is empty.
    pub below_least: Vec<RecipeMatch>,
    /// Choices that we made in the search, and warnings.
    pub remarks: Vec<Remark>,
    nearest: f64,
    beyond_measured: Option<f64>,
}

impl RecipeMatches {
    /// Least distance of any recipe that we found, in the unit of the metric. You may not find this recipe
    /// in the list if another one is as near within the tolerance.
    #[must_use]
    pub fn nearest(&self) -> f64 {
        self.nearest
    }

    /// Least distance of any recipe, in the unit of the metric, if you allow amounts outside the range that
    /// was measured of each pigment. `None` if this brings no recipe visibly nearer.
    #[must_use]
    pub fn beyond_measured(&self) -> Option<f64> {
        self.beyond_measured
    }

    /// Advice for a target if you see that all recipes differ from it. `None` if one is nearer than 1
    /// CIEDE2000, or 1 % of reflectance.
    #[must_use]
    pub fn hint(&self) -> Option<Hint> {
        let advice = match self.is_reached_below_least() {
            true => "allow smaller shares: [least=0.001]",
            false => "allow more pigments with [at_most], or add paints to the library",
        };
        (!self.is_reached()).then(|| Hint::new(advice))
    }

    /// Whether you cannot see the difference between a recipe and the target: it is at most 1 CIEDE2000, or
    /// 1 % of reflectance.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        self.nearest() <= REACHED
    }

    /// Whether only the least share keeps the target from being reached: a recipe of
    /// [`Self::below_least`] reaches it.
    #[must_use]
    pub fn is_reached_below_least(&self) -> bool {
        !self.is_reached() && self.below_least.iter().any(|recipe| recipe.distance <= REACHED)
    }
}

impl PigmentLibrary {
    /// Prepares a search for recipes with `options`.
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, or options exclude each other.
    pub fn recipe_search(&self, options: &MatchRequest) -> Result<RecipeSearch<'_>, MatchError> {
        let (limits, remarks) = options.limits(self)?;
        let tolerance_origin = options.tolerance_for(self).1;
        let unknown = options.unknown(self, &limits)?;
        Ok(RecipeSearch { library: self, unknown, limits, tolerance_origin, remarks })
    }
}

impl MatchRequest {
    /// Searches recipes of a library for a colour or a measured spectrum. `task` counts the sets of pigments
    /// that we tried in the first of the searches that a target may take. If you have several targets, prepare
    /// the search once with [`PigmentLibrary::recipe_search`].
    ///
    /// ```
    /// use documents::Task;
    /// use pigment::{MatchRequest, PigmentLibrary};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let request = MatchRequest::default();
    /// let found = request.run(&oils, &"#4a7d8c".parse()?, &Task::default())?;
    /// let best = &found.recipes[0];
    /// for &(pigment, share) in &best.shares {
    ///     println!("{:5.1} % {}", 100.0 * share, oils[pigment].name);
    /// }
    /// // The first is the plainest that is as near as this library can tell.
    /// assert!(found.nearest() < 0.1 && best.delta_e[0] < 1.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, options exclude each other, no recipe fits them, or `task` was
    /// cancelled.
    pub fn run(
        &self,
        library: &PigmentLibrary,
        target: &ColorTarget,
        task: &Task,
    ) -> Result<RecipeMatches, MatchError> {
        library.recipe_search(self)?.recipes_for(target, task)
    }
}

impl RecipeSearch<'_> {
    /// Searches recipes for one target. `task` counts the sets of pigments that we tried in the first of
    /// the searches that a target may take.
    ///
    /// If no recipe reaches the target, we also try the pigments with an unknown S. If a recipe with them is
    /// nearer by 0.5, it is the last one of the list, and a warning says that it is a guess.
    ///
    /// # Errors
    /// [`MatchError`] if no recipe fits the options, a spectrum has no visible wavelength, or `task` was
    /// cancelled.
    pub fn recipes_for(
        &self,
        target: &ColorTarget,
        task: &Task,
    ) -> Result<RecipeMatches, MatchError> {
        let mut remarks = self.remarks.clone();
        if let TargetColor::Reflectance(reflectance) = &target.color {
            remarks.extend(check_visible_band(reflectance.grid())?);
        }
        let RecipeLimits { metric, conditions, .. } = &self.limits;
        let spectrum = spectrum_of(target, self.library.grid, (*metric, conditions), &mut remarks)?;
        let target = Target { spectrum, ..target.under(&self.limits.conditions)? };
        let (found, nearest) = recipes_and_nearest(self.library, &target, &self.limits, task)?;
        let further = task.quiet();
        if found.is_empty() {
            return Err(MatchError::NoRecipe);
        }
        let mut matches = RecipeMatches {
            beyond_measured: self.nearest_beyond_measured(&target, nearest, &further)?,
            target,
            recipes: found,
            by_cie1976: Vec::new(),
            below_least: Vec::new(),
            remarks,
            nearest,
        };
        matches.below_least = self.below_least(&matches, &further)?;
        if matches.nearest() > FAR && self.limits.metric == Metric::Ciede2000 {
            let metric = Metric::Cie1976;
            let limits = RecipeLimits { metric, count: 1, ..self.limits.clone() };
            matches.by_cie1976 = recipes(self.library, &matches.target, &limits, &further)?;
        }
        self.add_guess(&mut matches, &further)?;
        Ok(matches)
    }

    /// Adds the nearest recipe with pigments of unknown S, if no other recipe reaches the target and this one
    /// is visibly nearer.
    fn add_guess(&self, matches: &mut RecipeMatches, task: &Task) -> Result<(), MatchError> {
        if matches.is_reached() || self.unknown.is_empty() {
            return Ok(());
        }
        let allowed = [&self.limits.allowed[..], &self.unknown].concat();
        let limits = RecipeLimits { allowed, count: 1, tolerance: 0.0, ..self.limits.clone() };
        let found = recipes(self.library, &matches.target, &limits, task)?;
        let known = matches.below_least.iter().map(|recipe| recipe.distance);
        let nearest = known.fold(matches.nearest(), f64::min);
        let guess = found.into_iter().find(|found| {
            found.distance < nearest - VISIBLE
                && found.shares.iter().any(|(id, _)| self.unknown.contains(id))
        });
        let Some(guess) = guess else { return Ok(()) };
        let names: Vec<&str> = guess
            .shares
            .iter()
            .filter(|(id, _)| self.unknown.contains(id))
            .map(|(id, _)| self.library[*id].name.as_str())
            .collect();
        let text = format!(
            "the last recipe is a guess: S is not known of {}, only assumed from the masstone",
            names.join(", ")
        );
        let hint = "measure a tint with white and fit again";
        matches.remarks.push(Remark::warning(text).with_hint(hint));
        matches.recipes.push(guess);
        Ok(())
    }

    /// The plainest recipe with smaller shares than the least one that reaches the target, or else the nearest
    /// one. Empty if it is not nearer than all of `matches`.
    fn below_least(
        &self,
        matches: &RecipeMatches,
        task: &Task,
    ) -> Result<Vec<RecipeMatch>, MatchError> {
        let wanted = self.limits.tolerance.clamp(USUAL_TOLERANCE, REACHED);
        if matches.nearest() <= wanted
            || self.limits.whole_parts.is_some()
            || self.limits.least_share <= SMALLEST_SHARE
        {
            return Ok(Vec::new());
        }
        let limits = RecipeLimits {
            least_share: SMALLEST_SHARE,
            tolerance: REACHED,
            count: PLAIN_ONES,
            ..self.limits.clone()
        };
        let (found, nearest) = recipes_and_nearest(self.library, &matches.target, &limits, task)?;
        let near_enough = wanted.max(nearest + USUAL_TOLERANCE);
        let nearer = matches.nearest() - USUAL_TOLERANCE;
        let is_wanted =
            |recipe: &RecipeMatch| recipe.distance <= near_enough && recipe.distance < nearer;
        if let Some(plainest) = found.into_iter().find(is_wanted) {
            return Ok(vec![plainest]);
        }
        if nearest >= nearer {
            return Ok(Vec::new());
        }
        // Many plainer recipes are within the tolerance of the nearest one, but not near enough.
        let tolerance = near_enough - nearest;
        let limits = RecipeLimits { tolerance, count: 1, ..limits };
        let (found, _) = recipes_and_nearest(self.library, &matches.target, &limits, task)?;
        Ok(found.into_iter().filter(is_wanted).collect())
    }

    /// Distance of the nearest recipe of any amounts, if limits of amounts keep it from being found.
    fn nearest_beyond_measured(
        &self,
        target: &Target,
        nearest: f64,
        task: &Task,
    ) -> Result<Option<f64>, MatchError> {
        if self.limits.amounts.iter().all(Option::is_none) {
            return Ok(None);
        }
        let limits = RecipeLimits { amounts: Vec::new(), count: 1, ..self.limits.clone() };
        let (_, free) = recipes_and_nearest(self.library, target, &limits, task)?;
        Ok((free < nearest - USUAL_TOLERANCE).then_some(free))
    }
}

/// The spectrum of a measured target on the grid of a library. If there is none, you cannot search by
/// spectrum.
pub(super) fn spectrum_of(
    target: &ColorTarget,
    grid: Grid,
    (metric, conditions): (Metric, &[ViewingCondition]),
    remarks: &mut Vec<Remark>,
) -> Result<Option<SpectralTarget>, MatchError> {
    let asked = metric.spectrum_weights();
    let TargetColor::Reflectance(measured) = &target.color else {
        return if asked.is_some() {
            Err(MatchError::NoSpectrum(target.name.clone()))
        } else {
            Ok(None)
        };
    };
    let own = measured.grid();
    let spectrum = SpectralTarget::new(measured, grid, asked.unwrap_or_default(), conditions)?;
    if asked.is_none() {
        return Ok(spectrum);
    }
    let spectrum = spectrum.ok_or_else(|| MatchError::NoSharedBand {
        name: target.name.clone(),
        target_nm: [own.start_nm(), own.end_nm()],
        library_nm: [grid.start_nm(), grid.end_nm()],
    })?;
    let [first, last] = spectrum.band_nm();
    if first > WANTED_NM[0] || last < WANTED_NM[1] {
        remarks.push(Remark::warning(format!(
            "{}: matched from {first} to {last} nm only, the band that target and library share",
            target.name.clone()
        )));
    }
    Ok(Some(spectrum))
}

impl RecipeSearch<'_> {
    /// The result for one target as JSON. It holds the target's name, Lab by light, `hex` and `in_gamut`,
    /// then `reached`, `reached_below_least`, `nearest`, `beyond_measured`, measure and tolerance, then `recipes`,
    /// `by_cie1976` and `below_least`, each as [`Self::recipe_json`]. If you pass `grams`, the mass of the mixture, recipes
    /// contain amounts.
    #[must_use]
    pub fn to_json(&self, matched: &RecipeMatches, grams: Option<f64>) -> Value {
        let lists = [&matched.recipes, &matched.by_cie1976, &matched.below_least];
        let [recipes, by_cie1976, below_least] = lists.map(|recipes| {
            let recipes = recipes.iter().map(|recipe| self.recipe_json(recipe, grams));
            recipes.collect::<Vec<Value>>()
        });
        let target = &matched.target;
        json!({
            "target": target.name,
            "lab": self.by_light(target.lab.iter().map(|lab| json!(lab.to_array()))),
            "hex": displayed(target.lab[0]).to_hex(),
            "in_gamut": displayed(target.lab[0]).in_gamut(),
            "reached": matched.is_reached(),
            "reached_below_least": matched.is_reached_below_least(),
            "nearest": matched.nearest(),
            "beyond_measured": matched.beyond_measured(),
            "by": self.limits.metric.name(),
            "unit": self.limits.metric.unit(),
            "band_nm": target.spectrum.as_ref().map(SpectralTarget::band_nm),
            "tolerance": self.limits.tolerance,
            "tolerance_origin": self.tolerance_origin.name(),
            "recipes": recipes,
            "by_cie1976": by_cie1976,
            "below_least": below_least,
        })
    }

    /// One recipe: pigments with their shares, distance, errors and colours by light, reflectance. You also
    /// find parts, amounts, `rms_percent`, metamerism, thickness, and the cost of `grams` or of a unit of
    /// mass, if they are known.
    #[must_use]
    pub fn recipe_json(&self, recipe: &RecipeMatch, grams: Option<f64>) -> Value {
        let amount_key = if self.is_absolute() { "amount" } else { "grams" };
        let pigments = recipe.shares.iter().enumerate().map(|(place, (id, share))| {
            let mut entry = json!({ "name": self.library[*id].name, "share": share });
            if let Some(parts) = &recipe.parts {
                entry["parts"] = json!(parts[place]);
            }
            if let Some(amount) = self.amount(recipe, *share, grams) {
                entry[amount_key] = json!(amount);
            }
            if self.library[*id].guessed {
                entry["guessed"] = json!(true);
            }
            if let Some((_, limit)) = recipe.at_limit.iter().find(|(limited, _)| limited == id) {
                entry["at_limit"] = match limit {
                    AmountLimit::Least => json!("least measured"),
                    AmountLimit::Greatest => json!("greatest measured"),
                };
            }
            entry
        });
        let wavelengths: Vec<f64> = self.library.grid.wavelengths_nm().collect();
        let color = displayed(recipe.lab[0]);
        let mut entry = json!({
            "pigments": pigments.collect::<Vec<Value>>(),
            "distance": recipe.distance,
            "delta_e": self.by_light(recipe.delta_e.iter().map(|d| json!(d))),
            "lab": self.by_light(recipe.lab.iter().map(|lab| json!(lab.to_array()))),
            "hex": color.to_hex(),
            "in_gamut": color.in_gamut(),
            "wavelengths_nm": wavelengths,
            "reflectance": recipe.reflectance,
        });
        if let Some(rms) = recipe.rms_percent {
            entry["rms_percent"] = json!(rms);
        }
        if !recipe.metamerism.is_empty() {
            entry["metamerism"] = self.metamerism(recipe);
        }
        if self.limits.film != FilmKind::Hiding {
            entry["thickness"] = json!(recipe.thickness);
        }
        if let Some(cost) = recipe.cost {
            entry["cost"] = json!(cost * grams.unwrap_or(1.0));
        }
        entry
    }

    /// Amount of a pigment with the given share: grams of a mixture of `grams`, or absolute amounts in the
    /// library's unit. `None` where neither is known.
    #[must_use]
    pub fn amount(&self, recipe: &RecipeMatch, share: f64, grams: Option<f64>) -> Option<f64> {
        match (grams, recipe.thickness) {
            (_, Some(thickness)) if self.is_absolute() => Some(share * thickness),
            (grams, _) => grams.map(|grams| share * grams),
        }
    }

    /// Names of the lights, in the order of the limits.
    pub fn lights(&self) -> impl Iterator<Item = &str> {
        self.limits.conditions.iter().map(|condition| condition.viewing.illuminant.name())
    }

    fn is_absolute(&self) -> bool {
        self.library.amounts == AmountKind::Absolute
    }

    /// Metamerism indices of a recipe as JSON, each with its name, lights and unit.
    fn metamerism(&self, recipe: &RecipeMatch) -> Value {
        let mut lights = self.lights();
        let reference = lights.next().unwrap_or_default();
        let each = lights.zip(&recipe.metamerism).map(|(test, index)| {
            let change = IlluminantChange { reference, test };
            change.to_json(*index)
        });
        Value::from(each.collect::<Vec<Value>>())
    }

    /// JSON object with one value per light, keyed by its name.
    fn by_light(&self, values: impl Iterator<Item = Value>) -> Value {
        Value::Object(self.lights().map(str::to_owned).zip(values).collect::<Map<_, _>>())
    }
}

/// Encoded sRGB of `lab`, seen adapted to its light.
fn displayed(lab: Lab) -> Rgb {
    // Lab is relative to its white, so we can take any white for the round trip.
    let white = RgbSpace::Srgb.white();
    RgbSpace::Srgb.encoded_from_xyz(lab.to_xyz(white), white, Adaptation::Bradford)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn search(target: &str, request: MatchRequest) -> RecipeMatches {
        let oils = PigmentLibrary::van_gogh_oils();
        request.run(&oils, &target.parse().unwrap(), &Task::default()).unwrap()
    }

    #[test]
    fn a_target_out_of_reach_gets_the_nearest_recipe_there_is() {
        for (target, names, known) in [
            ("85,0,110", &["Lead White", "Chrome Yellow", "Chrome Yellow (Otero)"][..], 6.04),
            ("30,60,-30", &["Cochineal Lake", "Viridian"][..], 13.61),
        ] {
            let only = names.iter().map(|name| (*name).to_owned()).collect();
            let tolerance = Some(0.05);
            let found = search(target, MatchRequest { only, tolerance, ..MatchRequest::default() });
            assert!(found.nearest() < known, "{target}: {}", found.nearest());
            assert!(found.recipes[0].distance < known + 0.05, "{target}");
        }
    }

    #[test]
    fn the_nearest_is_reported_though_the_list_stops_within_the_tolerance() {
        let [fine, coarse] = [0.0, 2.0].map(|tolerance| {
            let tolerance = Some(tolerance);
            search("45,10,20", MatchRequest { tolerance, count: 1, ..MatchRequest::default() })
        });
        assert!((fine.nearest() - coarse.nearest()).abs() < 1e-9);
        assert!(coarse.recipes[0].distance > coarse.nearest(), "{:?}", coarse.recipes[0]);
        assert!(coarse.recipes[0].distance <= coarse.nearest() + 2.0);
    }

    #[test]
    fn the_tolerance_follows_the_error_of_the_library() {
        let mut oils = PigmentLibrary::van_gogh_oils();
        let plain = MatchRequest::default();
        let error = oils.mean_error().unwrap();
        assert!(error > 1.0, "{error}");
        assert_eq!(tolerance_of(&oils, &plain), (error, ToleranceOrigin::Library));
        let given = MatchRequest { tolerance: Some(0.2), ..plain.clone() };
        assert_eq!(tolerance_of(&oils, &given), (0.2, ToleranceOrigin::Given));
        oils.evidence = None;
        assert_eq!(tolerance_of(&oils, &plain), (USUAL_TOLERANCE, ToleranceOrigin::Usual));
    }

    fn tolerance_of(library: &PigmentLibrary, options: &MatchRequest) -> (f64, ToleranceOrigin) {
        let search = library.recipe_search(options).unwrap();
        (search.limits.tolerance, search.tolerance_origin)
    }

    #[test]
    fn the_plain_recipe_comes_before_one_of_four_that_the_library_cannot_tell_apart() {
        let target = "61.2,0.3,-44.5";
        let fine = search(target, MatchRequest { tolerance: Some(0.0), ..MatchRequest::default() });
        let usual = search(target, MatchRequest::default());
        assert!(
            pigment_count(&fine) > 2 && pigment_count(&usual) == 2,
            "{} and {}",
            pigment_count(&fine),
            pigment_count(&usual)
        );
        assert!((usual.nearest() - fine.nearest()).abs() < 1e-9);
    }

    #[test]
    fn a_pale_tint_is_out_of_reach_of_the_least_share_and_not_of_the_pigments() {
        let only = ["Zinc White", "Bone Black"].map(str::to_owned).to_vec();
        let request = MatchRequest { only, tolerance: Some(0.5), ..MatchRequest::default() };
        let tint = search("88,-1,-2", request.clone());
        assert!(tint.nearest() > 5.0 && tint.is_reached_below_least(), "{}", tint.nearest());
        let [below] = &tint.below_least[..] else { panic!("{tint:?}") };
        assert!(below.distance < 1.0, "{below:?}");
        assert!(below.shares.iter().any(|(_, share)| *share < 0.02), "{below:?}");
        assert!(tint.hint().unwrap().to_string().contains("`least = 0.001`"), "{:?}", tint.hint());
        // Whoever allows small shares, or divides into parts, needs no such recipe.
        for request in [
            MatchRequest { least_share: Some(0.001), ..request.clone() },
            MatchRequest { whole_parts: Some(20), ..request },
        ] {
            assert!(search("88,-1,-2", request).below_least.is_empty());
        }
        assert!(search("45,10,20", MatchRequest::default()).below_least.is_empty());
        let magenta = search("#ff00ff", MatchRequest::default());
        assert!(!magenta.is_reached_below_least() && !magenta.is_reached(), "{magenta:?}");
    }

    #[test]
    fn the_balance_decides_the_least_share_of_a_mass() {
        let oils = PigmentLibrary::van_gogh_oils();
        let least =
            |request: &MatchRequest| oils.recipe_search(request).unwrap().limits.least_share;
        let plain = MatchRequest::default();
        let of_pot = MatchRequest { grams: Some(250.0), ..plain.clone() };
        let coarse = MatchRequest { balance: 1.0, ..of_pot.clone() };
        let given = MatchRequest { least_share: Some(0.1), ..of_pot.clone() };
        let found = [&plain, &of_pot, &coarse, &given].map(least);
        assert_eq!(found, [0.02, 0.01 / 250.0, 1.0 / 250.0, 0.1]);
        for balance in [0.0, f64::NAN] {
            let error =
                oils.recipe_search(&MatchRequest { balance, ..of_pot.clone() }).unwrap_err();
            assert!(error.to_string().starts_with("the step of a balance is above 0"), "{error}");
        }
        let too_little = MatchRequest { grams: Some(0.005), ..plain };
        assert!(oils.recipe_search(&too_little).is_ok(), "a drop is weighed as one pigment");
    }

    fn pigment_count(found: &RecipeMatches) -> usize {
        found.recipes[0].shares.len()
    }
}
