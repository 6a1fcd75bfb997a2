//! Tests of the panels and of the whole window without a window system, some with a real worker and
//! a synthetic pen.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod harness;
mod fixture;
mod seen;
mod painter;
mod panel_window;
mod brushes;
mod canvas;
mod over_canvas;
mod drawing;
mod eyedropper;
mod wheel;
mod swatches;
mod quick;
mod files;
mod floating;
mod glyphs;
mod guide;
mod history;
mod keys;
mod layers;
mod layout;
mod narrow;
mod between;
mod light;
mod own_brushes;
mod pen;
mod pen_window;
mod reference;
mod tour;
mod tubes;
mod volumes;
mod whole;
mod monkey;
mod volume_paint;
mod volume_files;
mod volume_exports;
mod look;
mod look_windows;
mod touch;
mod idle;
mod language;
mod docking;
mod working;
mod aids;
mod meshes;
