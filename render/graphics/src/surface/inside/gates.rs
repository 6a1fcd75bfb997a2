//! Surfaces that hold only what faces their way.

use super::crossing::{Crossing, CrossingSum};
use crate::compute::Image;
use crate::surface::visibility::Fragment;

/// Limits on what closed surfaces hold: the triangles of a scene that face as they do. So paint on one
/// side of a thin wall does not show on the other.
#[derive(Debug, Clone, Copy)]
pub struct Gates<'a> {
    /// Of each closed surface a unit vector, and as the fourth number the least cosine between it
    /// and the normal of a triangle that the surface holds; -2 for a surface that holds all. The
    /// fifth number is that of the only body whose triangles it holds, 0 for any; the others have no
    /// meaning.
    pub surfaces: &'a [[f32; 8]],
    /// The unit normal of each triangle of the scene, in the memory of what counts, and as the fourth
    /// number that of its body, 0 for one that surfaces of any body hold.
    pub normals: &'a Image<[f32; 4]>,
}

/// The number of closed surfaces that hold the seen point and let it pass.
#[derive(Debug, Clone, Copy)]
pub(super) struct GatedCount<'a> {
    pub(super) surfaces: &'a [[f32; 8]],
    pub(super) normals: &'a [[f32; 4]],
    pub(super) seen: &'a [Fragment],
}

impl CrossingSum for GatedCount<'_> {
    type Sum = i32;

    #[inline]
    fn add(&self, sum: &mut i32, crossing: &Crossing) {
        // Crossings are added only where a triangle is seen.
        let [x, y, z, of] = self.normals[self.seen[crossing.pixel].triangle as usize];
        let [to_x, to_y, to_z, least, body, ..] = self.surfaces[crossing.surface as usize];
        let is_own = body == 0.0 || of == 0.0 || body == of;
        if is_own && x * to_x + y * to_y + z * to_z >= least {
            *sum = sum.wrapping_add(crossing.sign);
        }
    }
}
