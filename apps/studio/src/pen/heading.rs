//! The direction of a stroke, across which a following brush turns its broad side.

use eframe::egui::Vec2;

/// Path length in points over which the brush turns: the remaining angle falls by a factor
/// of e.
const TURNING_POINTS: f64 = 30.0;

/// Path length in points over which the direction of the stroke is averaged: single steps
/// of a mouse are a few whole points, so their directions jump by up to 45 degrees.
const AVERAGED_POINTS: f64 = 20.0;

/// Path length in points at which the direction at the start of a stroke is taken. Shorter
/// ones give a coarse direction, longer ones a later start.
const START_POINTS: f64 = 8.0;

/// Rotation of a brush that follows its stroke.
#[derive(Debug, Clone, Copy)]
pub(super) struct Heading {
    /// Rotation in the window, clockwise, in degrees.
    twist: f64,
    /// Recent way of the stroke in points; older steps weigh less.
    way: (f64, f64),
    /// Path length in points.
    path: f64,
    /// Whether the rotation at the start of the stroke is settled.
    started: bool,
}

impl Heading {
    /// A stroke without direction, with this rotation of the brush.
    pub(super) fn new(twist: f64) -> Self {
        Self { twist, way: (0.0, 0.0), path: 0.0, started: false }
    }

    /// Rotation of the brush in the window, clockwise, in degrees.
    pub(super) fn twist(&self) -> f64 {
        self.twist
    }

    /// Whether the rotation at the start of the stroke is settled.
    pub(super) fn is_started(&self) -> bool {
        self.started
    }

    /// Whether the stroke is long enough to tell its direction.
    pub(super) fn is_clear(&self) -> bool {
        self.path >= START_POINTS
    }

    /// Adds a step of the stroke. Once started, the brush turns gradually across the direction.
    pub(super) fn add(&mut self, step: Vec2) {
        let length = f64::from(step.length());
        if length == 0.0 {
            return;
        }
        let kept = (-length / AVERAGED_POINTS).exp();
        self.way = (self.way.0 * kept + f64::from(step.x), self.way.1 * kept + f64::from(step.y));
        self.path += length;
        if self.started {
            self.twist += self.off() * (1.0 - (-length / TURNING_POINTS).exp());
        }
    }

    /// Settles the rotation at the start: across the direction so far, if there is one.
    pub(super) fn start(&mut self) {
        self.started = true;
        if self.path > 0.0 {
            self.twist += self.off();
        }
    }

    /// Angle from the broad side to the line across the direction, in degrees. The broad side
    /// has no direction, so it is taken modulo 180 degrees.
    fn off(&self) -> f64 {
        let across = self.way.1.atan2(self.way.0).to_degrees() + 90.0;
        (across - self.twist + 90.0).rem_euclid(180.0) - 90.0
    }
}
