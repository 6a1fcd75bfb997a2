//! The light: illuminant, direction, gloss, split view.

mod lamps;

mod picker;

mod row;

mod temperature;

mod choice;

mod curve;

mod white;

mod dome;

mod gloss_pad;

mod panel;

pub use panel::LightPanel;
