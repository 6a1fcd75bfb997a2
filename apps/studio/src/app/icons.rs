//! Icons of the toolbar, as lines in a square of 18 x 18 points.

use eframe::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, pos2};

use super::intent::Intent;
use crate::panels::Mode;

/// Side of the square of icon coordinates, in points.
const SQUARE: f32 = 18.0;

/// One element of an icon.
#[derive(Debug, Clone, Copy)]
pub(super) enum Mark {
    /// Polyline through points.
    Line(&'static [(f32, f32)]),
    /// Filled convex polygon.
    Filled(&'static [(f32, f32)]),
    /// Circular arc: centre, radius, start and end angle in degrees clockwise from the
    /// right.
    Arc((f32, f32), f32, f32, f32),
}

use Mark::{Arc, Filled, Line};

/// Draws the icon of an intent at the centre of a button. Returns whether it has one.
pub(super) fn draw(painter: &Painter, button: Rect, intent: Intent, color: Color32) -> bool {
    let marks = marks(intent);
    draw_marks(painter, button, marks, color);
    !marks.is_empty()
}

/// Draws marks at the centre of a button.
pub(super) fn draw_marks(painter: &Painter, button: Rect, marks: &[Mark], color: Color32) {
    let corner = button.center() - eframe::egui::Vec2::splat(0.5 * SQUARE);
    let place = |&(x, y): &(f32, f32)| corner + eframe::egui::vec2(x, y);
    let stroke = Stroke::new(1.5, color);
    for mark in marks {
        match mark {
            Line(places) => {
                painter.line(places.iter().map(place).collect(), stroke);
            }
            Filled(places) => {
                let shape = places.iter().map(place).collect();
                painter.add(Shape::convex_polygon(shape, color, Stroke::NONE));
            }
            Arc(middle, radius, from, to) => {
                let middle = place(middle);
                painter.line(
                    (0..=24)
                        .map(|step: u8| {
                            let angle = from + (to - from) * f32::from(step) / 24.0;
                            let (sin, cos) = angle.to_radians().sin_cos();
                            pos2(middle.x + radius * cos, middle.y + radius * sin)
                        })
                        .collect::<Vec<Pos2>>(),
                    stroke,
                );
            }
        }
    }
}

/// The marks of an intent's icon; none without one.
pub(super) fn marks(intent: Intent) -> &'static [Mark] {
    match intent {
        Intent::Tool(Mode::Paint) => &[
            Line(&[(7.5, 10.5), (15.5, 2.5)]),
            Line(&[(6.0, 9.0), (9.0, 12.0)]),
            Filled(&[(5.6, 9.8), (8.2, 12.4), (6.4, 15.0), (2.0, 16.0), (3.0, 11.6)]),
        ],
        Intent::Tool(Mode::Blend) => &[
            Line(&[(9.0, 1.5), (9.0, 6.0)]),
            Line(&[(6.5, 6.0), (11.5, 6.0), (15.0, 12.5), (3.0, 12.5), (6.5, 6.0)]),
            Line(&[(9.0, 8.5), (9.0, 12.5)]),
            Arc((5.5, 16.0), 1.8, 180.0, 360.0),
            Arc((9.1, 16.0), 1.8, 0.0, 180.0),
            Arc((12.7, 16.0), 1.8, 180.0, 360.0),
        ],
        Intent::Tool(Mode::Scrape) => &[
            Line(&[(16.0, 2.0), (11.5, 6.5)]),
            Filled(&[(11.0, 4.5), (13.5, 7.0), (7.0, 15.5), (2.5, 11.0)]),
            Line(&[(2.0, 16.5), (16.0, 16.5)]),
        ],
        Intent::Tool(Mode::Erase) => &[
            Line(&[(6.0, 14.5), (2.0, 10.5), (10.0, 2.5), (16.0, 8.5), (10.0, 14.5), (6.0, 14.5)]),
            Line(&[(6.2, 6.3), (12.2, 12.3)]),
            Line(&[(6.0, 16.8), (16.0, 16.8)]),
        ],
        Intent::Tool(Mode::Mask) => &[
            Line(&[(2.5, 5.5), (2.5, 2.5), (5.5, 2.5)]),
            Line(&[(7.5, 2.5), (10.5, 2.5)]),
            Line(&[(12.5, 2.5), (15.5, 2.5), (15.5, 5.5)]),
            Line(&[(15.5, 7.5), (15.5, 10.5)]),
            Line(&[(15.5, 12.5), (15.5, 15.5), (12.5, 15.5)]),
            Line(&[(10.5, 15.5), (7.5, 15.5)]),
            Line(&[(5.5, 15.5), (2.5, 15.5), (2.5, 12.5)]),
            Line(&[(2.5, 10.5), (2.5, 7.5)]),
        ],
        Intent::Tool(Mode::Squeeze) => &[
            Line(&[(3.0, 2.5), (15.0, 2.5)]),
            Line(&[(4.5, 2.5), (6.8, 11.5), (11.2, 11.5), (13.5, 2.5)]),
            Filled(&[(7.2, 11.5), (10.8, 11.5), (10.8, 14.0), (7.2, 14.0)]),
            Filled(&[(8.0, 15.0), (10.0, 15.0), (9.0, 17.5)]),
        ],
        Intent::Tool(Mode::Pick) => &[
            Line(&[(10.0, 8.0), (4.0, 14.0), (2.5, 15.5)]),
            Line(&[(8.5, 6.5), (3.5, 11.5), (3.0, 15.0), (6.5, 14.5), (11.5, 9.5)]),
            Line(&[(7.0, 5.0), (13.0, 11.0)]),
            Filled(&[(9.5, 6.5), (12.5, 3.0), (15.0, 3.0), (15.0, 5.5), (11.5, 8.5)]),
        ],
        Intent::Tool(Mode::Pan) => &[
            Line(&[(9.0, 2.0), (9.0, 16.0)]),
            Line(&[(2.0, 9.0), (16.0, 9.0)]),
            Line(&[(7.0, 4.0), (9.0, 2.0), (11.0, 4.0)]),
            Line(&[(7.0, 14.0), (9.0, 16.0), (11.0, 14.0)]),
            Line(&[(4.0, 7.0), (2.0, 9.0), (4.0, 11.0)]),
            Line(&[(14.0, 7.0), (16.0, 9.0), (14.0, 11.0)]),
        ],
        Intent::Tool(Mode::Rotate) => {
            &[Arc((9.0, 9.5), 6.0, -60.0, 220.0), Filled(&[(8.2, 1.6), (13.6, 3.6), (9.6, 7.4)])]
        }
        Intent::Tool(Mode::Zoom) => &[
            Arc((7.5, 7.5), 4.8, 0.0, 360.0),
            Line(&[(11.0, 11.0), (16.0, 16.0)]),
            Line(&[(5.3, 7.5), (9.7, 7.5)]),
            Line(&[(7.5, 5.3), (7.5, 9.7)]),
        ],
        Intent::Undo => {
            &[Arc((9.5, 10.0), 5.0, -130.0, 100.0), Filled(&[(2.6, 6.8), (7.6, 3.0), (8.4, 8.6)])]
        }
        Intent::Redo => {
            &[Arc((8.5, 10.0), 5.0, -50.0, -280.0), Filled(&[(15.4, 6.8), (10.4, 3.0), (9.6, 8.6)])]
        }
        Intent::Mirror => &[
            Line(&[(9.0, 1.5), (9.0, 16.5)]),
            Line(&[(6.5, 4.5), (6.5, 13.5), (1.8, 13.5), (6.5, 4.5)]),
            Filled(&[(11.5, 4.5), (11.5, 13.5), (16.2, 13.5)]),
        ],
        Intent::Fit => &[
            Line(&[(2.0, 6.0), (2.0, 2.5), (5.5, 2.5)]),
            Line(&[(12.5, 2.5), (16.0, 2.5), (16.0, 6.0)]),
            Line(&[(16.0, 12.0), (16.0, 15.5), (12.5, 15.5)]),
            Line(&[(5.5, 15.5), (2.0, 15.5), (2.0, 12.0)]),
            Line(&[(5.0, 6.0), (13.0, 6.0), (13.0, 12.0), (5.0, 12.0), (5.0, 6.0)]),
        ],
        Intent::Wash => &[
            Line(&[(9.0, 2.0), (5.2, 8.2)]),
            Line(&[(9.0, 2.0), (12.8, 8.2)]),
            Arc((9.0, 11.0), 4.7, -36.0, 216.0),
            Arc((9.0, 11.0), 2.4, 30.0, 100.0),
        ],
        Intent::Wipe => &[
            Line(&[(3.0, 12.0), (8.5, 3.5), (15.0, 7.0), (11.0, 13.0)]),
            Line(&[(3.0, 12.0), (6.0, 13.5), (8.5, 11.5), (11.0, 13.0)]),
            Line(&[(2.5, 16.0), (15.5, 16.0)]),
        ],
        Intent::Dry => &[
            Arc((9.0, 9.0), 3.2, 0.0, 360.0),
            Line(&[(9.0, 1.5), (9.0, 3.8)]),
            Line(&[(9.0, 14.2), (9.0, 16.5)]),
            Line(&[(1.5, 9.0), (3.8, 9.0)]),
            Line(&[(14.2, 9.0), (16.5, 9.0)]),
            Line(&[(3.7, 3.7), (5.3, 5.3)]),
            Line(&[(12.7, 12.7), (14.3, 14.3)]),
            Line(&[(14.3, 3.7), (12.7, 5.3)]),
            Line(&[(5.3, 12.7), (3.7, 14.3)]),
        ],
        _ => &[],
    }
}
