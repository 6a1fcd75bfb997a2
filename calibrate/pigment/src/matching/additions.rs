//! The search for what to add to a pot of paint.
//!
//! The more you add, the nearer the pot comes to its target as predicted, but the less sure is the prediction. We
//! therefore judge an addition by the error to expect: the root of the sum of the squares of both.

use documents::{Cancelled, Task};
use rayon::prelude::*;

use super::forward::{Forward, Scratch};
use super::limits::{FilmKind, RecipeLimits, RequiredPigment};
use super::pot::{PaintErrors, PotEstimate};
use super::search::{Candidate, descend, expected, search, within_limits};
use super::target::{Target, ViewingCondition};
use crate::library::PigmentLibrary;
use crate::recipe::PigmentId;

/// We search the least addition for at most this many sets of pigments.
const MOST_SETS: usize = 120;
/// We try this many amounts between the least and the greatest, in equal ratios. We chose it by eye.
const AMOUNTS: usize = 16;
/// We halve the last ratio of amounts this often, down to about 0.1 % of the amount.
const HALVINGS: usize = 9;
/// An addition of up to this fraction of the pot is preferred to a larger one.
const EASY: f64 = 0.5;
/// You do not add more for an error to expect that is lower by less than this fraction. We chose it by eye.
const LEAST_GAIN: f64 = 0.1;
/// But if this fraction more is all that the limits allow, you add all. We chose it by eye.
const REST: f64 = 0.15;
/// This fraction applies instead to paint of which little is in stock. We chose it by eye.
const REST_OF_STOCK: f64 = 1.0;

/// Limits of an addition to a pot. We give amounts as fractions of the paint in the pot.
pub(super) struct Additions<'a> {
    /// The library, with the paint in the pot as its last pigment.
    pub(super) library: &'a PigmentLibrary,
    pub(super) conditions: &'a [ViewingCondition],
    /// The pot by its readings.
    pub(super) estimate: &'a PotEstimate,
    /// Errors of the pigments of the library.
    pub(super) errors: &'a [PaintErrors],
    /// Pigments that you may add.
    pub(super) allowed: Vec<PigmentId>,
    /// Most pigments to add, 1 to 7.
    pub(super) at_most: usize,
    /// Greatest amount of each pigment of the library, infinite without a limit.
    pub(super) stock: Vec<f64>,
    /// Least amount of one pigment that you can weigh, above 0.
    pub(super) least: f64,
    /// Greatest sum of all additions.
    pub(super) most: f64,
    /// Difference from the target that is near enough.
    pub(super) tolerance: f64,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Addition {
    /// Pigments in rising order, each with its amount as a fraction of the paint in the pot.
    pub(super) amounts: Vec<(PigmentId, f64)>,
    /// The mixture of pot and addition.
    pub(super) mixture: Candidate,
    /// Error to expect.
    pub(super) expected: f64,
}

impl Addition {
    pub(super) fn total(&self) -> f64 {
        self.amounts.iter().map(|(_, amount)| amount).sum()
    }
}

/// Additions of one set of pigments, from the least amount to the greatest.
struct Ladder {
    set: Vec<PigmentId>,
    steps: Vec<Addition>,
}

impl Ladder {
    fn up_to(&self, most: f64) -> impl Iterator<Item = &Addition> {
        self.steps.iter().take_while(move |step| step.total() <= most * (1.0 + 1e-9))
    }

    /// Least error to expect of additions up to `most`.
    fn best(&self, most: f64) -> f64 {
        self.up_to(most).map(|step| step.expected).fold(f64::INFINITY, f64::min)
    }
}

