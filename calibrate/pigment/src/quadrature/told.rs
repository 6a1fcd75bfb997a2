//! Quadratures as JSON for programs.

use serde_json::{Value, json};

use super::effective::EffectiveQuadrature;
use super::rule::{Quadrature, QuadratureError};
use crate::library::PigmentLibrary;

impl Quadrature {
    /// The wavelengths `nodes_nm` with their `weights`, and the `error` over mixtures, null without one.
    #[must_use]
    pub fn to_json(&self, error: Option<QuadratureError>) -> Value {
        json!({ "nodes_nm": self.nodes_nm, "weights": self.weights, "error": error })
    }
}

impl EffectiveQuadrature {
    /// The rule as [`Quadrature::to_json`] with its `error` over films that hide, `error_over_grounds`, and
    /// K and S of each pigment of `library`, for which the quadrature was fitted, at the wavelengths.
    #[must_use]
    pub fn to_json(
        &self,
        library: &PigmentLibrary,
        [hiding, over_grounds]: [Option<QuadratureError>; 2],
    ) -> Value {
        let curves = self.absorption.iter().zip(&self.scattering);
        let pigments = library.pigments.iter().zip(curves);
        let pigments: Vec<Value> = pigments
            .map(|(p, (k, s))| json!({ "name": p.name, "absorption": k, "scattering": s }))
            .collect();
        json!({
            "nodes_nm": self.rule.nodes_nm,
            "weights": self.rule.weights,
            "error": hiding,
            "error_over_grounds": over_grounds,
            "pigments": pigments,
        })
    }
}
