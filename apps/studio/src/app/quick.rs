//! The quick palette: a round menu at the pointer with tubes, mixtures and brush sizes.

use std::f32::consts::TAU;

use eframe::egui::{
    Align2, Area, Color32, Context, FontId, Id, Key, Mesh, Order, PointerButton, Pos2, Rect, Role,
    Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use paint::layer::SLOTS;
use paint::strokes::Recipe;
use session::PaintingState;
use session::swatches::{KeptMixture, SwatchBook, Usable};

use crate::language::tr_format;
use crate::panels::Tools;
use crate::theme;

/// Most mixtures in their ring. If there were more, they would be too narrow for a finger.
const MIXTURES: usize = 14;

/// Sizes of a brush, in mm.
const SIZES_MM: [f64; 10] = [1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 18.0, 28.0, 40.0];

/// One choice of the quick palette.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum QuickChoice {
    /// Loads the brush from the tube of a slot.
    Tube {
        slot: usize,
        name: String,
        color: [u8; 3],
        /// Colour of its tint with white.
        tint: Option<[u8; 3]>,
    },
    /// Loads the brush with a mixture.
    Mixture {
        /// Name, or its recipe as text.
        name: String,
        recipe: Recipe,
        vehicle: f64,
        color: [u8; 3],
    },
    /// Makes the brush as wide as this, in mm.
    Size(f64),
}

impl QuickChoice {
    /// Name for screen readers, also shown below the menu.
    pub(super) fn name(&self) -> String {
        match self {
            Self::Tube { name, .. } => tr_format!("quick {name}", name),
            Self::Mixture { name, .. } => tr_format!("quick mixture {name}", name),
            Self::Size(mm) => tr_format!("quick size {mm} mm", mm),
        }
    }

    pub(super) fn label(&self) -> String {
        match self {
            Self::Tube { name, .. } | Self::Mixture { name, .. } => name.clone(),
            Self::Size(mm) => format!("{mm} mm"),
        }
    }
}

/// Choices from the inner to the outer ring: tubes, mixtures that you can load now, and sizes. The
/// mixtures that you loaded last come first, then those of your list.
pub(super) fn quick_choices(
    painting: &PaintingState,
    tools: &Tools,
    book: &SwatchBook,
) -> [Vec<QuickChoice>; 3] {
    let tubes = (0..SLOTS).filter_map(|slot| {
        let name = painting.library[painting.slots[slot]?].name.clone();
        let color = painting.masstones[slot].unwrap_or([128; 3]);
        Some(QuickChoice::Tube { slot, name, color, tint: painting.tints[slot] })
    });
    let sizes = SIZES_MM.map(QuickChoice::Size).to_vec();
    [tubes.collect(), mixtures(painting, tools, book), sizes]
}

fn mixtures(painting: &PaintingState, tools: &Tools, book: &SwatchBook) -> Vec<QuickChoice> {
    let PaintingState { library, slots, lighting, light, .. } = painting;
    let Ok(weights) = light.viewing.weights(library.grid) else { return Vec::new() };
    let recent = tools.recent.iter().filter_map(|(recipe, vehicle): &(Recipe, f64)| {
        let light = (&weights, lighting.illuminant.as_str());
        KeptMixture::of(library, recipe.clone(), *vehicle, light)
    });
    let mut found: Vec<QuickChoice> = Vec::new();
    for kept in recent.chain(book.swatches.iter().cloned()) {
        let again = found.iter().any(
            |known| matches!(known, QuickChoice::Mixture { recipe, .. } if *recipe == kept.recipe),
        );
        if found.len() < MIXTURES && !again && kept.usable(library, slots) == Usable::Now {
            let color = kept.screen_color(library, &weights);
            let KeptMixture { name, recipe, vehicle, .. } = kept;
            found.push(QuickChoice::Mixture { name, recipe, vehicle, color });
        }
    }
    found
}

/// Largest angle of one piece of a wedge's edge, in radians.
const PIECE: f32 = 0.08;

/// A ring of equal wedges around a centre, clockwise from the top.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ring {
    inner: f32,
    outer: f32,
    count: usize,
}

impl Ring {
    /// Index of the wedge at an offset from the centre.
    fn wedge_at(&self, offset: Vec2) -> Option<usize> {
        let radius = offset.length();
        if self.count == 0 || radius < self.inner || radius >= self.outer {
            return None;
        }
        // The first wedge lies around the upward direction.
        let turn = offset.x.atan2(-offset.y) / TAU + 0.5 / self.count as f32;
        Some((turn.rem_euclid(1.0) * self.count as f32) as usize % self.count)
    }

