//! Strokes and pictures of a subject from any camera, layer by layer.

use std::sync::Arc;

use artmap::map::ArtMap;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::coherence::{Features, Hierarchy, Projection, depth_field};
use graphics::compute::{Compute, GreyImage};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::surface::Model;
use paint::document::Slots;
use pigment::PigmentLibrary;

use super::built_ground::BuiltGround;
use super::color_paint::FilmHeight;
use super::composed::over;
use super::device_tones::ToneMemory;
use super::divided::{Divide, THIN};
use super::error::PainterError;
use super::flow::phase;
use super::joined_paint::PaintOfMapsError;
use super::offsets::Matching;
use super::paint_tones::PaintTones;
use super::passes::{PaintedPicture, painted};
use super::roots::Roots;
use super::settings::{LightWith, Offsets, OverlapSettings, Settings};
use super::silhouette::outlines;
use super::splat::StrokeSplat;
use super::strokes::{Sight, ranks, splats};
use super::subject::Subject;
use super::tones::Tones;

/// Cover around which the strokes of upper layers end.
const THIN_ABOVE: f32 = 0.7;

/// Distance of strokes in mm where a map does not tell it: that of a small flat brush.
const STROKE_MM: f64 = 3.0;

/// Most pixels of a picture.
const MOST_PIXELS: usize = 1 << 28;

/// Paints one subject, a model ([`Painter::of_model`]) or a picture ([`Painter::of_picture`]), in
/// the brushwork of art maps.
#[derive(Debug)]
pub struct Painter {
    /// Where pictures are made. Paintings, and what decides on strokes, stay on the processor.
    compute: Compute,
    memory: ToneMemory,
    model: Model,
    closed: Vec<bool>,
    bounds: [Vec3; 2],
    layers: Vec<Layered>,
    tones: Tones,
    settings: Settings,
    /// The paint of the maps, if they have any; maps whose paint cannot be joined still have colours.
    paint: Result<Option<PaintTones>, PaintOfMapsError>,
    /// Films of the subject's own colours.
    film: FilmHeight,
    /// Pigments for them, if not those of the maps' library.
    pigments: Option<(Arc<PigmentLibrary>, Option<Slots>)>,
    /// The ground of the last painting.
    pub(super) ground: Option<BuiltGround>,
    /// Distance of strokes of the first map in mm.
    spacing_mm: f64,
    /// Units of the subject along the longer side of the picture of the settings.
    units: f32,
    matched: f64,
}

/// The strokes of one layer.
#[derive(Debug)]
struct Layered {
    features: Features,
    roots: Roots,
}

impl Painter {
    /// Lays the maps out and finds the strokes of a subject.
    pub(super) fn new(
        subject: Subject,
        maps: &[&ArtMap],
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        let Subject { surfaces, packed, closed, coloring, lightness, units, more } = subject;
        let tones = Tones::new(maps, settings.light.between, &coloring);
        let hierarchy = Arc::new(Hierarchy::new(&surfaces[0].mesh));
        if hierarchy.faces() == 0 {
            return Err(PainterError::NoArea);
        }
        let first = |(number, map): (usize, &&ArtMap)| {
            tones.nearest(number, map.keys[map.first.min(map.keys.len() - 1)].tone as f32)
        };
        let slices: Vec<usize> = maps.iter().enumerate().map(first).collect();
        let mut strokes = 0;
        let mut continued = 0.0;
        let mut layers = Vec::new();
        for (surface, number) in surfaces.into_iter().zip(0..) {
            let own = settings.of_layer(number);
            let features = Features::new(Arc::clone(&hierarchy), own.strokes.seed);
            let roots = Roots::new(surface, Arc::clone(&coloring), lightness);
            let density = (more, own.reference_px / units);
            let (roots, matched) = kept(roots, &features, (&tones, &slices), &own, density);
            strokes += roots.count();
            continued += matched * roots.count() as f64;
            layers.push(Layered { features, roots });
        }
        let bounds = packed.bounds;
        let paint = PaintTones::new(maps, settings.light.between);
        Ok(Self {
            compute: Compute::cpu(),
            memory: ToneMemory::Host,
            model: Model::new(&mut Compute::cpu(), packed.as_ref().clone())?,
            closed,
            bounds,
            layers,
            tones,
            settings: settings.clone(),
            paint,
            film: FilmHeight::of(maps[0]),
            pigments: None,
            ground: None,
            spacing_mm: maps[0].mm_per_texel.map_or(STROKE_MM, |mm| mm * maps[0].spacing),
            units,
            matched: continued / strokes.max(1) as f64,
        })
    }

