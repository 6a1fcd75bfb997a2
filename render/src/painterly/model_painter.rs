//! Meshes to pictures in the brushwork of a map, frame by frame.

use std::sync::Arc;

use artmap::map::ArtMap;
use artmap::sample::PaintOfSamples;
use glam::Vec3;
use graphics::camera::Camera;
use graphics::coherence::{Features, Hierarchy, Projection, depth_field};
use graphics::compute::Compute;
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::mesh::{DirectionField, DirectionSettings, Mesh};
use graphics::surface::{Model, PackedMesh};
use paint::amount::quanta_from_mm;
use paint::document::{Document, DryLayer, Lighting, Medium};
use paint::ground::GroundSpec;
use paint::layer::{Cell, Layer, SLOTS};

use super::amounts::amounts;
use super::coloring::Coloring;
use super::divided::Divide;
use super::error::ModelPainterError;
use super::flow::phase;
use super::offsets::Matching;
use super::paint_tones::PaintTones;
use super::passes::{PaintedModel, painted};
use super::places::{Directions, NORMAL_ROUNDS, colors};
use super::roots::Roots;
use super::settings::{ColorSource, LightWith, Offsets, Settings};
use super::silhouette::outlines;
use super::splat::StrokeSplat;
use super::strokes::{Sight, ranks, splats};
use super::tones::Tones;

/// Share of the longer side of a picture that a model fills at the size at which strokes have the
/// size of the settings: the height of a picture of 4 : 3, less a margin.
const FILLED: f32 = 0.69;

/// Strokes are kept up to this many times the density that a model needs which fills the picture.
const MORE: f32 = 2.0;

/// Most pixels of a picture.
const MOST_PIXELS: usize = 1 << 28;

/// Paints one mesh in the brushwork of an art map, from any camera.
///
/// ```
/// use render::artmap::map::ArtMap;
/// use render::camera::Framing;
/// use render::mesh::Mesh;
/// use render::painterly::{ModelPainter, Settings};
/// # fn example(map: &ArtMap) -> Result<(), Box<dyn std::error::Error>> {
/// let mesh = Mesh::torus_knot(5000);
/// let camera = Framing::default().fit(&mesh.positions);
/// let mut painter = ModelPainter::new(&mesh, map, &Settings::default())?;
/// let painted = painter.paint(&camera, (320, 240), 0.0)?;
/// assert_eq!(painted.color.width(), 320);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct ModelPainter {
    model: Model,
    /// For each triangle whether its part of the mesh is closed.
    closed: Vec<bool>,
    bounds: [Vec3; 2],
    features: Features,
    roots: Roots,
    tones: Tones,
    settings: Settings,
    /// The paint of the map, if it has any.
    paint: Option<PaintTones>,
    /// Width of a texel of the map in mm, where it is known.
    mm_per_texel: Option<f64>,
    /// Radius of a sphere around the middle of the mesh that holds it.
    radius: f32,
    matched: f64,
}

impl ModelPainter {
    /// Lays the map out and finds the strokes of `mesh`: what does not depend on the view.
    ///
    /// # Errors
    /// [`ModelPainterError`] for a mesh that cannot be drawn, a map without tiles, and settings out
    /// of their ranges.
    pub fn new(mesh: &Mesh, map: &ArtMap, settings: &Settings) -> Result<Self, ModelPainterError> {
        settings.valid()?;
        mesh.check()?;
        if map.keys.is_empty() || map.size() == 0 {
            return Err(ModelPainterError::NoTile);
        }
        let lines = DirectionSettings {
            along: settings.strokes.along.into(),
            normal_rounds: NORMAL_ROUNDS,
            smoothing: f64::from(settings.strokes.smoothing),
        };
        let directions = Directions::new(mesh, DirectionField::of_curvature(mesh, &lines, &[])?);
        let rounds = settings.light.smoothing_rounds as usize;
        let lit = Mesh { normals: mesh.smoothed_normals(rounds), ..mesh.clone() };
        let packed = PackedMesh::new(&lit);
        let (closed, bounds) = (mesh.closed_parts(), mesh.bounds());
        let model = Model::new(&mut Compute::cpu(), packed.clone())?;
        let coloring = Coloring::new(map, &colors(mesh, &packed), &settings.color);
        let tones = Tones::new(map, settings.light.between, &coloring);
        let hierarchy = Arc::new(Hierarchy::new(mesh));
        if hierarchy.faces() == 0 {
            return Err(ModelPainterError::NoArea);
        }
        let features = Features::new(hierarchy, settings.strokes.seed);
        let roots = Roots::new(lit, packed, directions, coloring);
        let radius = radius(mesh);
        let first = tones.nearest(map.keys[map.first.min(map.keys.len() - 1)].tone as f32);
        let (roots, matched) = kept(roots, &features, (&tones, first), settings, radius);
        let settings = settings.clone();
        let paint = PaintTones::new(map, settings.light.between);
        let mm_per_texel = map.mm_per_texel;
        Ok(Self {
            model,
            closed,
            bounds,
            features,
            roots,
            tones,
            settings,
            paint,
            mm_per_texel,
            radius,
            matched,
        })
    }

