//! A world: its surface, its volumes, what you are doing to them, and where all paint is.

use std::sync::Arc;

use glam::Vec3;
use graphics::mesh::Mesh;
use paint::layer::{Cell, SLOTS};

use super::actions::{Lift, Source, Timed};
use super::recipe::amounts_of;
use super::settings::{
    MOST_PARTICLES, MOST_VOLUMES, STEPS_PER_SECOND, Scale, WorldError, WorldSettings,
};
use crate::motion::{MotionError, Push, SurfaceLattice, Surroundings, kick};
use crate::volume::{MOST_DETAIL, SphereMesh, Volume};
use crate::wetting::{Grid, Spilling};

/// Marks a cell without a volume in `of_cell`.
pub(super) const NONE: u32 = u32::MAX;

pub(super) const BIRTH: f32 = 0.02;

/// All volumes over one scene.
///
/// Time passes by [`World::step`] alone, a 120th of a second each. A clone is a snapshot. The same
/// steps and actions lead from it to the same bytes, on any number of threads. You can take any
/// number of steps per frame.
///
/// ```
/// use graphics::mesh::SampleModel;
/// use volumes::world::{Pour, Recipe, World, WorldSettings};
///
/// let mesh = SampleModel::Sphere.mesh(500);
/// let mut world = World::of(&mesh, &WorldSettings::default())?;
/// // 40 mm^3 of the paint in slot 0 a second, for half a second.
/// world.pour(Pour::at(mesh.positions[100].into(), 40.0, 0.5, Recipe::of_slot(0)))?;
/// for _ in 0..60 {
///     world.step()?;
/// }
/// assert!(!world.volumes().is_empty());
/// let poured = world.tally().poured[0] as f64 * world.quantum_mm3();
/// assert!((poured - 20.0).abs() < 1e-6);
/// # Ok::<(), volumes::world::WorldError>(())
/// ```
#[derive(Debug, Clone)]
pub struct World {
    pub(super) settings: WorldSettings,
    pub(super) scale: Scale,
    pub(super) whole: Arc<Grid>,
    /// The grid of the surface inside of all regions in which volumes must stay.
    pub(super) grid: Arc<Grid>,
    pub(super) spilling: Spilling,
    pub(super) surroundings: Surroundings,
    pub(super) volumes: Vec<Volume>,
    /// Index of the wet volume in each cell, or [`NONE`].
    pub(super) of_cell: Vec<u32>,
    /// Paint of the cells for spilling. Each step fills this anew.
    pub(super) paint: Vec<Cell>,
    /// Whether the last step spilled nothing, and no paint has come or gone since then.
    pub(super) settled: bool,
    pub(super) sources: Vec<Timed<Source>>,
    pub(super) sponges: Vec<Timed<Lift>>,
    pub(super) pushes: Vec<Timed<Push>>,
    pub(super) poured: [u64; SLOTS + 1],
    pub(super) lifted: [u64; SLOTS + 1],
    pub(super) in_tube: [u64; SLOTS + 1],
    pub(super) steps: u64,
    pub(super) numbered: u64,
}

impl World {
    /// A world without volumes around a mesh. The y axis points upwards.
    ///
    /// # Errors
    /// If the mesh has no surface, a setting is out of its range, or cells are too small.
    pub fn of(mesh: &Mesh, settings: &WorldSettings) -> Result<Self, WorldError> {
        mesh.check().map_err(crate::wetting::WettingError::from)?;
        let [low, high] = mesh.bounds();
        let scale = settings.scale((high - low).max_element())?;
        let grid = Arc::new(Grid::of(mesh, scale.cell, settings.samples, settings.seed)?);
        let spilling = Spilling::new(&grid.cells, scale.cell, settings.rate, settings.slope)?;
        let mut surroundings = Surroundings::new(scale.cell, settings.seed);
        surroundings.surface =
            Some(Arc::new(SurfaceLattice::of(&grid.samples.places, scale.cell)?));
        let count = grid.cells.len();
        Ok(Self {
            settings: *settings,
            scale,
            whole: Arc::clone(&grid),
            grid,
            spilling,
            surroundings,
            volumes: Vec::new(),
            of_cell: vec![NONE; count],
            paint: vec![Cell::default(); count],
            settled: false,
            sources: Vec::new(),
            sponges: Vec::new(),
            pushes: Vec::new(),
            poured: [0; SLOTS + 1],
            lifted: [0; SLOTS + 1],
            in_tube: [0; SLOTS + 1],
            steps: 0,
            numbered: 0,
        })
    }

    /// The volumes, in the order in which they began. This leaves out those that vanished.
    #[must_use]
    pub fn volumes(&self) -> &[Volume] {
        &self.volumes
    }

    /// The surface inside of all regions in which volumes must stay, its cells and their links.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// [`Self::grid`], which snapshots share until you add a region.
    pub(crate) fn shared_grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The direction that each volume's cell faces, in the order of the volumes. It is zero for a
    /// volume that colours all that it holds. This is a single volume, or one in a cell with
    /// surface that faces opposite ways.
    #[must_use]
    pub fn facing(&self) -> Vec<Vec3> {
        self.volumes
            .iter()
            .map(|volume: &Volume| {
                let cell = volume.cell.map(|cell| self.grid.cells.facing[cell as usize]);
                cell.filter(|facing| *facing != Vec3::ZERO).map_or(Vec3::ZERO, |_| volume.normal)
            })
            .collect()
    }

