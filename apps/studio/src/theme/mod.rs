//! Colours and sizes of the window, dark and light. All colours are exactly neutral greys,
//! because colour is judged here; the surround of the canvas has 18 % reflectance in both
//! themes. All text has a contrast of at least 7:1 (WCAG 2.2, level AAA).

mod contrast;
mod colors;
mod visuals;
mod look;
mod scale;

pub use colors::{BOARD, BOARD_TEXT, Colors, DARK, LIGHT, SURROUND, colors};
pub use contrast::contrast;
pub(crate) use look::text_field;
pub use look::{
    Look, PANEL_WIDTH, TOUCH_TARGET, ThemeChoice, apply, apply_look, at_least, is_narrow, is_touch,
    panel_width, target,
};
pub use scale::{scale_in_window, stepped_scale};
pub use visuals::CORNER_RADIUS;
