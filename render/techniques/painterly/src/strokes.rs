//! The strokes of a view. We decide which splats we draw, where, how large, and with which tone.
//! Strokes along outlines and strokes that move along the surface, in loops that close, are here
//! too.
//!
//! A splat's weight is continuous in camera, light and time. It fades with the rank of the splat,
//! so that the density in the picture stays. It also fades where the surface or the stroke turns
//! away from the eye.
//!
//! Strokes along outlines are narrow, in the darkest tone, before all others. The normal at an
//! outline is across the direction to the eye. A line of even width on the screen takes all places
//! up to a cosine that depends on how the surface bends. For example, at a distance of w behind the
//! outline of a ball of radius R this cosine is sqrt(2 w / R).

use glam::{Mat2, Vec2, Vec3};
use graphics::coherence::{Density, Features, Projection, SeenFeature};
use graphics::smoothstep;
use rayon::prelude::*;

use super::regions::Style;
use super::roots::{Root, Roots};
use super::settings::{FlowSettings, Settings, Zoom};
use super::splats::StrokeSplat;
use super::tones::Tones;

/// Cosines between eye and normal over which splats gain weight against others. A wide range keeps
/// strokes calm that turn away: 0.25 instead of 0.6 pops a fifth more on a knot.
const FACING: [f32; 2] = [0.0, 0.6];

/// Cosines between eye and normal over which splats begin to cover.
const COVERING: [f32; 2] = [0.0, 0.2];

/// A splat gains weight while the length of its projected direction rises from the first value to
/// the second, relative to its true length. The direction of strokes that run towards the eye is
/// not stable.
const LENGTH: [f32; 2] = [0.05, 0.35];

/// Weight of strokes that run towards the eye. With this they show only where there are no others.
const FORESHORTENED: f32 = 0.01;

/// Places count as equally far as the middle of the model if the ratio of the distances is at most
/// this.
const CALM: f32 = 1.25;

/// Steepest plane of a splat: length away from the eye per length across the view.
const STEEPEST: f32 = 2.0;

/// Which random numbers of a feature give the random part of its place in the map.
const NOISE: [u64; 2] = [18, 19];

/// Which random number of a feature gives the time at which its stroke twinkles.
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
    /// Pixels per unit of the model at the distance at which strokes have the size of the settings.
    pub(super) px_per_unit: f32,
    /// Distance of the middle of the model in front of the eye, above 0.
    pub(super) distance: f32,
    /// For each triangle, whether we hide it if it faces away. Empty if you see all triangles.
    pub(super) closed: &'a [bool],
}

/// A splat has full weight up to the first rank and none from the second on. Ranks are in splats
/// per pixel.
pub(super) fn ranks(settings: &Settings) -> [f32; 2] {
    let [across, along] = settings.strokes.radii_px();
    let density = settings.overlap.splats / (std::f32::consts::PI * across * along);
    let end = density / (1.0 - settings.overlap.fade / 2.0);
    [end * (1.0 - settings.overlap.fade), end]
}

/// The splats to draw, hidden ones included. Their order does not depend on the sight.
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

/// The splat of one feature, `None` if it has no weight.
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
    let [across, along] = [across, place.along]
        .map(|along| Vec2::from(projection.moved(at, seen.distance, along)) / per_unit);
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
    fn lean(flat: Vec2, drawn: Vec2, tilt: f32) -> Vec2 {
        flat + (drawn - flat) * tilt
    }
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
        axes: [lean(Vec2::new(flat.y, -flat.x), across, tilt), lean(flat, along, tilt)],
        radii,
        weight,
        cover,
        tone,
        color: root.color + roots.coloring().lighter(twinkle),
    };
    brushed.splat(seen, (root, style), tones, sight)
}

/// How we lay a stroke down in the picture.
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
    /// The splat of a feature, `None` if it is seen edge-on.
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
    /// Size of strokes relative to the settings, where a unit of the model has `px_per_unit`
    /// pixels.
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

/// Distance from the eye by which we scale the way between strokes in the map. For all places that
/// are about as far as the middle of the model, this is the distance of the middle, so that strokes
/// do not slide in the map while the model turns.
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

/// Number of splats of an outline per area of a splat, where the surface faces the eye. There are
/// more towards outlines.
const DENSITY: f32 = 1.5;

/// Length of a splat relative to its width.
const STRETCH: f32 = 4.0;

