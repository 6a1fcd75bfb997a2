//! Actions on a world over time, as data. You pass them to a [`World`](super::World).

use glam::Vec3;

use super::recipe::{Measured, Recipe, Track};
use super::settings::{STEPS_PER_SECOND, WorldError, in_range};

/// Paint that flows from a tube.
#[derive(Debug, Clone, PartialEq)]
pub struct Pour {
    /// Where it flows onto the surface, by seconds since it began to flow.
    pub track: Track,
    /// Flow in mm^3/s, 0 or more.
    pub rate_mm3_s: f64,
    /// How long it flows in seconds, above 0. If you pass infinity, it flows until you stop it.
    pub for_s: f64,
    /// The paint that flows.
    pub recipe: Recipe,
    /// Region of the volumes that begin where it flows.
    pub region: u16,
}

impl Pour {
    /// Paint that flows at one place (in the unit of the scene) into region 0.
    #[must_use]
    pub fn at(place: Vec3, rate_mm3_s: f64, for_s: f64, recipe: Recipe) -> Self {
        Self { track: Track::at(place), rate_mm3_s, for_s, recipe, region: 0 }
    }
}

/// A sponge that takes up wet paint.
#[derive(Debug, Clone, PartialEq)]
pub struct Lift {
    /// Its middle, by seconds since you set it down.
    pub track: Track,
    /// Its radius, above 0, in the unit of the scene.
    pub radius: f32,
    /// Share of the paint below it that it takes up per second, 0 to 120. If you pass 120, it
    /// takes all at once.
    pub rate: f32,
    /// How long it takes up paint in seconds, above 0. If you pass infinity, this lasts until you
    /// stop it.
    pub for_s: f64,
}

/// A single volume, outside of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Single {
    /// Its centre, in the unit of the scene.
    pub center: Vec3,
    /// Its radius, above 0, in the unit of the scene.
    pub radius: f32,
    /// Level of detail of its mesh, 0 to [`crate::volume::MOST_DETAIL`].
    pub detail: u8,
    /// Its paint, as much as makes a film on all surface within its radius. Pass `None` for a
    /// volume that only shows the colours of the scene.
    pub recipe: Option<Recipe>,
    /// Index of its region.
    pub region: u16,
}

#[derive(Debug, Clone)]
pub(super) struct Timed<T> {
    pub(super) number: u64,
    pub(super) what: T,
    pub(super) steps: u64,
    pub(super) most: Option<u64>,
}

impl<T> Timed<T> {
    pub(super) fn new(number: u64, what: T, for_s: f64) -> Result<Self, WorldError> {
        Ok(Self { number, what, steps: 0, most: steps_of(for_s)? })
    }

    pub(super) fn seconds(&self) -> f64 {
        self.steps as f64 / f64::from(STEPS_PER_SECOND)
    }

    pub(super) fn has_ended(&self) -> bool {
        self.most.is_some_and(|most| self.steps >= most)
    }
}

#[derive(Debug, Clone)]
pub(super) struct Source {
    pub(super) pour: Pour,
    pub(super) measured: Measured,
    pub(super) flowing: u64,
    /// Seed of the volume that it flowed into last.
    pub(super) into: Option<u64>,
}

/// Whole steps of a time in seconds, at least one. `None` for a time without end.
fn steps_of(seconds: f64) -> Result<Option<u64>, WorldError> {
    if seconds == f64::INFINITY {
        return Ok(None);
    }
    in_range("for_s", seconds, [f64::MIN_POSITIVE, 1e9], "above 0")?;
    Ok(Some((seconds * f64::from(STEPS_PER_SECOND)).round().max(1.0) as u64))
}
