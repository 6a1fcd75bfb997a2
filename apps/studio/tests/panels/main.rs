//! Tests of the panels and of the whole window without a window system, some with a real worker and
//! a synthetic pen.

#![expect(clippy::unwrap_used, reason = "a test may panic")]

mod harness;
mod fixture;
mod painter;
mod brushes;
mod canvas;
mod eyedropper;
mod files;
mod guide;
mod keys;
mod layers;
mod layout;
mod light;
mod pen;
mod reference;
mod tubes;
mod volumes;
mod monkey;
mod look;
mod touch;
mod language;
mod aids;
