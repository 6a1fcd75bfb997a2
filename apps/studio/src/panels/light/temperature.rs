//! A slider of colour temperature: CIE daylight, or a black body below 4000 K.

use eframe::egui::{Slider, Ui};

use super::super::pending_value::Edit;
use super::labelled_slider::labelled_slider;
use crate::language::tr;

/// Lowest temperature of CIE daylight, in kelvin (CIE 15:2018).
const DAYLIGHT_FROM: f64 = 4000.0;

/// Range of the slider, in kelvin.
const KELVIN: (f64, f64) = (1500.0, 25000.0);

/// Time after the last key press at which the temperature is applied, in seconds.
const PAUSE: f64 = 0.5;

/// The slider and its temperature that is not applied yet.
#[derive(Debug, Default)]
pub(super) struct Temperature {
    waiting: Option<(f64, Option<f64>)>,
}

impl Temperature {
    /// Name in `spectra` of the light being set.
    pub(super) fn preview(&self) -> Option<String> {
        self.waiting.map(|(kelvin, _)| light(kelvin))
    }

    /// Draws the slider; `kelvin` is the temperature of the current light. Returns the
    /// name of the chosen light once the slider is released or no key was pressed for a
    /// while.
    pub(super) fn show(&mut self, ui: &mut Ui, name: &str, kelvin: f64) -> Option<String> {
        let now = ui.input(|input| input.time);
        let mut value = self.waiting.map_or(kelvin, |(waiting, _)| waiting);
        let slider = Slider::new(&mut value, KELVIN.0..=KELVIN.1)
            .logarithmic(true)
            .smart_aim(false)
            .custom_formatter(|kelvin, _| format!("{:.0}", rounded(kelvin)))
            .suffix(" K")
            .update_while_editing(false);
        let response = labelled_slider(ui, tr("Temperature"), slider).accessible_name(name).on_hover_text(
            tr("Temperature of the light: daylight from 4000 K, a black body below. Applied on release"),
        );
        let value = rounded(value);
        match Edit::of(&response) {
            Edit::Dragged => self.waiting = Some((value, None)),
            Edit::Released => {
                self.waiting = None;
                return Some(light(value));
            }
            Edit::Set => {
                self.waiting = Some((value, Some(now)));
            }
            Edit::None => {}
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

/// Rounds to just visible steps: 10 K below 10000 K, else 100 K.
fn rounded(kelvin: f64) -> f64 {
    let step = if kelvin < 10000.0 { 10.0 } else { 100.0 };
    (kelvin / step).round() * step
}

/// Name of a light in `spectra`: `D5600K` for daylight, `3200K` for a black body.
fn light(kelvin: f64) -> String {
    if kelvin < DAYLIGHT_FROM { format!("{kelvin}K") } else { format!("D{kelvin}K") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_names_are_known_to_spectra() {
        for (kelvin, wanted) in
            [(1500.0, "1500K"), (3990.0, "3990K"), (4000.0, "D4000K"), (25000.0, "D25000K")]
        {
            assert_eq!(light(kelvin), wanted);
            spectra::light_from_text(wanted).unwrap();
        }
    }

    #[test]
    fn rounded_temperatures_stay_on_the_slider() {
        assert_eq!([5604.9, 12345.0, 9996.0].map(rounded), [5600.0, 12300.0, 10000.0]);
        assert_eq!([KELVIN.0, KELVIN.1].map(rounded), [KELVIN.0, KELVIN.1]);
    }
}
