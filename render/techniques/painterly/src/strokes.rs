//! The strokes of a sight: which splats are drawn, where, how large, and with which tone.
//!
//! A splat's weight is continuous in camera, light and time: it fades with its rank, so that the
//! density in the picture stays, and where the surface or the stroke turns away from the eye.

use glam::{Mat2, Vec2, Vec3};
use graphics::coherence::{Density, Features, Projection, SeenFeature};
use graphics::smoothstep;
use rayon::prelude::*;

use super::flow::{moved, twinkled};
use super::regions::Style;
use super::roots::{Root, Roots};
use super::settings::{Settings, Zoom};
use super::splat::StrokeSplat;
use super::tones::Tones;

/// Cosines between eye and normal over which splats gain weight against others. A wide range keeps
/// strokes calm that turn away: 0.25 instead of 0.6 pops a fifth more on a knot.
const FACING: [f32; 2] = [0.0, 0.6];

/// Cosines between eye and normal over which splats begin to cover.
const COVERING: [f32; 2] = [0.0, 0.2];

/// Lengths of the projected direction, by its own length, over which splats gain weight: the
/// direction of strokes that run towards the eye is not stable.
const LENGTH: [f32; 2] = [0.05, 0.35];

/// Weight of strokes that run towards the eye: they show where there are no others.
const FORESHORTENED: f32 = 0.01;

/// Ratio of distances within which places are about as far as the middle of the model.
const CALM: f32 = 1.25;

/// Steepest plane of a splat, in lengths away from the eye by lengths across.
const STEEPEST: f32 = 2.0;

/// Numbers of the random parts of a feature's place in the map.
const NOISE: [u64; 2] = [18, 19];

/// Number of the random time at which a stroke twinkles.
const TWINKLE: u64 = 20;

/// One picture to paint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight<'a> {
    pub(super) projection: &'a Projection,
    /// Unit vector towards the light, in model coordinates.
    pub(super) light: Vec3,
    /// Where strokes stand in the loop, 0 to 1.
    pub(super) phase: f32,
    /// Settings for the size of the picture.
    pub(super) settings: &'a Settings,
    /// Pixels to a unit of the model at the distance at which strokes have the size of the
    /// settings.
    pub(super) px_per_unit: f32,
    /// Distance of the middle of the model in front of the eye, above 0.
    pub(super) distance: f32,
    /// For each triangle whether it is hidden where it turns away; empty where all are seen.
    pub(super) closed: &'a [bool],
}

/// Ranks in splats per pixel: up to the first they have full weight, at the second none.
pub(super) fn ranks(settings: &Settings) -> [f32; 2] {
    let [across, along] = settings.strokes.radii_px();
    let density = settings.overlap.splats / (std::f32::consts::PI * across * along);
    let end = density / (1.0 - settings.overlap.fade / 2.0);
    [end * (1.0 - settings.overlap.fade), end]
}

/// The splats to draw, hidden ones included, in an order that does not depend on the sight.
pub(super) fn splats(
    features: &Features,
    roots: &Roots,
    tones: &Tones,
    sight: &Sight<'_>,
) -> Vec<StrokeSplat> {
    let density = match sight.settings.strokes.zoom {
        Zoom::Screen => Density::Screen,
        Zoom::Surface => Density::Surface { px_per_unit: sight.px_per_unit },
    };
    let [_, along] = sight.settings.strokes.radii_px();
    let [_, end] = ranks(sight.settings);
    let [least, most] = roots.sizes();
    let seen = features.seen(sight.projection, density, end / (least * least), along * most);
    seen.par_iter()
        .with_min_len(256)
        .filter_map(|seen: &SeenFeature| {
            let root = sight.may_see(seen).then(|| roots.of(&seen.feature))?;
            splat(seen, (&root, roots), tones, sight)
        })
        .collect()
}

/// The splat of one feature; `None` if it has no weight.
fn splat(
    seen: &SeenFeature,
    (root, roots): (&Root, &Roots),
    tones: &Tones,
    sight: &Sight<'_>,
) -> Option<StrokeSplat> {
    let Sight { projection, settings, .. } = sight;
    let place = &root.place;
    let style = roots.style(root);
    let (normal, across) = match seen.facing < 0.0 {
        true => (-place.normal, -place.across()),
        false => (place.normal, place.across()),
    };
    let per_unit = projection.focal_px() / seen.distance;
    let at = [seen.x, seen.y];
    let drawn = |along: Vec3| Vec2::from(projection.moved(at, seen.distance, along)) / per_unit;
    let [across, along] = [drawn(across), drawn(place.along)];
    let [full, end] = ranks(settings);
    let rank = seen.rank * style.size * style.size;
    let present = place.detail * (1.0 - smoothstep([full, end], rank));
    let drawn_out = FORESHORTENED + (1.0 - FORESHORTENED) * smoothstep(LENGTH, along.length());
    let weight = present * drawn_out * smoothstep(FACING, seen.facing.abs());
    let cover = present * smoothstep(COVERING, seen.facing.abs());
    if weight <= 0.0 {
        return None;
    }
    let flat = along.try_normalize()?;
    let tilt = settings.strokes.tilt;
    let lean = |flat: Vec2, drawn: Vec2| flat + (drawn - flat) * tilt;
    let size = style.size * sight.zoom(per_unit);
    let radii = settings.strokes.radii_px().map(|radius| radius * size);
    let wrap = settings.light.wrap;
    let lit = ((normal.dot(sight.light) + wrap) / (1.0 + wrap)).clamp(0.0, 1.0);
    let [darkest, lightest] = style.tones;
    let twinkle = match style.twinkle {
        0.0 => 0.0,
        most => most * twinkled(style.twinkles, sight.phase, seen.feature.unit(TWINKLE)),
    };
    let tone = darkest + (lightest - darkest) * root.tone.unwrap_or(lit) + twinkle;
    let brushed = Brushed {
        axes: [lean(Vec2::new(flat.y, -flat.x), across), lean(flat, along)],
        radii,
        weight,
        cover,
        tone,
        color: root.color + roots.coloring().lighter(twinkle),
    };
    brushed.splat(seen, (root, style), tones, sight)
}

