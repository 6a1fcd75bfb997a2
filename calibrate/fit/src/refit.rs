//! A fit without some of the samples, and its predictions for them.

use pigment::library::PigmentLibrary;
use pigment::{Curves, PigmentId};
use spectra::Grid;
use spectra::optics::Surface;

use crate::absolute::all_but;
use crate::calibration::{CalibrationError, pigment, solve, without};
use crate::fit::{
    FitError, FitSettings, Problem, RefinedState, Refinement, Unidentified, Watch, unidentified,
};
use crate::observation::Observation;
use crate::swatch::SwatchSet;

/// All that fits of parts of the same samples have in common.
pub(crate) struct Refits<'a> {
    pub(crate) set: &'a SwatchSet,
    pub(crate) observations: &'a [Observation],
    pub(crate) reference: PigmentId,
    pub(crate) surface: Surface,
    pub(crate) settings: &'a FitSettings,
    pub(crate) state: Option<RefinedState>,
    /// Of each fit.
    pub(crate) watch: Watch<'a>,
}

/// A fit of the other samples.
pub(crate) struct Refit {
    grid: Grid,
    curves: Vec<Curves>,
    /// Pigments of `curves`, by their places in the set.
    identified: Vec<PigmentId>,
    unknown: Vec<Unidentified>,
}

impl Refits<'_> {
    /// Mixtures that can be left out: those of two pigments or more, all of which the whole identifies.
    pub(crate) fn mixtures(&self) -> impl Iterator<Item = usize> {
        let shares = self.observations.iter().map(|o| o.shares.as_slice());
        let unknown = unidentified(shares, self.reference);
        let is_mixture = |o: &Observation| o.shares.iter().filter(|s| **s > 0.0).count() > 1;
        (0..self.observations.len()).filter(move |&i| {
            let target = &self.observations[i];
            is_mixture(target) && unknown.iter().all(|u| target.shares[u.pigment.index()] == 0.0)
        })
    }

    /// Fits all samples but those of `group`.
    pub(crate) fn without(&self, group: &[usize]) -> Result<Refit, CalibrationError> {
        let rest: Vec<Observation> = all_but(self.observations.len(), group)
            .iter()
            .map(|&i| self.observations[i].clone())
            .collect();
        let unknown = unidentified(rest.iter().map(|o| o.shares.as_slice()), self.reference);
        let (solvable, identified) = without(&rest, &unknown);
        let among =
            identified.iter().position(|&p| p == self.reference).ok_or(FitError::Reference)?;
        let problem = Problem::new(self.set.grid, self.surface, &solvable, PigmentId(among))?;
        let how = Refinement::prediction(self.settings.smoothness, self.state);
        let how = Refinement { watch: self.watch, ..how };
        let curves = solve(&problem, self.settings.method, how)?.curves;
        Ok(Refit { grid: self.set.grid, curves, identified, unknown })
    }

    /// Library of a fit of this set. Title, licence, source and evidence are empty.
    pub(crate) fn library(&self, refit: &Refit) -> PigmentLibrary {
        let name = |id: PigmentId| self.set.pigments[id.index()].clone();
        let pigments = refit.identified.iter().zip(&refit.curves);
        PigmentLibrary {
            reference: Some(name(self.reference)),
            settings: Some(self.settings.clone()),
            pigments: pigments.map(|(&id, curves)| pigment(&name(id), curves, None)).collect(),
            ..PigmentLibrary::empty(self.set.grid, self.surface)
        }
    }
}

impl Refit {
    /// Whether K and S of every pigment of `target` are known.
    pub(crate) fn identifies(&self, target: &Observation) -> bool {
        self.unknown.iter().all(|u| target.shares[u.pigment.index()] == 0.0)
    }

    /// Predicted reflectance of `target` in a film that hides, where the amounts of all pigments but its
    /// main one are multiplied by `strength`.
    pub(crate) fn film(&self, target: &Observation, surface: Surface, strength: f64) -> Vec<f64> {
        let main = (0..target.shares.len())
            .reduce(|a: usize, b: usize| if target.shares[b] > target.shares[a] { b } else { a })
            .map(PigmentId);
        let parts = self.identified.iter().zip(&self.curves).map(|(pigment, curves)| {
            let (absorption, scattering) = curves.as_slices();
            let share = target.shares[pigment.index()];
            let scale = if Some(*pigment) == main { 1.0 } else { strength };
            (share * scale, absorption, scattering)
        });
        Curves::weighted_sum(self.grid, parts).hiding(surface)
    }
}