    /// Makes pictures on another device. They agree with those of the processor to rounding; strokes,
    /// stages and paintings are the same to the bit.
    ///
    /// # Errors
    /// [`PainterError::Device`] for maps that the device cannot hold.
    pub fn on(mut self, mut compute: Compute) -> Result<Self, PainterError> {
        let coloring = self.layers[0].roots.coloring();
        self.memory = ToneMemory::new(&mut compute, &self.tones, coloring)?;
        self.compute = compute;
        Ok(self)
    }

    /// Paints the subject as `camera` sees it, in `width` x `height` pixels, at a time in seconds. The
    /// same input gives the same bits on any number of threads.
    ///
    /// # Errors
    /// [`PainterError::Size`] for a picture without pixels or with more than 2^28,
    /// [`PainterError::Time`] for a time that is no number.
    pub fn paint(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<PaintedPicture, PainterError> {
        let (depth, layers) = self.splats(camera, size, seconds)?;
        self.picture(depth, &layers)
    }

    /// The picture of these strokes on a subject of this depth.
    pub(super) fn picture(
        &mut self,
        depth: Field<f32>,
        layers: &[Vec<StrokeSplat>],
    ) -> Result<PaintedPicture, PainterError> {
        let size = (depth.width(), depth.height());
        // The processor takes the depth as it is: copies of this size cost milliseconds.
        let depth = match &mut self.compute {
            Compute::Cpu => depth.into(),
            device => device.upload(&depth)?,
        };
        let mut whole = None;
        for (layer, splats) in layers.iter().enumerate() {
            let overlap = &self.settings.overlap;
            let seen = (&depth, splats.as_slice());
            let divide = divide(&self.tones, &self.layers[layer], layer, overlap);
            let own = painted(&mut self.compute, seen, &divide, &self.memory, overlap)?;
            whole = Some(match whole {
                None => own,
                Some(lower) => over(lower, &own),
            });
        }
        Ok(whole.unwrap_or_else(|| PaintedPicture::bare(size)))
    }

    /// The depth of the subject at each pixel (0 near to 1, nothing), and the strokes of each layer,
    /// the lowest first.
    ///
    /// # Errors
    /// Those of [`Self::paint`].
    pub fn splats(
        &mut self,
        camera: &Camera,
        (width, height): (usize, usize),
        seconds: f64,
    ) -> Result<(Field<f32>, Vec<Vec<StrokeSplat>>), PainterError> {
        if width == 0 || height == 0 || width.saturating_mul(height) > MOST_PIXELS {
            return Err(PainterError::Size { width, height });
        }
        if !seconds.is_finite() {
            return Err(PainterError::Time { seconds });
        }
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        if !clip_from_model.is_finite() || clip_from_model.determinant() == 0.0 {
            let Camera { eye, target, up, .. } = *camera;
            return Err(PainterError::Camera { eye, target, up });
        }
        let visible = self.model.visible(&mut Compute::cpu(), camera, width, height)?;
        let depth = depth_field(visible.host());
        let projection = Projection::new(camera, width, height);
        let light = &self.settings.light;
        let above = DistantLight::with_camera(light.azimuth_deg, light.elevation_deg);
        let light = match (light.with, above) {
            (LightWith::Model, DistantLight::WithCamera(towards)) => {
                DistantLight::WithModel(towards)
            }
            (_, light) => light,
        };
        let drawn = self.layers.iter().zip(0..).map(|(layer, number)| {
            let settings = self.settings.of_layer(number).for_size(width, height);
            let sight = Sight {
                projection: &projection,
                light: light.direction(camera),
                phase: phase(seconds, &settings.flow),
                px_per_unit: settings.reference_px / self.units,
                settings: &settings,
                distance: self.distance(camera),
                closed: if self.holds(camera) { &[] } else { &self.closed },
            };
            let mut drawn = splats(&layer.features, &layer.roots, &self.tones, &sight);
            drawn.extend(outlines(&layer.features, &layer.roots, &self.tones, &sight));
            drawn
        });
        Ok((depth, drawn.collect()))
    }

    /// The picture of the strokes of one layer, made on the processor.
    pub(super) fn painted(
        &self,
        depth: &GreyImage,
        splats: &[StrokeSplat],
        layer: usize,
    ) -> Result<PaintedPicture, DeviceError> {
        let seen = (depth, splats);
        let divide = self.divide(layer);
        painted(&mut Compute::cpu(), seen, &divide, &ToneMemory::Host, &self.settings.overlap)
    }

    /// Mean L* of the map where a stroke shows it.
    pub(super) fn tone_of(&self, splat: &StrokeSplat) -> f32 {
        self.tones.tone(splat.slice as usize)
    }

    /// How the sums of a layer become pixels.
    pub(super) fn divide(&self, layer: usize) -> Divide<'_> {
        divide(&self.tones, &self.layers[layer], layer, &self.settings.overlap)
    }