    /// Offset of the middle of a wedge from the centre.
    fn middle(&self, index: usize) -> Vec2 {
        0.5 * (self.inner + self.outer) * direction(self.angle(index as f32))
    }

    /// A wedge as a mesh of one colour, with a gap to its neighbours.
    fn mesh(&self, center: Pos2, index: usize, fill: Color32) -> Mesh {
        let mut mesh = Mesh::default();
        for (at, [near, far]) in self.edge(center, index).into_iter().enumerate() {
            mesh.colored_vertex(near, fill);
            mesh.colored_vertex(far, fill);
            let last = 2 * at as u32;
            if at > 0 {
                mesh.add_triangle(last - 2, last - 1, last);
                mesh.add_triangle(last - 1, last + 1, last);
            }
        }
        mesh
    }

    /// Outline of a wedge as a closed line.
    fn outline(&self, center: Pos2, index: usize) -> Vec<Pos2> {
        let edge = self.edge(center, index);
        let near = edge.iter().map(|[near, _]| *near);
        near.chain(edge.iter().rev().map(|[_, far]| *far)).collect()
    }

    /// Points of the inner and the outer edge of a wedge, clockwise.
    fn edge(&self, center: Pos2, index: usize) -> Vec<[Pos2; 2]> {
        let from = self.angle(index as f32 - 0.5);
        let to = self.angle(index as f32 + 0.5);
        let pieces = ((to - from) / PIECE).ceil().max(1.0) as usize;
        let shares = (0..=pieces).map(|piece| piece as f32 / pieces as f32);
        shares
            .map(|share| {
                [self.inner + 1.0, self.outer - 1.0].map(|radius| {
                    // The gap is one point on either side, at any radius.
                    let gap = 1.0 / radius;
                    let angle = from + gap + (to - from - 2.0 * gap) * share;
                    center + radius * direction(angle)
                })
            })
            .collect()
    }

    /// Angle clockwise from the top after this number of wedges.
    fn angle(&self, wedges: f32) -> f32 {
        TAU * wedges / self.count as f32
    }
}

fn direction(angle: f32) -> Vec2 {
    vec2(angle.sin(), -angle.cos())
}

const MIDDLE: f32 = 46.0;

/// Widths of the rings of tubes, mixtures and sizes, in points. Each is wider than a finger.
const WIDTHS: [f32; 3] = [58.0, 52.0, 48.0];

/// A tube's wedge shows the masstone over this share of the width, and its tint over the rest.
const MASSTONE: f32 = 0.68;

/// Side of a wedge's target for screen readers, in points.
const TARGET: f32 = 44.0;

/// An opening key counts as held after this time, in seconds.
const HOLD_SECONDS: f64 = 0.35;

/// Largest dot for a brush size, as a radius in points.
const LARGEST_DOT: f32 = 19.0;

/// The open menu.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct QuickPalette {
    center: Pos2,
    opened: f64,
    /// Whether you opened it with the secondary button. You then choose a wedge by releasing the
    /// button over it.
    by_button: bool,
    choices: [Vec<QuickChoice>; 3],
    /// Colour of the paint on the brush, shown in the middle.
    held: Option<[u8; 3]>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum QuickAnswer {
    Chosen(QuickChoice),
    /// You chose nothing, and the menu closes.
    Closed,
}

impl QuickPalette {
    /// Opens the menu around a point, moved so that it fits into the window.
    pub(super) fn at(
        context: &Context,
        point: Pos2,
        by_button: bool,
        choices: [Vec<QuickChoice>; 3],
        held: Option<[u8; 3]>,
    ) -> Self {
        let room = context.content_rect().shrink(radius(&choices) + 4.0);
        fn within(at: f32, low: f32, high: f32) -> f32 {
            if low < high { at.clamp(low, high) } else { 0.5 * (low + high) }
        }
        let center = pos2(
            within(point.x, room.left(), room.right()),
            within(point.y, room.top(), room.bottom()),
        );
        let opened = context.input(|input| input.time);
        Self { center, opened, by_button, choices, held }
    }

