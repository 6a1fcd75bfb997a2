//! A world: its surface, its volumes, what you are doing to them, and where all paint is. Also its
//! state as a file, from which it continues to the same bytes, and regions in which volumes must
//! stay.

use std::sync::Arc;

use glam::Vec3;
use graphics::mesh::Mesh;
use paint::layer::{Cell, SLOTS};

use super::actions::{Lift, Pour, Source, Timed};
use super::recipe::amounts_of;
use super::settings::{
    MOST_PARTICLES, MOST_VOLUMES, STEPS_PER_SECOND, Scale, WorldError, WorldSettings,
};
use crate::motion::{KeepIn, MotionError, Push, SurfaceLattice, Surroundings, kick};
use crate::saved::{
    Kind, Reader, SavedError, Stored, file_of_state, identity, state_of_file, stored,
};
use crate::volume::{MOST_DETAIL, Particles, SphereMesh, Volume};
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

const WORLD: Kind = Kind { format: b"impasto-world\0\0\0", version: 1, name: "world" };

stored!(Particles { places, velocities, samples });
stored!(Volume {
    center,
    target_center,
    radius,
    target_radius,
    detail,
    region,
    cell,
    body,
    normal,
    seed,
    dry,
    paint,
    particles,
    rests_under,
});
stored!(Pour { track, rate_mm3_s, for_s, recipe, region });
stored!(Lift { track, radius, rate, for_s });
stored!(Push { center, direction, radius, strength });
stored!(Source { pour, measured, flowing, into });

impl<T: Stored> Stored for Timed<T> {
    fn store(&self, bytes: &mut Vec<u8>) {
        let Self { number, what, steps, most } = self;
        number.store(bytes);
        what.store(bytes);
        (*steps, *most).store(bytes);
    }

    fn read(from: &mut Reader<'_>) -> Option<Self> {
        let (number, what) = Stored::read(from)?;
        let (steps, most) = Stored::read(from)?;
        Some(Self { number, what, steps, most })
    }
}

