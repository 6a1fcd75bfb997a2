//! Meshes to watercolors, frame by frame.

use std::path::Path;
use std::sync::Arc;

use super::pipeline::{Controls, FrameTextures, StageObserver, Wash, WashImages, paint};
use super::settings::{CoherenceMethod, CoherenceSettings, Settings};
use super::shadow_map::ShadowMap;
use super::textures::{BrushTouch, PaperTexture, PaperTextureError, TextureImages, Textures};
use super::toon::{Toon, shade_toon};
use documents::hint::Explain;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::coherence::{
    AnchoredNoise, FeatureNoise, Features, Hierarchy, Particles, Projection, depths, draw_anchored,
    repeating_noise,
};
use graphics::compute::{ColorImage, Compute, GreyImage};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::mesh::Mesh;
use graphics::surface::{Model, PackedMesh};
use graphics::tones::{ToneRamp, ToneRampError};
use spectra::color::Rgb;

/// Length of the waves in the textures that follow particles, in texels.
const WAVE_TEXELS: usize = 32;

/// Octaves of the grain, the finer of the two feature noises.
const GRAIN_OCTAVES: usize = 2;

/// Samples along each side of a pixel if you do not set them. This is enough for smooth
/// silhouettes.
const USUAL_SAMPLES: usize = 2;

/// Least and greatest width and height of the map of cast shadows, in pixels. Between these limits
/// it is as large as the picture.
const LEAST_SHADOW_PX: usize = 512;
const MOST_SHADOW_PX: usize = 2048;

/// Paints one mesh from any camera, in pictures of one size. For example:
///
/// ```
/// use graphics::camera::Framing;
/// use graphics::compute::Compute;
/// use graphics::mesh::Mesh;
/// use watercolor::{ModelPainter, Settings};
///
/// let mesh = Mesh::sphere(200);
/// let camera = Framing::default().fit(&mesh.positions);
/// let mut painter = ModelPainter::new(Compute::cpu(), mesh, &Settings::default(), (32, 24))?;
/// let picture = painter.paint(&camera)?;
/// assert_eq!((picture.width(), picture.height()), (32, 24));
/// # Ok::<(), watercolor::ModelPainterError>(())
/// ```
#[derive(Debug)]
pub struct ModelPainter {
    compute: Compute,
    model: Model,
    toon: Toon,
    /// Centre and radius of a sphere that the mesh lies in.
    sphere: (Vec3, f32),
    settings: Settings,
    textures: TextureImages,
    noise: Noise,
    controls: Controls,
    width: usize,
    height: usize,
}

/// How the textures follow the moving mesh. Pairs are flow and dispersion.
#[derive(Debug)]
enum Noise {
    /// The textures are fixed to the screen.
    Static,
    /// The textures follow particles of the mesh.
    Particles { particles: Particles, waves: [AnchoredNoise; 2], textures: [GreyImage; 2] },
    /// Each feature of the noise follows a point of the mesh.
    Features { features: [Features; 2], noises: [FeatureNoise; 2] },
}

/// The mesh as a camera sees it, shaded but without effects.
struct ShadedFrame {
    /// Toon-shaded colour with coverage.
    color: ColorImage,
    /// Flow and dispersion of this frame. This is `None` if they do not move with the mesh.
    noise: Option<[GreyImage; 2]>,
}

impl ModelPainter {
    /// Paints `mesh` in pictures of `width` x `height` pixels. We adapt the lengths of `settings`
    /// to this size ([`Settings::for_size`]).
    ///
    /// # Errors
    /// [`ModelPainterError`] if the paper's scan or the picture of greys cannot be read, or
    /// the device has no memory left.
    pub fn new(
        mut compute: Compute,
        mut mesh: Mesh,
        settings: &Settings,
        (width, height): (usize, usize),
    ) -> Result<Self, ModelPainterError> {
        let settings = settings.for_size(width, height);
        let toon = &settings.toon;
        mesh.normals = mesh.smoothed_normals(toon.smoothing_rounds as usize);
        let toon = Toon {
            light: DistantLight::with_camera(toon.light_azimuth_deg, toon.light_elevation_deg),
            tones: match &toon.greys {
                Some(path) => ToneRamp::open(Path::new(path))?,
                None => ToneRamp::steps(toon.levels as usize, toon.softness),
            },
            strength: toon.strength,
            shadow: toon.shadow,
            shadow_color: Rgb::from_hex(&toon.shadow_color)
                .map_or([1.0; 3], |color| color.0.map(|value| value as f32)),
            samples: USUAL_SAMPLES,
        };
        let textures = Textures::new(width, height, &settings)?.upload(&mut compute)?;
        let noise = Noise::new(&mut compute, &mesh, &settings)?;
        let [low, high] = mesh.bounds();
        let sphere = ((low + high) / 2.0, low.distance(high) / 2.0);
        let model = Model::new(&mut compute, PackedMesh::new(&mesh))?;
        let controls = Controls::default();
        Ok(Self {
            compute,
            model,
            toon,
            sphere,
            settings,
            textures,
            noise,
            controls,
            width,
            height,
        })
    }

