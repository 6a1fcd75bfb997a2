//! Stages and defects, which the page hears while a call runs.

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// Hears the stage of long work.
    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoStage)]
    pub(crate) fn stage(text: &str);

    /// Hears where the program stopped by a defect.
    #[wasm_bindgen(js_namespace = globalThis, js_name = impastoDefect)]
    fn defect(text: &str);
}

/// Tells the page of defects from now on.
#[wasm_bindgen]
pub fn begin() {
    std::panic::set_hook(Box::new(|panic| defect(&panic.to_string())));
}
