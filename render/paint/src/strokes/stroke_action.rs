//! A stroke in a script: its keys and the tool that they name.

use serde::{Deserialize, Serialize};

use super::sample_rows;
use super::surface_id::SurfaceId;
use crate::brush::StrokeTool;
use crate::pose::Sample;

/// Strength of blending and erasing where a script names none.
const STRENGTH: f64 = 0.5;

/// A stroke of a brush.
///
/// In a script the tool is `"tool": "blend"`, `"scrape"` or `"erase"`, left out for painting. Blending
/// and erasing have a `"strength"` above 0 to 1, 0.5 by default; scraping has a `"height_mm"` of 0 to
/// 10 over the ground, 0 by default.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Keys", into = "Keys")]
pub struct Stroke {
    /// Name of the brush.
    pub brush: String,
    /// The surface; the canvas by default.
    pub on: SurfaceId,
    /// The tool that the head is used as; it paints by default.
    pub tool: StrokeTool,
    /// Samples of the pen in order of time.
    pub samples: Vec<Sample>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum ToolName {
    #[default]
    Paint,
    Blend,
    Scrape,
    Erase,
}

impl ToolName {
    fn is_paint(&self) -> bool {
        *self == Self::Paint
    }
}

/// The keys of a stroke in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    brush: String,
    #[serde(default, skip_serializing_if = "SurfaceId::is_canvas")]
    on: SurfaceId,
    #[serde(default, skip_serializing_if = "ToolName::is_paint")]
    tool: ToolName,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    strength: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    height_mm: Option<f64>,
    #[serde(with = "sample_rows")]
    samples: Vec<Sample>,
}

impl TryFrom<Keys> for Stroke {
    type Error = &'static str;

    fn try_from(keys: Keys) -> Result<Self, Self::Error> {
        let Keys { brush, on, tool, strength, height_mm, samples } = keys;
        let stray = match tool {
            ToolName::Paint => strength.or(height_mm),
            ToolName::Blend | ToolName::Erase => height_mm,
            ToolName::Scrape => strength,
        };
        if stray.is_some() {
            return Err("`strength` belongs to the tools blend and erase, `height_mm` to scrape");
        }
        let strength = strength.unwrap_or(STRENGTH);
        let tool = match tool {
            ToolName::Paint => StrokeTool::Paint,
            ToolName::Blend => StrokeTool::Blend { strength },
            ToolName::Scrape => StrokeTool::Scrape { height_mm: height_mm.unwrap_or(0.0) },
            ToolName::Erase => StrokeTool::Erase { strength },
        };
        Ok(Self { brush, on, tool, samples })
    }
}

impl From<Stroke> for Keys {
    fn from(Stroke { brush, on, tool, samples }: Stroke) -> Self {
        let (tool, strength, height_mm) = match tool {
            StrokeTool::Paint => (ToolName::Paint, None, None),
            StrokeTool::Blend { strength } => (ToolName::Blend, Some(strength), None),
            StrokeTool::Scrape { height_mm } => (ToolName::Scrape, None, Some(height_mm)),
            StrokeTool::Erase { strength } => (ToolName::Erase, Some(strength), None),
        };
        Self { brush, on, tool, strength, height_mm, samples }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(keys: &str) -> Result<Stroke, String> {
        let text = format!("{{\"brush\": \"a\", {keys}\"samples\": [[0, 1, 2, 0.5]]}}");
        serde_json::from_str(&text).map_err(|error| error.to_string())
    }

    #[test]
    fn a_stroke_without_a_tool_paints_and_is_written_as_before() {
        let stroke = read("").unwrap();
        assert_eq!(stroke.tool, StrokeTool::Paint);
        let text = serde_json::to_string(&stroke).unwrap();
        assert_eq!(text, r#"{"brush":"a","samples":[[0.0,1.0,2.0,0.5]]}"#);
    }

    #[test]
    fn tools_are_read_with_their_numbers_and_defaults_and_written_whole() {
        for (keys, tool) in [
            (r#""tool": "erase", "#, StrokeTool::Erase { strength: 0.5 }),
            (r#""tool": "erase", "strength": 1, "#, StrokeTool::Erase { strength: 1.0 }),
            (r#""tool": "blend", "strength": 0.2, "#, StrokeTool::Blend { strength: 0.2 }),
            (r#""tool": "scrape", "#, StrokeTool::Scrape { height_mm: 0.0 }),
            (r#""tool": "scrape", "height_mm": 0.1, "#, StrokeTool::Scrape { height_mm: 0.1 }),
            (r#""tool": "paint", "#, StrokeTool::Paint),
        ] {
            let stroke = read(keys).unwrap();
            assert_eq!(stroke.tool, tool);
            let text = serde_json::to_string(&stroke).unwrap();
            assert_eq!(serde_json::from_str::<Stroke>(&text).unwrap(), stroke);
        }
    }

    #[test]
    fn unknown_tools_and_numbers_of_other_tools_are_refused() {
        for (keys, reason) in [
            (r#""tool": "smudge", "#, "unknown variant `smudge`, expected one of `paint`"),
            (r#""strength": 0.5, "#, "`strength` belongs to the tools blend and erase"),
            (r#""tool": "erase", "height_mm": 0, "#, "`height_mm` to scrape"),
            (r#""tool": "scrape", "strength": 1, "#, "`strength` belongs to"),
            (r#""tool": "erase", "force": 1, "#, "unknown field `force`"),
        ] {
            let error = read(keys).unwrap_err();
            assert!(error.contains(reason), "{error}");
        }
    }
}
