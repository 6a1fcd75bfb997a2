//! Precision of the numbers that stored maps keep.

use half::f16;

use crate::pixel_maps::BlockMaps;

/// Number by which a probability of 1 is stored.
pub(crate) const PRESENCE_ONE: f32 = 250.0;
/// Number that stands for no probability.
pub(crate) const NO_PRESENCE: u8 = 255;

/// Share or deviation as it is stored. Every NaN has the same bits.
pub(crate) fn half_of(value: f32) -> f16 {
    if value.is_nan() { f16::NAN } else { f16::from_f32(value) }
}

/// Probability as it is stored.
pub(crate) fn code_of(presence: f32) -> u8 {
    match presence.is_nan() {
        true => NO_PRESENCE,
        false => (presence.clamp(0.0, 1.0) * PRESENCE_ONE).round() as u8,
    }
}

/// Probability of a stored number.
pub(crate) fn presence_of(code: u8) -> f32 {
    match code {
        NO_PRESENCE => f32::NAN,
        code => f32::from(code) / PRESENCE_ONE,
    }
}

impl BlockMaps {
    /// The maps as they are read from a store: shares and their deviations in half precision, presence in
    /// steps of 1/250.
    #[must_use]
    pub fn as_kept(mut self) -> Self {
        for value in self.share.iter_mut().chain(&mut self.share_sd) {
            *value = half_of(*value).to_f32();
        }
        for value in &mut self.presence {
            *value = presence_of(code_of(*value));
        }
        self
    }
}
