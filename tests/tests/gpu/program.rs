//! `impasto gpu`: the adapters that it lists, and the one that painting would use.

use graphics::gpu::{BackendChoice, Kind, adapters, best};
use suite::program::impasto;

#[test]
fn the_program_names_the_adapter_that_would_be_used() {
    let found = adapters();
    let run = impasto(&["gpu", "--json"]);
    assert_eq!((run.status, run.err.as_str()), (0, ""));
    let told = run.json();
    let used = best(&found, BackendChoice::Auto).map(|adapter| adapter.name.as_str());
    let forced = best(&found, BackendChoice::Gpu).map(|adapter| adapter.name.as_str());
    assert_eq!(told["used"].as_str(), used);
    assert_eq!(told["with_backend_gpu"].as_str(), forced);
    let listed = told["adapters"].as_array().unwrap();
    assert_eq!(listed.len(), found.len());
    for (listed, adapter) in listed.iter().zip(&found) {
        let cells = listed["largest_canvas_cells"].as_u64().unwrap();
        let bytes = adapter.limits.binding_bytes;
        assert!(cells * 32 <= bytes && (cells + 1) * 32 > bytes, "{cells} of {bytes}");
    }
    let words = impasto(&["gpu"]);
    let first = words.out.lines().next().unwrap();
    let name = used.unwrap_or("the processor");
    assert!(first.starts_with(&format!("painting uses {name}: ")), "{first}");
}

#[test]
fn software_is_used_only_when_asked_for() {
    let found = adapters();
    let used = best(&found, BackendChoice::Auto);
    assert!(used.is_none_or(|adapter| adapter.kind != Kind::Software), "{used:?}");
    assert!(best(&found, BackendChoice::Cpu).is_none(), "the processor is no adapter");
}