    /// Paints the mesh as `camera` sees it, in `width` x `height` pixels, at a time in seconds. The
    /// same input gives the same bits on any number of threads.
    ///
    /// # Errors
    /// [`ModelPainterError::Size`] for a picture without pixels or with more than 2^28,
    /// [`ModelPainterError::Time`] for a time that is no number.
    pub fn paint(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
    ) -> Result<PaintedModel, ModelPainterError> {
        let (depth, splats) = self.splats(camera, size, seconds)?;
        let coloring = self.roots.coloring();
        let colored = self.settings.color.from == ColorSource::Model;
        Ok(painted(&depth, &splats, &self.tones, coloring, colored, &self.settings.overlap))
    }

    /// Paints the mesh as [`Self::paint`] does, with the pigments of the map: a painting of one dry
    /// layer, a cell for each pixel. Amounts are the weighted means of the amounts that strokes
    /// show, so strokes that overlap do not pile up. The cells are as wide as the map's strokes
    /// demand: `strokes.width_px` of them to the distance of its strokes in mm.
    ///
    /// # Errors
    /// As [`Self::paint`]; [`ModelPainterError::NoPaint`] for a map without pigments,
    /// [`ModelPainterError::ModelColors`] if colours are the model's,
    /// [`ModelPainterError::Ground`] for a ground that cannot be made.
    pub fn painting(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
        seconds: f64,
        (title, ground): (&str, &GroundSpec),
    ) -> Result<Document, ModelPainterError> {
        if self.settings.color.from == ColorSource::Model {
            return Err(ModelPainterError::ModelColors);
        }
        let (depth, splats) = self.splats(camera, size, seconds)?;
        let (Some(paint), Some(mm_per_texel)) = (&self.paint, self.mm_per_texel) else {
            return Err(ModelPainterError::NoPaint);
        };
        let overlap = &self.settings.overlap;
        let coloring = self.roots.coloring();
        let divide = Divide { tones: &self.tones, coloring, overhang: overlap.overhang };
        let amounts = amounts(&depth, &splats, &divide, paint, overlap);
        let width_px = self.settings.for_size(size.0, size.1).strokes.width_px;
        let cell_mm = f64::from(self.tones.spacing) * mm_per_texel / f64::from(width_px);
        let PaintOfSamples { library, slots } = &paint.of;
        let ground = ground.build(size.0, size.1, cell_mm, library)?;
        let mut layer = Layer::empty(size.0, size.1);
        for (index, amounts) in amounts.values().iter().enumerate() {
            let quanta = amounts.map(|mm| quanta_from_mm(f64::from(mm), cell_mm));
            let pigments = std::array::from_fn(|slot| quanta[slot]);
            layer.set_cell(index, Cell { pigments, vehicle: quanta[SLOTS] });
        }
        let medium = Medium::of(library);
        let library = library.as_ref().clone();
        let lighting = Lighting::default();
        let bare = Document::bare(title, cell_mm, ground, library, medium, *slots, lighting);
        let dry = vec![DryLayer { slots: *slots, opacity: 1.0, paint: layer }];
        Ok(Document { dry, ..bare })
    }