/// Half the width of a splat relative to the line.
const RADIUS: f32 = 0.8;

/// We place splats up to this distance inside the outline in the picture, relative to the width of
/// the line.
const BEHIND: f32 = 0.5;

/// Greatest cosine at which a place belongs to an outline, however much the surface bends.
const MOST: f32 = 0.6;

/// How much the cosine of a triangle may differ from the cosine of the smooth surface.
const UNEVEN: f32 = 0.2;

/// Weight against other strokes, after it is raised to the power of the sharpness.
const STRENGTH: f32 = 256.0;

/// Amount that a splat of an outline adds to the cover.
const COVER: f32 = 1.0;

/// The splats of outlines, in an order that does not depend on the sight. If lines have no width,
/// this is empty.
pub(super) fn outlines(
    features: &Features,
    roots: &Roots,
    tones: &Tones,
    sight: &Sight<'_>,
) -> Vec<StrokeSplat> {
    let width = sight.settings.silhouette.width_px;
    if width <= 0.0 {
        return Vec::new();
    }
    let radii = [RADIUS * width, RADIUS * STRETCH * width];
    let end = DENSITY / (radii[0] * radii[1]);
    let seen = features.seen_where(
        sight.projection,
        Density::Facing,
        end,
        radii[1],
        |seen: &SeenFeature| {
            seen.facing.abs() < MOST + UNEVEN && sight.may_see(seen) && {
                let most = most(roots.greatest_bend(&seen.feature), seen, sight);
                seen.facing.abs() < most + UNEVEN
            }
        },
    );
    seen.par_iter()
        .with_min_len(256)
        .filter_map(|seen: &SeenFeature| {
            outline(seen, (&roots.unmatched(&seen.feature), roots), tones, sight, (radii, end))
        })
        .collect()
}

fn outline(
    seen: &SeenFeature,
    (root, roots): (&Root, &Roots),
    tones: &Tones,
    sight: &Sight<'_>,
    (radii, end): ([f32; 2], f32),
) -> Option<StrokeSplat> {
    let projection = sight.projection;
    let to_eye = (projection.camera().eye - seen.feature.position).try_normalize()?;
    let normal = root.place.normal;
    let cosine = normal.dot(to_eye).abs();
    // Curvature of the surface towards the eye decides how far the cosine grows behind the outline.
    let back = to_eye.reject_from_normalized(normal).try_normalize()?;
    let bend = back.dot(root.place.bend * back).abs();
    let silhouette = &sight.settings.silhouette;
    let most = most(bend, seen, sight);
    let present = 1.0 - smoothstep([0.4 * end, end], seen.rank);
    let share = present * (1.0 - smoothstep([0.5 * most, most], cosine));
    if share <= 0.0 {
        return None;
    }
    let line = normal.cross(to_eye);
    let drawn = Vec2::from(projection.moved([seen.x, seen.y], seen.distance, line));
    let along = drawn.try_normalize()?;
    let weight = strength(sight.settings.overlap.sharpness) * share;
    let brushed = Brushed {
        axes: [Vec2::new(along.y, -along.x), along],
        radii,
        weight,
        cover: COVER * share,
        tone: 0.0,
        color: root.color * (1.0 - silhouette.darkness),
    };
    brushed.splat(seen, (root, roots.style(root)), tones, sight)
}

/// The cosine at which a line ends on a surface of this curvature towards the eye.
fn most(bend: f32, seen: &SeenFeature, sight: &Sight<'_>) -> f32 {
    let per_unit = sight.projection.focal_px() / seen.distance;
    let behind = 2.0 * BEHIND * sight.settings.silhouette.width_px * bend / per_unit;
    behind.sqrt().min(MOST)
}

/// The weight that gives [`STRENGTH`] at a power of `sharpness`.
fn strength(sharpness: u32) -> f32 {
    (0..sharpness.max(1).ilog2()).fold(STRENGTH, |weight, _| weight.sqrt())
}

/// Where strokes stand in a loop, 0 to below 1. If you add a whole number of loops, you get the
/// same bits.
///
/// We divide `seconds` by the duration in f64, so that times which are whole multiples of a frame
/// rate do not drift.
pub(super) fn phase(seconds: f64, settings: &FlowSettings) -> f32 {
    let loops = seconds / f64::from(settings.loop_seconds);
    let phase = (loops - loops.floor()) as f32;
    // Steps of 2^-20, so that rounding before the end of a loop and after it agree.
    let steps = (phase * 1_048_576.0).round() / 1_048_576.0;
    if steps >= 1.0 { 0.0 } else { steps }
}

