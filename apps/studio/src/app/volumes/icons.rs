//! Icons of the tools of a scene, in a square of 18 x 18 points.

use eframe::egui::{Color32, Painter, Rect};
use session::volumes::SceneTool;

use super::intent::SceneIntent;
use crate::app::icons::Mark::{self, Arc, Filled, Line};
use crate::app::icons::{self, draw_marks};
use crate::app::intent::Intent;

/// Draws the icon of an intent at the centre of a button.
pub(super) fn draw(painter: &Painter, button: Rect, intent: SceneIntent, color: Color32) {
    draw_marks(painter, button, marks(intent), color);
}

fn marks(intent: SceneIntent) -> &'static [Mark] {
    match intent {
        // A tube with a drop below it.
        SceneIntent::Tool(SceneTool::Pour) => &[
            Line(&[(3.0, 2.0), (15.0, 2.0)]),
            Line(&[(4.5, 2.0), (6.8, 9.0), (11.2, 9.0), (13.5, 2.0)]),
            Filled(&[(9.0, 10.0), (11.4, 14.0), (10.4, 16.4), (7.6, 16.4), (6.6, 14.0)]),
        ],
        // Wind.
        SceneIntent::Tool(SceneTool::Push) => &[
            Line(&[(1.5, 6.5), (11.0, 6.5)]),
            Arc((11.0, 4.2), 2.3, 90.0, -150.0),
            Line(&[(1.5, 9.5), (15.0, 9.5)]),
            Line(&[(1.5, 12.5), (9.0, 12.5)]),
            Arc((9.0, 14.6), 2.1, -90.0, 140.0),
        ],
        // A sponge with an arrow upwards.
        SceneIntent::Tool(SceneTool::Lift) => &[
            Line(&[(2.5, 11.0), (15.5, 11.0), (15.5, 16.0), (2.5, 16.0), (2.5, 11.0)]),
            Filled(&[(5.0, 13.0), (6.5, 13.0), (6.5, 14.5), (5.0, 14.5)]),
            Filled(&[(10.5, 12.6), (12.0, 12.6), (12.0, 14.1), (10.5, 14.1)]),
            Line(&[(9.0, 9.0), (9.0, 1.8)]),
            Line(&[(6.0, 4.8), (9.0, 1.8), (12.0, 4.8)]),
        ],
        SceneIntent::Tool(SceneTool::Dry) => icons::marks(Intent::Dry),
        SceneIntent::Undo => icons::marks(Intent::Undo),
        SceneIntent::Frame => icons::marks(Intent::Fit),
        // A ball.
        SceneIntent::Volumes => {
            &[Arc((9.0, 9.0), 6.5, 0.0, 360.0), Arc((9.0, 3.5), 8.0, 48.0, 132.0)]
        }
        SceneIntent::Hatching => &[
            Line(&[(2.0, 8.0), (8.0, 2.0)]),
            Line(&[(2.0, 13.0), (13.0, 2.0)]),
            Line(&[(4.0, 16.0), (16.0, 4.0)]),
            Line(&[(9.0, 16.0), (16.0, 9.0)]),
        ],
        _ => &[],
    }
}