/// How a stroke is laid down in the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Brushed {
    /// Directions across and along the stroke in the picture, shorter than 1 where it is
    /// foreshortened.
    pub(super) axes: [Vec2; 2],
    /// Half its width and length in pixels.
    pub(super) radii: [f32; 2],
    pub(super) weight: f32,
    pub(super) cover: f32,
    /// Tone from the darkest (0) to the lightest (1) tile of the map.
    pub(super) tone: f32,
    pub(super) color: Vec3,
}

impl Brushed {
    /// The splat of a feature; `None` if it is seen edge-on.
    pub(super) fn splat(
        &self,
        seen: &SeenFeature,
        (root, style): (&Root, &Style),
        tones: &Tones,
        sight: &Sight<'_>,
    ) -> Option<StrokeSplat> {
        let Sight { projection, settings, .. } = sight;
        let Self { axes, radii, weight, cover, tone, color } = *self;
        let ellipse = Mat2::from_cols(axes[0] * radii[0], axes[1] * radii[1]);
        if ellipse.determinant().abs() <= 1e-4 * radii[0] * radii[1] {
            return None;
        }
        let inverse = ellipse.inverse();
        let squares = ellipse.x_axis * ellipse.x_axis + ellipse.y_axis * ellipse.y_axis;
        // Depth of one pixel's length away from the eye.
        let depth_px = projection.depth_scale() / (projection.focal_px() * seen.distance);
        let towards = seen.feature.normal.dot(seen.feature.position - projection.camera().eye);
        let slope = Vec2::from(projection.slope(seen.feature.normal, towards));
        let per_unit = projection.focal_px() / seen.distance;
        let width_px = settings.strokes.width_px * style.size * sight.zoom(per_unit);
        let map = tones.map(style.map);
        let widths_per_px = map.spacing / (width_px * map.size as f32);
        let widths_per_unit = match settings.strokes.zoom {
            Zoom::Screen => {
                let distance = calm_distance(seen.distance, sight.distance);
                projection.focal_px() / distance * widths_per_px
            }
            Zoom::Surface => per_unit * widths_per_px,
        };
        let [u, v] = root.start.at(widths_per_unit).to_array();
        let noise = NOISE.map(|number| {
            let random = seen.feature.unit(number) - 0.5;
            2.0 * random * settings.flow.noise * map.spacing / map.size as f32
        });
        let flow = moved(root.place.flow, sight.phase, style.periods);
        Some(StrokeSplat {
            x: seen.x,
            y: seen.y,
            across: inverse.row(0).to_array(),
            along: inverse.row(1).to_array(),
            reach: squares.to_array().map(f32::sqrt),
            depth: seen.depth,
            slope: slope.clamp_length_max(STEEPEST * depth_px).to_array(),
            tolerance: depth_px * radii[0],
            weight,
            cover,
            offset: [u + noise[0], v + noise[1] + flow],
            extent: radii.map(|radius| radius * widths_per_px),
            slice: tones.slice(style.map, tone) as u32,
            halvings: tones.halvings(style.map, map.spacing / width_px) as u32,
            color: color.to_array(),
        })
    }
}

impl Sight<'_> {
    /// Size of strokes by that of the settings, where a unit of the model has so many pixels.
    fn zoom(&self, px_per_unit: f32) -> f32 {
        match self.settings.strokes.zoom {
            Zoom::Screen => 1.0,
            Zoom::Surface => px_per_unit / self.px_per_unit,
        }
    }

    /// Whether the face of a feature may be seen.
    pub(super) fn may_see(&self, seen: &SeenFeature) -> bool {
        let closed = self.closed.get(seen.feature.face as usize);
        seen.facing > 0.0 || !closed.copied().unwrap_or(false)
    }
}

/// Distance by which strokes go on in each other: that of the middle of the model for all places
/// that are about as far, so that strokes do not slide in the map while the model turns.
fn calm_distance(own: f32, middle: f32) -> f32 {
    let [nearest, farthest] = [middle / CALM, middle * CALM];
    if own < nearest {
        own * CALM
    } else if own > farthest {
        own / CALM
    } else {
        middle
    }
}
