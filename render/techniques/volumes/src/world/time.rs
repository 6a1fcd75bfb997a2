//! One step of time. Paint spills from one volume of the grid to the next, and they grow with
//! their paint. This also has paint that dries, and the graphics device of large worlds.

use glam::Vec3;
use graphics::compute::Compute;
use graphics::gpu::{Adapter, Device, DeviceError};
use paint::layer::Cell;

use super::settings::{STEPS_PER_SECOND, WorldError, in_range};
use super::state::{BIRTH, NONE, World};
use crate::containing::Inside;
use crate::motion::{DeviceMotion, advance};
use crate::volume::Volume;
use crate::wetting::{DeviceSpilling, Grid};

impl World {
    /// Takes one step, a 120th of a second: paint flows, sponges take it up, it spills, and the
    /// volumes move.
    ///
    /// # Errors
    /// If there are too many volumes, or forces too stiff for a step. All paint that has moved
    /// until then is in the tally.
    pub fn step(&mut self) -> Result<(), WorldError> {
        self.step_by(None)
    }

    /// Takes one step like [`Self::step`]. If the world has more particles than
    /// [`super::DEVICE_PARTICLES`], a graphics device does it. You get the same paint to the
    /// quantum, unless you split a volume. Places of particles agree with the processor's within
    /// 1e-4 radii, except for single particles that the surface pulls to another of two equally
    /// near samples.
    ///
    /// # Errors
    /// This fails like [`Self::step`], and if the device fails. The tally then holds all paint that
    /// has moved so far.
    pub fn step_on(&mut self, device: &mut StepDevice) -> Result<(), WorldError> {
        let serving = device.serving(&self.volumes)?;
        self.step_by(serving)
    }

    fn step_by(&mut self, mut device: Option<&mut OpenedDevice>) -> Result<(), WorldError> {
        self.move_paint(device.as_deref_mut())?;
        let pushes = self.pushes.iter().map(|timed| timed.what);
        self.surroundings.pushes = pushes.collect();
        let seconds = 1.0 / STEPS_PER_SECOND as f32;
        let Self { volumes, settings, surroundings, .. } = self;
        match device {
            None => advance(volumes, &settings.motion, surroundings, seconds)?,
            Some(OpenedDevice { device, motion, .. }) => {
                motion.advance(device, volumes, &settings.motion, surroundings, seconds)?
            }
        };
        self.pushes.iter_mut().for_each(|timed| timed.steps += 1);
        self.pushes.retain(|timed| !timed.has_ended());
        self.remove_vanished();
        self.steps += 1;
        Ok(())
    }

    /// Takes the first half of a step: paint flows, is taken up and spills.
    pub(super) fn move_paint(
        &mut self,
        device: Option<&mut OpenedDevice>,
    ) -> Result<(), WorldError> {
        self.flow()?;
        self.take_up();
        if self.settings.cell > 0.0 { self.spill(device) } else { Ok(()) }
    }

    /// Removes volumes that have lost all their paint and are only dots.
    fn remove_vanished(&mut self) {
        let least = 0.5 * BIRTH * self.scale.cell;
        let count = self.volumes.len();
        self.volumes.retain(|volume| {
            let vanishing = volume.target_radius == 0.0 && !volume.dry;
            !vanishing || volume.radius > least
        });
        if self.volumes.len() < count {
            self.settled = false;
            self.index_cells();
        }
    }

    pub(super) fn index_cells(&mut self) {
        self.of_cell.fill(NONE);
        for (index, volume) in (0..).zip(&self.volumes) {
            if let (Some(cell), false) = (volume.cell, volume.dry) {
                self.of_cell[cell as usize] = index;
            }
        }
    }
}

/// If you give a device to a world, it moves the world from this number of particles on. Smaller
/// worlds stay on the processor, with the same bytes on every machine.
pub const DEVICE_PARTICLES: usize = 200_000;

/// A graphics device for the steps of large worlds ([`World::step_on`]). It keeps its memory from
/// step to step. You can use one for any number of worlds.
#[derive(Debug)]
pub struct StepDevice {
    above: usize,
    opening: Opening,
}

/// A device that we may have to open first.
#[derive(Debug)]
enum Opening {
    Processor,
    Closed(Adapter),
    Open(Box<OpenedDevice>),
}

#[derive(Debug)]
pub(super) struct OpenedDevice {
    pub(super) device: Device,
    pub(super) motion: DeviceMotion,
    pub(super) spilling: DeviceSpilling,
}

impl OpenedDevice {
    fn new(device: Device) -> Box<Self> {
        let motion = DeviceMotion::default();
        let spilling = DeviceSpilling::default();
        Box::new(Self { device, motion, spilling })
    }
}

