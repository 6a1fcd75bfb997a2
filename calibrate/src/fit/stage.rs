//! Stages of a fit, told while it runs.

use std::fmt;

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
        }
    }
}

/// A function that is told each stage of a fit, or none.
#[derive(Clone, Copy, Default)]
pub struct Watch<'a>(Option<&'a (dyn Fn(FitStage) + Sync)>);

impl<'a> Watch<'a> {
    /// Watches a fit by a function, which any thread may call.
    #[must_use]
    pub fn new(told: &'a (dyn Fn(FitStage) + Sync)) -> Self {
        Self(Some(told))
    }

    pub(super) fn tell(self, stage: FitStage) {
        if let Some(told) = self.0 {
            told(stage);
        }
    }
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Watch" } else { "no Watch" })
    }
}
