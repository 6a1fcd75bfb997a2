//! The surface that a volume wets, by the samples that it holds.

use glam::{DVec3, Vec3};

use super::film_profile::{FilmProfile, smooth_step};
use super::lattice::{SampleLattice, SampledSurface};
use crate::containing::Inside;
use crate::volume::Volume;

/// Held samples below which the surface counts as its tangent plane, and from which the samples
/// alone count.
const FEW: f64 = 8.0;
const MANY: f64 = 24.0;

/// Rings and directions over which a tangent plane is measured.
const RINGS: usize = 12;
const DIRECTIONS: usize = 32;

/// The reach of a volume over surfaces.
#[derive(Debug, Clone, Copy)]
pub struct Wetted {
    /// Centre in the unit of the scene.
    pub center: Vec3,
    /// Distance of the farthest vertex from the centre, in the unit of the scene.
    pub reach: f32,
    /// 1 / radius.
    pub per_radius: f32,
    /// Mean normal of the surface that the volume lies on; surfaces that face away from it are not
    /// wetted. Zero for a volume that wets all that it holds.
    pub facing: Vec3,
    /// Number of the only body that it wets; 0 for all.
    pub body: u32,
}

impl Wetted {
    /// The reach of `volume` whose inside is `inside`.
    #[must_use]
    pub fn of(volume: &Volume, inside: &Inside) -> Self {
        let reach = inside.farthest() as f32;
        let Volume { center, radius, normal, body, .. } = *volume;
        Self { center, reach, per_radius: 1.0 / radius, facing: normal, body }
    }

    /// Height of the film of `profile` at a place on a surface with this normal, relative to that
    /// far inside; 0 beyond the reach of the volume and where the surface faces away. Depends on
    /// volume and place alone, whether the volume holds the place or not.
    #[must_use]
    #[inline]
    pub fn relative_height(&self, profile: &FilmProfile, place: Vec3, normal: Vec3) -> f32 {
        let from = place - self.center;
        let distance = from.length_squared();
        // Also false for what is no number.
        let near = distance < self.reach * self.reach && !self.faces_away(profile, normal);
        if !near {
            return 0.0;
        }
        profile.height((self.reach - distance.sqrt()) * self.per_radius)
    }

    /// Whether surface of this body is never wetted; 0 may be any body.
    #[must_use]
    #[inline]
    pub fn is_foreign(&self, body: u32) -> bool {
        self.body != 0 && body != 0 && body != self.body
    }

    #[inline]
    fn faces_away(&self, profile: &FilmProfile, normal: Vec3) -> bool {
        self.facing != Vec3::ZERO && normal.dot(self.facing) < profile.gate
    }

    /// Integral of [`Self::relative_height`] over the surface that the volume holds, in the unit of
    /// the scene squared. Volumes that hold few samples are measured on the tangent plane of the
    /// nearest one. 0 if it holds no surface.
    #[must_use]
    pub fn film_area(
        &self,
        inside: &Inside,
        profile: &FilmProfile,
        surface: &SampledSurface<'_>,
        lattice: &SampleLattice,
    ) -> f64 {
        let mut count = 0.0;
        let mut area = 0.0;
        let own = |index: &usize| !self.is_foreign(surface.bodies[*index]);
        for index in lattice.near(self.center, self.reach).filter(own) {
            let place = surface.places[index];
            let normal = surface.normals[index];
            let patch = surface.areas[index];
            let height = self.relative_height(profile, place, normal);
            if height > 0.0 {
                let share = held_share(inside, place, normal, f64::from(patch.sqrt()));
                count += share;
                area += share * f64::from(patch * height);
            }
        }
        if count >= MANY {
            return area;
        }
        let Some(on_plane) = self.area_on_plane(inside, profile, surface, lattice) else {
            return area;
        };
        let share = f64::from(smooth_step(((count - FEW) / (MANY - FEW)) as f32));
        on_plane + share * (area - on_plane)
    }

    /// The integral on the tangent plane of the nearest sample; none if no sample is near, or the
    /// plane passes the volume.
    fn area_on_plane(
        &self,
        inside: &Inside,
        profile: &FilmProfile,
        surface: &SampledSurface<'_>,
        lattice: &SampleLattice,
    ) -> Option<f64> {
        let away = |&index: &usize| surface.places[index].distance_squared(self.center);
        let near = lattice.near(self.center, self.reach).filter(|&index: &usize| {
            !self.faces_away(profile, surface.normals[index])
                && !self.is_foreign(surface.bodies[index])
        });
        let nearest = near.min_by(|a, b| away(a).total_cmp(&away(b)))?;
        let normal = surface.normals[nearest];
        let above = (self.center - surface.places[nearest]).dot(normal);
        let foot = self.center - above * normal;
        let most = self.reach * self.reach - above * above;
        if most <= 0.0 {
            return None;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let step = most.sqrt() / RINGS as f32;
        let mut area = 0.0;
        for ring in 0..RINGS {
            let radius = (ring as f32 + 0.5) * step;
            let piece = std::f64::consts::TAU * f64::from(radius * step) / DIRECTIONS as f64;
            for direction in 0..DIRECTIONS {
                let turn = (direction as f64 + 0.5) / DIRECTIONS as f64 * std::f64::consts::TAU;
                let (sin, cos) = turn.sin_cos();
                let place = foot + radius * (u * cos as f32 + v * sin as f32);
                let height = self.relative_height(profile, place, normal);
                let share = held_share(inside, place, normal, f64::from(step));
                area += piece * share * f64::from(height);
            }
        }
        Some(area)
    }
}

/// How much of a patch of surface as wide as `width` a volume holds, 0 to 1: all or nothing, but
/// for patches that the skin crosses.
fn held_share(inside: &Inside, place: Vec3, normal: Vec3, width: f64) -> f64 {
    let ray: DVec3 = place.as_dvec3() - inside.center();
    let distance = ray.length();
    let rest = inside.exit(place).distance - distance;
    // The skin crosses the surface farther from the place where the ray is steep over it.
    let steep = ray.dot(normal.as_dvec3()) / distance;
    let along = (1.0 - steep * steep).max(0.01).sqrt();
    let share = 0.5 + rest / (along * width);
    if share.is_nan() { 1.0 } else { share.clamp(0.0, 1.0) }
}
