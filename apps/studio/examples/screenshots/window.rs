//! The window of the tests, and waiting for what it shows.

use std::error::Error;
use std::time::Duration;

use egui_kittest::kittest::Queryable;

#[expect(dead_code, reason = "the tests need more of it")]
#[path = "../../tests/panels/harness.rs"]
mod harness;

pub(crate) use harness::{Window, button, has_adapter};

/// Draws frames until a control with this label exists.
pub(crate) fn wait_for(window: &mut Window, label: &str) -> Result<(), Box<dyn Error>> {
    for _ in 0..6000 {
        if window.harness().query_by_label(label).is_some() {
            return Ok(());
        }
        std::thread::sleep(Duration::from_millis(5));
        window.harness().step();
    }
    Err(format!("the window shows no \"{label}\"").into())
}
