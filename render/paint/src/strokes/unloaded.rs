//! Brushes that paint before they have paint.

use std::collections::BTreeSet;

use super::action::Action;
use super::script::StrokeScript;
use crate::brush::StrokeTool;

impl StrokeScript {
    /// Index of the first stroke, and name, of each brush that paints on the canvas before it was
    /// loaded or moved over the palette, in order. Such a stroke only moves the paint that lies there.
    /// Brushes of `kept`, which come with paint of an earlier session, are left out.
    #[must_use]
    pub fn unloaded_brushes(&self, kept: &BTreeSet<&str>) -> Vec<(usize, &str)> {
        let mut seen = kept.clone();
        let mut found = Vec::new();
        for (index, action) in self.actions.iter().enumerate() {
            match action {
                Action::Load(load) => {
                    seen.insert(&load.brush);
                }
                Action::Stroke(stroke) | Action::Cut(stroke) => {
                    let paints = stroke.on.is_canvas() && stroke.tool == StrokeTool::Paint;
                    let is_first = seen.insert(&stroke.brush);
                    if paints && is_first {
                        found.push((index, stroke.brush.as_str()));
                    }
                }
                _ => {}
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn brushes_without_paint_are_found_once() {
        let stroke = |brush: &str, more: &str| {
            format!(r#"{{"stroke": {{"brush": "{brush}", {more} "samples": [[0, 1, 1, 0.5]]}}}}"#)
        };
        let actions = [
            stroke("dry", ""),
            stroke("dry", ""),
            r#"{"load": {"brush": "wet", "recipe": {"W": 1}, "amount_mm": 0.3}}"#.to_owned(),
            stroke("wet", ""),
            stroke("soft", r#""tool": "blend","#),
            stroke("kept", ""),
        ];
        let brush = r#"{"shape": "flat", "size_mm": 5}"#;
        let brushes = ["dry", "wet", "soft", "kept"].map(|name| format!(r#""{name}": {brush}"#));
        let text = format!(
            r#"{{"format": "strokes", "version": 1, "title": "", "palette": {{"W": "Lead White"}},
            "canvas": {{"width_mm": 9, "height_mm": 9, "cell_mm": 0.2}},
            "brushes": {{{}}}, "actions": [{}]}}"#,
            brushes.join(", "),
            actions.join(", ")
        );
        let script = StrokeScript::from_json("a.json", text.as_bytes()).unwrap();
        assert_eq!(script.unloaded_brushes(&BTreeSet::from(["kept"])), [(0, "dry")]);
        assert_eq!(script.unloaded_brushes(&BTreeSet::new()), [(0, "dry"), (5, "kept")]);
    }
}
