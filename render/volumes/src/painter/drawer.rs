//! What a camera sees of a scene and which volumes hold it, before a picture is composed.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::compute::{ColorImage, Compute, Image};
use graphics::field::Field;
use graphics::mesh::Mesh;
use graphics::surface::{
    Crossings, Fragment, InsideCounter, Model, NO_TRIANGLE, PackedMesh, Rasteriser, Sides,
    SurfacePoint, VisibilityBuffer,
};

use super::averaged::averaged;
use super::error::PaintingError;
use super::films::Films;
use super::looks::{self, RegionLook};
use super::region_counts::{RegionSurfaces, Volumes};
use crate::drawing::{DrawingLook, Inside, Region, TintTable, reveal, shade, shade_apart};
use crate::hatching::{Hatching, ThresholdTexture};
use crate::pigments::{Drawing, Facets, FilmHeights, SeenPlaces};
use crate::script::RegionStyle;
use crate::settings::Settings;
use crate::world::World;

/// Most samples of a picture.
const MOST_SAMPLES: usize = 1 << 28;

/// Draws one scene with its volumes.
#[derive(Debug)]
pub(super) struct Drawer {
    /// Where pictures are made.
    compute: Compute,
    model: Model,
    packed: PackedMesh,
    facets: Facets,
    texture: ThresholdTexture,
    hatching: Hatching,
    /// The same in the processor's memory, for films and parts.
    host_hatching: Hatching,
    pub(super) settings: Settings,
    look: DrawingLook,
    pub(super) regions: Vec<RegionLook>,
    surfaces: Vec<RegionSurfaces>,
    counter: InsideCounter,
    crossings: Crossings,
}

/// What a camera sees, before volumes bring colour.
pub(super) struct Sight {
    pub(super) visible: Image<Fragment>,
    /// Colours lit, textured and hatched, each with its grey.
    pub(super) shaded: ColorImage,
    /// Volumes and shells that hold each sample, by region.
    pub(super) counts: Vec<Image<i32>>,
}

/// A painting's parts, one value for each pixel.
pub(super) struct Parts {
    /// Colours lit and textured but not hatched, each with its grey.
    pub(super) color: Field<[f32; 4]>,
    pub(super) cover: Field<f32>,
    pub(super) ink: Field<f32>,
    /// Share of the scene's own colours.
    pub(super) tint: Field<f32>,
    pub(super) heights: Field<FilmHeights>,
}

impl Parts {
    pub(super) fn drawing(&self) -> Drawing<'_> {
        Drawing {
            color: &self.color,
            cover: Some(&self.cover),
            ink: Some(&self.ink),
            tint: Some(&self.tint),
            films: Some(&self.heights),
        }
    }
}

impl Drawer {
    pub(super) fn new(
        scene: &Mesh,
        settings: &Settings,
        styles: &[RegionStyle],
    ) -> Result<Self, PaintingError> {
        scene.check()?;
        let packed = PackedMesh::new(scene);
        let mut compute = Compute::cpu();
        let texture = ThresholdTexture::new(u64::from(settings.seed));
        let host_hatching = Hatching::new(&mut compute, &texture, &packed)?;
        let regions: Result<Vec<_>, _> = styles.iter().map(RegionLook::of).collect();
        let regions = regions?;
        let look = looks::drawing_look(settings);
        look.check()?;
        Ok(Self {
            model: Model::new(&mut compute, packed.clone())?,
            hatching: host_hatching.clone(),
            host_hatching,
            texture,
            facets: Facets::of(&packed),
            packed,
            look,
            settings: settings.clone(),
            surfaces: vec![RegionSurfaces::default(); regions.len()],
            regions,
            counter: InsideCounter::default(),
            crossings: Crossings::default(),
            compute,
        })
    }

    /// Draws on another device.
    pub(super) fn on(self, mut compute: Compute) -> Result<Self, PaintingError> {
        let model = Model::new(&mut compute, self.packed.clone())?;
        let hatching = Hatching::new(&mut compute, &self.texture, &self.packed)?;
        Ok(Self { model, hatching, counter: InsideCounter::default(), compute, ..self })
    }

    pub(super) fn compute_name(&self) -> &str {
        self.compute.name()
    }

    /// Draws with other settings of light, grey, hatching, paper and gate.
    pub(super) fn set(&mut self, settings: &Settings) -> Result<(), PaintingError> {
        let look = looks::drawing_look(settings);
        look.check()?;
        (self.look, self.settings) = (look, settings.clone());
        Ok(())
    }

