//! The choice of what a validation leaves out at a time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::swatch::{Swatch, SwatchSet};

/// Samples that a validation leaves out at a time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LeaveOut {
    /// Each sample by itself, masstones and films of one pigment too
    Sample,
    /// Each sample of two pigments or more by itself
    #[default]
    Mixture,
    /// All films over one ground (absolute amounts)
    Ground,
    /// All samples of one pigment by itself: its masstone, or its series of amounts
    Pigment,
    /// All samples of one file
    File,
}

/// One film that may be left out: a whole sample, or one of its films for absolute amounts.
#[derive(Clone, Copy)]
pub(crate) struct Candidate<'a> {
    /// Index among the films of the fit.
    pub(crate) index: usize,
    pub(crate) swatch: &'a Swatch,
    /// Name of its ground, or empty.
    pub(crate) ground: &'a str,
}

/// Whether there are two pigments or more.
pub(crate) fn is_mixture(amounts: &[f64]) -> bool {
    amounts.iter().filter(|amount| **amount > 0.0).count() > 1
}

impl LeaveOut {
    /// Whether each sample is left out by itself, so that samples may be dealt into groups instead.
    pub(crate) fn is_single(self) -> bool {
        matches!(self, Self::Sample | Self::Mixture)
    }

    /// The usual choice: mixtures, or samples if there are no mixtures.
    pub(crate) fn usual(set: &SwatchSet) -> Self {
        let has_mixtures = set.swatches.iter().any(|swatch| is_mixture(&swatch.amounts));
        if has_mixtures { Self::Mixture } else { Self::Sample }
    }

    /// Whether a sample with these amounts is ever left out.
    pub(crate) fn selects(self, amounts: &[f64]) -> bool {
        match self {
            Self::Mixture => is_mixture(amounts),
            Self::Pigment => !is_mixture(amounts),
            Self::Sample | Self::Ground | Self::File => true,
        }
    }

    /// Groups of `candidates` that are left out together, in order of first appearance. `pigments` are
    /// the names.
    pub(crate) fn groups<'a>(
        self,
        candidates: impl Iterator<Item = Candidate<'a>>,
        pigments: &'a [String],
    ) -> Vec<Vec<usize>> {
        let selected = candidates.filter(|candidate| self.selects(&candidate.swatch.amounts));
        let mut groups: Vec<(&str, Vec<usize>)> = Vec::new();
        for Candidate { index, swatch, ground } in selected {
            let key = match self {
                Self::Sample | Self::Mixture => "",
                Self::Ground => ground,
                Self::File => &swatch.file,
                Self::Pigment => {
                    let place = swatch.amounts.iter().position(|amount| *amount > 0.0);
                    place.map_or("", |place| pigments[place].as_str())
                }
            };
            match groups.iter_mut().find(|(known, _)| *known == key && !self.is_single()) {
                Some((_, group)) => group.push(index),
                None => groups.push((key, vec![index])),
            }
        }
        groups.into_iter().map(|(_, group)| group).collect()
    }

    /// Noun for one of the films that are left out.
    pub(crate) fn noun(self) -> &'static str {
        match self {
            Self::Mixture => "mixture",
            Self::Ground => "film",
            Self::Sample | Self::Pigment | Self::File => "sample",
        }
    }

    /// How they are left out.
    pub(crate) fn manner(self) -> &'static str {
        match self {
            Self::Sample | Self::Mixture => "one by one",
            Self::Ground => "ground by ground",
            Self::Pigment => "pigment by pigment",
            Self::File => "file by file",
        }
    }
}
