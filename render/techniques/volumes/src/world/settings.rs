//! Settings of a world, the lengths that follow from them, and errors of worlds.

use documents::hint::Explain;
use glam::Vec3;
use graphics::gpu::DeviceError;

use crate::motion::{MotionError, MotionSettings};
use crate::wetting::{QUANTA_PER_FACE, SAMPLES_PER_CELL, WettingError};

/// Greatest number of volumes.
pub const MOST_VOLUMES: usize = 4096;

/// Greatest number of particles of all volumes.
pub const MOST_PARTICLES: usize = 2_000_000;

/// Steps of time in a second.
pub const STEPS_PER_SECOND: u32 = 120;

/// Longest side of a model in mm, if no unit is given.
const LONGEST_MM: f64 = 200.0;

/// Cells along the longest side, if none are given.
const CELLS: f32 = 12.0;

/// Settings of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorldSettings {
    /// Length of one unit of the scene in mm; without, the longest side of the model is 200 mm.
    pub unit_mm: Option<f64>,
    /// Width of a cell as a share of the longest side of the model, 0 to 1; 1/12 by default. With
    /// 0 paint does not spill, and there are single volumes only.
    pub cell: f32,
    /// Samples of the surface in a cell on average, 1 and more; [`SAMPLES_PER_CELL`] by default.
    pub samples: usize,
    /// Thickness of the film that paint spreads to, 0.0001 to 100 mm; 0.02 by default.
    pub film_mm: f64,
    /// Share of a difference of heads that spills across a face in a step, 0 to
    /// [`crate::wetting::FASTEST_RATE`]; 0.04 by default.
    pub rate: f32,
    /// Head that a cell gains for each cell width that it lies higher, 0 to 1000; 0 by default.
    pub slope: f32,
    /// Seed of everything random.
    pub seed: u64,
    /// The motion of volumes.
    pub motion: MotionSettings,
}

impl Default for WorldSettings {
    fn default() -> Self {
        Self {
            unit_mm: None,
            cell: 1.0 / CELLS,
            samples: SAMPLES_PER_CELL,
            film_mm: 0.02,
            rate: 0.04,
            slope: 0.0,
            seed: 1,
            motion: MotionSettings::default(),
        }
    }
}

/// Lengths of a world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    /// Length of one unit of the scene in mm.
    pub(super) unit_mm: f64,
    /// Width of a cell, in the unit of the scene.
    pub(super) cell: f32,
    /// Volume of a quantum in mm^3.
    pub(super) quantum_mm3: f64,
}

impl WorldSettings {
    /// The lengths of a model whose longest side is `longest`, in the unit of the scene.
    pub(super) fn scale(&self, longest: f32) -> Result<Scale, WorldError> {
        self.motion.check()?;
        in_range("cell", self.cell.into(), [0.0, 1.0], "0 to 1")?;
        in_range("film_mm", self.film_mm, [1e-4, 100.0], "0.0001 to 100")?;
        let cell = longest * if self.cell > 0.0 { self.cell } else { 1.0 / CELLS };
        let unit_mm = self.unit_mm.unwrap_or(LONGEST_MM / f64::from(longest));
        if self.unit_mm.is_some() {
            in_range("unit_mm", unit_mm, [1e-9, 1e9], "1e-9 to 1e9")?;
        }
        let cell_mm = f64::from(cell) * unit_mm;
        let quantum_mm3 = cell_mm * cell_mm * self.film_mm / f64::from(QUANTA_PER_FACE);
        Ok(Scale { unit_mm, cell, quantum_mm3 })
    }
}

/// Why something cannot be done to a world. Places are in the unit of the scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum WorldError {
    /// The surface cannot be wetted.
    #[error(transparent)]
    Wetting(#[from] WettingError),
    /// The volumes cannot be moved.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A number is out of its range.
    #[error("{key} is {range}, found `{found}`")]
    #[fault(Setting)]
    Number {
        /// Name of the number, for example `film_mm`.
        key: &'static str,
        /// Its range in words.
        range: &'static str,
        /// Its value.
        found: f64,
    },
    /// A recipe without paint, or with a share below 0.
    #[error("a recipe has shares of 0 or more and at least one above, found `{0:?}`")]
    #[hint("name a pigment with a share above 0")]
    Recipe(Vec<f64>),
    /// A place is too far from the surface.
    #[error("the place `{}, {}, {}` is {distance} from the surface, farther than {most}", place.x, place.y, place.z)]
    #[hint("pour at a place of the model's surface")]
    OffSurface {
        /// The place.
        place: Vec3,
        /// Its distance from the surface.
        distance: f32,
        /// Greatest distance.
        most: f32,
    },
    /// There are as many volumes as there can be.
    #[error("there is no room for more than {most} {what}")]
    #[hint(verbatim, "take larger cells (grid.cell), or fewer volumes")]
    #[fault(Setting)]
    Full {
        /// The things of which there are too many: volumes or particles.
        what: &'static str,
        /// Greatest number.
        most: usize,
    },
    /// There is no such volume, or it cannot be split.
    #[error("volume {index} of {count} {why}")]
    #[hint(
        "name a wet volume; you can split it only with a grid (grid.cell), if it is not yet in the grid and contains some surface"
    )]
    Volume {
        /// Index of the volume.
        index: usize,
        /// Number of volumes.
        count: usize,
        /// The fault.
        why: &'static str,
    },
}

/// Checks that a number lies in a range, which no NaN does.
pub(super) fn in_range(
    key: &'static str,
    found: f64,
    [least, most]: [f64; 2],
    range: &'static str,
) -> Result<(), WorldError> {
    match (least..=most).contains(&found) {
        true => Ok(()),
        false => Err(WorldError::Number { key, range, found }),
    }
}
