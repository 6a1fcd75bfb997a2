//! Draws the scene that a camera sees, and counts the volumes at each sample, for a picture that we
//! compose later. Also averages samples to pixels, and makes the parts of a painting in pigments.

use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, Image};
use graphics::field::Field;
use graphics::mesh::Mesh;
use graphics::surface::{Fragment, NO_TRIANGLE, PackedMesh};
use rayon::prelude::*;

use super::error::PaintingError;
use super::films::Films;
use super::in_sight::{self, InSight, LoadedScene, RegionLook, RegionSurfaces, Volumes};
use crate::drawing::{DrawingLook, Inside, Region, TintTable, reveal, shade, shade_apart};
use crate::hatching::ThresholdTexture;
use crate::pigments::{Drawing, Facets, FilmHeights};
use crate::script::RegionStyle;
use crate::settings::Settings;
use crate::world::World;

/// A picture has at most this many samples.
const MOST_SAMPLES: usize = 1 << 28;

/// A thread works on at least this many samples.
const SAMPLES: usize = 8192;

#[derive(Debug)]
pub(super) struct Drawer {
    /// The scene on the device that makes pictures.
    pub(super) scene: LoadedScene,
    /// The scene on the processor, which makes paintings. `None` if pictures are made there too.
    pub(super) host: Option<LoadedScene>,
    pub(super) packed: PackedMesh,
    pub(super) facets: Facets,
    texture: ThresholdTexture,
    pub(super) settings: Settings,
    pub(super) look: DrawingLook,
    pub(super) regions: Vec<RegionLook>,
    surfaces: Vec<RegionSurfaces>,
}

/// The view of a camera, before volumes bring colour.
pub(super) struct Sight {
    pub(super) visible: Image<Fragment>,
    pub(super) shaded: ColorImage,
    pub(super) counts: Vec<Image<i32>>,
}

impl Drawer {
    pub(super) fn new(
        scene: &Mesh,
        settings: &Settings,
        styles: &[RegionStyle],
    ) -> Result<Self, PaintingError> {
        scene.check()?;
        let packed = PackedMesh::new(scene);
        let facets = Facets::of(&packed);
        let texture = ThresholdTexture::new(u64::from(settings.seed));
        let regions: Result<Vec<_>, _> = styles.iter().map(RegionLook::of).collect();
        let regions = regions?;
        let look = in_sight::drawing_look(settings);
        look.check()?;
        Ok(Self {
            scene: LoadedScene::new(Compute::cpu(), &packed, &facets, &texture)?,
            host: None,
            texture,
            facets,
            packed,
            look,
            settings: settings.clone(),
            surfaces: vec![RegionSurfaces::default(); regions.len()],
            regions,
        })
    }

    pub(super) fn on(self, compute: Compute) -> Result<Self, PaintingError> {
        let scene = LoadedScene::new(compute, &self.packed, &self.facets, &self.texture)?;
        let host = [Some(self.scene), self.host].into_iter().flatten().find(LoadedScene::is_host);
        Ok(Self { scene, host, ..self })
    }

    pub(super) fn compute_name(&self) -> &str {
        self.scene.compute.name()
    }

    pub(super) fn set(&mut self, settings: &Settings) -> Result<(), PaintingError> {
        let look = in_sight::drawing_look(settings);
        look.check()?;
        (self.look, self.settings) = (look, settings.clone());
        Ok(())
    }

