//! Stages of a fit, told while it runs, and the request to end it.

use std::fmt;

use documents::{Cancellation, Cancelled};

/// A stage of a fit that has begun or come further.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStage {
    /// Quadratic programs, from which the refinement starts: one of several rounds.
    Programs {
        /// Round, from 1.
        round: usize,
        /// Number of rounds.
        of: usize,
    },
    /// Refinement by spectra: a round of one estimate of noise and smoothness.
    Spectra {
        /// Estimate of noise and smoothness, from 1.
        estimate: usize,
        /// Round in which the scale of the residuals is set anew, from 1.
        round: usize,
    },
    /// Refinement by colour differences.
    Colors,
    /// Standard deviations of K and S: samples whose part is computed.
    Deviations {
        /// Number of these samples.
        done: usize,
        /// Number of all samples.
        of: usize,
    },
    /// Choice of the film model of absolute amounts: a fit that was made for it.
    FilmModel,
    /// Validation: a mixture that was left out and predicted.
    LeftOut,
}

impl fmt::Display for FitStage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Programs { round, of } => write!(f, "quadratic programs, round {round} of {of}"),
            Self::Spectra { estimate, round } => {
                write!(f, "refinement by spectra, estimate {estimate}, round {round}")
            }
            Self::Colors => write!(f, "refinement by colours"),
            Self::Deviations { done, of } => {
                write!(f, "standard deviations, sample {done} of {of}")
            }
            Self::FilmModel => write!(f, "choice of the film model"),
            Self::LeftOut => write!(f, "mixture left out"),
        }
    }
}

/// A watch on a fit or a validation: a function that is told each stage, and a request to end it.
///
/// ```
/// use calibrate::fit::Watch;
/// use calibrate::{FitOptions, PreparedFit, Readings};
/// use documents::Cancellation;
/// # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
///
/// let readings = Readings::open(path)?;
/// let cancellation = Cancellation::default();
/// let told = |stage| eprintln!("{stage}");
/// let watch = Watch::new(&told).until(&cancellation);
/// let prepared = PreparedFit::new(&readings, &FitOptions::default(), watch)?;
/// // Another thread may ask for it at any time.
/// cancellation.cancel();
/// assert!(prepared.fit_watched(watch).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Default)]
pub struct Watch<'a> {
    told: Option<&'a (dyn Fn(FitStage) + Sync)>,
    cancellation: Option<&'a Cancellation>,
}

impl<'a> Watch<'a> {
    /// Watches a fit by a function, which any thread may call.
    #[must_use]
    pub fn new(told: &'a (dyn Fn(FitStage) + Sync)) -> Self {
        Self { told: Some(told), cancellation: None }
    }

    /// Ends the work with [`Cancelled`] once `cancellation` asks for it.
    #[must_use]
    pub fn until(self, cancellation: &'a Cancellation) -> Self {
        Self { cancellation: Some(cancellation), ..self }
    }

    /// The watch of a part of the work whose own stages are not told.
    #[must_use]
    pub(crate) fn quiet(self) -> Self {
        Self { told: None, ..self }
    }

    pub(crate) fn tell(self, stage: FitStage) {
        if let Some(told) = self.told {
            told(stage);
        }
    }

    /// Whether the work was asked to end. Its loops then end early, and [`Self::check`] refuses what they
    /// leave behind.
    #[must_use]
    pub(crate) fn is_cancelled(self) -> bool {
        self.cancellation.is_some_and(Cancellation::is_cancelled)
    }

    pub(crate) fn check(self) -> Result<(), Cancelled> {
        self.cancellation.map_or(Ok(()), Cancellation::check)
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("Watch");
        shown.field("told", &self.told.is_some()).field("cancellation", &self.cancellation).finish()
    }
}
