//! The search for recipes by name: options in, recipes out, with a fallback for distant targets.

use spectra::hint::Hint;

use super::error::MatchError;
use super::options::MatchOptions;
use super::ranking::{RecipeMatch, recipes};
use super::request::MatchRequest;
use super::target::{ColorTarget, Target, TargetColor};
use super::viewing_condition::Metric;
use crate::library::PigmentLibrary;
use crate::remark::Remark;
use crate::visible_band::check_visible_band;

/// CIEDE2000 of the nearest recipe above which recipes are also searched by CIE 1976: CIEDE2000 was made for
/// differences up to about 5 units (CIE 142:2001).
const FAR: f64 = 5.0;

/// A search for recipes of one library, prepared for any number of targets.
#[derive(Debug, Clone)]
pub struct RecipeSearch<'a> {
    library: &'a PigmentLibrary,
    /// Limits of the recipes.
    pub request: MatchRequest,
    /// Choices made in preparing the search, and warnings.
    pub remarks: Vec<Remark>,
}

/// Recipes found for one target; at least one.
#[derive(Debug, Clone, PartialEq)]
pub struct RecipeMatches {
    /// Colours that the recipes should have.
    pub target: Target,
    /// Recipes in the order of [`recipes`].
    pub recipes: Vec<RecipeMatch>,
    /// Nearest recipe by CIE 1976, for a target from which all recipes differ by more than 5 CIEDE2000;
    /// empty otherwise.
    pub by_cie1976: Vec<RecipeMatch>,
    /// Choices made in the search, and warnings.
    pub remarks: Vec<Remark>,
}

impl RecipeMatches {
    /// Least distance of any recipe, in CIEDE2000.
    #[must_use]
    pub fn nearest(&self) -> f64 {
        self.recipes.iter().map(|recipe| recipe.distance).fold(f64::INFINITY, f64::min)
    }

    /// Advice for a target from which all recipes differ visibly; `None` if one is nearer than 1
    /// CIEDE2000.
    #[must_use]
    pub fn hint(&self) -> Option<Hint> {
        let advice = "allow more pigments with [at_most], or add paints to the library";
        (self.nearest() > 1.0).then(|| Hint::new(advice))
    }
}

impl PigmentLibrary {
    /// Prepares a search for recipes with `options`.
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, or options exclude each other.
    pub fn recipe_search(&self, options: &MatchOptions) -> Result<RecipeSearch<'_>, MatchError> {
        let (request, remarks) = options.request(self)?;
        Ok(RecipeSearch { library: self, request, remarks })
    }

    /// Searches recipes for a colour or a measured spectrum.
    ///
    /// ```
    /// use pigment::{MatchOptions, PigmentLibrary};
    ///
    /// let oils = PigmentLibrary::van_gogh_oils();
    /// let found = oils.recipes_for(&"#4a7d8c".parse()?, &MatchOptions::default())?;
    /// let best = &found.recipes[0];
    /// for &(pigment, share) in &best.shares {
    ///     println!("{:5.1} % {}", 100.0 * share, oils[pigment].name);
    /// }
    /// assert!(best.delta_e[0] < 0.1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`MatchError`] if a name is unknown, options exclude each other, or no recipe fits them.
    pub fn recipes_for(
        &self,
        target: &ColorTarget,
        options: &MatchOptions,
    ) -> Result<RecipeMatches, MatchError> {
        self.recipe_search(options)?.recipes_for(target)
    }
}

impl RecipeSearch<'_> {
    /// Searches recipes for one target.
    ///
    /// # Errors
    /// [`MatchError`] if no recipe fits the options, or a spectrum has no visible wavelength.
    pub fn recipes_for(&self, target: &ColorTarget) -> Result<RecipeMatches, MatchError> {
        let mut remarks = self.remarks.clone();
        if let TargetColor::Reflectance(reflectance) = &target.color {
            remarks.extend(check_visible_band(reflectance.grid())?);
        }
        let target = target.under(&self.request.conditions)?;
        let found = recipes(self.library, &target, &self.request)?;
        if found.is_empty() {
            return Err(MatchError::NoRecipe);
        }
        let mut matches = RecipeMatches { target, recipes: found, by_cie1976: Vec::new(), remarks };
        if matches.nearest() > FAR {
            let metric = Metric::Cie1976;
            let request = MatchRequest { metric, count: 1, ..self.request.clone() };
            matches.by_cie1976 = recipes(self.library, &matches.target, &request)?;
        }
        Ok(matches)
    }
}
