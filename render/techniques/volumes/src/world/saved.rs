//! Saves worlds as files, from which they continue to the same bytes. Also regions in which
//! volumes must stay.

use std::sync::Arc;

use glam::Vec3;

use super::actions::{Lift, Pour, Source, Timed};
use super::settings::{MOST_PARTICLES, MOST_VOLUMES, WorldError, WorldSettings};
use super::state::World;
use crate::motion::{KeepIn, Push};
use crate::saved::{
    Kind, Reader, SavedError, Stored, file_of_state, identity, state_of_file, stored,
};
use crate::volume::{MOST_DETAIL, Particles, SphereMesh, Volume};
use crate::wetting::Spilling;

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