    /// Distance of the middle of the subject in front of the eye, at least that of the near plane.
    fn distance(&self, camera: &Camera) -> f32 {
        let [low, high] = self.bounds;
        let [_, _, back] = camera.axes();
        (camera.eye - (low + high) / 2.0).dot(back).max(camera.near)
    }

    /// Whether the camera may see the subject from inside: a corner of the bounding box lies before
    /// its near plane, or behind the eye.
    pub(super) fn holds(&self, camera: &Camera) -> bool {
        let [low, high] = self.bounds;
        let [_, _, back] = camera.axes();
        // The corner nearest along the viewing direction.
        let nearest = Vec3::select(back.cmpge(Vec3::ZERO), high, low);
        (camera.eye - nearest).dot(back) <= camera.near
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Share of strokes that continue a neighbour, 0 to 1; 0 with random offsets.
    #[must_use]
    pub fn matched(&self) -> f64 {
        self.matched
    }

    /// Takes pigments for the colours of the subject from this library, instead of that of the maps:
    /// those of a palette, or up to eight that suit the picture.
    pub fn set_pigments(&mut self, library: Arc<PigmentLibrary>, palette: Option<Slots>) {
        self.pigments = Some((library, palette));
        self.ground = None;
    }

    /// The library of pigments for the colours of the subject: the one that was set, that of the
    /// maps, or the Van Gogh oils; and the palette, if one was set.
    pub(super) fn pigments(&self) -> (Arc<PigmentLibrary>, Option<Slots>) {
        self.pigments
            .clone()
            .or_else(|| Some((Arc::clone(&self.paint.as_ref().ok()?.as_ref()?.of.library), None)))
            .unwrap_or_else(|| (Arc::new(PigmentLibrary::van_gogh_oils()), None))
    }

    /// Films of the subject's own colours.
    pub(super) fn film(&self) -> FilmHeight {
        self.film
    }

    /// Width of a cell in mm of a painting of so many cells: strokes have their size in mm.
    pub(super) fn cell_mm(&self, size: (usize, usize)) -> f64 {
        self.spacing_mm / f64::from(self.settings.for_size(size.0, size.1).strokes.width_px)
    }

    /// Whether strokes have the colours of the subject.
    pub(super) fn of_subject(&self) -> bool {
        self.layers[0].roots.coloring().of_model()
    }

    /// The paint of the maps, if they have any.
    pub(super) fn paint_tones(&self) -> Result<Option<&PaintTones>, PaintOfMapsError> {
        self.paint.as_ref().map(Option::as_ref).map_err(|error| *error)
    }
}

/// How the sums of a layer become pixels.
fn divide<'a>(
    tones: &'a Tones,
    layer: &'a Layered,
    number: usize,
    overlap: &OverlapSettings,
) -> Divide<'a> {
    let thin = if number == 0 { THIN } else { THIN_ABOVE };
    Divide { tones, coloring: layer.roots.coloring(), overhang: overlap.overhang, thin }
}

/// Keeps the strokes that a picture of the settings needs, `more` times as many, at so many pixels
/// to a unit of the subject. Returns the share of them that continue a neighbour.
fn kept(
    roots: Roots,
    features: &Features,
    (tones, slices): (&Tones, &[usize]),
    settings: &Settings,
    (more, per_unit): (f32, f32),
) -> (Roots, f64) {
    let [_, end] = ranks(settings);
    let [least, most] = roots.sizes();
    let priority = more * end * per_unit * per_unit / (least * least);
    let radii = settings.strokes.radii_px().map(|radius| radius / per_unit);
    let width = settings.strokes.width_px / per_unit;
    let styles = roots.styles().to_vec();
    let mut matched = 0.0;
    let roots = roots.keeping(features, priority, radii[1] * most, |features, roots| {
        let random = settings.overlap.offsets == Offsets::Random;
        let matching = Matching { features, roots, tones, slices, styles: &styles, radii, width };
        let (starts, share) = (!random).then(|| matching.starts())?;
        matched = share;
        Some(starts)
    });
    (roots, matched)
}
