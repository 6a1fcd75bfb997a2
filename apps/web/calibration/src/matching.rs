//! Recipes for target colours.

use calibrate::matching::MatchRequest;
use documents::Task;
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, request, setting};
use crate::library::Library;
use crate::remarks::remarks;
use crate::targets::Targets;

#[wasm_bindgen]
impl Library {
    /// Recipes for the target with index `place`, as JSON with the keys of `impasto match --json`, and `remarks`.
    pub fn recipes(&self, targets: &Targets, place: usize, options: &str) -> Result<String> {
        let options: MatchRequest = request(options)?;
        let target = targets.targets.get(place);
        let target = target.ok_or_else(|| setting("no such colour", "choose another"))?;
        let search = self.0.recipe_search(&options).told()?;
        let found = search.recipes_for(target, &Task::default()).told()?;
        let mut told = search.to_json(&found, None);
        told["remarks"] = remarks(&found.remarks);
        Ok(told.to_string())
    }
}
