//! Tests of file dialogs, saving, recovery and export.

mod bench;
mod saving;
mod output;
mod dialogs;