impl StepDevice {
    /// Uses the device of `compute`. If this is the processor, it moves all worlds.
    #[must_use]
    pub fn new(compute: Compute) -> Self {
        let device = compute.into_device();
        let opening =
            device.map_or(Opening::Processor, |device| Opening::Open(OpenedDevice::new(device)));
        Self { above: DEVICE_PARTICLES, opening }
    }

    /// Uses the adapter of `compute`, which paints meanwhile. We open it a second time once a
    /// world is large enough.
    #[must_use]
    pub fn beside(compute: &Compute) -> Self {
        let adapter = compute.device().map(|device| device.adapter().clone());
        let opening = adapter.map_or(Opening::Processor, Opening::Closed);
        Self { above: DEVICE_PARTICLES, opening }
    }

    /// Serves worlds of more than `particles` particles. Use this to replace [`DEVICE_PARTICLES`].
    #[must_use]
    pub fn above(self, particles: usize) -> Self {
        Self { above: particles, ..self }
    }

    /// Whether this device moves the world.
    #[must_use]
    pub fn serves(&self, world: &World) -> bool {
        self.serves_volumes(&world.volumes)
    }

    fn serves_volumes(&self, volumes: &[Volume]) -> bool {
        let particles: usize = volumes.iter().map(|v| v.particles.places[0].len()).sum();
        !matches!(self.opening, Opening::Processor) && particles > self.above
    }

    /// The device, if it serves a world of these volumes.
    pub(super) fn serving(
        &mut self,
        volumes: &[Volume],
    ) -> Result<Option<&mut OpenedDevice>, DeviceError> {
        if !self.serves_volumes(volumes) {
            return Ok(None);
        }
        if let Opening::Closed(adapter) = &self.opening {
            self.opening = Opening::Open(OpenedDevice::new(Device::open(adapter)?));
        }
        match &mut self.opening {
            Opening::Open(opened) => Ok(Some(opened)),
            Opening::Processor | Opening::Closed(_) => Ok(None),
        }
    }
}

/// A whole volume dries if at least this share of the surface below it lies within the radius that
/// dries.
const SHARE: f32 = 0.5;

impl World {
    /// Dries all paint on the scene. This freezes its shape and its amounts. If you pour wet paint
    /// later, it lies over the dry paint, in new volumes.
    pub fn dry(&mut self) {
        self.volumes.iter_mut().for_each(|volume| volume.dry = true);
        self.of_cell.fill(NONE);
        self.settled = false;
    }

    /// Dries the volumes that hold a place, in the unit of the scene, as [`World::dry`] does. This
    /// also dries volumes with half of the surface below their paint within `radius` of the place.
    /// Wet paint beside them flows on, also over them. Returns how many dried.
    ///
    /// # Errors
    /// If the radius or a coordinate of the place is out of its range.
    pub fn dry_within(&mut self, place: Vec3, radius: f32) -> Result<usize, WorldError> {
        in_range("radius", radius.into(), [1e-15, 1e15], "above 0")?;
        for along in place.to_array() {
            in_range("at", along.into(), [-1e15, 1e15], "finite")?;
        }
        let mut dried = 0;
        for index in 0..self.volumes.len() {
            if self.volumes[index].dry || !self.is_below(index, place, radius) {
                continue;
            }
            let volume = &mut self.volumes[index];
            volume.dry = true;
            if let Some(cell) = volume.cell {
                self.of_cell[cell as usize] = NONE;
            }
            dried += 1;
        }
        self.settled &= dried == 0;
        Ok(dried)
    }

    fn is_below(&self, index: usize, place: Vec3, radius: f32) -> bool {
        let volume = &self.volumes[index];
        let reach = volume.radius.max(2.0 * self.scale.cell);
        if volume.center.distance(place) > radius + reach {
            return false;
        }
        let share = self.share_below(index, |at| at.distance(place) < radius);
        share >= SHARE || Inside::of(volume).holds(place)
    }
}

/// A volume begins at most this share of the giver's radius from the giver's centre. Usually even
/// the deepest dents of the giver lie farther out, so you do not see it begin.
const HIDDEN: f32 = 0.7;

/// Level of detail of the volumes of the grid.
const DETAIL: u8 = 2;

impl World {
    /// The wet volume in a cell. If there is none, begins one at `place` in the region.
    pub(super) fn volume_in(
        &mut self,
        cell: usize,
        place: Vec3,
        region: u16,
    ) -> Result<usize, WorldError> {
        if self.of_cell[cell] != NONE {
            return Ok(self.of_cell[cell] as usize);
        }
        let index = self.begin(place, BIRTH * self.scale.cell, DETAIL)?;
        let volume = &mut self.volumes[index];
        volume.cell = Some(cell as u32);
        volume.region = region;
        volume.normal = self.grid.cells.normals[cell];
        volume.body = self.grid.bodies.of_cells[cell];
        self.of_cell[cell] = index as u32;
        Ok(index)
    }

