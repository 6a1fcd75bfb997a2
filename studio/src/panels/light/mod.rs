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

pub use panel::LightPanel;
