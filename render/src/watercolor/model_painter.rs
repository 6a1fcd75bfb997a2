//! Meshes to watercolors, picture after picture.

use std::path::Path;
use std::sync::Arc;

use super::pipeline::{WashOn, Watcher, Watercolor, paint};
use super::settings::{CoherenceMethod, CoherenceSettings, Settings};
use super::textures::{PaperTextureError, Textures, TexturesOn};
use super::toon::{Light, Shading, Toon};
use super::wash::{Controls, Wash};
use graphics::camera::Camera;
use graphics::coherence::{
    AnchoredNoise, Anchoring, Depths, FeatureNoise, Features, Hierarchy, Particles, Sight,
    Splatting, repeating_pigment,
};
use graphics::gpu::DeviceError;
use graphics::mesh::Mesh;
use graphics::surface::PackedMesh;
use graphics::tones::{ToneRamp, ToneRampError};

/// Texels of a wave of the textures that follow particles.
const WAVE_TEXELS: usize = 32;
/// Octaves of the finer of both noises, of features.
const GRAIN_OCTAVES: usize = 2;

/// A backend that does all that moving meshes need.
pub trait MovingBackend: Watercolor + Shading + Depths + Anchoring + Splatting {}

impl<B: Watercolor + Shading + Depths + Anchoring + Splatting> MovingBackend for B {}

/// Paints one mesh from any camera, always in the same size.
#[derive(Debug)]
pub struct ModelPainter<B: MovingBackend> {
    model: B::Model,
    toon: Toon,
    settings: Settings,
    textures: TexturesOn<B>,
    noise: Noise<B>,
    controls: Controls,
    width: usize,
    height: usize,
}

/// What clouds and grains hold on to.
#[derive(Debug)]
enum Noise<B: MovingBackend> {
    Static,
    Particles { particles: Particles, waves: [AnchoredNoise; 2], textures: [B::Grey; 2] },
    Features { features: [Features; 2], noises: [FeatureNoise; 2] },
}

/// What a camera sees, before the effects.
#[derive(Debug)]
pub struct Moment<B: MovingBackend> {
    /// Toon-shaded colour with coverage.
    pub color: B::Color,
    /// Clouds and grains; those that do not move where there are none.
    pub noise: Option<[B::Grey; 2]>,
}

impl<B: MovingBackend> ModelPainter<B> {
    /// Of `mesh` in pictures of `width` x `height`, by settings for that size; each
    /// pixel is the mean of `samples` x `samples`.
    ///
    /// # Errors
    /// [`ModelPainterError`] if there is no such paper or greys, or the device has no room.
    pub fn new(
        backend: &mut B,
        mut mesh: Mesh,
        settings: Settings,
        (width, height): (usize, usize),
        samples: usize,
    ) -> Result<Self, ModelPainterError> {
        let toon = &settings.toon;
        mesh.normals = mesh.smoothed_normals(toon.smoothing_rounds as usize);
        let toon = Toon {
            light: Light::with_camera(toon.light_azimuth_deg, toon.light_elevation_deg),
            tones: match &toon.greys {
                Some(path) => ToneRamp::open(Path::new(path))?,
                None => ToneRamp::steps(toon.levels as usize, toon.softness),
            },
            strength: toon.strength,
            samples: samples.max(1),
        };
        let textures = Textures::new(width, height, &settings)?.on(backend)?;
        let noise = Noise::new(backend, &mesh, &settings)?;
        let model = backend.model(PackedMesh::new(&mesh))?;
        let controls = Controls::default();
        Ok(Self { model, toon, settings, textures, noise, controls, width, height })
    }

    /// Where effects are stronger or weaker, in the picture, from the next one on.
    ///
    /// # Panics
    /// If they are of another size.
    pub fn set_controls(&mut self, controls: Controls) {
        for control in controls.dry_brush.iter().chain(&controls.density) {
            let found = (control.width(), control.height());
            assert_eq!(found, (self.width, self.height), "a control of the picture's size");
        }
        self.controls = controls;
    }

    /// What paints it.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Textures that do not move.
    #[must_use]
    pub fn textures(&self) -> &TexturesOn<B> {
        &self.textures
    }

    /// What `camera` sees.
    ///
    /// # Errors
    /// As [`super::Backend::color_of`].
    pub fn moment(&mut self, backend: &mut B, camera: &Camera) -> Result<Moment<B>, DeviceError> {
        let Self { model, toon, noise, width, height, .. } = self;
        let samples = toon.samples;
        let seen = backend.seen(model, camera, *width * samples, *height * samples)?;
        let color = backend.toon(model, &seen, camera, toon)?;
        if let Noise::Static = noise {
            return Ok(Moment { color, noise: None });
        }
        let seen = match samples {
            1 => seen,
            _ => backend.seen(model, camera, *width, *height)?,
        };
        let depth = backend.depths(&seen)?;
        let noise = noise.at(backend, &depth, &Sight::new(camera, *width, *height))?;
        Ok(Moment { color, noise })
    }