impl Additions<'_> {
    fn pot(&self) -> PigmentId {
        PigmentId(self.library.pigments.len() - 1)
    }

    /// Amount of all pigments of a set that is in stock.
    fn stock_of(&self, set: &[PigmentId]) -> f64 {
        set.iter().filter_map(|pigment| self.stock.get(pigment.index())).sum()
    }

    /// Limits of mixtures of the pot with additions of `allowed`, `share` of which is the pot.
    fn limits(&self, allowed: &[PigmentId], share: Option<f64>) -> RecipeLimits {
        let usual = RecipeLimits::new(self.library, self.conditions.to_vec(), FilmKind::Hiding);
        let pot = self.pot();
        let mut allowed = allowed.to_vec();
        allowed.push(pot);
        // The share of an addition is largest if nothing else is added to the pot.
        let mut amounts: Vec<Option<[f64; 2]>> = self
            .stock
            .iter()
            .map(|stock| {
                let limit = match share {
                    Some(share) => stock * share,
                    None if stock.is_finite() => stock / (1.0 + stock),
                    None => 1.0,
                };
                Some([0.0, limit.min(1.0)])
            })
            .collect();
        amounts.push(None);
        RecipeLimits {
            allowed,
            required: vec![RequiredPigment { pigment: pot, share }],
            at_most: self.at_most + 1,
            least_share: 0.0,
            amounts,
            tolerance: self.tolerance,
            ..usual
        }
    }

    /// Additions that leave an error of `off` or less, the least first. We take the first of these classes, unless a
    /// later one lowers the error to expect by more than the tolerance: up to half the pot of its own pigments, more
    /// of these, up to half the pot of any pigments, more of these.
    pub(super) fn find(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        off: f64,
        task: &Task,
    ) -> Result<Vec<Addition>, Cancelled> {
        let own: Vec<PigmentId> = (self.allowed.iter().copied())
            .filter(|pigment| self.estimate.pigments.contains(pigment))
            .collect();
        let mut best = (off, Vec::new());
        for allowed in [&own, &self.allowed] {
            if allowed.is_empty() || (best.0 <= self.tolerance && !best.1.is_empty()) {
                continue;
            }
            let ladders = self.ladders(allowed, forward, target, task)?;
            for most in [self.most.min(EASY), self.most] {
                let least = ladders.iter().map(|l| l.best(most)).fold(f64::INFINITY, f64::min);
                let gains =
                    if best.1.is_empty() { least < off } else { least < best.0 - self.tolerance };
                if gains {
                    let near = self.tolerance.max(least * (1.0 + LEAST_GAIN)).min(off);
                    best = (least, self.within(&ladders, most, near, (forward, target)));
                }
            }
        }
        Ok(best.1)
    }

    /// The least addition of each set of pigments with an error to expect of up to `near`, the least first. If some
    /// come within the tolerance, as they are predicted, you get only such ones.
    fn within(
        &self,
        ladders: &[Ladder],
        most: f64,
        near: f64,
        (forward, target): (&Forward<'_>, &Target),
    ) -> Vec<Addition> {
        let mut all_steps = ladders.iter().flat_map(|ladder| ladder.up_to(most));
        let can_reach =
            all_steps.any(|step| step.expected <= near && step.mixture.distance <= self.tolerance);
        let is_enough = |step: &Addition| {
            step.expected <= near && (step.mixture.distance <= self.tolerance || !can_reach)
        };
        let additions = ladders.par_iter().map_init(Scratch::default, |scratch, ladder| {
            let steps: Vec<&Addition> = ladder.up_to(most).collect();
            let first = steps.iter().position(|step| is_enough(step))?;
            let mut enough = steps[first].clone();
            let Some(before) = first.checked_sub(1) else { return Some(enough) };
            let mut little = steps[before].total();
            for _ in 0..HALVINGS {
                let middle = (little * enough.total()).sqrt();
                let near_mixture = Some(&enough.mixture);
                match self.of_amount(forward, target, &ladder.set, middle, near_mixture, scratch) {
                    Some(found) if is_enough(&found) => enough = found,
                    _ => little = middle,
                }
            }
            let last = steps[steps.len() - 1];
            let is_all = last.total() >= self.stock_of(&ladder.set) * (1.0 - 1e-6);
            let rest = if is_all { REST_OF_STOCK } else { REST };
            let rest = last.total() <= enough.total() * (1.0 + rest);
            Some(if rest && !can_reach && is_enough(last) { last.clone() } else { enough })
        });
        let mut additions: Vec<Addition> =
            additions.flatten().filter(|addition| self.is_whole(addition)).collect();
        additions.sort_by(|a, b| a.total().total_cmp(&b.total()));
        without_needless(&additions)
    }

    /// Additions of every set of the `allowed` pigments that may come near.
    fn ladders(
        &self,
        allowed: &[PigmentId],
        forward: &Forward<'_>,
        target: &Target,
        task: &Task,
    ) -> Result<Vec<Ladder>, Cancelled> {
        let whole = self.limits(allowed, None);
        let found = search(forward, &whole, target, &task.steps(expected(&whole)));
        task.check()?;
        let mut sets: Vec<Candidate> = found.into_iter().filter(|c| c.pigments.len() > 1).collect();
        let near = sets.iter().filter(|set| set.distance <= self.tolerance).count();
        if near > 0 {
            sets[..near].sort_by(|a, b| {
                (1.0 - a.share(self.pot())).total_cmp(&(1.0 - b.share(self.pot())))
            });
        }
        sets.truncate(MOST_SETS);
        let ladders = sets.par_iter().map_init(Scratch::default, |scratch, set| {
            if task.is_cancelled() { None } else { self.ladder(forward, target, set, scratch) }
        });
        let ladders = ladders.flatten().collect();
        task.check()?;
        Ok(ladders)
    }

    fn ladder(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &Candidate,
        scratch: &mut Scratch,
    ) -> Option<Ladder> {
        let set = &set.pigments;
        let most = self.most.min(self.stock_of(set));
        if most < self.least {
            return None;
        }
        let ratio = most / self.least;
        let mut amounts: Vec<f64> = (0..=AMOUNTS)
            .map(|step| self.least * ratio.powf(step as f64 / AMOUNTS as f64))
            .chain((self.least..most).contains(&EASY).then_some(EASY))
            .collect();
        amounts.sort_by(f64::total_cmp);
        let mut steps: Vec<Addition> = Vec::new();
        for added in amounts {
            let near = steps.last().map(|addition| &addition.mixture);
            steps.extend(self.of_amount(forward, target, set, added, near, scratch));
        }
        let nearest = (steps.iter())
            .min_by(|a, b| a.mixture.distance.total_cmp(&b.mixture.distance))
            .map(|step| self.nearest(forward, target, set, step.clone(), most, scratch));
        steps.extend(nearest);
        steps.retain(|addition| self.is_whole(addition));
        steps.sort_by(|a, b| a.total().total_cmp(&b.total()));
        Some(Ladder { set: set.clone(), steps })
    }

    /// The addition nearest to the target around `best`.
    fn nearest(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        mut best: Addition,
        most: f64,
        scratch: &mut Scratch,
    ) -> Addition {
        let mut step = (most / self.least).powf(0.5 / AMOUNTS as f64);
        for _ in 0..HALVINGS {
            for tried in [best.total() * step, best.total() / step] {
                let tried = tried.clamp(self.least, most);
                let near = Some(&best.mixture);
                if let Some(found) = self.of_amount(forward, target, set, tried, near, scratch)
                    && found.mixture.distance < best.mixture.distance
                {
                    best = found;
                }
            }
            step = step.sqrt();
        }
        best
    }

    /// Whether no pigment is lighter than you can weigh. We search a smaller set without it by itself.
    fn is_whole(&self, addition: &Addition) -> bool {
        addition.amounts.iter().all(|(_, amount)| *amount >= self.least * (1.0 - 1e-6))
    }

    /// The mixture nearest to the target in which the sum of all additions is `added`. `None` if the stock
    /// does not suffice.
    fn of_amount(
        &self,
        forward: &Forward<'_>,
        target: &Target,
        set: &[PigmentId],
        added: f64,
        near: Option<&Candidate>,
        scratch: &mut Scratch,
    ) -> Option<Addition> {
        let share = 1.0 / (1.0 + added);
        let limits = self.limits(&self.allowed, Some(share));
        let others = (set.len() - 1) as f64;
        let start = Candidate {
            pigments: set.to_vec(),
            shares: set
                .iter()
                .map(|&pigment| {
                    let known =
                        near.map(|near| near.share(pigment) / (1.0 - near.share(self.pot())));
                    let part = known.unwrap_or(1.0 / others);
                    if pigment == self.pot() { share } else { part * (1.0 - share) }
                })
                .collect(),
            thickness: 1.0,
            distance: f64::INFINITY,
        };
        let start = within_limits(&limits, &start)?;
        let mixture = descend(forward, &limits, target, &start, scratch)?;
        let parts: Vec<(PigmentId, f64)> =
            mixture.pigments.iter().copied().zip(mixture.shares.iter().copied()).collect();
        let slopes = forward.slopes(target, &mixture.pigments, &mixture.shares, scratch);
        let spread = self.estimate.spread(self.library, self.errors, &parts, &slopes);
        let pot = mixture.share(self.pot());
        let amounts = parts.iter().filter(|(pigment, _)| *pigment != self.pot());
        Some(Addition {
            amounts: amounts.map(|(pigment, share)| (*pigment, share / pot)).collect(),
            expected: mixture.distance.hypot(spread),
            mixture,
        })
    }
}

/// Drops additions that need further pigments and save hardly any paint.
fn without_needless(additions: &[Addition]) -> Vec<Addition> {
    /// You do not weigh a further pigment to save less than this fraction. We chose it by eye.
    const LEAST_SAVING: f64 = 0.02;

    let needed = additions.iter().filter(|addition| {
        !additions.iter().any(|other| {
            other.amounts.len() < addition.amounts.len()
                && other
                    .amounts
                    .iter()
                    .all(|(pigment, _)| addition.amounts.iter().any(|(known, _)| known == pigment))
                && other.total() <= addition.total() * (1.0 + LEAST_SAVING)
        })
    });
    needed.cloned().collect()
}