    pub(super) fn sight(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Sight, PaintingError> {
        let (width, height) = self.samples(size)?;
        let LoadedScene { compute, model, hatching, .. } = &mut self.scene;
        let visible = model.visible(compute, camera, width, height)?;
        let shaded = shade(compute, model, &visible, camera, &self.look, hatching)?;
        let counts = self.counts(world, &visible, camera)?;
        Ok(Sight { visible, shaded, counts })
    }

    /// Whether the processor counts the volumes that have gates, though another device makes the
    /// pictures.
    pub(super) fn counts_elsewhere(&self) -> bool {
        !self.scene.gates
    }

    /// The counts of all regions. If the device of the scene cannot count something, the processor
    /// counts it for the same samples.
    fn counts(
        &mut self,
        world: &World,
        visible: &Image<Fragment>,
        camera: &Camera,
    ) -> Result<Vec<Image<i32>>, PaintingError> {
        let facing = world.facing();
        let all = Volumes { volumes: world.volumes(), facing: &facing };
        check_regions(all, self.regions.len())?;
        self.scene.tell_bodies(&self.facets, &world.grid().bodies.of_triangles)?;
        let elsewhere = self.counts_elsewhere();
        let seen = match elsewhere {
            true => Some(Image::from(self.scene.compute.download(visible)?)),
            false => None,
        };
        if elsewhere {
            self.load_on_host()?;
        }
        if let Some(host) = self.host.as_mut().filter(|_| elsewhere) {
            host.tell_bodies(&self.facets, &world.grid().bodies.of_triangles)?;
        }
        let in_sight = InSight::new(camera, seen.as_ref().unwrap_or(visible));
        let gate = self.settings.drawing.gate;
        let mut counts = Vec::with_capacity(self.regions.len());
        for (region, surfaces) in self.regions.iter().enumerate().zip(&mut self.surfaces) {
            surfaces.update(all, region, gate, &in_sight);
            counts.push(match (&seen, &mut self.host) {
                (Some(seen), Some(host)) if surfaces.gated() => {
                    let counted = surfaces.counts(host, seen, camera)?;
                    self.scene.compute.upload(counted.host())?
                }
                _ => surfaces.counts(&mut self.scene, visible, camera)?,
            });
        }
        Ok(counts)
    }

    pub(super) fn revealed(
        &mut self,
        sight: &Sight,
        regions: &[Region],
        paper: Option<[f32; 3]>,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        let Sight { visible, shaded, .. } = sight;
        let samples = self.look.samples;
        let compute = &mut self.scene.compute;
        let picture = reveal(compute, shaded, visible, regions, paper, samples)?;
        Ok(compute.take(picture)?)
    }

    pub(super) fn regions_of(&self, sight: &Sight) -> Vec<Region> {
        let regions = self.regions.iter().zip(&sight.counts);
        regions
            .map(|(look, counts): (&RegionLook, &Image<i32>)| Region {
                counts: counts.clone(),
                table: look.shells.table().clone(),
                inside: Inside::OwnColors,
                stain: look.stain,
            })
            .collect()
    }

    pub(super) fn parts(
        &mut self,
        films: &mut Films,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Parts, PaintingError> {
        let (width, height) = self.samples(size)?;
        self.load_on_host()?;
        let host = self.host.as_mut().unwrap_or(&mut self.scene);
        host.tell_bodies(&self.facets, &world.grid().bodies.of_triangles)?;
        let LoadedScene { compute, model, hatching, .. } = &mut *host;
        let image = model.visible(compute, camera, width, height)?;
        let visible = image.host();
        let (color, ink) = shade_apart(&self.packed, visible, camera, &self.look, hatching)?;
        let facing = world.facing();
        let all = Volumes { volumes: world.volumes(), facing: &facing };
        check_regions(all, self.regions.len())?;
        let in_sight = InSight::new(camera, &image);
        let gate = self.settings.drawing.gate;
        let mut tint: Option<Field<f32>> = None;
        for (region, surfaces) in self.regions.iter().enumerate().zip(&mut self.surfaces) {
            if region.1.inside.has_own_colors() {
                surfaces.update(all, region, gate, &in_sight);
                let counts = surfaces.counts(host, &image, camera)?;
                let tint = tint.get_or_insert_with(|| Field::filled(width, height, 0.0));
                lay_tint(tint, counts.host(), region.1.shells.table());
            }
        }
        let sight = (&self.packed, visible, &in_sight, camera);
        let heights = films.heights(world, (&self.regions, &self.settings), sight);
        let mut ink = ink;
        let look = &self.look.hatching;
        match &tint {
            None => each(&mut ink, |ink, _| *ink *= look.outside),
            Some(tint) => each(&mut ink, |ink, sample| {
                *ink *= look.outside + (look.inside - look.outside) * tint.values()[sample];
            }),
        }
        let mut cover = Field::filled(width, height, 1.0);
        each(&mut cover, |cover, sample| {
            if visible.values()[sample].triangle == NO_TRIANGLE {
                *cover = 0.0;
            }
        });
        let samples = self.look.samples;
        Ok(Parts {
            color: averaged(color, samples),
            cover: averaged(cover, samples),
            ink: averaged(ink, samples),
            tint: tint.map(|tint| averaged(tint, samples)),
            heights: averaged(heights, samples),
        })
    }

    /// Copies the scene to the processor's memory, unless it is there already.
    pub(super) fn load_on_host(&mut self) -> Result<(), PaintingError> {
        if !self.scene.is_host() && self.host.is_none() {
            let host = Compute::cpu();
            self.host = Some(LoadedScene::new(host, &self.packed, &self.facets, &self.texture)?);
        }
        Ok(())
    }

    pub(super) fn samples(
        &self,
        (width, height): (usize, usize),
    ) -> Result<(usize, usize), PaintingError> {
        let sides = [width, height].map(|side| side.saturating_mul(self.look.samples));
        match sides[0].saturating_mul(sides[1]) {
            1..=MOST_SAMPLES => Ok(sides.into()),
            _ => {
                let most = MOST_SAMPLES / (self.look.samples * self.look.samples);
                Err(PaintingError::Size { most, width, height })
            }
        }
    }
}

fn check_regions(all: Volumes<'_>, regions: usize) -> Result<(), PaintingError> {
    let mut indices = all.volumes.iter().map(|volume| usize::from(volume.region));
    match indices.find(|&region| region >= regions) {
        None => Ok(()),
        Some(region) => Err(PaintingError::Region { region, regions }),
    }
}

fn lay_tint(tint: &mut Field<f32>, counts: &Field<i32>, table: &TintTable) {
    each(tint, |below, sample| {
        *below += (1.0 - *below) * table.tint(counts.values()[sample]);
    });
}

/// Changes each sample. `change` gets its index.
fn each(field: &mut Field<f32>, change: impl Fn(&mut f32, usize) + Sync) {
    let samples = field.values_mut().par_iter_mut().with_min_len(SAMPLES).enumerate();
    samples.for_each(|(index, sample)| change(sample, index));
}

/// A value that a pixel averages over its samples.
pub(super) trait Averaged: Copy + Send + Sync {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self;
}

impl<const N: usize> Averaged for [f32; N] {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        let mut sum = [0.0; N];
        for value in values {
            sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value);
        }
        sum.map(|sum| sum / count as f32)
    }
}

