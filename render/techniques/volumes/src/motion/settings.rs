//! Settings of the motion of volumes, for example stiffness, friction and roughness, and the error
//! that you get if volumes cannot be moved.

use documents::hint::Explain;
use graphics::gpu::DeviceError;

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
    /// Standard deviation of the velocity with which particles begin, 0 to 100 radii a second; 0.3
    /// by default.
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

/// A setting, a volume or a time does not allow motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error, Explain)]
pub enum MotionError {
    /// A number is out of its range.
    #[error("{key} is {least} to {most}, found `{value}`")]
    #[hint("leave the setting out to take its default")]
    #[fault(Setting)]
    OutOfRange {
        /// Name of the setting, for example `pressure`.
        key: &'static str,
        /// Value that was found.
        value: f32,
        /// Least value allowed.
        least: f32,
        /// Greatest value allowed.
        most: f32,
    },
    /// Stiff forces would need more sub-steps than are taken at once.
    #[error(
        "{seconds} s under forces of stiffness {stiffness} 1/s^2 take {needed} sub-steps, more than {most}: at most {fitting_seconds} s, or a stiffness of at most {fitting_stiffness} 1/s^2, would fit"
    )]
    #[hint(
        verbatim,
        "take shorter steps, or weaker forces: the settings motion.pressure, elastic, cohesion, surface_pull, keep"
    )]
    #[fault(Setting)]
    TooStiff {
        /// Time that was asked for, in seconds.
        seconds: f32,
        /// Stiffness of all forces together, in 1/s^2.
        stiffness: f32,
        /// Number of sub-steps that it takes; a whole number.
        needed: f32,
        /// Greatest number of sub-steps.
        most: u32,
        /// Longest time that fits this stiffness, in seconds.
        fitting_seconds: f32,
        /// Greatest stiffness that fits this time, in 1/s^2.
        fitting_stiffness: f32,
    },
    /// A volume has a centre or radius that no volume can have.
    #[error("volume {index} has {what} `{value}`, which must be {must}")]
    #[hint("give the volume a finite centre and a radius above 0")]
    Volume {
        /// Index of the volume.
        index: usize,
        /// The quantity: centre, radius or target radius.
        what: &'static str,
        /// Value that was found.
        value: f32,
        /// Its range in words.
        must: &'static str,
    },
    /// The places that describe the surface are not finite.
    #[error("place {0} of the surface is not finite")]
    #[hint("repair the mesh: a vertex of it is not a number")]
    Place(usize),
    /// The look-up of the nearest place of the surface would be too large.
    #[error(
        "cells of {cell} make {blocks} blocks of the surface's box, more than {most}: cells of {fitting_cell} would fit"
    )]
    #[hint(verbatim, "take larger cells (grid.cell)")]
    #[fault(Setting)]
    TooFine {
        /// Size of a cell, in the unit of the scene.
        cell: f32,
        /// Number of blocks; a whole number.
        blocks: f32,
        /// Greatest number of blocks.
        most: usize,
        /// Size of a cell that fits, in the unit of the scene.
        fitting_cell: f32,
    },
    /// The graphics device failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

#[cfg(test)]
mod tests {
    use super::*;
    use documents::hint::Explain;

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
