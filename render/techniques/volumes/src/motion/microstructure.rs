//! The microstructure of surfaces: the resting radius varies with the place in the world.

use graphics::noise::{SolidHills, random};

use super::settings::MotionSettings;

/// Hills in the whole scene, by which the resting radius of every particle varies. Volumes at one
/// place share them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Microstructure {
    hills: SolidHills,
}

impl Microstructure {
    /// The microstructure that `seed` decides.
    #[must_use]
    pub fn of_seed(seed: u64) -> Self {
        // A stream of its own among the random numbers of a seed.
        const STREAM: u64 = 0x6772_6169;
        Self { hills: SolidHills::new(&mut random(seed, STREAM)) }
    }

    /// Its hills, which tell two microstructures apart.
    pub(super) fn hills(self) -> SolidHills {
        self.hills
    }
}

/// Resting radii of the particles of one volume.
#[derive(Debug, Clone, Copy)]
pub(super) struct RestingRadii {
    pub(super) hills: SolidHills,
    /// Greatest share of the radius that the hills add.
    pub(super) height: f32,
    /// Units of the hills in one unit of the scene.
    pub(super) units: f32,
    pub(super) center: [f32; 3],
    pub(super) radius: f32,
    /// Factor that keeps a resting mesh outside of its nominal ball.
    pub(super) scale: f32,
}

impl RestingRadii {
    pub(super) fn new(
        microstructure: Microstructure,
        settings: &MotionSettings,
        cell: f32,
        center: [f32; 3],
        inradius: f32,
    ) -> Self {
        // The hills are strongest at a wavelength of `grain` cells.
        let units = 1.0 / (SolidHills::STRONGEST * settings.grain * cell);
        let hills = microstructure.hills;
        let height = settings.microstructure;
        Self { hills, height, units, center, radius: 0.0, scale: 1.0 / inradius }
    }

    /// Writes the resting radius in every direction: R (1 + a N(c + R u)) over the inradius.
    #[inline(always)]
    pub(super) fn write(&self, directions: [&[f32]; 3], out: &mut [f32]) {
        let (radius, scaled) = (self.radius, self.radius * self.scale);
        let [x, y, z] = directions.map(|along| &along[..out.len()]);
        if self.height == 0.0 {
            out.fill(scaled);
            return;
        }
        let [from_x, from_y, from_z] = self.center;
        for i in 0..out.len() {
            let hill = self.hills.at([
                (from_x + radius * x[i]) * self.units,
                (from_y + radius * y[i]) * self.units,
                (from_z + radius * z[i]) * self.units,
            ]);
            out[i] = scaled * (1.0 + self.height * hill);
        }
    }
}
