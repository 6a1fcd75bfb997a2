//! Recipes for target colours.

use calibrate::Backing;
use calibrate::matching::{MatchOptions, RequiredName, Thickness, ViewingCondition};
use documents::Task;
use serde::Deserialize;
use wasm_bindgen::prelude::*;

use crate::failure::{Result, Told, options, setting};
use crate::library::Library;
use crate::remarks::remarks;
use crate::targets::Targets;
use crate::viewing::ViewingNames;

/// Options of a search, as the page passes them.
#[derive(Debug, Deserialize)]
struct Options {
    viewing: ViewingNames,
    thickness: Option<f64>,
    over: Option<f64>,
    only: Vec<String>,
    with: Vec<String>,
    without: Vec<String>,
    at_most: usize,
    least_share: f64,
    whole_parts: Option<u32>,
    tolerance: Option<f64>,
    beyond_measured: bool,
    count: usize,
}

impl Options {
    fn read(json: &str) -> Result<MatchOptions> {
        let read: Self = options(json)?;
        let with = read.with.into_iter().map(|name| RequiredName { name, share: None });
        Ok(MatchOptions {
            conditions: vec![ViewingCondition { viewing: read.viewing.viewing()?, weight: 1.0 }],
            thickness: read.thickness.map(Thickness::Fixed),
            over: read.over.map(Backing::even).transpose().told()?,
            only: read.only,
            with: with.collect(),
            without: read.without,
            at_most: read.at_most,
            least_share: read.least_share,
            whole_parts: read.whole_parts,
            tolerance: read.tolerance,
            beyond_measured: read.beyond_measured,
            count: read.count,
            ..MatchOptions::default()
        })
    }
}

#[wasm_bindgen]
impl Library {
    /// Recipes for the target at `place`, as JSON with the keys of `impasto match --json`, and `remarks`.
    pub fn recipes(&self, targets: &Targets, place: usize, options: &str) -> Result<String> {
        let options = Options::read(options)?;
        let target = targets.targets.get(place);
        let target = target.ok_or_else(|| setting("no such colour", "choose another"))?;
        let search = self.0.recipe_search(&options).told()?;
        let found = search.recipes_for(target, &Task::default()).told()?;
        let mut told = search.to_json(&found, None);
        told["remarks"] = remarks(&found.remarks);
        Ok(told.to_string())
    }
}