impl Averaged for f32 {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        values.sum::<Self>() / count as Self
    }
}

impl Averaged for FilmHeights {
    fn mean(values: impl Iterator<Item = Self>, count: usize) -> Self {
        let mut sum = [0_i64; 9];
        for value in values {
            sum.iter_mut().zip(value.0).for_each(|(sum, value)| *sum += i64::from(value));
        }
        Self(sum.map(|sum| (sum / count as i64) as i32))
    }
}

/// Averages over `samples` x `samples` values. The sides of the field must be multiples of
/// `samples`.
pub(super) fn averaged<T: Averaged>(field: Field<T>, samples: usize) -> Field<T> {
    if samples == 1 {
        return field;
    }
    let width = field.width() / samples;
    let height = field.height() / samples;
    let values = (0..width * height)
        .into_par_iter()
        .with_min_len(4096)
        .map(|index: usize| {
            let x = index % width * samples;
            let y = index / width * samples;
            let rows = (0..samples).flat_map(|line| field.row(y + line, x, samples));
            T::mean(rows.copied(), samples * samples)
        })
        .collect();
    Field::from_values(width, height, values)
}

pub(super) struct Parts {
    pub(super) color: Field<[f32; 4]>,
    pub(super) cover: Field<f32>,
    pub(super) ink: Field<f32>,
    /// Share of the scene's own colours at each pixel. `None` if no region shows them.
    pub(super) tint: Option<Field<f32>>,
    pub(super) heights: Field<FilmHeights>,
}

impl Parts {
    pub(super) fn drawing(&self) -> Drawing<'_> {
        Drawing {
            color: &self.color,
            cover: Some(&self.cover),
            ink: Some(&self.ink),
            tint: self.tint.as_ref(),
            films: Some(&self.heights),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tints_of_regions_are_laid_one_over_the_other() {
        let half = TintTable::new(vec![0.0, 0.5, 1.0]).unwrap();
        let mut tint = Field::filled(3, 1, 0.0);
        lay_tint(&mut tint, &Field::from_values(3, 1, vec![0, 1, 1]), &half);
        lay_tint(&mut tint, &Field::from_values(3, 1, vec![0, 1, 2]), &half);
        assert_eq!(tint.values(), [0.0, 0.75, 1.0]);
    }

    #[test]
    fn a_pixel_is_the_mean_of_its_samples() {
        let field = Field::from_values(4, 2, vec![0.0, 2.0, 1.0, 1.0, 4.0, 2.0, 1.0, 1.0]);
        assert_eq!(averaged(field.clone(), 2).values(), [2.0, 1.0]);
        assert_eq!(averaged(field.clone(), 1), field);
        let heights = [3, 5, 7, 9].map(|height| FilmHeights([height; 9]));
        let field = Field::from_values(2, 2, heights.to_vec());
        assert_eq!(averaged(field, 2).values(), [FilmHeights([6; 9])]);
    }
}
