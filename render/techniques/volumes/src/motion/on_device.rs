//! Moves all volumes over one step on a graphics device.

use std::sync::Arc;

use graphics::gpu::{Buffer, Device, DeviceError, Recording, Rows};
use rayon::prelude::*;

use super::device_form::{
    MovedParticle, MovedVolume, PackedLattice, STEP, StepParams, pack, unpack, words_of_spheres,
};
use super::settings::{MotionError, MotionSettings};
use super::step::{Acting, Conditions, conditions};
use super::surface_lattice::SurfaceLattice;
use super::surroundings::Surroundings;
use crate::device_memory::DeviceMemory;
use crate::volume::Volume;

/// The motion of volumes on a graphics device. It keeps its memory there from step to step. A
/// workgroup moves a volume.
///
/// The state of all volumes goes to the device and comes back in every step. So you have it whole
/// on the processor between steps.
#[derive(Debug, Default)]
pub struct DeviceMotion {
    spheres: Option<Buffer>,
    surface: Option<(Arc<SurfaceLattice>, PackedLattice, Buffer)>,
    volumes: DeviceMemory,
    numbers: DeviceMemory,
    particles: DeviceMemory,
    deviations: DeviceMemory,
    marks: DeviceMemory,
}

struct Moving {
    acting: Vec<(usize, Acting)>,
    moved: Vec<MovedVolume>,
    numbers: Vec<f32>,
    count: usize,
}

impl Moving {
    fn of(volumes: &[Volume], conditions: Conditions<'_>) -> Self {
        let mut moving = Self { acting: Vec::new(), moved: Vec::new(), numbers: vec![], count: 0 };
        for (index, volume) in volumes.iter().enumerate() {
            let Some(acting) = Acting::on(volume, conditions) else { continue };
            let first = moving.count;
            let numbers = &mut moving.numbers;
            moving.moved.push(MovedVolume::new((volume, &acting), conditions, first, numbers));
            moving.count += volume.mesh().directions.len();
            moving.acting.push((index, acting));
        }
        moving
    }

    fn particles(&self, volumes: &[Volume]) -> Vec<MovedParticle> {
        let mut particles = vec![bytemuck::Zeroable::zeroed(); self.count];
        let mut rest = particles.as_mut_slice();
        let mut parts = Vec::with_capacity(self.moved.len());
        for ((index, _), moved) in self.acting.iter().zip(&self.moved) {
            let (own, after) = rest.split_at_mut(moved.particles().len());
            parts.push((&volumes[*index], own));
            rest = after;
        }
        parts.into_par_iter().for_each(|(volume, own)| pack(volume, own));
        particles
    }

    fn end(
        &self,
        volumes: &mut [Volume],
        conditions: Conditions<'_>,
        (particles, stills): (&[MovedParticle], &[u32]),
    ) {
        let mut own = self.acting.iter().zip(&self.moved).zip(stills).peekable();
        let mut changed = Vec::with_capacity(self.moved.len());
        for (index, volume) in volumes.iter_mut().enumerate() {
            if let Some(own) = own.next_if(|(((moving, _), _), _)| *moving == index) {
                changed.push((volume, own));
            }
        }
        changed.into_par_iter().for_each(|(volume, (((_, acting), moved), still))| {
            unpack(&particles[moved.particles()], volume);
            if let Some(ball) = moved.last_ball(&self.numbers) {
                (volume.center, volume.radius) = ball;
            }
            acting.end(volume, *still == 1, conditions);
        });
    }
}

impl DeviceMotion {
    /// Moves all volumes like [`super::advance`], but on a graphics device. Centres and radii are
    /// the same to the bit. Particles agree with the processor's to rounding, which friction
    /// damps. You get the same bits on the same device.
    ///
    /// # Errors
    /// This fails like [`super::advance`]. If the device runs out of memory or fails, you get
    /// [`MotionError::Device`]. No volume has moved then.
    pub fn advance(
        &mut self,
        device: &mut Device,
        volumes: &mut [Volume],
        settings: &MotionSettings,
        surroundings: &Surroundings,
        seconds: f32,
    ) -> Result<u32, MotionError> {
        let Some(conditions) = conditions(volumes, settings, surroundings, seconds)? else {
            return Ok(0);
        };
        let moving = Moving::of(volumes, conditions);
        if moving.moved.is_empty() {
            return Ok(conditions.count);
        }
        let particles = moving.particles(volumes);
        let found = self.run(device, &moving, &particles, conditions)?;
        moving.end(volumes, conditions, (&found.0, &found.1));
        Ok(conditions.count)
    }

    /// Returns the particles after the step, and 1 for each volume that is still.
    fn run(
        &mut self,
        device: &mut Device,
        moving: &Moving,
        particles: &[MovedParticle],
        conditions: Conditions<'_>,
    ) -> Result<(Vec<MovedParticle>, Vec<u32>), DeviceError> {
        let count = moving.count;
        let volumes = moving.moved.len();
        let spheres = match &self.spheres {
            Some(spheres) => spheres.clone(),
            None => {
                let spheres = device.buffer_of("spheres", &words_of_spheres())?;
                self.spheres.insert(spheres).clone()
            }
        };
        let (lattice, surface) = self.surface(device, conditions)?;
        let params = StepParams::new(conditions, lattice.as_ref(), count);
        let stills = Rows { first: count, ..Rows::start(volumes) };
        let marks = self.marks.of_bytes(device, "marks", size_of::<u32>() * (count + volumes))?;
        device.write(&marks, stills, &vec![0_u32; volumes])?;
        let own = self.particles.holding(device, "particles", particles)?;
        let buffers = [
            &self.volumes.holding(device, "volumes", &moving.moved)?,
            &spheres,
            &self.numbers.holding(device, "radii and forces", &moving.numbers)?,
            &surface.unwrap_or_else(|| spheres.clone()),
            &own,
            &self.deviations.of_bytes(device, "deviations", size_of::<[f32; 4]>() * count)?,
            &marks,
        ];
        let mut recording = Recording::default();
        recording.dispatch(&STEP, &params, &buffers, [volumes as u32, 1, 1]);
        device.submit(&mut recording)?;
        Ok((device.read(&own, Rows::start(count))?, device.read(&marks, stills)?))
    }

    fn surface(
        &mut self,
        device: &mut Device,
        conditions: Conditions<'_>,
    ) -> Result<(Option<PackedLattice>, Option<Buffer>), DeviceError> {
        let pulls = conditions.settings.surface_pull > 0.0;
        let Some(lattice) = conditions.surroundings.surface.as_ref().filter(|_| pulls) else {
            return Ok((None, None));
        };
        if let Some((own, packed, buffer)) = &self.surface
            && Arc::ptr_eq(own, lattice)
        {
            return Ok((Some(*packed), Some(buffer.clone())));
        }
        self.surface = None;
        let (packed, words) = PackedLattice::new(lattice);
        let buffer = device.buffer_of("samples of the surface", &words)?;
        self.surface = Some((Arc::clone(lattice), packed, buffer.clone()));
        Ok((Some(packed), Some(buffer)))
    }
}
