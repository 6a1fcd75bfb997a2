//! The arrays of maps: names, types, and numbers as stored bytes.

use half::f16;
use serde_json::{Map, Value, json};

use crate::kept_numbers::{NO_PRESENCE, PRESENCE_ONE, code_of, half_of};
use crate::pixel_maps::{BlockMaps, Mask};

/// Number of a pixel that no run has mapped yet.
pub(crate) const NOT_YET: u8 = 255;

/// An array of maps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MapArray {
    Share,
    ShareSd,
    Presence,
    Chi2,
    Rms,
    Second,
    Mask,
}

impl MapArray {
    /// All arrays in the order in which a shard writes them. The mask comes last: where it is, the
    /// others are too.
    pub(crate) const ALL: [Self; 7] = [
        Self::Share,
        Self::ShareSd,
        Self::Presence,
        Self::Chi2,
        Self::Rms,
        Self::Second,
        Self::Mask,
    ];

    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Share => "share",
            Self::ShareSd => "share_sd",
            Self::Presence => "presence",
            Self::Chi2 => "chi2",
            Self::Rms => "rms",
            Self::Second => "second",
            Self::Mask => "mask",
        }
    }

    /// Whether the array has a number for each pigment.
    pub(crate) const fn is_of_pigments(self) -> bool {
        matches!(self, Self::Share | Self::ShareSd | Self::Presence)
    }

    pub(crate) const fn data_type(self) -> &'static str {
        match self {
            Self::Share | Self::ShareSd => "float16",
            Self::Presence | Self::Mask => "uint8",
            Self::Chi2 | Self::Rms => "float32",
            Self::Second => "uint64",
        }
    }

    /// Bytes of a number.
    pub(crate) const fn bytes(self) -> usize {
        match self {
            Self::Presence | Self::Mask => 1,
            Self::Share | Self::ShareSd => 2,
            Self::Chi2 | Self::Rms => 4,
            Self::Second => 8,
        }
    }

    pub(crate) fn fill(self) -> Value {
        match self {
            Self::Presence => json!(NO_PRESENCE),
            Self::Mask => json!(NOT_YET),
            Self::Second => json!(0),
            _ => json!("NaN"),
        }
    }

    pub(crate) fn attributes(self) -> Map<String, Value> {
        let attributes = match self {
            Self::Share => json!({"long_name": "share of the pigment", "units": "1"}),
            Self::ShareSd => {
                json!({"long_name": "standard deviation of the share", "units": "1"})
            }
            Self::Presence => json!({
                "long_name": "probability that the pigment is present",
                "units": "1",
                "scale_factor": 1.0 / f64::from(PRESENCE_ONE),
                "_FillValue": NO_PRESENCE
            }),
            Self::Chi2 => json!({"long_name": "chi-square per degree of freedom", "units": "1"}),
            Self::Rms => {
                json!({"long_name": "root mean square residual in reflectance", "units": "1"})
            }
            Self::Second => json!({
                "long_name": "second-best set of pigments: bit i is the pigment i, 0 is none"
            }),
            Self::Mask => {
                let names = Mask::ALL.map(|mask| mask.name().replace(' ', "_")).join(" ");
                let mut values: Vec<u8> = Mask::ALL.iter().map(|mask| mask.code()).collect();
                values.push(NOT_YET);
                json!({
                    "long_name": "whether the pixel is mapped, or why not",
                    "flag_values": values,
                    "flag_meanings": format!("{names} not_yet")
                })
            }
        };
        match attributes {
            Value::Object(map) => map,
            _ => Map::new(),
        }
    }

    /// Bytes of one number of the fill value.
    pub(crate) fn fill_bytes(self) -> Vec<u8> {
        match self {
            Self::Presence => vec![NO_PRESENCE],
            Self::Mask => vec![NOT_YET],
            Self::Second => vec![0; 8],
            Self::Share | Self::ShareSd => f16::NAN.to_le_bytes().to_vec(),
            Self::Chi2 | Self::Rms => f32::NAN.to_le_bytes().to_vec(),
        }
    }

    /// Writes the numbers of the pixels `pixels` of `maps` to `stored`.
    pub(crate) fn store(self, maps: &BlockMaps, pixels: std::ops::Range<usize>, stored: &mut [u8]) {
        let of_pigments = pixels.start * maps.pigments..pixels.end * maps.pigments;
        match self {
            Self::Share => halves(&maps.share[of_pigments], stored),
            Self::ShareSd => halves(&maps.share_sd[of_pigments], stored),
            Self::Presence => {
                for (byte, value) in stored.iter_mut().zip(&maps.presence[of_pigments]) {
                    *byte = code_of(*value);
                }
            }
            Self::Chi2 => singles(&maps.chi2[pixels], stored),
            Self::Rms => singles(&maps.rms[pixels], stored),
            Self::Second => {
                for (bytes, value) in stored.chunks_exact_mut(8).zip(&maps.second[pixels]) {
                    bytes.copy_from_slice(&value.to_le_bytes());
                }
            }
            Self::Mask => {
                for (byte, mask) in stored.iter_mut().zip(&maps.mask[pixels]) {
                    *byte = mask.code();
                }
            }
        }
    }
}

/// Half-precision numbers. Every NaN has the same bits.
fn halves(values: &[f32], stored: &mut [u8]) {
    for (bytes, value) in stored.chunks_exact_mut(2).zip(values) {
        bytes.copy_from_slice(&half_of(*value).to_le_bytes());
    }
}

/// Single-precision numbers. Every NaN has the same bits.
fn singles(values: &[f32], stored: &mut [u8]) {
    for (bytes, value) in stored.chunks_exact_mut(4).zip(values) {
        let value = if value.is_nan() { f32::NAN } else { *value };
        bytes.copy_from_slice(&value.to_le_bytes());
    }
}
