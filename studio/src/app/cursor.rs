//! What is seen where the pen is: the head of the brush, or the colour below the
//! eyedropper.

use eframe::egui::{Color32, CursorIcon, Pos2, Stroke, Ui};
use render::paint::brush::{Head, Relief};
use render::paint::strokes::{BrushSpec, SurfaceId};
use render::tile::Rect;

use super::Studio;
use super::surfaces::Hover;
use crate::panels::Mode;
use crate::theme;
use crate::view::HeadLook;
use session::{HeadOnCanvas, PaintingState};

/// Radius of the ring around the colour below the eyedropper, in points.
const RING: f32 = 24.0;

/// A head that hovers: straight, just above a level surface.
#[derive(Debug)]
pub(super) struct Hovering {
    spec: BrushSpec,
    head: Head,
    level: Relief,
}

impl Hovering {
    /// The head of a brush, if it can be made at this size.
    fn of(spec: &BrushSpec, cell_mm: f64) -> Option<Self> {
        let head = Head::new(spec.shape, spec.size_mm, cell_mm).ok()?;
        Some(Self { spec: spec.clone(), head, level: Relief::flat(1, 1, cell_mm) })
    }

    fn over(&mut self, hover: &Hover) -> Option<HeadOnCanvas> {
        self.head.hover(&hover.sample.pose(self.level.cell_mm()), &self.level);
        let mesh = self.head.mesh()?;
        let surface = hover.surface;
        Some(HeadOnCanvas {
            surface,
            around: mesh.around,
            along: mesh.along,
            vertices: mesh.vertices,
        })
    }
}

impl Studio {
    /// Draws what is where the pen is.
    pub(super) fn cursor(&mut self, ui: &Ui, mode: Mode) {
        let Some(easel) = self.easel.clone() else { return };
        match mode {
            Mode::Paint => self.brush(ui, &easel),
            Mode::Pick => self.ring(ui),
            Mode::Squeeze | Mode::Pan | Mode::Rotate | Mode::Zoom => {}
        }
    }

    /// The head: bent as the worker has it, or straight above the surface.
    fn brush(&mut self, ui: &Ui, easel: &PaintingState) {
        let look = |name: &str| {
            let brush = easel.brushes.iter().find(|brush| brush.name == name);
            HeadLook::lit_by(&easel.lighting, brush.and_then(|brush| brush.color))
        };
        if let Some(head) = &self.head {
            self.view(head.surface).show_head(ui, head, look(&self.tools.brush));
            ui.ctx().set_cursor_icon(CursorIcon::None);
            return;
        }
        let Some(hover) = &self.hover else { return };
        let Some(brush) = easel.brushes.iter().find(|brush| brush.name == hover.brush) else {
            return;
        };
        let same =
            |held: &Hovering| held.spec == brush.spec && held.level.cell_mm() == easel.cell_mm;
        if !self.hovering.as_ref().is_some_and(same) {
            self.hovering = Hovering::of(&brush.spec, easel.cell_mm);
        }
        let head = self.hovering.as_mut().and_then(|held| held.over(hover));
        if let Some(head) = head {
            self.view(hover.surface).show_head(ui, &head, look(&hover.brush));
            ui.ctx().set_cursor_icon(CursorIcon::None);
        }
    }

    /// A ring of the colour below the pointer, within a neutral one.
    fn ring(&self, ui: &Ui) {
        let Some(point) = ui.input(|input| input.pointer.hover_pos()) else { return };
        let over = |surface: &SurfaceId| self.view(*surface).position(point).is_some();
        let Some(surface) = self.surfaces_shown().into_iter().find(over) else { return };
        let Some(color) = self.color_at(surface, point) else { return };
        let painter = ui.painter_at(self.view(surface).rect());
        painter.circle_stroke(point, RING + 6.0, Stroke::new(6.0, theme::SURROUND));
        painter.circle_stroke(point, RING, Stroke::new(8.0, color));
        ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
    }

    /// The colour on the screen of the cell at a point of the window.
    fn color_at(&self, surface: SurfaceId, point: Pos2) -> Option<Color32> {
        let view = self.view(surface);
        let [x, y] = view.position(point)?;
        let beyond = x >= f64::from(self.tools.split) * view.cells().0 as f64;
        let second = view.picture(true).filter(|_| beyond);
        let (x, y) = (x as usize, y as usize);
        let cell = second.or(view.picture(false))?.pixels(Rect { x, y, width: 1, height: 1 });
        cell.pixels.first().copied()
    }
}
