//! How the file browser shows a folder.

use serde::{Deserialize, Serialize};

/// Order of the files of a folder. Folders come first in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BrowserOrder {
    /// By name, with numbers in numerical order.
    #[default]
    Name,
    /// By the time of the last change, the latest first.
    Date,
}

/// Form and order of the files in the file browser.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct BrowserLook {
    /// Whether files are shown as a grid of pictures rather than a list.
    pub grid: bool,
    /// Order of the files.
    pub order: BrowserOrder,
}
