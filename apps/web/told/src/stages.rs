//! Reports the stages of long work, and defects of the program, to the page while a call runs.

use std::sync::atomic::{AtomicU64, Ordering};

use documents::{Progress, Task};
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoStage)]
    fn hear_stage(text: &str);

    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoDefect)]
    fn hear_defect(text: &str);
}

/// Passes the stage of long work to the page.
pub fn stage(text: &str) {
    hear_stage(text);
}

/// A task that passes the `text` of each report to the page.
pub fn task(text: impl Fn(&Progress) -> String + Send + Sync + 'static) -> Task {
    Task::observed(move |progress| hear_stage(&text(progress)))
}

/// A task that passes `name` to the page, then each further percent of `all` steps.
pub fn task_in_percent(name: &'static str, all: usize) -> Task {
    hear_stage(name);
    let all = all.max(1) as u64;
    let before = AtomicU64::new(0);
    Task::observed(move |progress| {
        let now = 100 * progress.done.min(all) / all;
        if now > before.fetch_max(now, Ordering::Relaxed) {
            hear_stage(&format!("{name}, {now} %"));
        }
    })
}

/// Reports panics to the page from now on.
#[wasm_bindgen]
pub fn begin() {
    std::panic::set_hook(Box::new(|panic| hear_defect(&panic.to_string())));
}
