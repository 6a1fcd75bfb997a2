//! Converts volumes, their meshes and the forces on them for the kernel of a step.

use glam::Vec3;
use graphics::gpu::{Kernel, Storage, layout};

use super::forces::damping;
use super::star::{LEAST_SHARE, RestingRadii};
use super::step::{Acting, Conditions};
use super::surface_lattice::{BOXES, SurfaceLattice};
use crate::volume::{MOST_DETAIL, SphereMesh, Volume};

#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct StepParams {
    lattice_low: [f32; 3],
    boxes: f32,
    lattice_sides: [u32; 3],
    places_from: u32,
    pressure: f32,
    elastic: f32,
    cohesion: f32,
    keep: f32,
    pull: f32,
    cell: f32,
    inset: f32,
    seconds: f32,
    damping: f32,
    still: f32,
    height: f32,
    units: f32,
    boxes_from: u32,
    samples: u32,
    sub_steps: u32,
    seed: u32,
    weakest: f32,
    stills_from: u32,
    padding: [u32; 2],
}

impl StepParams {
    pub(super) fn new(
        conditions: Conditions<'_>,
        lattice: Option<&PackedLattice>,
        particles: usize,
    ) -> Self {
        let Conditions { settings, surroundings, count, seconds, .. } = conditions;
        let none = PackedLattice::default();
        let lattice = lattice.unwrap_or(&none);
        let microstructure = surroundings.microstructure;
        let radii = RestingRadii::new(microstructure, settings, surroundings.cell, [0.0; 3], 1.0);
        Self {
            lattice_low: lattice.low,
            boxes: lattice.boxes,
            lattice_sides: lattice.sides,
            places_from: lattice.places_from,
            pressure: settings.pressure,
            elastic: settings.elastic,
            cohesion: settings.cohesion,
            keep: settings.keep,
            pull: settings.surface_pull,
            cell: surroundings.cell,
            inset: conditions.inset(),
            seconds,
            damping: damping(settings.friction, seconds),
            still: conditions.still(),
            height: radii.height,
            units: radii.units,
            boxes_from: lattice.boxes_from,
            samples: lattice.samples,
            sub_steps: count,
            seed: radii.hills.seed(),
            weakest: conditions.weakest(),
            stills_from: particles as u32,
            padding: [0; 2],
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct MovedVolume {
    constant: [f32; 3],
    scale: f32,
    least_cone: f32,
    first: u32,
    count: u32,
    neighbours: u32,
    faces: u32,
    face_count: u32,
    balls: u32,
    pushes: u32,
    push_count: u32,
    regions: u32,
    region_count: u32,
    padding: u32,
}

impl MovedVolume {
    /// The particles of `volume` begin at `first`. This appends its centres and radii in all
    /// sub-steps, its pushes and its regions to `numbers`. We compute centres and radii here and
    /// not on the device, so that volumes vanish in the same step as without a device.
    pub(super) fn new(
        (volume, acting): (&Volume, &Acting),
        conditions: Conditions<'_>,
        first: usize,
        numbers: &mut Vec<f32>,
    ) -> Self {
        let mesh = volume.mesh();
        let (neighbours, faces) = places_of_sphere(volume.detail);
        let balls = numbers.len() as u32;
        let mut ball = (volume.center, volume.radius);
        for _ in 0..conditions.count {
            ball = acting.moved(ball, volume, conditions);
            numbers.extend(ball.0.to_array());
            numbers.push(ball.1);
        }
        let pushes = numbers.len() as u32;
        for push in &acting.pushes {
            numbers.extend(push.center.to_array());
            numbers.push(push.radius);
            numbers.extend(push.direction.to_array());
            numbers.push(push.strength);
        }
        let regions = numbers.len() as u32;
        for region in &acting.regions {
            numbers.extend(region.numbers());
            numbers.push(0.0);
        }
        Self {
            constant: acting.constant.to_array(),
            scale: 1.0 / mesh.inradius,
            least_cone: LEAST_SHARE * mesh.least_cone,
            first: first as u32,
            count: mesh.directions.len() as u32,
            neighbours,
            faces,
            face_count: mesh.faces.len() as u32,
            balls,
            pushes,
            push_count: acting.pushes.len() as u32,
            regions,
            region_count: acting.regions.len() as u32,
            padding: 0,
        }
    }

    pub(super) fn last_ball(&self, numbers: &[f32]) -> Option<(Vec3, f32)> {
        let balls = numbers[self.balls as usize..self.pushes as usize].as_chunks().0;
        balls.last().map(|&[x, y, z, radius]| (Vec3::new(x, y, z), radius))
    }

    pub(super) fn particles(&self) -> std::ops::Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct MovedParticle {
    place: [f32; 3],
    distance: f32,
    velocity: [f32; 3],
    sample: u32,
}

pub(super) fn pack(volume: &Volume, moved: &mut [MovedParticle]) {
    let [px, py, pz] = &volume.particles.places;
    let [vx, vy, vz] = &volume.particles.velocities;
    let samples = volume.particles.samples.iter().copied().chain(std::iter::repeat(u32::MAX));
    for ((i, moved), sample) in moved.iter_mut().enumerate().zip(samples) {
        let place = [px[i], py[i], pz[i]];
        let velocity = [vx[i], vy[i], vz[i]];
        *moved = MovedParticle { place, distance: 0.0, velocity, sample };
    }
}

pub(super) fn unpack(moved: &[MovedParticle], volume: &mut Volume) {
    let particles = &mut volume.particles;
    particles.samples.resize(moved.len(), u32::MAX);
    let [px, py, pz] = &mut particles.places;
    let [vx, vy, vz] = &mut particles.velocities;
    for (i, moved) in moved.iter().enumerate() {
        [px[i], py[i], pz[i]] = moved.place;
        [vx[i], vy[i], vz[i]] = moved.velocity;
        particles.samples[i] = moved.sample;
    }
}

/// Directions of the finest sphere as bits, three each, which all other spheres share. Then six
/// neighbours per vertex and three corners per face of every sphere.
pub(super) fn words_of_spheres() -> Vec<u32> {
    let finest = SphereMesh::of_detail(MOST_DETAIL);
    let mut words: Vec<u32> =
        finest.directions.as_flattened().iter().map(|along| along.to_bits()).collect();
    for mesh in (0..=MOST_DETAIL).map(SphereMesh::of_detail) {
        words.extend(mesh.neighbours.as_flattened());
        words.extend(mesh.faces.as_flattened());
    }
    words
}

fn places_of_sphere(detail: u8) -> (u32, u32) {
    fn sizes(detail: u8) -> (u32, u32) {
        let fours = 4_u32.pow(detail.into());
        (6 * (10 * fours + 2), 60 * fours)
    }
    let before = (0..detail).map(sizes).map(|(neighbours, faces)| neighbours + faces);
    let directions = sizes(MOST_DETAIL).0 / 2;
    let neighbours = directions + before.sum::<u32>();
    (neighbours, neighbours + sizes(detail).0)
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct PackedLattice {
    low: [f32; 3],
    boxes: f32,
    sides: [u32; 3],
    boxes_from: u32,
    places_from: u32,
    samples: u32,
}

impl PackedLattice {
    pub(super) fn new(lattice: &SurfaceLattice) -> (Self, Vec<u32>) {
        let SurfaceLattice { cell, low, counts, tables, boxes, places, .. } = lattice;
        let mut words = Vec::with_capacity(tables.len() + boxes.len() + 3 * places.len());
        words.extend_from_slice(tables);
        words.extend_from_slice(boxes);
        words.extend(places.iter().flat_map(|place| place.to_array()).map(f32::to_bits));
        let packed = Self {
            low: low.to_array(),
            boxes: BOXES as f32 / cell,
            sides: counts.map(|count| count as u32),
            boxes_from: tables.len() as u32,
            places_from: (tables.len() + boxes.len()) as u32,
            samples: places.len() as u32,
        };
        (packed, words)
    }
}

pub(crate) static STEP: Kernel = Kernel {
    name: "volumes_step",
    source: concat!(
        include_str!("microstructure.wgsl"),
        include_str!("surroundings.wgsl"),
        include_str!("step.wgsl")
    ),
    parameters: layout!(StepParams {
        lattice_low,
        boxes,
        lattice_sides,
        places_from,
        pressure,
        elastic,
        cohesion,
        keep,
        pull,
        cell,
        inset,
        seconds,
        damping,
        still,
        height,
        units,
        boxes_from,
        samples,
        sub_steps,
        seed,
        weakest,
        stills_from,
        padding
    }),
    structs: &[
        layout!(MovedVolume {
            constant,
            scale,
            least_cone,
            first,
            count,
            neighbours,
            faces,
            face_count,
            balls,
            pushes,
            push_count,
            regions,
            region_count,
            padding
        }),
        layout!(MovedParticle { place, distance, velocity, sample }),
    ],
    storage: &[
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Read,
        Storage::Write,
        Storage::Write,
        Storage::Write,
    ],
};