impl World {
    /// The whole state of this world as the bytes of a file: volumes with their particles, paint,
    /// all that flows or pushes, the tally and the time. As `wish`, pass words for what this world
    /// belongs to, for example a digest of all that led to it. You need the same words for
    /// [`World::resumed`].
    ///
    /// ```
    /// use graphics::mesh::SampleModel;
    /// use volumes::world::{Pour, Recipe, World, WorldSettings};
    ///
    /// let mesh = SampleModel::Sphere.mesh(500);
    /// let beginning = World::of(&mesh, &WorldSettings::default())?;
    /// let mut world = beginning.clone();
    /// world.pour(Pour::at(mesh.positions[100].into(), 40.0, 0.5, Recipe::of_slot(0)))?;
    /// for _ in 0..30 {
    ///     world.step()?;
    /// }
    /// let file = world.saved("a red spot");
    /// let mut again = beginning.resumed(&file, "a red spot")?;
    /// world.step()?;
    /// again.step()?;
    /// assert_eq!(again.volumes(), world.volumes());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn saved(&self, wish: &str) -> Vec<u8> {
        let mut state = Vec::new();
        self.store_state(&mut state);
        file_of_state(WORLD, &identity([wish, &self.fingerprint()]), &state)
    }

    /// Resumes the world that [`World::saved`] gave as `file`. This world must have the same
    /// scene. You get the same bytes as from the world that was saved.
    ///
    /// # Errors
    /// [`SavedError`] if the file holds no world or one of another version, is damaged, or was
    /// saved over another scene, with other settings, in other regions, or with another `wish`.
    pub fn resumed(&self, file: &[u8], wish: &str) -> Result<Self, SavedError> {
        let state = state_of_file(WORLD, &identity([wish, &self.fingerprint()]), file)?;
        let mut reader = Reader::new(state);
        let world = self.with_state(&mut reader).ok_or(SavedError::Damaged)?;
        if reader.is_empty() { Ok(world) } else { Err(SavedError::Damaged) }
    }

    /// Words for scene, settings and regions. If these differ, so do the words.
    pub(crate) fn fingerprint(&self) -> String {
        let forces = self.surroundings.fingerprint(&self.settings.motion);
        let cells = self.grid.cells.len();
        let samples = self.whole.samples.len();
        format!("{:?} {:?} {forces:x} {cells} {samples}", self.settings, self.scale)
    }

    /// Appends everything that changes as time passes.
    pub(crate) fn store_state(&self, bytes: &mut Vec<u8>) {
        self.volumes.store(bytes);
        self.settled.store(bytes);
        self.sources.store(bytes);
        self.sponges.store(bytes);
        self.pushes.store(bytes);
        self.surroundings.pushes.store(bytes);
        [self.poured, self.lifted, self.in_tube].store(bytes);
        [self.steps, self.numbered].store(bytes);
    }

    /// This world in a state that [`World::store_state`] wrote. `None` if the state does not
    /// belong to it.
    pub(crate) fn with_state(&self, from: &mut Reader<'_>) -> Option<Self> {
        let volumes: Vec<Volume> = Stored::read(from)?;
        if !self.can_hold(&volumes) {
            return None;
        }
        let mut world = Self { volumes, ..self.clone() };
        world.settled = Stored::read(from)?;
        world.sources = Stored::read(from)?;
        world.sponges = Stored::read(from)?;
        world.pushes = Stored::read(from)?;
        world.surroundings.pushes = Stored::read(from)?;
        [world.poured, world.lifted, world.in_tube] = Stored::read(from)?;
        [world.steps, world.numbered] = Stored::read(from)?;
        world.index_cells();
        Some(world)
    }

    /// Checks that volumes have whole meshes, and only cells that exist.
    fn can_hold(&self, volumes: &[Volume]) -> bool {
        let cells = self.grid.cells.len();
        let mut particles = 0;
        let whole = volumes.iter().all(|volume| {
            if volume.detail > MOST_DETAIL {
                return false;
            }
            let count = SphereMesh::of_detail(volume.detail).directions.len();
            particles += count;
            let Particles { places, velocities, samples } = &volume.particles;
            let lists = places.iter().chain(velocities);
            lists.map(Vec::len).chain([samples.len()]).all(|length| length == count)
                && volume.cell.is_none_or(|cell| (cell as usize) < cells)
        });
        whole && volumes.len() <= MOST_VOLUMES && particles <= MOST_PARTICLES
    }
}

impl World {
    /// Keeps all volumes inside of a region from now on. No paint spills to surface outside of it.
    /// Paint that is there already stays, in volumes that shrink to dots.
    ///
    /// # Errors
    /// If a number of the region is out of its range.
    pub fn keep(&mut self, region: KeepIn) -> Result<(), WorldError> {
        let mut kept = self.surroundings.clone();
        kept.regions.push(region);
        kept.check()?;
        let regions = &kept.regions;
        let inside = |at: Vec3| regions.iter().all(|region| region.way_back(at, 0.0) == Vec3::ZERO);
        let grid = self.whole.within(inside);
        let WorldSettings { rate, slope, .. } = self.settings;
        self.spilling = Spilling::new(&grid.cells, self.scale.cell, rate, slope)?;
        for volume in self.volumes.iter_mut().filter(|volume| !volume.dry) {
            let cell = volume.cell.map_or(0, |cell| cell as usize);
            let wettable = volume.cell.is_some() && grid.cells.capacities[cell] > 0;
            if wettable && !inside(volume.target_center) {
                volume.target_center = grid.cells.centers[cell];
            }
            if wettable && !inside(volume.center) {
                volume.center = volume.target_center;
            }
        }
        self.grid = Arc::new(grid);
        self.surroundings = kept;
        self.settled = false;
        for index in 0..self.volumes.len() {
            if self.volumes[index].cell.is_some() && !self.volumes[index].dry {
                self.set_paint(index, self.volumes[index].paint);
            }
        }
        Ok(())
    }
}
