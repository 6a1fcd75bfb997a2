//! Options of a quadrature, which every program fills in its own way: which wavelengths to choose and how to
//! test them. You also find here the result.
//!
//! Comments of the fields are the help texts of the command line and the descriptions of the schema.

use documents::Task;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::effective::{EffectiveQuadrature, FilmSet};
use super::rule::{MOST_MIXTURES, MixtureSet, Quadrature, QuadratureError, QuadratureFailure};
use crate::evaluate::Viewing;
use crate::library::PigmentLibrary;

/// Method of choosing wavelengths. The module's table describes each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum QuadratureChoice {
    /// Gaussian nodes of (x + y + z) E, each weight divided among X, Y and Z (Baxter, Wendt and Lin
    /// 2004)
    Gauss,
    /// Nodes of `gauss`, with weights exact for polynomials in each channel
    Moments,
    /// Nodes and weights fitted to mixtures of the library
    Library,
    /// Nodes, weights, and K and S of every pigment at the nodes fitted to films of the library: what
    /// painting computes with
    Effective,
}

/// Options of a quadrature. [`Self::run`] chooses the wavelengths and tests them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(description = "Options of a quadrature")]
pub struct QuadratureRequest {
    /// Method of choosing the wavelengths [default: effective where a library is given, else moments]
    pub method: Option<QuadratureChoice>,
    /// Number of wavelengths, 1 to 32
    pub nodes: usize,
    /// Seed of the random mixtures
    pub seed: u64,
    /// Number of random mixtures, at most 100000
    pub mixtures: usize,
    /// Light and observer
    pub viewing: Viewing,
}

impl Default for QuadratureRequest {
    fn default() -> Self {
        Self { method: None, nodes: 8, seed: 1, mixtures: 1000, viewing: Viewing::default() }
    }
}

/// Wavelengths that were chosen, with their colour errors on random films that no method was fitted to.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadratureOutcome {
    /// Wavelengths and weights.
    pub rule: Quadrature,
    /// K and S at the wavelengths, for the method `effective`.
    pub effective: Option<EffectiveQuadrature>,
    /// Error over films that hide, unless there are none.
    pub error: Option<QuadratureError>,
    /// Error over films on random grounds, for the method `effective`.
    pub error_over_grounds: Option<QuadratureError>,
}

impl QuadratureOutcome {
    /// The outcome as JSON for programs. Pass the library of the request as `library`.
    #[must_use]
    pub fn to_json(&self, library: Option<&PigmentLibrary>) -> Value {
        match (&self.effective, library) {
            (Some(effective), Some(library)) => {
                effective.to_json(library, [self.error, self.error_over_grounds])
            }
            _ => self.rule.to_json(self.error),
        }
    }
}

impl QuadratureRequest {
    /// Chooses wavelengths for the films of a library, or without one, and tests them on random mixtures of it.
    /// `task` may end the work.
    ///
    /// ```
    /// use documents::Task;
    /// use pigment::quadrature::QuadratureRequest;
    ///
    /// let request = QuadratureRequest { nodes: 4, ..QuadratureRequest::default() };
    /// let outcome = request.run(None, &Task::default())?;
    /// assert_eq!(outcome.rule.nodes_nm.len(), 4);
    /// # Ok::<(), pigment::quadrature::QuadratureFailure>(())
    /// ```
    ///
    /// # Errors
    /// [`QuadratureFailure`] for a method that needs a library where there is none, for 0 nodes or more than
    /// 32, for more than 100,000 mixtures, or if `task` was cancelled.
    pub fn run(
        &self,
        library: Option<&PigmentLibrary>,
        task: &Task,
    ) -> Result<QuadratureOutcome, QuadratureFailure> {
        let Self { viewing, nodes, .. } = self;
        if self.mixtures > MOST_MIXTURES {
            return Err(QuadratureFailure::Mixtures(self.mixtures));
        }
        let method = self.method.unwrap_or(match library {
            Some(_) => QuadratureChoice::Effective,
            None => QuadratureChoice::Moments,
        });
        let rule = match (method, library) {
            (QuadratureChoice::Gauss, _) => Quadrature::gauss(viewing, *nodes)?,
            (QuadratureChoice::Moments, _) => Quadrature::moments(viewing, *nodes)?,
            (QuadratureChoice::Library, Some(library)) => {
                Quadrature::library(viewing, library, *nodes)?
            }
            (QuadratureChoice::Effective, Some(library)) => return self.effective(library, task),
            (QuadratureChoice::Library, None) => {
                return Err(QuadratureFailure::NoLibrary("library"));
            }
            (QuadratureChoice::Effective, None) => {
                return Err(QuadratureFailure::NoLibrary("effective"));
            }
        };
        let tested = library.filter(|_| self.mixtures > 0);
        let error = tested.map(|library| {
            let weights = viewing.weights(library.grid).expect("the method fits the grid");
            rule.error(&MixtureSet::random(library, &weights, self.mixtures, self.seed))
        });
        Ok(QuadratureOutcome { rule, effective: None, error, error_over_grounds: None })
    }

    fn effective(
        &self,
        library: &PigmentLibrary,
        task: &Task,
    ) -> Result<QuadratureOutcome, QuadratureFailure> {
        let Self { viewing, nodes, seed, mixtures, .. } = self;
        let found = EffectiveQuadrature::of(viewing, library, *nodes, task)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let draws = [FilmSet::hiding, FilmSet::over_grounds].map(|draw| {
            (*mixtures > 0)
                .then(|| found.error(library, &draw(library, &weights, *mixtures, *seed)))
        });
        let [error, error_over_grounds] = draws;
        let rule = found.rule.clone();
        Ok(QuadratureOutcome { rule, effective: Some(found), error, error_over_grounds })
    }
}
