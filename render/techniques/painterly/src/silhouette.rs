//! Strokes along outlines: narrow, in the darkest tone, before all others.
//!
//! The normal at an outline is across the direction to the eye. A line of even width on the screen
//! takes all places up to a cosine that depends on how the surface bends: at a distance of w behind
//! the outline of a ball of radius R the cosine is sqrt(2 w / R).

use glam::Vec2;
use graphics::coherence::{Density, Features, SeenFeature};
use graphics::smoothstep;
use rayon::prelude::*;

use super::roots::{Root, Roots};
use super::splat::StrokeSplat;
use super::strokes::{Brushed, Sight};
use super::tones::Tones;

/// Splats of a line per area of a splat, where the surface faces the eye; there are more towards
/// outlines.
const DENSITY: f32 = 1.5;

/// Length of a splat by its width.
const STRETCH: f32 = 4.0;

/// Half the width of a splat by that of the line.
const RADIUS: f32 = 0.8;

/// Part of the line in pixels behind the outline, by its width.
const BEHIND: f32 = 0.5;

/// Greatest cosine at which a place belongs to an outline, however much the surface bends.
const MOST: f32 = 0.6;

/// How much the cosine of a triangle may differ from that of the smooth surface.
const UNEVEN: f32 = 0.2;

/// Weight against other strokes, after it is raised to the power of the sharpness.
const STRENGTH: f32 = 256.0;

/// Part of a splat in the cover beyond outlines.
const COVER: f32 = 1.0;

/// The splats of outlines, in an order that does not depend on the sight; none for lines of no
/// width.
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
    let near = |seen: &SeenFeature| {
        seen.facing.abs() < MOST + UNEVEN && sight.may_see(seen) && {
            let most = most(roots.greatest_bend(&seen.feature), seen, sight);
            seen.facing.abs() < most + UNEVEN
        }
    };
    let seen = features.seen_where(sight.projection, Density::Facing, end, radii[1], near);
    seen.par_iter()
        .with_min_len(256)
        .filter_map(|seen: &SeenFeature| {
            outline(seen, (&roots.single(&seen.feature), roots), tones, sight, (radii, end))
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
}