    /// What `camera` sees in a picture of `size`.
    pub(super) fn sight(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Sight, PaintingError> {
        let (width, height) = self.samples(size)?;
        let visible = self.model.visible(&mut self.compute, camera, width, height)?;
        let (look, hatching) = (&self.look, &self.hatching);
        let shaded = shade(&mut self.compute, &self.model, &visible, camera, look, hatching)?;
        let counts = self.counts(world, &visible, camera)?;
        Ok(Sight { visible, shaded, counts })
    }

    /// The counts of all regions.
    fn counts(
        &mut self,
        world: &World,
        visible: &Image<Fragment>,
        camera: &Camera,
    ) -> Result<Vec<Image<i32>>, PaintingError> {
        let facing = world.facing();
        let all = Volumes { volumes: world.volumes(), facing: &facing };
        self.check_regions(all)?;
        let seen = match &self.compute {
            Compute::Cpu => Some(SeenPlaces::of(&self.packed, &self.facets, visible.host())),
            Compute::Gpu(_) => None,
        };
        let mut counts = Vec::with_capacity(self.regions.len());
        for (number, region) in self.regions.iter().enumerate() {
            let surfaces = &mut self.surfaces[number];
            surfaces.update(all, number, region);
            counts.push(match &seen {
                Some(seen) => {
                    let gate = self.settings.drawing.gate;
                    surfaces.gated(&mut self.crossings, (seen, camera), gate).into()
                }
                None => {
                    let scene = (&self.model, visible);
                    surfaces.counts(&mut self.compute, &mut self.counter, scene, camera)?
                }
            });
        }
        Ok(counts)
    }

    /// The picture of a sight, with the volumes of `regions`.
    pub(super) fn revealed(
        &mut self,
        sight: &Sight,
        regions: &[Region],
        paper: Option<[f32; 3]>,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        let Sight { visible, shaded, .. } = sight;
        let samples = self.look.samples;
        let picture = reveal(&mut self.compute, shaded, visible, regions, paper, samples)?;
        Ok(self.compute.download(&picture)?)
    }

    /// The regions of a sight.
    pub(super) fn regions_of(&self, sight: &Sight) -> Vec<Region> {
        let regions = self.regions.iter().zip(&sight.counts);
        let region = |(look, counts): (&RegionLook, &Image<i32>)| Region {
            counts: counts.clone(),
            table: look.shells.table().clone(),
            inside: Inside::OwnColors,
        };
        regions.map(region).collect()
    }

    /// Colour of the paper, encoded sRGB.
    pub(super) fn paper(&self) -> [f32; 3] {
        looks::paper(&self.settings)
    }

    /// Samples along each side of a pixel.
    pub(super) fn samples_a_pixel(&self) -> usize {
        self.look.samples
    }

    /// An image in the memory of whatever draws.
    pub(super) fn uploaded<T: bytemuck::Pod>(
        &mut self,
        field: &Field<T>,
    ) -> Result<Image<T>, PaintingError> {
        Ok(self.compute.upload(field)?)
    }

    /// The values of an image.
    pub(super) fn downloaded<T: bytemuck::Pod>(
        &mut self,
        image: &Image<T>,
    ) -> Result<Field<T>, PaintingError> {
        Ok(self.compute.download(image)?)
    }

    /// What `camera` sees, on the processor.
    fn seen(
        &self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<VisibilityBuffer, PaintingError> {
        let (width, height) = self.samples(size)?;
        let mut visible = Field::filled(width, height, Fragment::EMPTY);
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        let PackedMesh { vertices, triangles, .. } = &self.packed;
        let mut rasteriser = Rasteriser::default();
        rasteriser.draw(clip_from_model, vertices, triangles, Sides::Both, &mut visible);
        Ok(visible)
    }

    /// The ink of the strokes at each sample, at full strength, 0 to 1.
    pub(super) fn ink(
        &self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Field<f32>, PaintingError> {
        let visible = self.seen(camera, size)?;
        let hatching = &self.host_hatching;
        Ok(shade_apart(&self.packed, &visible, camera, &self.look, hatching)?.1)
    }

    /// A picture of the strokes alone, in the grey of the pencil on white.
    pub(super) fn strokes(
        &self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        let ink = averaged(self.ink(camera, size)?, self.look.samples);
        let darker = 1.0 - self.look.hatching.pencil;
        let stroke = |&ink: &f32| {
            let grey = 1.0 - ink * darker;
            [grey, grey, grey, 1.0]
        };
        let values = ink.values().iter().map(stroke).collect();
        Ok(Field::from_values(ink.width(), ink.height(), values))
    }

    /// Place and normal that each sample shows; zeros where nothing is seen.
    pub(super) fn surfaces_seen(
        &self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<[Field<[f32; 3]>; 2], PaintingError> {
        let visible = self.seen(camera, size)?;
        let of = |value: &dyn Fn(SurfacePoint<'_>) -> Vec3| {
            let values = visible.values().iter().map(|seen| match seen.triangle {
                NO_TRIANGLE => [0.0; 3],
                _ => value(SurfacePoint::new(&self.packed, *seen)).to_array(),
            });
            Field::from_values(visible.width(), visible.height(), values.collect())
        };
        Ok([of(&|point| point.position()), of(&|point| point.normal(camera.eye))])
    }

    /// What each pixel shows, on the processor, and where that is; no numbers where nothing is seen.
    pub(super) fn places(
        &self,
        camera: &Camera,
        (width, height): (usize, usize),
    ) -> Result<(VisibilityBuffer, Field<Vec3>), PaintingError> {
        self.samples((width, height))?;
        let mut visible = Field::filled(width, height, Fragment::EMPTY);
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        let PackedMesh { vertices, triangles, .. } = &self.packed;
        let mut rasteriser = Rasteriser::default();
        rasteriser.draw(clip_from_model, vertices, triangles, Sides::Both, &mut visible);
        let places = SeenPlaces::of(&self.packed, &self.facets, &visible).places;
        Ok((visible, places))
    }

    /// The parts of a painting with `films`, on the processor.
    pub(super) fn parts(
        &mut self,
        films: &mut Films,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Parts, PaintingError> {
        let (width, height) = self.samples(size)?;
        let visible = &self.seen(camera, size)?;
        let hatching = &self.host_hatching;
        let (color, ink) = shade_apart(&self.packed, visible, camera, &self.look, hatching)?;
        let seen = SeenPlaces::of(&self.packed, &self.facets, visible);
        let facing = world.facing();
        let all = Volumes { volumes: world.volumes(), facing: &facing };
        self.check_regions(all)?;
        let mut tint = Field::filled(width, height, 0.0);
        for (number, region) in self.regions.iter().enumerate() {
            if looks::has_own_colors(region.inside) {
                let surfaces = &mut self.surfaces[number];
                surfaces.update(all, number, region);
                let gate = self.settings.drawing.gate;
                let counts = surfaces.gated(&mut self.crossings, (&seen, camera), gate);
                lay_tint(&mut tint, &counts, region.shells.table());
            }
        }
        let sight = (&self.packed, visible, camera);
        let heights = films.heights(world, &self.regions, &self.settings, sight);
        let hatching = &self.look.hatching;
        let (inside, outside) = (hatching.inside, hatching.outside);
        let mut ink = ink;
        for (ink, tint) in ink.values_mut().iter_mut().zip(tint.values()) {
            *ink *= outside + (inside - outside) * tint;
        }
        let covered = visible.values().iter();
        let covered = covered.map(|seen| f32::from(u8::from(seen.triangle != NO_TRIANGLE)));
        let cover = Field::from_values(width, height, covered.collect());
        let samples = self.look.samples;
        Ok(Parts {
            color: averaged(color, samples),
            cover: averaged(cover, samples),
            ink: averaged(ink, samples),
            tint: averaged(tint, samples),
            heights: averaged(heights, samples),
        })
    }

    /// Width and height in samples.
    fn samples(&self, (width, height): (usize, usize)) -> Result<(usize, usize), PaintingError> {
        let sides = [width, height].map(|side| side.saturating_mul(self.look.samples));
        match sides[0].saturating_mul(sides[1]) {
            1..=MOST_SAMPLES => Ok(sides.into()),
            _ => {
                let most = MOST_SAMPLES / (self.look.samples * self.look.samples);
                Err(PaintingError::Size { most, width, height })
            }
        }
    }

    fn check_regions(&self, all: Volumes<'_>) -> Result<(), PaintingError> {
        let regions = self.regions.len();
        let mut indices = all.volumes.iter().map(|volume| usize::from(volume.region));
        match indices.find(|&region| region >= regions) {
            None => Ok(()),
            Some(region) => Err(PaintingError::Region { region, regions }),
        }
    }
}

/// Lays the tint of a region over those before it.
fn lay_tint(tint: &mut Field<f32>, counts: &Field<i32>, table: &TintTable) {
    for (below, &count) in tint.values_mut().iter_mut().zip(counts.values()) {
        *below += (1.0 - *below) * table.tint(count);
    }
}
