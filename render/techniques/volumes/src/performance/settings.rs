//! Settings of a file as those of a world.

use crate::motion::MotionSettings;
use crate::settings::Settings;
use crate::world::WorldSettings;

impl From<&Settings> for WorldSettings {
    fn from(settings: &Settings) -> Self {
        let Settings { motion, grid, .. } = settings;
        Self {
            unit_mm: (settings.unit_mm > 0.0).then(|| f64::from(settings.unit_mm)),
            cell: grid.cell,
            samples: grid.samples as usize,
            film_mm: f64::from(grid.film_mm),
            rate: grid.rate,
            slope: grid.slope,
            seed: u64::from(settings.seed),
            motion: MotionSettings {
                pressure: motion.pressure,
                elastic: motion.elastic,
                cohesion: motion.cohesion,
                friction: motion.friction,
                kick: motion.kick,
                microstructure: motion.microstructure,
                grain: motion.grain,
                fastest: motion.fastest,
                surface_pull: motion.surface_pull,
                gravity: motion.gravity,
                keep: motion.keep,
            },
        }
    }
}
