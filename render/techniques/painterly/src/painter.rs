//! The painter makes strokes and pictures of a subject from any camera, layer by layer, one layer
//! over the other. This file also holds the maps and regions of a subject, the ground of its
//! paintings, and the reasons why you cannot paint it.

use std::sync::Arc;

use artmap::map::ArtMap;
use documents::Cancelled;
use documents::hint::Explain;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::coherence::{Features, Hierarchy, Projection, depth_field};
use graphics::compute::{Compute, GreyImage};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::DeviceError;
use graphics::mesh::{DirectionFault, MeshFault};
use graphics::surface::Model;
use paint::document::Slots;
use paint::ground::{Ground, GroundError, GroundSpec};
use pigment::PigmentLibrary;
use rayon::prelude::*;

use super::color_paint::{ColorPaintError, FilmHeight};
use super::gather::{Divide, THIN};
use super::paint_tones::{PaintOfMapsError, PaintTones};
use super::passes::{PaintedPicture, painted};
use super::places::Subject;
use super::regions::{Regions, RegionsError};
use super::roots::{Matching, Roots};
use super::settings::{LightWith, Offsets, OverlapSettings, Settings, SettingsError};
use super::splats::StrokeSplat;
use super::strokes::{Sight, outlines, phase, ranks, splats};
use super::tones::{ToneMemory, Tones};

/// Strokes of upper layers end where their cover falls to about this.
const THIN_ABOVE: f32 = 0.7;

/// Distance of strokes in mm if a map does not give it. This is the distance of a small flat brush.
const STROKE_MM: f64 = 3.0;

/// Most pixels of a picture.
const MOST_PIXELS: usize = 1 << 28;

/// Paints one subject, a model ([`Painter::of_model`]) or a picture ([`Painter::of_picture`]), in
/// the brushwork of art maps.
#[derive(Debug)]
pub struct Painter {
    /// Where we make pictures. Paintings, and everything that decides on strokes, stay on the
    /// processor.
    compute: Compute,
    memory: ToneMemory,
    model: Model,
    closed: Vec<bool>,
    bounds: [Vec3; 2],
    layers: Vec<Layered>,
    tones: Tones,
    settings: Settings,
    /// The paint of the maps, if they have any. If maps cannot be joined in paint, you can still
    /// use their colours.
    paint: Result<Option<PaintTones>, PaintOfMapsError>,
    /// Height of the films that show the subject's own colours.
    film: FilmHeight,
    /// Pigments of these films, if they do not come from the library of the maps.
    pigments: Option<(Arc<PigmentLibrary>, Option<Slots>)>,
    /// The ground of the last painting.
    pub(super) ground: Option<BuiltGround>,
    /// Distance of strokes of the first map in mm.
    spacing_mm: f64,
    /// Length of the longer side of a picture, in units of the subject, if strokes have the size of
    /// the settings.
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
        let slices: Vec<usize> = maps
            .iter()
            .enumerate()
            .map(|(number, map): (usize, &&ArtMap)| {
                tones.nearest(number, map.keys[map.first.min(map.keys.len() - 1)].tone as f32)
            })
            .collect();
        let mut strokes = 0;
        let mut continued = 0.0;
        let mut layers = Vec::new();
        for (surface, number) in surfaces.into_iter().zip(0..) {
            let own = settings.of_layer(number);
            let features = Features::new(Arc::clone(&hierarchy), own.strokes.seed);
            let roots = Roots::new(surface, Arc::clone(&coloring), lightness);
            let density = (more, own.reference_px / units);
            let (roots, matched) =
                with_kept_strokes(roots, &features, (&tones, &slices), &own, density);
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

    /// Makes pictures on another device. They agree with the processor's to rounding. This does not
    /// change strokes, stages and paintings, which stay the same to the bit.
    ///
    /// # Errors
    /// [`PainterError::Device`] for maps that the device cannot hold.
    pub fn on(mut self, mut compute: Compute) -> Result<Self, PainterError> {
        let coloring = self.layers[0].roots.coloring();
        self.memory = ToneMemory::new(&mut compute, &self.tones, coloring)?;
        self.compute = compute;
        Ok(self)
    }

    /// Paints the subject as `camera` sees it, in `width` x `height` pixels, at a time in seconds.
    /// If you pass the same input, you get the same bits on any number of threads.
    ///
    /// # Errors
    /// [`PainterError::Size`] for a picture without pixels or with more than 2^28,
    /// [`PainterError::Time`] for a time that is not a number.
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

    /// The depth of the subject at each pixel (0 near to 1, nothing), and the strokes of each
    /// layer, the lowest first.
    ///
    /// # Errors
    /// The errors of [`Self::paint`].
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
            return Err(PainterError::Time(seconds));
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

    /// The values by which the sums of a layer become pixels.
    pub(super) fn divide(&self, layer: usize) -> Divide<'_> {
        divide(&self.tones, &self.layers[layer], layer, &self.settings.overlap)
    }

