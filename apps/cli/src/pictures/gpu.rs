//! `impasto gpu`: shows which graphics adapter would be used, and why.

use clap::Args;
use graphics::gpu::{Adapter, BackendChoice, adapters, best};
use paint::engine::max_canvas_cells;
use serde_json::{Map, Value, json};

use crate::console::{Console, without_noise};
use crate::failure::Result;

/// Show which graphics adapter painting would use, and why
///
/// Hardware adapters that can compute are used, discrete before integrated. A software adapter
/// (lavapipe, SwiftShader) is slower than painting on the processor, so it is used only by
/// --backend gpu where there is no hardware. With no adapter at all the processor paints; this is
/// no error. "cells" is the largest canvas that one buffer of the adapter can hold, at 32 bytes per
/// cell; its memory may be too small for that.
#[derive(Debug, Args)]
pub(crate) struct Gpu {
    /// Print JSON: used, with_backend_gpu (null where there is none), why, adapters
    #[arg(long)]
    json: bool,
    /// Print the adapters as CSV; `use` says which one paints, and which one would with --backend gpu
    #[arg(long, conflicts_with = "json")]
    csv: bool,
}

impl Gpu {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let found = without_noise(console, adapters)?;
        let used = best(&found, BackendChoice::Auto);
        let forced = best(&found, BackendChoice::Gpu);
        let why = why(&found, used);
        if self.json {
            let [used, forced] = [used, forced].map(|adapter| adapter.map(|found| &found.name));
            return console.json(&json!({
                "used": used,
                "with_backend_gpu": forced,
                "why": why,
                "adapters": found.iter().map(as_json).collect::<Vec<_>>(),
            }));
        }
        if self.csv {
            let rows = found.iter().map(|adapter| {
                let of_use = if used.is_some_and(|used| std::ptr::eq(used, adapter)) {
                    "yes"
                } else if forced.is_some_and(|forced| std::ptr::eq(forced, adapter)) {
                    "by --backend gpu"
                } else {
                    "no"
                };
                let mut row = json!({"use": of_use});
                row.as_object_mut().expect("an object").extend(as_json(adapter));
                row
            });
            return console.csv_rows(&rows.collect::<Vec<_>>());
        }
        let name = used.map_or("the processor", |adapter| &adapter.name);
        console.line(format!("painting uses {name}: {why}"))?;
        if let (None, Some(adapter)) = (used, forced) {
            console.line(format!("--backend gpu would use {}", adapter.name))?;
        }
        for (adapter, number) in found.iter().zip(1..) {
            let side = side(adapter);
            console.line("")?;
            console.line(format!("{number}. {}", adapter.name))?;
            console.line(format!("   {}, {}", adapter.kind.name(), adapter.backend))?;
            if !adapter.driver.is_empty() {
                console.line(format!("   driver {}", adapter.driver))?;
            }
            console.line(format!(
                "   a buffer of {} MiB: canvases of up to {} cells ({side} x {side})",
                adapter.limits.binding_bytes >> 20,
                max_canvas_cells(adapter),
            ))?;
            if let Some(reason) = &adapter.unfit {
                console.line(format!("   cannot be used: {reason}"))?;
            }
        }
        Ok(())
    }
}

/// Side of the largest square canvas, in cells.
fn side(adapter: &Adapter) -> u64 {
    max_canvas_cells(adapter).isqrt()
}

/// Reason for the choice of adapter.
fn why(found: &[Adapter], used: Option<&Adapter>) -> String {
    match (found.first(), used) {
        (_, Some(adapter)) => {
            format!("it is a hardware adapter that can compute ({})", adapter.kind.name())
        }
        (None, None) => "no graphics driver offers an adapter".to_owned(),
        (Some(Adapter { unfit: Some(_), .. }), None) => "no adapter can be used".to_owned(),
        (Some(_), None) => "there is no hardware adapter, and software ones are slower".to_owned(),
    }
}

fn as_json(adapter: &Adapter) -> Map<String, Value> {
    let fields = [
        ("name", json!(adapter.name)),
        ("kind", json!(adapter.kind.name())),
        ("backend", json!(adapter.backend)),
        ("driver", json!(adapter.driver)),
        ("buffer_bytes", json!(adapter.limits.binding_bytes)),
        ("largest_canvas_cells", json!(max_canvas_cells(adapter))),
        ("unfit", json!(adapter.unfit)),
    ];
    fields.map(|(name, value)| (name.to_owned(), value)).into_iter().collect()
}
