//! `impasto stencil`: pours paint over a scene drawn as a grey sketch, which turns to colour where
//! the paint spreads.
mod options;
mod scene;
mod film;
mod job;

pub(crate) use options::Stencil;

use crate::console::Console;
use crate::failure::Result;
use job::Job;

impl Stencil {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        if self.show_preset.print(console)? {
            return Ok(());
        }
        Job::of(self, console)?.run(console)
    }
}
