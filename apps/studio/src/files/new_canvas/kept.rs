//! Canvases that are kept for the next painting.

use serde::{Deserialize, Serialize};

use super::settings::NewCanvas;

/// Most presets that are kept.
const MOST_PRESETS: usize = 100;

/// A canvas under a name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CanvasPreset {
    /// Name that the painter gave it.
    pub name: String,
    /// Canvas kept under the name.
    pub canvas: NewCanvas,
}

/// The canvas that was used last, and presets.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct KeptCanvases {
    /// The canvas that was begun last: the start of the next.
    pub last: NewCanvas,
    /// Canvases under names, in the order of the names.
    pub presets: Vec<CanvasPreset>,
}

impl KeptCanvases {
    /// Moves numbers that are out of range to the nearest that are allowed.
    pub(crate) fn bound(&mut self) {
        self.last.bound();
        self.presets.truncate(MOST_PRESETS);
        self.presets.iter_mut().for_each(|preset| preset.canvas.bound());
    }

    /// Keeps `canvas` as `name`, in place of one of the same name.
    pub(crate) fn keep(&mut self, name: &str, canvas: NewCanvas) {
        self.remove(name);
        self.presets.push(CanvasPreset { name: name.to_owned(), canvas });
        self.presets.sort_by(|a, b| a.name.cmp(&b.name));
        self.presets.truncate(MOST_PRESETS);
    }

    /// Removes the preset of this name.
    pub(crate) fn remove(&mut self, name: &str) {
        self.presets.retain(|preset| preset.name != name);
    }

    /// The preset of this name.
    #[must_use]
    pub(crate) fn preset(&self, name: &str) -> Option<&NewCanvas> {
        self.presets.iter().find(|preset| preset.name == name).map(|preset| &preset.canvas)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_kept_by_name_and_removed() {
        let mut kept = KeptCanvases::default();
        let mut large = NewCanvas::default();
        large.canvas.width_mm = 500.0;
        kept.keep("study", NewCanvas::default());
        kept.keep("large", NewCanvas::default());
        kept.keep("large", large.clone());
        let names: Vec<&str> = kept.presets.iter().map(|preset| preset.name.as_str()).collect();
        assert_eq!(names, ["large", "study"]);
        assert_eq!(kept.preset("large"), Some(&large), "the later one");
        kept.remove("study");
        assert_eq!(kept.preset("study"), None);
    }

    #[test]
    fn kept_canvases_survive_their_file() {
        let mut kept = KeptCanvases::default();
        kept.last.canvas.ground.relief =
            serde_json::from_str(r#"{"kind": "image", "path": "a.png"}"#).unwrap();
        kept.keep("study", NewCanvas::default());
        let text = serde_json::to_string(&kept).unwrap();
        assert_eq!(serde_json::from_str::<KeptCanvases>(&text).unwrap(), kept);
        let older: KeptCanvases = serde_json::from_str("{}").unwrap();
        assert_eq!(older, KeptCanvases::default());
    }
}
