//! The tools of a hand in a scene.

/// A tool of the pen in a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SceneTool {
    /// Pours paint of a tube on the surface.
    #[default]
    Pour,
    /// Blows at volumes and paint along the drag.
    Push,
    /// Takes paint up, as a sponge does.
    Lift,
    /// Dries the volumes below it, paint and shape.
    Dry,
}

impl SceneTool {
    /// All tools, in the order of the toolbar.
    pub const ALL: [Self; 4] = [Self::Pour, Self::Push, Self::Lift, Self::Dry];

    /// Its name in menus and lists.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pour => "Pour",
            Self::Push => "Push",
            Self::Lift => "Lift",
            Self::Dry => "Dry",
        }
    }
}

/// A tool and how it is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// The tool in hand.
    pub tool: SceneTool,
    /// Tube that is poured, by its number from 0.
    pub tube: usize,
    /// Paint poured a second at full pressure, in mm3.
    pub rate_mm3_s: f64,
    /// Radius of the reach of the other tools, in mm.
    pub radius_mm: f64,
    /// Strength of the other tools, 0 to 1.
    pub strength: f64,
}

impl Default for Grip {
    fn default() -> Self {
        let tool = SceneTool::Pour;
        Self { tool, tube: 0, rate_mm3_s: 40.0, radius_mm: 20.0, strength: 0.5 }
    }
}

/// The pen over the picture of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScenePen {
    /// Place as a share of the picture's width and height, 0 to 1 from the upper left corner.
    pub at: [f32; 2],
    /// Pressure, 0 to 1; 1 for a mouse.
    pub pressure: f32,
}