    /// The same with the processor, for glazes: the wash, and the textures of the moment.
    ///
    /// # Errors
    /// As [`super::Backend::color_of`].
    pub fn at_rest(
        &mut self,
        backend: &mut B,
        camera: &Camera,
    ) -> Result<(Wash, Textures), DeviceError> {
        let Moment { color, noise } = self.moment(backend, camera)?;
        let TexturesOn { flow, dispersion, paper } = &self.textures;
        let [flow, dispersion] = noise.as_ref().map_or([flow, dispersion], |[f, d]| [f, d]);
        let textures = Textures {
            flow: backend.grey_field(flow)?,
            dispersion: backend.grey_field(dispersion)?,
            paper: paper.texture.clone(),
        };
        let color = backend.color_field(&color)?;
        Ok((Wash { color, controls: self.controls.clone() }, textures))
    }

    /// The surface without light, as a stage of its own.
    ///
    /// # Errors
    /// As [`super::Backend::color_of`].
    pub fn flat(&mut self, backend: &mut B, camera: &Camera) -> Result<B::Color, DeviceError> {
        let (width, height) = (self.width * self.toon.samples, self.height * self.toon.samples);
        let seen = backend.seen(&mut self.model, camera, width, height)?;
        let flat = Toon { strength: 0.0, ..self.toon.clone() };
        backend.toon(&self.model, &seen, camera, &flat)
    }

    /// The watercolor from `camera`; `watcher` as of [`paint`].
    ///
    /// # Errors
    /// As [`super::Backend::color_of`], and what the watcher says.
    pub fn frame(
        &mut self,
        backend: &mut B,
        camera: &Camera,
        watcher: Option<Watcher<'_, B>>,
    ) -> Result<B::Color, DeviceError> {
        let Moment { color, noise } = self.moment(backend, camera)?;
        let TexturesOn { flow, dispersion, paper } = &self.textures;
        let [flow, dispersion] =
            noise.as_ref().map_or([flow, dispersion], |[flow, grain]| [flow, grain]);
        let mut grey =
            |field: &Option<_>| field.as_ref().map(|field| backend.grey_of(field)).transpose();
        let (dry_brush, density) = (grey(&self.controls.dry_brush)?, grey(&self.controls.density)?);
        let wash = WashOn { color, dry_brush, density };
        paint(backend, wash, flow, dispersion, paper, &self.settings, watcher)
    }
}

impl<B: MovingBackend> Noise<B> {
    fn new(backend: &mut B, mesh: &Mesh, settings: &Settings) -> Result<Self, DeviceError> {
        let CoherenceSettings { method, particles, octaves, feature_px, features_per_place } =
            settings.coherence;
        let seeds = [settings.flow.seed, settings.dispersion.seed];
        let octaves = octaves as usize;
        match method {
            CoherenceMethod::Static => Ok(Self::Static),
            CoherenceMethod::Particles => {
                let hierarchy = Hierarchy::new(mesh);
                let waves = [settings.flow.size_px, feature_px];
                let noise = |i: usize| AnchoredNoise {
                    wave_px: waves[i],
                    wave_texels: WAVE_TEXELS as f32,
                    octaves,
                    seed: seeds[i],
                };
                let mut texture = |seed| backend.grey_of(&repeating_pigment(WAVE_TEXELS, seed));
                Ok(Self::Particles {
                    particles: Particles::new(&hierarchy, particles as usize),
                    waves: [noise(0), noise(1)],
                    textures: [texture(seeds[0])?, texture(seeds[1])?],
                })
            }
            CoherenceMethod::Features => {
                let hierarchy = Arc::new(Hierarchy::new(mesh));
                let noise = |largest_px: f32, octaves, persistence| FeatureNoise {
                    largest_px,
                    octaves,
                    persistence,
                    coverage: features_per_place,
                };
                // The finest grain is as wide as a feature may be.
                let grain_px = feature_px / 2.0 * (1 << (GRAIN_OCTAVES - 1)) as f32;
                let flow =
                    noise(settings.flow.size_px / 2.0, octaves, FeatureNoise::FLOW.persistence);
                let grain = noise(grain_px, GRAIN_OCTAVES, FeatureNoise::DISPERSION.persistence);
                // Clouds and grains of one seed must not lie on each other.
                let features = [seeds[0], seeds[1] ^ u64::MAX]
                    .map(|seed| Features::new(Arc::clone(&hierarchy), seed));
                Ok(Self::Features { features, noises: [flow, grain] })
            }
        }
    }

    fn at(
        &self,
        backend: &mut B,
        depth: &B::Grey,
        sight: &Sight,
    ) -> Result<Option<[B::Grey; 2]>, DeviceError> {
        match self {
            Self::Static => Ok(None),
            Self::Particles { particles, waves, textures } => {
                let mut one = |i: usize| {
                    let anchors = particles.anchors(sight, waves[i]);
                    backend.anchored(depth, &textures[i], &anchors)
                };
                Ok(Some([one(0)?, one(1)?]))
            }
            Self::Features { features, noises } => {
                let mut one = |i: usize| {
                    let splats = features[i].splats(sight, noises[i]);
                    backend.splatted(depth, &splats)
                };
                Ok(Some([one(0)?, one(1)?]))
            }
        }
    }
}

/// Why a mesh cannot be painted.
#[derive(Debug, thiserror::Error)]
pub enum ModelPainterError {
    /// No such paper.
    #[error(transparent)]
    Paper(#[from] PaperTextureError),
    /// No such greys.
    #[error(transparent)]
    ToneRamp(#[from] ToneRampError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] DeviceError),
}
