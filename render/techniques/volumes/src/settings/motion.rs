//! Settings of the forces on a volume's particles.

use serde::{Deserialize, Serialize};

use super::setting::{Setting, Takes::Number};

/// Forces on particles, per unit of mass, and how fast volumes grow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MotionTable {
    /// Stiffness towards the desired radius in 1/s^2, 0..=1e6.
    pub pressure: f32,
    /// Stiffness towards the original place on the sphere in 1/s^2, 0..=1e6.
    pub elastic: f32,
    /// Stiffness towards the mean displacement of neighbours in 1/s^2, 0..=1e6.
    pub cohesion: f32,
    /// Friction in 1/s, 0..=1e4.
    pub friction: f32,
    /// Random velocity at birth in radii a second, 0..=100.
    pub kick: f32,
    /// Relief of the radius by the surface's microstructure, 0..=0.9.
    pub microstructure: f32,
    /// Width of the microstructure in cells, 0.01..=100.
    pub grain: f32,
    /// Greatest speed of a radius in cells a second, 0.001..=1000.
    pub fastest: f32,
    /// Stiffness towards the nearest surface within a cell in 1/s^2, 0..=1e6.
    pub surface_pull: f32,
    /// Acceleration down along the surface in cells a square second, 0..=1e6.
    pub gravity: f32,
    /// Stiffness of the walls of keep-in regions in 1/s^2, 0..=1e6.
    pub keep: f32,
}

impl Default for MotionTable {
    fn default() -> Self {
        Self {
            pressure: 400.0,
            elastic: 100.0,
            cohesion: 200.0,
            friction: 40.0,
            kick: 0.3,
            microstructure: 0.18,
            grain: 0.35,
            fastest: 1.0,
            surface_pull: 50.0,
            gravity: 0.0,
            keep: 2000.0,
        }
    }
}

const STIFFNESS: &str = "1/s^2";

pub(super) const SETTINGS: [Setting; 11] = [
    Setting::new(
        "motion.pressure",
        Number(0.0, 1e6),
        STIFFNESS,
        "Force that keeps the radius of a volume around the desired one.",
    ),
    Setting::new(
        "motion.elastic",
        Number(0.0, 1e6),
        STIFFNESS,
        "Force that keeps particles close to their original places.",
    ),
    Setting::new(
        "motion.cohesion",
        Number(0.0, 1e6),
        STIFFNESS,
        "Force that makes particles follow their neighbours: little lets rims fray.",
    ),
    Setting::new("motion.friction", Number(0.0, 1e4), "1/s", "How soon oscillations end."),
    Setting::new(
        "motion.kick",
        Number(0.0, 100.0),
        "radii a second",
        "Random push of the particles at birth and where paint is poured.",
    ),
    Setting::new(
        "motion.microstructure",
        Number(0.0, 0.9),
        "",
        "How far the surface's microstructure dents the rim, by the radius.",
    ),
    Setting::new("motion.grain", Number(0.01, 100.0), "cells", "Width of the microstructure."),
    Setting::new(
        "motion.fastest",
        Number(0.001, 1000.0),
        "cells a second",
        "Greatest speed at which a volume grows or shrinks.",
    ),
    Setting::new(
        "motion.surface_pull",
        Number(0.0, 1e6),
        STIFFNESS,
        "Force towards the surface on particles within a cell of it.",
    ),
    Setting::new(
        "motion.gravity",
        Number(0.0, 1e6),
        "cells/s^2",
        "Pull downwards along the surface.",
    ),
    Setting::new(
        "motion.keep",
        Number(0.0, 1e6),
        STIFFNESS,
        "Force of the walls of the regions that volumes are kept in.",
    ),
];
