//! Tests of file dialogs, saving, recovery and export.

mod bench;
mod keyboard;
mod saving;
mod output;
mod timelapse;
mod drawings;
mod kept;
mod scenes;
mod browsing;
mod beginning;
mod crop;
