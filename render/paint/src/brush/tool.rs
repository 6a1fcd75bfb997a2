//! Tools that work the wet paint with a clean head.

use documents::hint::{Explain, Hint};

/// Use of a head on the wet paint below it.
///
/// With every tool but [`StrokeTool::Paint`] the head is clean: the paint on the brush is set aside
/// for the stroke, and what the head holds at the end of the stroke is taken off the surface. Dry
/// paint never moves.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum StrokeTool {
    /// Paints with what is on the brush.
    #[default]
    Paint,
    /// Softens and mixes, as a dry mop: what the head picks up it lays down again.
    Blend {
        /// How much the paint is mixed and moved, above 0 to 1.
        strength: f64,
    },
    /// Takes all paint higher than a blade that glides over the crests of the ground. What lies
    /// between the crests stays.
    Scrape {
        /// Height of the blade over the crests at pressure 0 in mm, 0 to 10; it falls to 0 at full
        /// pressure.
        height_mm: f64,
    },
    /// Takes a share of the paint, as a rag: more with pressure and with each mm of the way.
    Erase {
        /// How much it takes, above 0 to 1. With 1 and full pressure the paint falls to 1/e over
        /// 1 mm.
        strength: f64,
    },
}

/// A number of a tool is out of range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the {field} of the tool `{tool}` is {wanted}, found `{found}`")]
pub struct ToolError {
    /// Name of the tool in a script.
    pub tool: &'static str,
    /// Name of the number in a script.
    pub field: &'static str,
    /// Description of the range.
    pub wanted: &'static str,
    /// Value of the number.
    pub found: f64,
}

impl Explain for ToolError {
    fn hint(&self) -> Option<Hint> {
        Some(Hint::new("a strength of 0.5 and a height of 0 mm suit most paint"))
    }
}

impl StrokeTool {
    /// Name in scripts and labels: `paint`, `blend`, `scrape` or `erase`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Paint => "paint",
            Self::Blend { .. } => "blend",
            Self::Scrape { .. } => "scrape",
            Self::Erase { .. } => "erase",
        }
    }

    /// Whether the head paints with what is on the brush.
    #[must_use]
    pub fn is_paint(&self) -> bool {
        *self == Self::Paint
    }

    /// The tool with its number replaced by `change` of it.
    #[must_use]
    pub fn map(self, change: impl Fn(f64) -> f64) -> Self {
        match self {
            Self::Paint => Self::Paint,
            Self::Blend { strength } => Self::Blend { strength: change(strength) },
            Self::Scrape { height_mm } => Self::Scrape { height_mm: change(height_mm) },
            Self::Erase { strength } => Self::Erase { strength: change(strength) },
        }
    }

    /// Checks the range of its number.
    ///
    /// # Errors
    /// [`ToolError`] if it is out of range.
    pub fn check(&self) -> Result<(), ToolError> {
        let (field, wanted, found, valid) = match *self {
            Self::Paint => return Ok(()),
            Self::Blend { strength } | Self::Erase { strength } => {
                let valid = strength > 0.0 && strength <= 1.0;
                ("strength", "above 0 to 1", strength, valid)
            }
            Self::Scrape { height_mm } => {
                ("height_mm", "0 to 10", height_mm, (0.0..=10.0).contains(&height_mm))
            }
        };
        if valid { Ok(()) } else { Err(ToolError { tool: self.name(), field, wanted, found }) }
    }
}
