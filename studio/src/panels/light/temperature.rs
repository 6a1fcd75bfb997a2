//! Light by its temperature: daylight, and below it a black body.

use eframe::egui::{Slider, Ui};

use super::super::draft::Touch;
use super::row::row;

/// Daylight begins here, in kelvin (CIE 15:2018).
const DAYLIGHT_FROM: f64 = 4000.0;

/// The temperatures of the slider.
const KELVIN: (f64, f64) = (1500.0, 25000.0);

/// Seconds without a key after which a temperature is taken.
const PAUSE: f64 = 0.5;

/// The slider, with a temperature that has not been asked for yet.
#[derive(Debug, Default)]
pub(super) struct Temperature {
    waiting: Option<(f64, Option<f64>)>,
}

impl Temperature {
    /// The temperature being set, as `spectra` names its light.
    pub(super) fn wished(&self) -> Option<String> {
        self.waiting.map(|(kelvin, _)| light(kelvin))
    }

    /// Shows the slider called `name`; `kelvin` is that of the present light. Gives the light
    /// that is asked for: once the slider is let go, or keys rest.
    pub(super) fn show(&mut self, ui: &mut Ui, name: &str, kelvin: f64) -> Option<String> {
        let now = ui.input(|input| input.time);
        let mut value = self.waiting.map_or(kelvin, |(waiting, _)| waiting);
        let slider = Slider::new(&mut value, KELVIN.0..=KELVIN.1)
            .logarithmic(true)
            .smart_aim(false)
            .custom_formatter(|kelvin, _| format!("{:.0}", rounded(kelvin)))
            .suffix(" K")
            .update_while_editing(false);
        let response = row(ui, "Temperature", slider).accessible_name(name).on_hover_text(
            "Temperature of the light: daylight from 4000 K, a black body below. Taken when let go",
        );
        let value = rounded(value);
        match Touch::of(&response) {
            Touch::Dragged => self.waiting = Some((value, None)),
            Touch::LetGo => {
                self.waiting = None;
                return Some(light(value));
            }
            Touch::Set => {
                self.waiting = Some((value, Some(now)));
            }
            Touch::None => {}
        }
        let (value, since) = self.waiting?;
        let since = since?;
        if now >= since + PAUSE {
            self.waiting = None;
            return Some(light(value));
        }
        ui.ctx().request_repaint_after_secs((since + PAUSE - now) as f32);
        None
    }
}

/// Steps that the eye can just tell: 10 K up to 10000 K, then 100 K.
fn rounded(kelvin: f64) -> f64 {
    let step = if kelvin < 10000.0 { 10.0 } else { 100.0 };
    (kelvin / step).round() * step
}

/// `D5600K`, `3200K`.
fn light(kelvin: f64) -> String {
    if kelvin < DAYLIGHT_FROM { format!("{kelvin}K") } else { format!("D{kelvin}K") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_lights_that_spectra_knows() {
        for (kelvin, wanted) in
            [(1500.0, "1500K"), (3990.0, "3990K"), (4000.0, "D4000K"), (25000.0, "D25000K")]
        {
            assert_eq!(light(kelvin), wanted);
            spectra::light_from_text(wanted).unwrap();
        }
    }

    #[test]
    fn temperatures_are_round_and_stay_on_the_slider() {
        assert_eq!([5604.9, 12345.0, 9996.0].map(rounded), [5600.0, 12300.0, 10000.0]);
        assert_eq!([KELVIN.0, KELVIN.1].map(rounded), [KELVIN.0, KELVIN.1]);
    }
}
