//! Control of one illuminant: a list and a temperature slider.

use eframe::egui::Ui;
use spectra::{ColorTemperature, light_from_text};

use super::picker::Picker;
use super::temperature::Temperature;
use crate::language::tr;

/// Slider position for a light without a colour temperature, in kelvin.
const USUAL_KELVIN: f64 = 6500.0;

/// Controls that choose one illuminant.
#[derive(Debug)]
pub(in crate::panels) struct IlluminantControl {
    picker: Picker,
    temperature_name: &'static str,
    temperature: Temperature,
    /// Name and colour temperature (kelvin) of the light last shown.
    known: (String, f64),
}

impl IlluminantControl {
    /// Creates the controls with their accessible names.
    pub(in crate::panels) fn new(name: &'static str, temperature_name: &'static str) -> Self {
        Self {
            picker: Picker::new(name),
            temperature_name,
            temperature: Temperature::default(),
            known: (String::new(), USUAL_KELVIN),
        }
    }

    /// Draws the controls. Returns the name of the illuminant that was chosen.
    pub(in crate::panels) fn show(&mut self, ui: &mut Ui, chosen: &str) -> Option<String> {
        if self.known.0 != chosen {
            let light = light_from_text(chosen).ok();
            let temperature = light.as_ref().and_then(ColorTemperature::of);
            let kelvin = temperature.map_or(USUAL_KELVIN, |temperature| temperature.kelvin);
            self.known = (chosen.to_owned(), kelvin);
        }
        let picked = self.picker.show(ui, chosen);
        picked.or(self.temperature.show(ui, tr(self.temperature_name), self.known.1))
    }

    /// Name of the illuminant at the slider while it is being moved.
    pub(in crate::panels) fn preview(&self) -> Option<String> {
        self.temperature.preview()
    }
}