    /// Begins the volume of a cell that paint reaches from a neighbour. It begins inside of the
    /// giver's volume. Then it moves to where it enters its cell, no faster than volumes grow.
    /// This way you see paint only where it has soaked to.
    fn soak(&mut self, cell: usize, giver: usize) -> Result<(), WorldError> {
        let Volume { center, radius, region, .. } = self.volumes[self.of_cell[giver] as usize];
        let Grid { cells, reach, .. } = &*self.grid;
        let full = reach.radius(giver, cells.capacities[giver], 0.0);
        let mut entrance = self.grid.entrance(cell, cells.centers[giver]);
        if entrance.distance(cells.centers[giver]) > full {
            // The giver never gets there, but its own surface does.
            entrance = self.grid.entrance(giver, entrance);
        }
        let begin = center + (entrance - center).clamp_length_max(HIDDEN * radius);
        let index = self.volume_in(cell, begin, region)?;
        self.volumes[index].target_center = entrance;
        Ok(())
    }

    /// Takes one step of spilling between all wet volumes of the grid.
    pub(super) fn spill(&mut self, device: Option<&mut OpenedDevice>) -> Result<(), WorldError> {
        if self.settled {
            return Ok(());
        }
        let grid = std::sync::Arc::clone(&self.grid);
        let mut reached = Vec::new();
        let mut over = false;
        for volume in self.volumes.iter().filter(|volume| !volume.dry) {
            let Some(cell) = volume.cell.map(|cell| cell as usize) else { continue };
            if volume.paint.volume() > grid.cells.capacities[cell] {
                over = true;
                let others = grid.graph.links(cell).map(|link| grid.graph.others[link]);
                reached.extend(others.filter(|&other| self.of_cell[other as usize] == NONE));
            }
        }
        if !over {
            return Ok(());
        }
        self.paint.fill(Cell::default());
        for volume in self.volumes.iter().filter(|volume| !volume.dry) {
            if let Some(cell) = volume.cell {
                self.paint[cell as usize] = volume.paint;
            }
        }
        reached.sort_unstable();
        reached.dedup();
        // Near the limit, paint stays where it is wet.
        let births = self.has_room(reached.len(), DETAIL).is_ok();
        let born = match device {
            None => {
                let cells = (&grid.graph, &grid.cells);
                self.spilling.step(cells, &mut self.paint, births)
            }
            Some(OpenedDevice { device, spilling, .. }) => {
                spilling.step(device, (&self.spilling, &grid), &mut self.paint, births)?
            }
        };
        for birth in born {
            let cell = birth.cell as usize;
            let giver = birth.giver as usize;
            self.soak(cell, giver)?;
        }
        let mut settled = true;
        for index in 0..self.volumes.len() {
            let Some(cell) = self.volumes[index].cell.filter(|_| !self.volumes[index].dry) else {
                continue;
            };
            let now = self.paint[cell as usize];
            if now != self.volumes[index].paint {
                self.set_paint(index, now);
                settled = false;
            }
        }
        self.settled = settled;
        Ok(())
    }

    /// Gives a volume of the grid its paint. As the cell fills, this moves the centre from where
    /// the volume enters towards the middle of its cell. The volume of a full cell holds all its
    /// surface.
    pub(super) fn set_paint(&mut self, index: usize, paint: Cell) {
        let Some(cell) = self.volumes[index].cell.map(|cell| cell as usize) else { return };
        let capacity = self.grid.cells.capacities[cell].max(1) as f32;
        let volume = &mut self.volumes[index];
        // We take the square. A ball that is as wide as its paint then ends where the paint of its
        // cell ends.
        let [before, now] = [volume.paint, paint].map(|paint: Cell| {
            let share = (paint.volume() as f32 / capacity).min(1.0);
            share * share
        });
        if now > before {
            let way = self.grid.cells.centers[cell] - volume.target_center;
            let share = if now < 1.0 { (now - before) / (1.0 - before) } else { 1.0 };
            if self.grid.cells.capacities[cell] > 0 {
                volume.target_center += way * share;
            }
        }
        volume.paint = paint;
        self.settled = false;
        volume.target_radius = match paint.volume() {
            0 => 0.0,
            amount => {
                let roughness = self.settings.motion.microstructure;
                let radius = self.grid.reach.radius(cell, amount, roughness);
                radius.max(BIRTH * self.scale.cell)
            }
        };
        volume.rests_under = 0;
    }
}
