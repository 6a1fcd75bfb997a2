//! One light of the two: its list, and its temperature.

use eframe::egui::Ui;
use spectra::{ColorTemperature, light_from_text};

use super::picker::Picker;
use super::temperature::Temperature;

/// The temperature of the slider where a light has none.
const USUAL_KELVIN: f64 = 6500.0;

/// What chooses a light.
#[derive(Debug)]
pub(super) struct Choice {
    picker: Picker,
    temperature_name: &'static str,
    temperature: Temperature,
    /// The temperature of the light last shown, by its name.
    known: (String, f64),
}

impl Choice {
    /// A choice with the names of its two controls.
    pub(super) fn new(name: &'static str, temperature_name: &'static str) -> Self {
        Self {
            picker: Picker::new(name),
            temperature_name,
            temperature: Temperature::default(),
            known: (String::new(), USUAL_KELVIN),
        }
    }

    /// Shows both; gives the light that is asked for.
    pub(super) fn show(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        if self.known.0 != chosen {
            let light = light_from_text(chosen).ok();
            let temperature = light.as_ref().and_then(ColorTemperature::of);
            let kelvin = temperature.map_or(USUAL_KELVIN, |temperature| temperature.kelvin);
            self.known = (chosen.to_owned(), kelvin);
        }
        let picked = self.picker.show(ui, chosen);
        picked.or(self.temperature.show(ui, self.temperature_name, self.known.1))
    }

    /// The light that the slider stands at, while it is being set.
    pub(super) fn wished(&self) -> Option<String> {
        self.temperature.wished()
    }
}
