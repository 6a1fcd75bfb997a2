//! How the pen controls one brush where this differs from the painter's general settings, including
//! the stabiliser, which smooths the path of a brush.

use serde::{Deserialize, Serialize};

use super::points::PressureCurve;
use super::reading::{BrushFileError, Object};

/// The tilt of a brush.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TiltUse {
    /// The general settings decide.
    #[default]
    AsSet,
    /// The tilt of the pen, where it measures one.
    Pen,
    /// The tilt that the general settings give a mouse, even if the pen measures its own.
    Ignored,
    /// Tilted by this angle, 0 to 80 degrees from upright, towards the hand of the general
    /// settings.
    Fixed(f64),
}

/// The rotation of a brush about its handle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TwistUse {
    /// The general settings decide.
    #[default]
    AsSet,
    /// The rotation of the pen, where it measures one.
    Device,
    /// The broad side turns across the direction of the stroke.
    Stroke,
    /// Turned by this angle clockwise, 0 to 360 degrees. At 0 the broad side is horizontal.
    Fixed(f64),
}

/// How the pen controls one brush.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BrushOptions {
    /// Tilt of the brush.
    pub tilt: TiltUse,
    /// Rotation about the handle.
    pub twist: TwistUse,
    /// Pressures of the brush at the lightest and the heaviest touch, 0 to 1. A pressure of 0 stays
    /// 0, because you have lifted the brush then.
    pub range: [f64; 2],
    /// Curve of the pressure. If you set this, it replaces the general one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub curve: Option<PressureCurve>,
    /// Stabiliser. If you set this, it replaces the general one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stabiliser: Option<StabiliserSettings>,
}

impl Default for BrushOptions {
    fn default() -> Self {
        let tilt = TiltUse::AsSet;
        let twist = TwistUse::AsSet;
        Self { tilt, twist, range: [0.0, 1.0], curve: None, stabiliser: None }
    }
}

impl BrushOptions {
    /// Maps a pressure from 0 to 1 into the range.
    #[must_use]
    pub fn in_range(&self, pressure: f64) -> f64 {
        let [least, most] = self.range;
        if pressure > 0.0 { least + (most - least) * pressure } else { 0.0 }
    }

    /// Replaces values that are out of range by the defaults.
    pub fn bound(&mut self) {
        if !self.tilt_is_valid() {
            self.tilt = TiltUse::default();
        }
        if !self.twist_is_valid() {
            self.twist = TwistUse::default();
        }
        if !self.range_is_valid() {
            self.range = Self::default().range;
        }
        self.curve.iter_mut().for_each(PressureCurve::bound);
        self.stabiliser.iter_mut().for_each(StabiliserSettings::bound);
    }

    /// Reads the options of a file.
    pub(super) fn read(mut object: Object<'_>) -> Result<Self, BrushFileError> {
        let default = Self::default();
        let read = Self {
            tilt: object.take("tilt")?.unwrap_or_default(),
            twist: object.take("twist")?.unwrap_or_default(),
            range: object.take("range")?.unwrap_or(default.range),
            curve: object.take("curve")?,
            stabiliser: object.take("stabiliser")?,
        };
        let curve = read.curve.as_ref();
        let bounded = curve.cloned().map(|mut curve| {
            curve.bound();
            curve
        });
        let stabiliser = read.stabiliser.is_none_or(|stabiliser| stabiliser.is_valid());
        for (valid, key, what) in [
            (read.tilt_is_valid(), "tilt", "is not within 0 to 80 degrees"),
            (read.twist_is_valid(), "twist", "is not within 0 to 360 degrees"),
            (read.range_is_valid(), "range", "must be two ascending numbers of 0 to 1"),
            (bounded.as_ref() == curve, "curve", "has an exponent that is not within 0.2 to 5"),
            (stabiliser, "stabiliser", "has a length that is not within 0.1 to 500"),
        ] {
            if !valid {
                return Err(object.fault_at(key, what));
            }
        }
        object.end()?;
        Ok(read)
    }

    fn tilt_is_valid(&self) -> bool {
        !matches!(self.tilt, TiltUse::Fixed(degrees) if !(0.0..=80.0).contains(&degrees))
    }

    fn twist_is_valid(&self) -> bool {
        !matches!(self.twist, TwistUse::Fixed(degrees) if !(0.0..=360.0).contains(&degrees))
    }

    fn range_is_valid(&self) -> bool {
        let [least, most] = self.range;
        (0.0..=1.0).contains(&least) && (least..=1.0).contains(&most)
    }
}

/// Allowed lengths of a stabiliser, in either unit.
const LENGTHS: std::ops::RangeInclusive<f64> = 0.1..=500.0;

/// How the brush follows the pen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StabiliserMethod {
    /// The brush is where the pen is.
    #[default]
    Off,
    /// The brush is at the mean position over the last stretch of the pen's path.
    Average,
    /// The pen pulls the brush by a string of this length.
    String,
}

/// Unit of the length of a stabiliser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Millimetres of the surface at any zoom.
    #[default]
    Mm,
    /// Points of the window. These are pixels if the interface is not scaled.
    Px,
}

/// How the brush follows the pen, and how far behind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StabiliserSettings {
    /// How the brush follows.
    pub method: StabiliserMethod,
    /// Length of the averaged path or of the string, 0.1 to 500.
    pub length: f64,
    /// Unit of the length.
    pub unit: LengthUnit,
}

impl Default for StabiliserSettings {
    /// Switched off. If you switch it on, its length is 4 mm.
    fn default() -> Self {
        Self { method: StabiliserMethod::Off, length: 4.0, unit: LengthUnit::Mm }
    }
}

impl StabiliserSettings {
    /// Whether the length is in its range.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        LENGTHS.contains(&self.length)
    }

    /// Replaces a length that is out of range by the default.
    pub fn bound(&mut self) {
        if !self.is_valid() {
            (self.length, self.unit) = (Self::default().length, Self::default().unit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_range_of_pressure_starts_at_the_lightest_touch() {
        let options = BrushOptions { range: [0.2, 0.6], ..BrushOptions::default() };
        assert_eq!((options.in_range(0.0), options.in_range(0.5)), (0.0, 0.4));
        assert!((options.in_range(1e-9) - 0.2).abs() < 1e-6, "the lightest touch");
    }

    #[test]
    fn values_out_of_range_are_replaced() {
        let mut options = BrushOptions {
            tilt: TiltUse::Fixed(f64::NAN),
            twist: TwistUse::Fixed(-1.0),
            range: [0.7, 0.2],
            curve: Some(PressureCurve::Power(40.0)),
            stabiliser: Some(StabiliserSettings { length: 0.0, ..StabiliserSettings::default() }),
        };
        options.bound();
        let kept = BrushOptions {
            curve: Some(PressureCurve::LINEAR),
            stabiliser: Some(StabiliserSettings::default()),
            ..BrushOptions::default()
        };
        assert_eq!(options, kept);
    }
}
