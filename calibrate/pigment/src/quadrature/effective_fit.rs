//! Effective K and S, fitted together with the weights and the wavelengths to films of a library.

use documents::Cancellation;

use super::effective::EffectiveQuadrature;
use super::effective_problem::{Nodes, Problem};
use super::films::FilmSet;
use super::rule::{Quadrature, QuadratureFailure};
use crate::evaluate::Viewing;
use crate::least_squares::Stop;
use crate::library::PigmentLibrary;

/// Films of the training set for each pigment, and at least.
const FILMS_A_PIGMENT: usize = 120;
const LEAST_FILMS: usize = 2000;
/// Further films drawn for each pigment. Those whose colours the first fit keeps worst join the training.
const CANDIDATES_A_PIGMENT: usize = 400;
const LEAST_CANDIDATES: usize = 8000;
/// Share of the further films that joins the training. Any from 1.5 to 3 % does as well.
const WORST: f64 = 0.02;
/// Seed of the films of both fits.
const SEED: u64 = 2004;
/// Stopping rules of the two fits. A later step gains less than the choice of the films does.
const FIRST_STOP: Stop<'static> =
    Stop { iterations: 100, relative_decrease: 1e-3, cancellation: None };
const SECOND_STOP: Stop<'static> = Stop { iterations: 20, ..FIRST_STOP };

impl EffectiveQuadrature {
    /// Fits wavelengths, weights, and K and S of every pigment, so that films of `library` keep their
    /// colours: least squares in CIEDE2000 over films that hide, tints, and thin films over black and
    /// white.
    ///
    /// There are two fits. The first keeps the wavelengths of [`Quadrature::library`]. The second begins where
    /// it ends, moves the wavelengths too, and takes in those of many further films whose colours the
    /// first keeps worst: few films show the edge of a pigment's absorption beside the light of a lamp,
    /// and a random set that is small enough misses them.
    ///
    /// # Errors
    /// [`QuadratureFailure::Count`] for 0 nodes, or more than 32.
    pub fn of(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
    ) -> Result<Self, QuadratureFailure> {
        Self::of_until(viewing, library, count, &Cancellation::default())
    }

    /// Fits like [`Self::of`], until `cancellation` ends it: many wavelengths of many pigments take minutes.
    ///
    /// # Errors
    /// [`QuadratureFailure`] for 0 nodes, or more than 32, or if the fit was cancelled.
    pub fn of_until(
        viewing: &Viewing,
        library: &PigmentLibrary,
        count: usize,
        cancellation: &Cancellation,
    ) -> Result<Self, QuadratureFailure> {
        let start = Quadrature::library(viewing, library, count)?;
        let weights = viewing.weights(library.grid).expect("the method fits the grid");
        let until = |stop: Stop<'static>| Stop { cancellation: Some(cancellation), ..stop };
        let pigments = library.pigments.len();

        let films = LEAST_FILMS.max(FILMS_A_PIGMENT * pigments);
        let films = FilmSet::for_fitting(library, &weights, films, SEED);
        let mut problem = Problem::new(start, library, films);
        let first = problem.solve(problem.first_point(), Nodes::Fixed, until(FIRST_STOP));
        cancellation.check()?;

        let count = LEAST_CANDIDATES.max(CANDIDATES_A_PIGMENT * pigments);
        let candidates = FilmSet::candidates(library, &weights, count, SEED);
        let errors = problem.at(&first).errors(library, &candidates);
        problem.add_worst(candidates, &errors, (WORST * count as f64) as usize);
        let second = problem.solve(first, Nodes::Free, until(SECOND_STOP));
        cancellation.check()?;
        Ok(problem.at(&second))
    }
}
