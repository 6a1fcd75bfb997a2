//! Tests of the panels and of the whole window without a window system, some with a real worker and
//! a synthetic pen.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod harness;

mod fixture;

mod painter;

mod panel_window;

mod brushes;

mod canvas;

mod drawing;

mod eyedropper;

mod files;

mod history;

mod layers;

mod layout;

mod light;

mod pen;

mod reference;

mod tubes;

mod volumes;

mod whole;

mod volume_paint;
