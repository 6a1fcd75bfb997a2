//! The least that must be added to a pot of paint so that its colour comes near enough to a target.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::descent::{descend, within_limits};
use super::film::FilmKind;
use super::forward::{Forward, Scratch};
use super::request::{MatchRequest, RequiredPigment};
use super::search::search;
use super::search_control::SearchControl;
use super::target::Target;
use super::viewing_condition::ViewingCondition;
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// Most sets of pigments whose least addition is searched.
const MOST_SETS: usize = 400;
/// Amounts that are tried between the least and the greatest, in equal ratios; chosen by eye.
const AMOUNTS: usize = 24;
/// Halvings of the last ratio of amounts, down to about 0.1 % of the amount.
const HALVINGS: usize = 9;

/// Limits of an addition to a pot. Amounts are fractions of the paint that is in the pot.
pub(super) struct Additions<'a> {
    /// The library, with the paint in the pot as its last pigment.
    pub(super) library: &'a PigmentLibrary,
    pub(super) conditions: &'a [ViewingCondition],
    /// Pigments that may be added.
    pub(super) allowed: Vec<PigmentId>,
    /// Most pigments to add, 1 to 7.
    pub(super) at_most: usize,
    /// Greatest amount of each pigment of the library; infinite without a limit.
    pub(super) stock: Vec<f64>,
    /// Least amount of one pigment, above 0.
    pub(super) least: f64,
    /// Greatest sum of all additions.
    pub(super) most: f64,
    /// Difference from the target that is near enough.
    pub(super) tolerance: f64,
}

/// An addition that was found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Addition {
    /// Pigments in rising order, each with its amount as a fraction of the paint in the pot.
    pub(super) amounts: Vec<(PigmentId, f64)>,
    /// The mixture of pot and addition.
    pub(super) mixture: Candidate,
}

impl Addition {
    /// Sum of all amounts.
    pub(super) fn total(&self) -> f64 {
        self.amounts.iter().map(|(_, amount)| amount).sum()
    }
}

