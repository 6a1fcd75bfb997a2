//! The light panel: illuminant, direction, gloss and split view.

mod illuminants;
mod picker;
mod labelled_slider;
mod temperature;
mod illuminant;
mod power_chart;
mod white;
mod direction;
mod gloss_pad;
mod panel;

pub(super) use direction::{Direction, direction_control, direction_text};
pub(super) use illuminant::IlluminantControl;
pub use panel::LightPanel;
pub(super) use power_chart::power_chart;
pub(super) use white::White;