    /// Averages `samples` x `samples` samples for each pixel, at least 1. Without this there are 2
    /// x 2.
    #[must_use]
    pub fn with_samples(mut self, samples: usize) -> Self {
        self.toon.samples = samples.max(1);
        self
    }

    /// Makes effects weaker in parts of the picture, from the next frame on.
    ///
    /// # Panics
    /// If the controls do not have the size of the picture.
    pub fn set_controls(&mut self, controls: Controls) {
        for control in controls.dry_brush.iter().chain(&controls.density) {
            let found = (control.width(), control.height());
            let size = (self.width, self.height);
            assert_eq!(found, size, "a control must have the size of the picture");
        }
        self.controls = controls;
    }

    /// The settings for the size of the pictures.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The paper, which does not move.
    #[must_use]
    pub fn paper(&self) -> &PaperTexture {
        &self.textures.paper.texture
    }

    /// Width and height of the pictures in pixels.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Name of the device that computes: `cpu`, or the name of a graphics adapter.
    #[must_use]
    pub fn compute_name(&self) -> &str {
        self.compute.name()
    }

    /// Paints the mesh as `camera` sees it. The picture is encoded sRGB, covered everywhere.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn paint(&mut self, camera: &Camera) -> Result<Field<[f32; 4]>, DeviceError> {
        self.paint_stages(camera, None)
    }

    /// Paints the mesh as `camera` sees it. We call `observer` with the picture after each stage.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn paint_stages(
        &mut self,
        camera: &Camera,
        observer: Option<StageObserver<'_>>,
    ) -> Result<Field<[f32; 4]>, DeviceError> {
        let ShadedFrame { color, noise } = self.shaded(camera)?;
        let wash = WashImages::new(&mut self.compute, color, &self.controls)?;
        let mut textures = FrameTextures::from(&self.textures);
        if let Some([flow, dispersion]) = &noise {
            (textures.flow, textures.dispersion) = (flow, dispersion);
        }
        let color = paint(&mut self.compute, wash, textures, &self.settings, observer)?;
        self.compute.download(&color)
    }

    /// The shaded mesh and the textures of this frame in the processor's memory. You need them for
    /// glazes ([`super::GlazePainter::paint`]).
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn wash(&mut self, camera: &Camera) -> Result<(Wash, Textures), DeviceError> {
        let ShadedFrame { color, noise } = self.shaded(camera)?;
        let TextureImages { flow, dispersion, paper, touch, .. } = &self.textures;
        let [flow, dispersion] = noise.as_ref().map_or([flow, dispersion], |[f, d]| [f, d]);
        let textures = Textures {
            flow: self.compute.download(flow)?,
            dispersion: self.compute.download(dispersion)?,
            paper: paper.texture.clone(),
            touch: match touch {
                Some((touch, quantiles)) => Some(BrushTouch {
                    touch: self.compute.download(touch)?,
                    quantiles: quantiles.clone(),
                }),
                None => None,
            },
            back_runs: None,
        };
        let color = self.compute.download(&color)?;
        Ok((Wash { color, controls: self.controls.clone() }, textures))
    }

    /// The colours of the surface without light, encoded sRGB with coverage.
    ///
    /// # Errors
    /// [`DeviceError`] if the device runs out of memory or is lost. This never happens on the
    /// processor.
    pub fn unlit(&mut self, camera: &Camera) -> Result<Field<[f32; 4]>, DeviceError> {
        let Self { compute, model, toon, width, height, .. } = self;
        let samples = toon.samples;
        let visible = model.visible(compute, camera, *width * samples, *height * samples)?;
        let unlit = Toon { strength: 0.0, ..toon.clone() };
        let color = shade_toon(compute, model, &visible, camera, &unlit, None)?;
        compute.download(&color)
    }

    fn shaded(&mut self, camera: &Camera) -> Result<ShadedFrame, DeviceError> {
        let Self { compute, model, toon, sphere, noise, width, height, .. } = self;
        let samples = toon.samples;
        let shadows = match toon.shadow {
            shadow if shadow > 0.0 && toon.strength > 0.0 => {
                let side = (*width).max(*height).clamp(LEAST_SHADOW_PX, MOST_SHADOW_PX);
                let light = toon.light.direction(camera);
                Some(ShadowMap::new(compute, model, light, *sphere, side)?)
            }
            _ => None,
        };
        let visible = model.visible(compute, camera, *width * samples, *height * samples)?;
        let color = shade_toon(compute, model, &visible, camera, toon, shadows.as_ref())?;
        if let Noise::Static = noise {
            return Ok(ShadedFrame { color, noise: None });
        }
        let visible = match samples {
            1 => visible,
            _ => model.visible(compute, camera, *width, *height)?,
        };
        let depth = depths(compute, &visible)?;
        let noise = noise.frame(compute, &depth, &Projection::new(camera, *width, *height))?;
        Ok(ShadedFrame { color, noise })
    }
}