impl Additions<'_> {
    fn pot(&self) -> PigmentId {
        PigmentId(self.library.pigments.len() - 1)
    }

    /// A request for mixtures of the pot with additions, `share` of which is the pot.
    fn request(&self, share: Option<f64>) -> MatchRequest {
        let usual = MatchRequest::new(self.library, self.conditions.to_vec(), FilmKind::Hiding);
        let pot = self.pot();
        let mut allowed = self.allowed.clone();
        allowed.push(pot);
        // Of a mixture, an addition has at most the share that it has beside the pot alone.
        let limit = |stock: &f64| match share {
            Some(share) => stock * share,
            None if stock.is_finite() => stock / (1.0 + stock),
            None => 1.0,
        };
        let mut amounts: Vec<Option<[f64; 2]>> =
            self.stock.iter().map(|stock| Some([0.0, limit(stock).min(1.0)])).collect();
        amounts.push(None);
        MatchRequest {
            allowed,
            required: vec![RequiredPigment { pigment: pot, share }],
            at_most: self.at_most + 1,
            least_share: 0.0,
            amounts,
            tolerance: self.tolerance,
            ..usual
        }
    }

    /// The additions of each set of pigments that come within the tolerance, the least first. If none does,
    /// those that come nearest, the nearest first.
    pub(super) fn find(&self, forward: &Forward<'_>, target: &Target) -> (Vec<Addition>, bool) {
        let whole = self.request(None);
        let found = search(forward, &whole, target, &SearchControl::default());
        let mut sets: Vec<Candidate> = found.into_iter().filter(|c| c.pigments.len() > 1).collect();
        let near = sets.iter().filter(|set| set.distance <= self.tolerance).count();
        let added = |set: &Candidate| 1.0 - set.share(self.pot());
        if near > 0 {
            sets[..near].sort_by(|a, b| added(a).total_cmp(&added(b)));
        }
        sets.truncate(MOST_SETS);
        let mut additions: Vec<Addition> = sets
            .par_iter()
            .map_init(Scratch::default, |scratch, set| {
                self.of_set(forward, target, &set.pigments, scratch)
            })
            .flatten()
            .collect();
        let is_near = |addition: &Addition| addition.mixture.distance <= self.tolerance;
        let reaches = additions.iter().any(is_near);
        if reaches {
            additions.retain(is_near);
            additions.sort_by(|a, b| a.total().total_cmp(&b.total()));
        } else {
            additions.sort_by(|a, b| a.mixture.distance.total_cmp(&b.mixture.distance));
        }
        (without_needless(additions, reaches), reaches)
    }

    /// The least addition of one set of pigments, the pot among them, or the nearest if none is near enough.
    fn of_set(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        scratch: &mut Scratch,
    ) -> Option<Addition> {
        let mut at = |added: f64, near: Option<&Candidate>| {
            self.of_amount(forward, target, set, added, near, scratch)
        };
        let stock = set.iter().filter_map(|pigment| self.stock.get(pigment.index()));
        let most = self.most.min(stock.sum());
        if most < self.least {
            return None;
        }
        let ratio = (most / self.least).powf(1.0 / AMOUNTS as f64);
        let mut nearest: Option<(f64, Candidate)> = None;
        let mut before = None;
        for step in 0..=AMOUNTS {
            let added = self.least * (most / self.least).powf(step as f64 / AMOUNTS as f64);
            let known = nearest.as_ref().map(|(_, candidate)| candidate);
            let Some(found) = at(added, known) else { continue };
            if found.distance <= self.tolerance {
                let least = least_between(before, (added, found), self.tolerance, &mut at);
                return self.addition(least);
            }
            before = Some(added);
            if nearest.as_ref().is_none_or(|(_, known)| found.distance < known.distance) {
                nearest = Some((added, found));
            }
        }
        let (mut added, mut best) = nearest?;
        let mut step = ratio.sqrt();
        for _ in 0..HALVINGS {
            for tried in [added * step, added / step] {
                let tried = tried.clamp(self.least, most);
                if let Some(found) = at(tried, Some(&best))
                    && found.distance < best.distance
                {
                    (added, best) = (tried, found);
                }
            }
            if best.distance <= self.tolerance {
                break;
            }
            step = step.sqrt();
        }
        self.addition(best)
    }

    /// The nearest mixture in which the additions are `added` in all; `None` if the stock does not suffice.
    fn of_amount(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        added: f64,
        near: Option<&Candidate>,
        scratch: &mut Scratch,
    ) -> Option<Candidate> {
        let share = 1.0 / (1.0 + added);
        let request = self.request(Some(share));
        let others = (set.len() - 1) as f64;
        let start = Candidate {
            pigments: set.to_vec(),
            shares: set
                .iter()
                .map(|&pigment: &PigmentId| {
                    let known =
                        near.map(|near| near.share(pigment) / (1.0 - near.share(self.pot())));
                    let part = known.unwrap_or(1.0 / others);
                    if pigment == self.pot() { share } else { part * (1.0 - share) }
                })
                .collect(),
            thickness: 1.0,
            distance: f64::INFINITY,
        };
        let start = within_limits(&request, &start)?;
        descend(forward, &request, target, &start, scratch)
    }

    /// The addition in a mixture, without traces below the least amount; `None` if nothing is left.
    fn addition(&self, mixture: Candidate) -> Option<Addition> {
        let pot = mixture.share(self.pot());
        let amounts: Vec<(PigmentId, f64)> = mixture
            .pigments
            .iter()
            .zip(&mixture.shares)
            .filter(|(pigment, _)| **pigment != self.pot())
            .map(|(&pigment, share)| (pigment, share / pot))
            .collect();
        // A smaller set without this pigment is searched by itself.
        let is_whole = amounts.iter().all(|(_, amount)| *amount >= self.least * (1.0 - 1e-6));
        is_whole.then_some(Addition { amounts, mixture })
    }
}

/// The mixture with the least addition between `before`, which is too little, and `enough`.
fn least_between(
    before: Option<f64>,
    (mut enough, mut mixture): (f64, Candidate),
    tolerance: f64,
    at: &mut impl FnMut(f64, Option<&Candidate>) -> Option<Candidate>,
) -> Candidate {
    let Some(mut little) = before else { return mixture };
    for _ in 0..HALVINGS {
        let middle = (little * enough).sqrt();
        match at(middle, Some(&mixture)) {
            Some(found) if found.distance <= tolerance => (enough, mixture) = (middle, found),
            _ => little = middle,
        }
    }
    mixture
}

/// Additions without those that need further pigments to do no better than an earlier one.
fn without_needless(additions: Vec<Addition>, reaches: bool) -> Vec<Addition> {
    /// Gain below which a further pigment is not worth weighing, as a fraction; chosen by eye.
    const LEAST_GAIN: f64 = 0.02;
    let effort = |addition: &Addition| {
        if reaches { addition.total() } else { addition.mixture.distance }
    };
    let has = |addition: &Addition, pigment: PigmentId| {
        addition.amounts.iter().any(|(known, _)| *known == pigment)
    };
    let is_needless = |addition: &Addition| {
        additions.iter().any(|other| {
            other.amounts.len() < addition.amounts.len()
                && other.amounts.iter().all(|(pigment, _)| has(addition, *pigment))
                && effort(other) <= effort(addition) * (1.0 + LEAST_GAIN)
        })
    };
    let needed: Vec<Addition> = additions.iter().filter(|a| !is_needless(a)).cloned().collect();
    needed
}
