//! Region and size of a wheel, computed once for each lightness.

use std::sync::Arc;

use pigment::palette::Boundary;

use crate::wheel_maker::MadeWheel;

/// Region and size of a wheel.
#[derive(Debug, Default)]
pub(super) struct WheelView {
    made: Option<MadeWheel>,
    lightness: Option<f64>,
    /// Colours that the tubes reach at the lightness.
    pub(super) region: Option<Boundary>,
    /// Greatest chroma of all mixtures.
    pub(super) chroma: f64,
}

impl WheelView {
    /// Follows the wheel and the lightness.
    pub(super) fn update(&mut self, made: Option<&MadeWheel>, lightness: Option<f64>) {
        let Some(Ok(wheel)) = made.map(|made| made.as_ref().as_ref()) else { return };
        let same = self.made.as_ref().zip(made).is_some_and(|(own, made)| Arc::ptr_eq(own, made));
        if !same {
            let chroma =
                wheel.gamut.samples.iter().map(|one| one.color.lab.a.hypot(one.color.lab.b));
            self.chroma = chroma.fold(0.0, f64::max);
            self.made = made.cloned();
        }
        if !same || self.lightness != lightness || self.region.is_none() {
            self.region = Some(wheel.region(lightness));
            self.lightness = lightness;
        }
    }
}