    /// Width of a cell, in the unit of the scene.
    #[must_use]
    pub fn cell(&self) -> f32 {
        self.scale.cell
    }

    /// The settings with which you made it.
    #[must_use]
    pub fn settings(&self) -> &WorldSettings {
        &self.settings
    }

    /// The forces on the volumes from outside, as they are now.
    #[must_use]
    pub fn surroundings(&self) -> &Surroundings {
        &self.surroundings
    }

    /// Length of one unit of the scene in mm.
    #[must_use]
    pub fn unit_mm(&self) -> f64 {
        self.scale.unit_mm
    }

    /// Volume of one quantum of paint in mm^3.
    #[must_use]
    pub fn quantum_mm3(&self) -> f64 {
        self.scale.quantum_mm3
    }

    /// Number of steps since the beginning.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Time since the beginning in seconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.steps as f64 / f64::from(STEPS_PER_SECOND)
    }

    /// Where all paint is now.
    #[must_use]
    pub fn tally(&self) -> Tally {
        let mut on_scene = [0; SLOTS + 1];
        for volume in &self.volumes {
            add(&mut on_scene, amounts_of(&volume.paint));
        }
        let Self { poured, lifted, in_tube, .. } = *self;
        Tally { poured, on_scene, lifted, in_tube }
    }

    /// Pushes what is inside of a ball for some time in seconds. If you pass infinity, this lasts
    /// until you stop it. Returns a number that you can pass to [`World::stop`].
    ///
    /// # Errors
    /// If the push or the time is out of its range.
    pub fn push(&mut self, push: Push, for_s: f64) -> Result<u64, WorldError> {
        let pushes = vec![push];
        Surroundings { pushes, ..self.surroundings.clone() }.check()?;
        let number = self.next_number();
        self.pushes.push(Timed::new(number, push, for_s)?);
        Ok(number)
    }

    /// Ends a flow, a sponge or a push before its time. If it has ended already, this does
    /// nothing.
    pub fn stop(&mut self, number: u64) {
        self.sources.retain(|timed| timed.number != number);
        self.sponges.retain(|timed| timed.number != number);
        self.pushes.retain(|timed| timed.number != number);
    }

    pub(super) fn next_number(&mut self) -> u64 {
        self.numbered += 1;
        self.numbered
    }

    /// Adds a ball with random velocities and returns its index.
    pub(super) fn begin(
        &mut self,
        center: Vec3,
        radius: f32,
        detail: u8,
    ) -> Result<usize, WorldError> {
        let number = f64::from(radius);
        super::settings::in_range("radius", number, [1e-15, 1e15], "above 0")?;
        super::settings::in_range("detail", detail.into(), [0.0, MOST_DETAIL.into()], "0 to 5")?;
        if !center.is_finite() {
            let index = self.volumes.len();
            let value = center.element_sum();
            return Err(MotionError::Volume { index, what: "centre", value, must: "finite" }.into());
        }
        self.has_room(1, detail)?;
        // Odd multiples of one number are all different (Weyl's sequence).
        let seed = self.next_number().wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ self.settings.seed;
        let mut volume = Volume::ball(center, radius, detail, seed);
        kick(&mut volume, self.settings.motion.kick, self.steps);
        self.volumes.push(volume);
        Ok(self.volumes.len() - 1)
    }

    /// Checks that there is room for `count` more volumes of this detail.
    pub(super) fn has_room(&self, count: usize, detail: u8) -> Result<(), WorldError> {
        let own = count * SphereMesh::of_detail(detail).directions.len();
        let particles: usize = self.volumes.iter().map(|v| v.particles.places[0].len()).sum();
        if self.volumes.len() + count > MOST_VOLUMES {
            return Err(WorldError::Full { what: "volumes", most: MOST_VOLUMES });
        }
        if particles + own > MOST_PARTICLES {
            return Err(WorldError::Full { what: "particles", most: MOST_PARTICLES });
        }
        Ok(())
    }
}

/// Amounts of paint in quanta: of eight slots, then of vehicle. At every time, `poured` is the sum
/// of `on_scene` and `lifted`, to the quantum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Paint that has come out of tubes, or with single volumes.
    pub poured: [u64; SLOTS + 1],
    /// Paint of all volumes, dry or not.
    pub on_scene: [u64; SLOTS + 1],
    /// Paint in sponges.
    pub lifted: [u64; SLOTS + 1],
    /// Paint that stayed in the tube, because there was no room for it.
    pub in_tube: [u64; SLOTS + 1],
}

pub(super) fn add(sums: &mut [u64; SLOTS + 1], amounts: [u64; SLOTS + 1]) {
    for (sum, amount) in sums.iter_mut().zip(amounts) {
        *sum += amount;
    }
}
