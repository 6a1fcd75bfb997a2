//! `impasto library rename`: renames pigments.

use std::path::PathBuf;

use calibrate::curation::{renamed, with_color_indices};
use clap::Args;

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::library_choice::{chosen, split};
use crate::output::Output;

/// Rename pigments; everything else stays the same, byte for byte
#[derive(Debug, Args)]
#[command(
    override_usage = "impasto library rename [OPTIONS] --output <FILE> [LIBRARY] [OLD=NEW]..."
)]
pub(super) struct Rename {
    /// The pigment library (JSON) [default: that of IMPASTO_LIBRARY, else
    /// the Van Gogh oils that ship], then names to change, all at once; the old name may be
    /// abbreviated
    #[arg(value_name = "[LIBRARY] OLD=NEW")]
    words: Vec<String>,
    /// Set a Colour Index name, such as "Ultramarine=PB29" (may be repeated); `NAME=` removes it
    #[arg(long = "colour-index", value_name = "NAME=INDEX")]
    color_index: Vec<String>,
    /// The library file to write (JSON)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Rename {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let (path, names) = split(&self.words, true);
        if names.is_empty() && self.color_index.is_empty() {
            return Err(Failure::usage("nothing to rename", "give OLD=NEW, or --colour-index"));
        }
        let chosen = chosen(path.as_deref(), console)?;
        let output = Output::open(&self.output, &chosen.inputs())?;
        let file = chosen.name();
        let before = chosen.library;
        let indexed = with_color_indices(&file, &before, &pairs(&self.color_index)?)?;
        let after = renamed(&file, &indexed, &pairs(names)?)?;
        output.write(after.to_json(), console)?;
        for (old, new) in before.pigments.iter().zip(&after.pigments) {
            if old.name != new.name {
                console.line(format!("{} is now {}", old.name, new.name))?;
            }
            if old.color_index != new.color_index {
                let index = new.color_index.as_deref().unwrap_or("without a Colour Index name");
                console.line(format!("{} is {index}", new.name))?;
            }
        }
        Ok(())
    }
}

/// Parses texts `NAME=CHANGE`.
fn pairs(texts: &[String]) -> Result<Vec<(String, String)>> {
    let pair = |text: &String| {
        let parts = text.split_once('=').filter(|(name, _)| !name.trim().is_empty());
        let (name, value) = parts.ok_or_else(|| {
            Failure::usage(
                format!("a change takes NAME=CHANGE, found `{text}`"),
                "try \"Viridian=Viridian (batch 2)\"",
            )
        })?;
        Ok((name.to_owned(), value.to_owned()))
    };
    texts.iter().map(pair).collect()
}