/// How much lighter a stroke is, -1 to 1, at a `phase` of a loop with so many changes to lighter
/// and darker. `own` (0 to 1) says where this stroke stands at the beginning.
pub(super) fn twinkled(twinkles: u32, phase: f32, own: f32) -> f32 {
    let at = phase * twinkles as f32 + own;
    let at = at - at.floor();
    // A parabola up and one down, close to a sine.
    let half = if at < 0.5 { 4.0 * at } else { 4.0 * at - 2.0 };
    let arc = half * (2.0 - half);
    if at < 0.5 { arc } else { -arc }
}

/// Change of the place in the map along the stroke, in widths of the map, at a `phase` of the loop
/// (equation 11 of Yan and others 2008). In a loop, strokes move by a whole number of widths, so
/// that every loop closes. This number is `periods` for the strongest flow (1), and less for weaker
/// flow.
pub(super) fn moved(strength: f32, phase: f32, periods: u32) -> f32 {
    let periods = (periods as f32 * strength.clamp(0.0, 1.0)).round();
    // The brushwork moves along the arrow if the place in the map moves against it.
    let back = -periods * phase;
    back - back.floor()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_are_as_strong_at_every_sharpness() {
        for sharpness in [1, 2, 4, 8, 16] {
            let found = strength(sharpness).powi(sharpness as i32);
            assert!((found / STRENGTH - 1.0).abs() < 1e-4, "{sharpness}: {found}");
        }
    }

    fn settings(periods: u32) -> FlowSettings {
        FlowSettings { periods, loop_seconds: 2.4, ..FlowSettings::default() }
    }

    #[test]
    fn a_loop_ends_where_it_began_to_the_bit() {
        let settings = settings(3);
        for frame in 0..48 {
            for loops in [1, 2, 7, 1000] {
                let [place, later] = [frame, frame + 48 * loops].map(|frame: i32| {
                    let seconds = f64::from(frame) * f64::from(settings.loop_seconds) / 48.0;
                    moved(0.8, phase(seconds, &settings), settings.periods)
                });
                assert_eq!(place.to_bits(), later.to_bits(), "{frame}");
            }
        }
    }

    #[test]
    fn strokes_of_weak_flow_go_on_over_the_end_of_a_loop() {
        for strength in [0.1, 0.4, 0.6, 0.9] {
            let [inside, over] = [[0.25, 0.5], [0.75, 0.0]].map(|phases| {
                let [from, to] = phases.map(|phase: f32| moved(strength, phase, 3));
                (from - to).rem_euclid(1.0)
            });
            assert!((inside - over).abs() < 1e-6, "{strength}: {inside}, {over}");
        }
    }

    #[test]
    fn strokes_move_evenly_and_stand_where_there_is_no_flow() {
        fn step(phase: f32) -> f32 {
            let step = moved(1.0, phase, 2) - moved(1.0, phase + 0.01, 2);
            step.rem_euclid(1.0)
        }
        assert!((0..99).all(|i| (step(i as f32 * 0.01) - 0.02).abs() < 1e-4));
        assert_eq!(moved(0.0, 0.3, 2), 0.0);
        assert_eq!(moved(1.0, 0.3, 0), 0.0);
    }

    #[test]
    fn twinkling_strokes_are_as_much_lighter_as_darker_and_close_their_loop() {
        let values: Vec<f32> = (0..240).map(|i| twinkled(3, i as f32 / 240.0, 0.2)).collect();
        assert!(values.iter().sum::<f32>().abs() < 1e-3);
        let (least, most) =
            values.iter().fold((1.0_f32, -1.0_f32), |(a, b), &v| (a.min(v), b.max(v)));
        assert!(least < -0.99 && most > 0.99 && (-1.0..=1.0).contains(&most));
        let steps = (0..240).map(|i| (values[(i + 1) % 240] - values[i]).abs());
        assert!(steps.fold(0.0, f32::max) < 0.11);
        for i in 0..=100 {
            let at = i as f32 / 100.0;
            let sine = (std::f32::consts::TAU * at).sin();
            assert!((twinkled(1, at, 0.0) - sine).abs() < 0.06, "{at}");
        }
    }
}
