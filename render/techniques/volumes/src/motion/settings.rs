//! How stiff volumes are, how much friction they have, how rough they grow.

use super::error::MotionError;

/// The settings of motion. Stiffness is per unit of mass; lengths are in cells of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionSettings {
    /// Stiffness of the pressure that keeps particles at the resting radius, 0 to 1e6 1/s^2; 400 by
    /// default.
    pub pressure: f32,
    /// Stiffness of the elastic force that keeps particles in their directions, 0 to 1e6 1/s^2; 100
    /// by default.
    pub elastic: f32,
    /// Stiffness of the cohesion between neighbours, 0 to 1e6 1/s^2; 200 by default.
    pub cohesion: f32,
    /// Friction, 0 to 1e4 1/s; 40 by default, which is critical for the pressure.
    pub friction: f32,
    /// Standard deviation of the velocity at birth, 0 to 100 radii a second; 0.3 by default.
    pub kick: f32,
    /// Greatest change of the resting radius by the microstructure of the surface, 0 to 0.9 of the
    /// radius; 0.18 by default.
    pub microstructure: f32,
    /// Wavelength of the microstructure, 0.01 to 100 cells; 0.35 by default.
    pub grain: f32,
    /// Greatest speed at which the resting radius grows or shrinks, 0.001 to 1000 cells a second; 1
    /// by default.
    pub fastest: f32,
    /// Stiffness of the pull to the surface, 0 to 1e6 1/s^2; 50 by default.
    pub surface_pull: f32,
    /// Gravity along the surface, 0 to 1e6 cells/s^2; 0 by default.
    pub gravity: f32,
    /// Stiffness of the walls of keep-in regions, 0 to 1e6 1/s^2; 2000 by default.
    pub keep: f32,
}

impl Default for MotionSettings {
    fn default() -> Self {
        Self {
            pressure: 400.0,
            elastic: 100.0,
            cohesion: 200.0,
            friction: 40.0,
            kick: 0.3,
            microstructure: 0.18,
            grain: 0.35,
            fastest: 1.0,
            surface_pull: 50.0,
            gravity: 0.0,
            keep: 2000.0,
        }
    }
}

impl MotionSettings {
    /// Every setting with its name, least and greatest value.
    #[must_use]
    pub fn numbers(&self) -> [(&'static str, f32, f32, f32); 11] {
        const STIFFEST: f32 = 1e6;
        [
            ("pressure", self.pressure, 0.0, STIFFEST),
            ("elastic", self.elastic, 0.0, STIFFEST),
            ("cohesion", self.cohesion, 0.0, STIFFEST),
            ("friction", self.friction, 0.0, 1e4),
            ("kick", self.kick, 0.0, 100.0),
            ("microstructure", self.microstructure, 0.0, 0.9),
            ("grain", self.grain, 0.01, 100.0),
            ("fastest", self.fastest, 0.001, 1000.0),
            ("surface_pull", self.surface_pull, 0.0, STIFFEST),
            ("gravity", self.gravity, 0.0, 1e6),
            ("keep", self.keep, 0.0, STIFFEST),
        ]
    }

    /// Checks the ranges of all numbers.
    ///
    /// # Errors
    /// [`MotionError::OutOfRange`] for the first number out of range.
    pub fn check(&self) -> Result<(), MotionError> {
        for (key, value, least, most) in self.numbers() {
            in_range(key, value, least, most)?;
        }
        Ok(())
    }
}

/// Whether `value` lies in `least..=most`, which no NaN does.
pub(super) fn in_range(
    key: &'static str,
    value: f32,
    least: f32,
    most: f32,
) -> Result<(), MotionError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(MotionError::OutOfRange { key, value, least, most })
}

#[cfg(test)]
mod tests {
    use documents::hint::Explain;

    use super::*;

    #[test]
    fn defaults_lie_in_their_ranges() {
        assert_eq!(MotionSettings::default().check(), Ok(()));
    }

    #[test]
    fn a_number_out_of_range_is_named_with_what_would_fit() {
        let error = MotionSettings { grain: f32::NAN, ..MotionSettings::default() }.check();
        assert!(error.unwrap_err().to_string().starts_with("grain is 0.01 to 100, found `NaN`"));
        let error = MotionSettings { friction: 10_001.0, ..MotionSettings::default() }.check();
        let error = error.unwrap_err();
        assert_eq!(error.to_string(), "friction is 0 to 10000, found `10001`");
        assert!(error.hint().is_some());
    }
}
