//! `impasto paint --from`: a photograph to pigments, and to strokes.

use clap::Args;

use crate::failure::Refusal;

/// What to do with a photograph.
#[derive(Debug, Args)]
#[command(next_help_heading = "Photographs")]
pub(crate) struct PhotographOptions {
    /// Paint after this photograph (PNG or JPEG)
    #[arg(long, value_name = "PHOTO")]
    from: Option<std::path::PathBuf>,
}

impl PhotographOptions {
    pub(super) fn refuse_with_script(&self) -> anyhow::Result<()> {
        if self.from.is_some() {
            return Err(Refusal::usage("x", "y"));
        }
        Ok(())
    }
}
impl PhotographOptions {
    pub(super) fn run(
        self,
        _l: calibrate::library::PigmentLibrary,
        _e: &crate::engine::EngineOptions,
        _x: crate::pictures::Exports,
        _j: bool,
        _c: &mut crate::console::Console<'_>,
    ) -> anyhow::Result<()> {
        Ok(())
    }
}
