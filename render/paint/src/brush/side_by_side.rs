//! Several sub-steps of a head, drawn side by side on several threads.
//!
//! A head bends through its poses one after another, which takes a small part of the time. What it
//! touches at each of them follows from how it is bent there, so that is drawn for all at once.
//! The contacts are those of [`Head::advance_as`] to the bit.

use rayon::prelude::*;

use super::head::Head;
use super::imprint::{Hold, Imprint};
use super::locks::Lock;
use super::net::Net;
use super::relief::Relief;
use super::sides::Border;
use super::tool::StrokeTool;
use crate::contact::Contact;
use crate::pose::Pose;
use graphics::tile::Rect;

/// A bent head in one of the sub-steps, and the buffers of its contact.
#[derive(Debug, Clone)]
struct Step {
    net: Net,
    locks: Vec<Lock>,
    imprint: Imprint,
    lifted: bool,
    hold: Option<Hold>,
    border: Option<Border>,
    /// Number of sub-steps since the head was set down, this one included.
    sub_steps: u32,
}

/// Buffers for sub-steps that are drawn side by side.
#[derive(Debug, Clone, Default)]
pub(crate) struct SideBySide {
    steps: Vec<Step>,
}

impl SideBySide {
    /// Moves `head` through `poses` as `tool`, and fills one of `contacts` for each. All calls must be
    /// for one head.
    ///
    /// # Panics
    /// If there are fewer contacts than poses.
    pub(crate) fn advance_as(
        &mut self,
        (head, tool): (&mut Head, StrokeTool),
        poses: &[Pose],
        relief: &Relief,
        bounds: Rect,
        contacts: &mut [Contact],
    ) {
        let contacts = &mut contacts[..poses.len()];
        while self.steps.len() < poses.len() {
            self.steps.push(Step::of(head));
        }
        let steps = &mut self.steps[..poses.len()];
        for ((step, pose), contact) in steps.iter_mut().zip(poses).zip(&mut *contacts) {
            (step.lifted, step.hold) = head.bend(pose, relief, contact);
            step.net.clone_from(&head.net);
            step.locks.clone_from(&head.locks.columns);
            step.sub_steps = head.sub_step();
        }
        steps.par_iter_mut().for_each(|step| {
            if let Some(hold) = &step.hold {
                step.imprint.evaluate(&step.net, hold, relief);
            }
        });
        for step in &mut *steps {
            if step.lifted {
                head.sides.lift();
            }
            let extent = step.hold.and_then(|_| step.imprint.extent());
            step.border = head.sides.follow(extent);
        }
        let head = &*head;
        let places = steps.par_iter_mut().zip(poses.par_iter().zip(contacts.par_iter_mut()));
        places.for_each(|(step, (pose, contact))| {
            if let Some(hold) = &step.hold {
                step.imprint.draw(&step.locks, hold, step.border, bounds, contact);
            }
            head.use_as(tool, (pose, step.sub_steps), relief, contact);
        });
    }
}

impl Step {
    fn of(head: &Head) -> Self {
        Self {
            net: head.net.clone(),
            locks: head.locks.columns.clone(),
            imprint: head.imprint.clone(),
            lifted: false,
            hold: None,
            border: None,
            sub_steps: 0,
        }
    }
}
