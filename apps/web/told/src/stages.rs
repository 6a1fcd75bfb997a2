//! Stages and defects, which the page hears while a call runs.

use documents::{Progress, Task};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoStage)]
    fn hear_stage(text: &str);

    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoDefect)]
    fn hear_defect(text: &str);
}

/// Tells the page the stage of long work.
pub fn stage(text: &str) {
    hear_stage(text);
}

/// A task that tells the page the `text` of each report.
pub fn task(text: impl Fn(&Progress) -> String + Send + Sync + 'static) -> Task {
    Task::observed(move |progress| hear_stage(&text(progress)))
}

/// Tells the page of defects from now on.
#[wasm_bindgen]
pub fn begin() {
    std::panic::set_hook(Box::new(|panic| hear_defect(&panic.to_string())));
}