    /// The depth of the mesh at each pixel (0 near to 1, nothing), and the strokes of a picture.
    ///
    /// # Errors
    /// As [`Self::paint`].
    pub fn splats(
        &mut self,
        camera: &Camera,
        (width, height): (usize, usize),
        seconds: f64,
    ) -> Result<(Field<f32>, Vec<StrokeSplat>), ModelPainterError> {
        if width == 0 || height == 0 || width.saturating_mul(height) > MOST_PIXELS {
            return Err(ModelPainterError::Size { width, height });
        }
        if !seconds.is_finite() {
            return Err(ModelPainterError::Time { seconds });
        }
        let clip_from_model = camera.clip_from_model(width as f32 / height as f32);
        if !clip_from_model.is_finite() || clip_from_model.determinant() == 0.0 {
            let Camera { eye, target, up, .. } = *camera;
            return Err(ModelPainterError::Camera { eye, target, up });
        }
        let visible = self.model.visible(&mut Compute::cpu(), camera, width, height)?;
        let depth = depth_field(visible.host());
        let settings = self.settings.for_size(width, height);
        let projection = Projection::new(camera, width, height);
        let light = &settings.light;
        let above = DistantLight::with_camera(light.azimuth_deg, light.elevation_deg);
        let light = match (light.with, above) {
            (LightWith::Model, DistantLight::WithCamera(towards)) => {
                DistantLight::WithModel(towards)
            }
            (_, light) => light,
        };
        let sight = Sight {
            projection: &projection,
            light: light.direction(camera),
            phase: phase(seconds, &settings.flow),
            px_per_unit: px_per_unit(&settings, self.radius),
            settings: &settings,
            distance: self.distance(camera),
            closed: if self.holds(camera) { &[] } else { &self.closed },
        };
        let mut drawn = splats(&self.features, &self.roots, &self.tones, &sight);
        drawn.extend(outlines(&self.features, &self.roots, &self.tones, &sight));
        Ok((depth, drawn))
    }

    /// Distance of the middle of the mesh in front of the eye, at least that of the near plane.
    fn distance(&self, camera: &Camera) -> f32 {
        let [low, high] = self.bounds;
        let [_, _, back] = camera.axes();
        (camera.eye - (low + high) / 2.0).dot(back).max(camera.near)
    }

    /// Whether the camera may see the mesh from inside: it stands in the bounding box, or so close
    /// that the near plane may cut it.
    fn holds(&self, camera: &Camera) -> bool {
        let [low, high] = self.bounds;
        let (low, high) = (low - camera.near, high + camera.near);
        camera.eye.cmpge(low).all() && camera.eye.cmple(high).all()
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
}

/// Keeps the strokes that a model which fills the picture needs, with the offsets of the settings.
/// Returns the share of them that continue a neighbour.
fn kept(
    roots: Roots,
    features: &Features,
    (tones, slice): (&Tones, usize),
    settings: &Settings,
    radius: f32,
) -> (Roots, f64) {
    let per_unit = px_per_unit(settings, radius);
    let [_, end] = ranks(settings);
    let priority = MORE * end * per_unit * per_unit;
    let radii = settings.strokes.radii_px().map(|radius| radius / per_unit);
    let texels_per_px = tones.spacing / settings.strokes.width_px;
    let widths_per_unit = per_unit * texels_per_px / tones.size as f32;
    let mut matched = 0.0;
    let roots = roots.keeping(features, priority, radii[1], |features, roots| {
        let random = settings.overlap.offsets == Offsets::Random;
        let matching = Matching { features, roots, tones, slice, radii, widths_per_unit };
        let (starts, share) = (!random).then(|| matching.starts())?;
        matched = share;
        Some(starts)
    });
    (roots, matched)
}

/// Pixels to a unit of a model of this radius that fills the picture.
fn px_per_unit(settings: &Settings, radius: f32) -> f32 {
    FILLED * settings.reference_px / (2.0 * radius)
}

/// Radius of the sphere around the middle of the bounding box that holds all vertices.
fn radius(mesh: &Mesh) -> f32 {
    let [low, high] = mesh.bounds();
    let middle = (low + high) / 2.0;
    let squares = mesh.positions.iter().map(|&at| Vec3::from(at).distance_squared(middle));
    squares.fold(0.0, f32::max).sqrt().max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod painting_tests;