impl Noise {
    fn new(compute: &mut Compute, mesh: &Mesh, settings: &Settings) -> Result<Self, DeviceError> {
        let CoherenceSettings { method, particles, octaves, feature_px, features_per_place } =
            settings.coherence;
        let seeds = [settings.flow.seed, settings.dispersion.seed];
        let octaves = octaves as usize;
        match method {
            CoherenceMethod::Static => Ok(Self::Static),
            CoherenceMethod::Particles => {
                let hierarchy = Hierarchy::new(mesh);
                let waves = [settings.flow.size_px, feature_px];
                Ok(Self::Particles {
                    particles: Particles::new(&hierarchy, particles as usize),
                    waves: [0, 1].map(|i: usize| AnchoredNoise {
                        wave_px: waves[i],
                        wave_texels: WAVE_TEXELS as f32,
                        octaves,
                        seed: seeds[i],
                    }),
                    textures: [
                        compute.upload(&repeating_noise(WAVE_TEXELS, seeds[0]))?,
                        compute.upload(&repeating_noise(WAVE_TEXELS, seeds[1]))?,
                    ],
                })
            }
            CoherenceMethod::Features => {
                let hierarchy = Arc::new(Hierarchy::new(mesh));
                // Features of the finest octave of the grain are as wide as the setting says.
                let grain_px = feature_px / 2.0 * (1 << (GRAIN_OCTAVES - 1)) as f32;
                let coverage = features_per_place;
                let largest_px = settings.flow.size_px / 2.0;
                let flow = FeatureNoise { largest_px, octaves, coverage, ..FeatureNoise::FLOW };
                let grain = FeatureNoise {
                    largest_px: grain_px,
                    octaves: GRAIN_OCTAVES,
                    coverage,
                    ..FeatureNoise::DISPERSION
                };
                // Flow and dispersion of one seed must not have the same features.
                let features = [seeds[0], seeds[1] ^ u64::MAX]
                    .map(|seed| Features::new(Arc::clone(&hierarchy), seed));
                Ok(Self::Features { features, noises: [flow, grain] })
            }
        }
    }

    /// Draws flow and dispersion for one view. Returns `None` if they do not move with the mesh.
    fn frame(
        &self,
        compute: &mut Compute,
        depth: &GreyImage,
        projection: &Projection,
    ) -> Result<Option<[GreyImage; 2]>, DeviceError> {
        match self {
            Self::Static => Ok(None),
            Self::Particles { particles, waves, textures } => {
                let flow = particles.anchors(projection, waves[0]);
                let flow = draw_anchored(compute, depth, &textures[0], &flow)?;
                let grain = particles.anchors(projection, waves[1]);
                let grain = draw_anchored(compute, depth, &textures[1], &grain)?;
                Ok(Some([flow, grain]))
            }
            Self::Features { features, noises } => {
                let flow = features[0].draw(compute, depth, projection, noises[0])?;
                let grain = features[1].draw(compute, depth, projection, noises[1])?;
                Ok(Some([flow, grain]))
            }
        }
    }
}

/// Why a mesh cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
pub enum ModelPainterError {
    /// The paper cannot be made.
    #[error(transparent)]
    Paper(#[from] PaperTextureError),
    /// The greys cannot be read.
    #[error(transparent)]
    ToneRamp(#[from] ToneRampError),
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}