    /// Distance of the middle of the subject in front of the eye. This is at least the distance of
    /// the near plane.
    fn distance(&self, camera: &Camera) -> f32 {
        let [low, high] = self.bounds;
        let [_, _, back] = camera.axes();
        (camera.eye - (low + high) / 2.0).dot(back).max(camera.near)
    }

    /// Whether the camera may see the subject from inside. This is so if a corner of the bounding
    /// box lies before its near plane, or behind the eye.
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

    /// Share of strokes that continue a neighbour, 0 to 1. With random offsets this is 0.
    #[must_use]
    pub fn matched(&self) -> f64 {
        self.matched
    }

    /// Takes pigments for the colours of the subject from this library instead of the maps'
    /// library. If you pass a palette, we use its pigments. If not, we use up to eight that suit
    /// the picture.
    pub fn set_pigments(&mut self, library: Arc<PigmentLibrary>, palette: Option<Slots>) {
        self.pigments = Some((library, palette));
        self.ground = None;
    }

    /// The library of pigments for the colours of the subject, and the palette if you set one. The
    /// library is the one that you set, the maps' own, or the Van Gogh oils.
    pub(super) fn pigments(&self) -> (Arc<PigmentLibrary>, Option<Slots>) {
        self.pigments
            .clone()
            .or_else(|| Some((Arc::clone(&self.paint.as_ref().ok()?.as_ref()?.of.library), None)))
            .unwrap_or_else(|| (Arc::new(PigmentLibrary::van_gogh_oils()), None))
    }

    /// Height of the films that show the subject's own colours.
    pub(super) fn film(&self) -> FilmHeight {
        self.film
    }

    /// Width of a cell in mm, for a painting of `size` cells. It follows from the width of a stroke
    /// in mm.
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

/// The values by which the sums of a layer become pixels.
fn divide<'a>(
    tones: &'a Tones,
    layer: &'a Layered,
    number: usize,
    overlap: &OverlapSettings,
) -> Divide<'a> {
    let thin = if number == 0 { THIN } else { THIN_ABOVE };
    Divide { tones, coloring: layer.roots.coloring(), overhang: overlap.overhang, thin }
}