    /// Draws the menu over the whole window, which takes no other input meanwhile. `opening` are
    /// the keys that open it. If you held one, you choose by releasing it.
    pub(super) fn show(&self, context: &Context, opening: &[Key]) -> Option<QuickAnswer> {
        let whole = context.content_rect();
        let area = Area::new(Id::unique("quick palette")).order(Order::Foreground);
        let shown = area.fixed_pos(whole.min).constrain(false).show(context, |ui| {
            ui.set_clip_rect(whole);
            ui.allocate_rect(whole, Sense::click_and_drag());
            self.draw(ui)
        });
        let by_name = shown.inner.map(QuickAnswer::Chosen);
        by_name.or_else(|| self.answer(context, opening))
    }

    /// Your choice by pointer or keys.
    fn answer(&self, context: &Context, opening: &[Key]) -> Option<QuickAnswer> {
        let (escape, let_go, released, secondary, pointer, now) = context.input(|input| {
            let pointer = &input.pointer;
            (
                input.key_pressed(Key::Escape),
                opening.iter().any(|key| input.key_released(*key)),
                pointer.button_released(PointerButton::Primary),
                pointer.button_released(PointerButton::Secondary),
                pointer.latest_pos(),
                input.time,
            )
        });
        // You are still releasing the click on the menu entry that opened this.
        if now <= self.opened {
            return None;
        }
        if escape {
            return Some(QuickAnswer::Closed);
        }
        let chosen = pointer.and_then(|point| self.choice_at(point)).cloned();
        let held = now - self.opened > HOLD_SECONDS;
        let dragged = secondary && self.by_button;
        if !(released || dragged || (let_go && held && chosen.is_some())) {
            return None;
        }
        // If you click the secondary button shortly, the menu stays open.
        let inside = pointer.is_some_and(|point| point.distance(self.center) < MIDDLE);
        if inside && dragged && !released {
            return None;
        }
        Some(chosen.map_or(QuickAnswer::Closed, QuickAnswer::Chosen))
    }

    /// Rings with their choices from the inside, without empty ones.
    fn rings(&self) -> impl Iterator<Item = (Ring, &Vec<QuickChoice>)> {
        let mut inner = MIDDLE;
        let filled = WIDTHS.iter().zip(&self.choices).filter(|(_, choices)| !choices.is_empty());
        filled.map(move |(width, choices)| {
            let ring = Ring { inner, outer: inner + width, count: choices.len() };
            inner += width;
            (ring, choices)
        })
    }

    fn choice_at(&self, point: Pos2) -> Option<&QuickChoice> {
        self.rings().find_map(|(ring, choices)| choices.get(ring.wedge_at(point - self.center)?))
    }

    /// Draws all wedges. Returns the choice that a screen reader activated.
    fn draw(&self, ui: &mut Ui) -> Option<QuickChoice> {
        let colors = theme::colors(ui.ctx());
        let painter = ui.painter().clone();
        let edge = Stroke::new(1.0, colors.line);
        painter.circle(self.center, radius(&self.choices) + 4.0, colors.panel, edge);
        let pointer = ui.input(|input| input.pointer.latest_pos());
        let below = pointer.and_then(|point| self.choice_at(point));
        let mut activated = None;
        for (at, (ring, choices)) in self.rings().enumerate() {
            for (index, choice) in choices.iter().enumerate() {
                let middle = self.center + ring.middle(index);
                let target = Rect::from_center_size(middle, Vec2::splat(TARGET));
                let id = Id::unique(("quick palette", at, index));
                let response = ui.interact(target, id, Sense::click());
                response.widget_info(|| WidgetInfo::labeled(Role::Button, true, choice.name()));
                if response.clicked() {
                    activated = Some(choice.clone());
                }
                let fill = match choice {
                    QuickChoice::Tube { color, .. } | QuickChoice::Mixture { color, .. } => {
                        screen(*color)
                    }
                    QuickChoice::Size(_) => colors.well,
                };
                painter.add(Shape::mesh(ring.mesh(self.center, index, fill)));
                if let QuickChoice::Tube { tint: Some(tint), .. } = choice {
                    let inner = ring.inner + MASSTONE * (ring.outer - ring.inner);
                    let rim = Ring { inner, ..ring };
                    painter.add(Shape::mesh(rim.mesh(self.center, index, screen(*tint))));
                }
                let outline = ring.outline(self.center, index);
                painter.add(Shape::closed_line(outline, Stroke::new(1.0, colors.line)));
                if let QuickChoice::Size(mm) = choice {
                    self.size(ui, middle, *mm);
                }
                if below == Some(choice) || response.has_focus() {
                    let line = Stroke::new(3.0, colors.strong);
                    painter.add(Shape::closed_line(ring.outline(self.center, index), line));
                }
            }
        }
        let held = self.held.map_or(colors.well, screen);
        painter.circle(self.center, MIDDLE - 8.0, held, Stroke::new(1.0, colors.line));
        if let Some(choice) = below {
            self.label(ui, &choice.label());
        }
        activated
    }

    /// Draws a dot that grows with the size of a brush, and the size in mm.
    fn size(&self, ui: &Ui, middle: Pos2, mm: f64) {
        let colors = theme::colors(ui.ctx());
        let radius = (1.0 + 2.8 * (mm as f32).sqrt()).min(LARGEST_DOT);
        ui.painter().circle_filled(middle - vec2(0.0, 3.0), 0.75 * radius, colors.text);
        let font = FontId::proportional(10.0);
        let at = middle + vec2(0.0, 16.0);
        ui.painter().text(at, Align2::CENTER_CENTER, format!("{mm}"), font, colors.text);
    }

    /// Draws the name of the choice below the pointer. It stands under the menu, or over it at the
    /// lower edge.
    fn label(&self, ui: &Ui, words: &str) {
        let colors = theme::colors(ui.ctx());
        let whole = ui.ctx().content_rect();
        let away = radius(&self.choices) + 20.0;
        let side = if self.center.y + away + 14.0 < whole.bottom() { 1.0 } else { -1.0 };
        let at = self.center + vec2(0.0, side * away);
        let galley = ui.painter().layout_no_wrap(
            words.to_owned(),
            FontId::proportional(14.0),
            colors.strong,
        );
        let rect = Align2::CENTER_CENTER.anchor_size(at, galley.size());
        ui.painter().rect_filled(rect.expand2(vec2(9.0, 4.0)), theme::CORNER_RADIUS, colors.bar);
        ui.painter().galley(rect.min, galley, colors.strong);
    }
}

/// Outer radius of all rings that are not empty.
fn radius(choices: &[Vec<QuickChoice>; 3]) -> f32 {
    let filled = WIDTHS.iter().zip(choices).filter(|(_, choices)| !choices.is_empty());
    MIDDLE + filled.map(|(width, _)| width).sum::<f32>()
}

fn screen([red, green, blue]: [u8; 3]) -> Color32 {
    Color32::from_rgb(red, green, blue)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: Ring = Ring { inner: 40.0, outer: 90.0, count: 8 };

    #[test]
    fn every_wedge_is_found_at_its_middle_and_none_beside_the_ring() {
        for count in [1, 3, 8, 12] {
            let ring = Ring { count, ..RING };
            for index in 0..count {
                assert_eq!(ring.wedge_at(ring.middle(index)), Some(index), "of {count}");
            }
        }
        for offset in [Vec2::ZERO, vec2(39.0, 0.0), vec2(0.0, 91.0)] {
            assert_eq!(RING.wedge_at(offset), None, "{offset:?}");
        }
        assert_eq!(Ring { count: 0, ..RING }.wedge_at(vec2(60.0, 0.0)), None);
    }

    #[test]
    fn wedges_go_clockwise_from_the_top_and_meet_half_way() {
        assert_eq!(RING.wedge_at(vec2(0.0, -60.0)), Some(0), "the top");
        assert_eq!(RING.wedge_at(vec2(60.0, 0.0)), Some(2), "the right");
        let between = [22.0_f32, 23.0, -23.0]
            .map(|degrees| RING.wedge_at(60.0 * direction(degrees.to_radians())));
        assert_eq!(between, [Some(0), Some(1), Some(7)]);
    }

    #[test]
    fn a_wedge_is_large_enough_for_a_finger_and_lies_within_its_ring() {
        let center = Pos2::new(100.0, 100.0);
        for point in RING.outline(center, 3) {
            let radius = point.distance(center);
            assert!((40.0..=90.0).contains(&radius), "{radius}");
            assert!(RING.wedge_at(point - center) == Some(3), "{point:?}");
        }
        let chord = (RING.middle(0) - RING.middle(1)).length();
        assert!(chord >= 44.0, "{chord}");
    }
}