/// Keeps the strokes that a picture of `per_unit` pixels per unit of the subject needs, at up to
/// `more` times its density. Returns the share of them that continue a neighbour.
fn with_kept_strokes(
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

#[cfg(test)]
mod exact_tests {
    //! We compare pictures of paintings, made from eight wavelengths, with exact spectra of the
    //! same amounts.

    use std::sync::Arc;

    use artmap::map::ArtMap;
    use artmap::sample::{PaintOfSamples, TexelPaint};
    use graphics::camera::Framing;
    use graphics::field::Field;
    use graphics::mesh::Mesh;
    use paint::document::{Document, Lighting, palette_slots};
    use paint::ground::GroundKind;
    use paint::layer::SLOTS;
    use paint::light::Light;
    use paint::scene::{SpectralDocument, picture, scene};
    use pigment::PigmentLibrary;
    use spectra::color::{Adaptation, Lab, RgbSpace, delta_e_ciede2000};

    use crate::painter::Painter;
    use crate::settings::Settings;
    use crate::test_scenes::map;

    /// The made-up map in paint: each tone another mixture of ochre, blue and white, in furrows with
    /// more blue than on ridges.
    fn painted_map() -> ArtMap {
        let mut map = map(4);
        let library = PigmentLibrary::van_gogh_oils();
        let names = ["Lead White", "Chrome Yellow", "Ultramarine", "Vermilion", "Viridian"];
        let slots = palette_slots(&names.map(str::to_owned), &library).unwrap();
        for (tone, key) in map.keys.iter_mut().enumerate() {
            let heights = key.tile.height_mm.as_ref().unwrap();
            let texels = heights
                .values()
                .iter()
                .map(|mm: &f32| {
                    let share = (mm / 0.2).clamp(0.0, 1.0);
                    let tone = tone as f32 / 3.0;
                    let mut pigments_mm = [0.0; SLOTS];
                    let parts =
                        [0.1 + tone, share, 0.3 * (1.0 - share), 0.4 - 0.3 * tone, 0.2 * tone];
                    pigments_mm
                        .iter_mut()
                        .zip(parts)
                        .for_each(|(own, part)| *own = part * (0.01 + mm));
                    TexelPaint { pigments_mm, vehicle_mm: 0.01 }
                })
                .collect();
            key.tile.paint = Some(Field::from_values(heights.width(), heights.height(), texels));
        }
        map.paint = Some(PaintOfSamples { library: Arc::new(library), slots });
        map.mm_per_texel = Some(0.25);
        map
    }

    /// CIEDE2000 of the picture of a document without relief against its exact spectra, by cell.
    fn differences(document: &Document) -> Vec<f64> {
        let light = Light::named(&document.library, "D65", "1931-2").unwrap();
        let seen = picture(document, &scene(document, &light));
        let spectral = SpectralDocument::full(document);
        let weights = light.viewing.weights(document.library.grid).unwrap();
        fn lab(rgb: [f64; 3]) -> Lab {
            let xyz = RgbSpace::Srgb.xyz_from_linear().apply(rgb);
            Lab::from_xyz(xyz.into(), RgbSpace::Srgb.white())
        }
        (0..seen.values().len())
            .map(|index: usize| {
                let x = index % seen.width();
                let y = index / seen.width();
                let xyz = weights.xyz(&spectral.measured_reflectance(x, y));
                let white = light.quadrature.rule.white;
                let exact = RgbSpace::Srgb.linear_from_xyz(xyz, white, Adaptation::Bradford).0;
                let [r, g, b, _] = seen[(x, y)].map(f64::from);
                delta_e_ciede2000(lab(exact), lab([r, g, b]))
            })
            .collect()
    }

    #[test]
    fn pictures_of_paintings_are_those_of_exact_spectra() {
        let mesh = Mesh::torus_knot(4000);
        let camera = Framing::default().fit(&mesh.positions);
        let settings = Settings::default().changed("test", "colour.from = \"map\"").unwrap();
        let mut painter = Painter::of_model(&mesh, &painted_map(), &settings).unwrap();
        let ground = GroundKind::Panel.spec(1);
        let document = painter.painting(&camera, (96, 72), 0.0, ("knot", &ground)).unwrap();
        let level = Lighting { relief: 0.0, ..Lighting::default() };
        let document = Document { lighting: level, ..document };
        let differences = differences(&document);
        let layer = &document.dry[0].paint;
        let painted: Vec<f64> = differences
            .iter()
            .enumerate()
            .filter(|(index, _)| layer.cell(*index).volume() > 0)
            .map(|(_, difference)| *difference)
            .collect();
        let mean = painted.iter().sum::<f64>() / painted.len() as f64;
        let most = painted.iter().fold(0.0_f64, |most, off| most.max(*off));
        assert!(painted.len() > 1000 && mean <= 0.3, "{mean} over {} cells", painted.len());
        assert!(most > 0.0, "nothing was compared");
    }
}

/// Paints one layer over another of the same size. Heights add up, since a dry layer lies on the
/// one below.
pub(super) fn over(mut lower: PaintedPicture, upper: &PaintedPicture) -> PaintedPicture {
    let colors = lower.color.values_mut().par_iter_mut().zip(upper.color.values());
    colors.for_each(|(lower, upper)| {
        let share = upper[3];
        let rest = lower[3] * (1.0 - upper[3]);
        let cover = share + rest;
        if share > 0.0 {
            for channel in 0..3 {
                lower[channel] = (upper[channel] * share + lower[channel] * rest) / cover;
            }
            lower[3] = cover;
        }
    });
    add(&mut lower.height_mm, &upper.height_mm);
    lower
}

fn add(lower: &mut Field<f32>, upper: &Field<f32>) {
    lower.values_mut().iter_mut().zip(upper.values()).for_each(|(lower, upper)| *lower += upper);
}

/// A ground, and everything that we built it from except the library.
#[derive(Debug)]
pub(super) struct BuiltGround {
    spec: GroundSpec,
    size: (usize, usize),
    cell_mm: f64,
    ground: Ground,
}

impl BuiltGround {
    /// The ground of a painting of this size and width of cells. We keep it for the next one.
    pub(super) fn reused_or_built(
        kept: &mut Option<Self>,
        spec: &GroundSpec,
        (size, cell_mm): ((usize, usize), f64),
        library: &PigmentLibrary,
    ) -> Result<Ground, GroundError> {
        if let Some(own) = kept
            .as_ref()
            .filter(|own: &&Self| own.spec == *spec && own.size == size && own.cell_mm == cell_mm)
        {
            return Ok(own.ground.clone());
        }
        let ground = spec.build(size.0, size.1, cell_mm, library)?;
        *kept = Some(Self { spec: spec.clone(), size, cell_mm, ground: ground.clone() });
        Ok(ground)
    }
}

/// A model or a picture cannot be painted.
#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
pub enum PainterError {
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The mesh cannot be drawn.
    #[error(transparent)]
    Mesh(#[from] MeshFault),
    /// Directions cannot be found.
    #[error(transparent)]
    Directions(#[from] DirectionFault),
    /// The mesh cannot be held in memory.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// Regions do not fit the subject.
    #[error(transparent)]
    Regions(#[from] RegionsError),
    /// The paint of several maps cannot be joined.
    #[error(transparent)]
    Maps(#[from] PaintOfMapsError),
    /// No triangle of the mesh has an area.
    #[error("no triangle of the mesh has an area")]
    #[hint("the model is a line or a point: export it again")]
    #[fault(Input)]
    NoArea,
    /// The map has no tile.
    #[error("the art map has no tile")]
    #[hint("build the map again from at least one sample")]
    #[fault(Input)]
    NoTile,
    /// The map has no pigments, or the width of its texels is unknown.
    #[error("the art map has colours only")]
    #[hint("build the map from samples of an impasto painting, or name a [style] such as oil-flat")]
    #[fault(Input)]
    NoPaint,
    /// The colours of the subject cannot be painted.
    #[error(transparent)]
    Colors(#[from] ColorPaintError),
    /// The ground cannot be made.
    #[error(transparent)]
    Ground(#[from] GroundError),
    /// The picture has no pixel, or too many.
    #[error("a picture of {width} x {height} pixels cannot be painted")]
    #[hint("pictures have 1 to 268435456 pixels")]
    Size {
        /// Its width.
        width: usize,
        /// Its height.
        height: usize,
    },
    /// The time is not a number.
    #[error("the time is `{0}` seconds")]
    #[hint("times are seconds from the start, for example 0.5")]
    Time(f64),
    /// The task was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The camera has no viewing direction, or upwards is along it.
    #[error("the camera at {eye} looks at {target}, with {up} upwards")]
    #[hint(
        "place the eye away from its target, and choose an upwards direction that is not along the view"
    )]
    Camera {
        /// Its eye.
        eye: Vec3,
        /// Where it looks.
        target: Vec3,
        /// Its upwards direction.
        up: Vec3,
    },
}

/// Maps with their names, and the regions of a subject. A region may name the map that it is
/// painted with.
#[derive(Debug, Clone)]
pub struct Brushwork<'a> {
    /// At least one map. We use the first for everything that no region covers.
    pub maps: Vec<(&'a str, &'a ArtMap)>,
    /// Regions, which call maps by their names.
    pub regions: Regions,
}

impl<'a> Brushwork<'a> {
    /// One map everywhere.
    #[must_use]
    pub fn of(map: &'a ArtMap) -> Self {
        Self { maps: vec![("", map)], regions: Regions::default() }
    }

    /// Checks that there is a map, and that each has a tile.
    pub(super) fn check(&self) -> Result<(), PainterError> {
        match self.maps.is_empty()
            || self.maps.iter().any(|(_, map)| map.keys.is_empty() || map.size() == 0)
        {
            true => Err(PainterError::NoTile),
            false => Ok(()),
        }
    }

    pub(super) fn names(&self) -> Vec<&'a str> {
        self.maps.iter().map(|(name, _)| *name).collect()
    }

    pub(super) fn art_maps(&self) -> Vec<&'a ArtMap> {
        self.maps.iter().map(|(_, map)| *map).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use paint::ground::GroundKind;

    #[test]
    fn a_layer_covers_what_lies_below_by_its_share() {
        let one = |color: [f32; 4], height| PaintedPicture {
            color: Field::filled(1, 1, color),
            height_mm: Field::filled(1, 1, height),
        };
        let lower = one([0.2, 0.4, 0.6, 1.0], 0.1);
        let half = over(lower.clone(), &one([1.0, 0.0, 0.0, 0.5], 0.2));
        assert_eq!(half.color.values()[0], [0.6, 0.2, 0.3, 1.0]);
        assert!((half.height_mm.values()[0] - 0.3).abs() < 1e-6);
        assert_eq!(over(lower.clone(), &one([0.9; 4].map(|_| 0.0), 0.0)), lower);
        let beyond = over(one([0.0; 4], 0.0), &one([0.3, 0.5, 0.7, 0.4], 0.2));
        assert_eq!(beyond.color.values()[0], [0.3, 0.5, 0.7, 0.4]);
    }

    #[test]
    fn another_ground_or_size_is_built_anew() {
        let library = PigmentLibrary::van_gogh_oils();
        let mut kept = None;
        for (kind, size, cell_mm) in [
            (GroundKind::Linen, (12, 9), 0.2),
            (GroundKind::Linen, (12, 9), 0.2),
            (GroundKind::Linen, (9, 12), 0.2),
            (GroundKind::Panel, (9, 12), 0.2),
            (GroundKind::Panel, (9, 12), 0.3),
        ] {
            let spec = kind.spec(1);
            let found =
                BuiltGround::reused_or_built(&mut kept, &spec, (size, cell_mm), &library).unwrap();
            assert_eq!(found, spec.build(size.0, size.1, cell_mm, &library).unwrap());
        }
    }
}
