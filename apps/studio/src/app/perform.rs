//! Performs the intents of menus, toolbar and keyboard.

use eframe::egui::{Context, ViewportCommand};
use paint::strokes::{Action, SurfaceId};

use super::crop::CropTool;
use super::intent::Intent;
use super::side::Panels;
use super::studio::Studio;
use crate::keymap::Scope;
use crate::panels::brushes::{wash, wipe};
use crate::panels::layers::dry;
use crate::panels::{FileRequest, PanelContext, Request};
use crate::pen::GuideKind;
use crate::theme;
use session::Command;

/// Rotation of view or brush by one key press, in degrees.
const TURN_DEG: f64 = 15.0;

/// Factor of the brush size for one key press.
const STEP: f64 = 1.15;

/// Factor of the zoom for one key press.
const ZOOM: f64 = std::f64::consts::SQRT_2;

impl Studio {
    /// Performs one intent: changes the view, or queues a request.
    pub(super) fn perform(&mut self, intent: Intent, context: &Context) {
        let area = self.canvas.rect();
        let density = context.pixels_per_point();
        let zoom = |studio: &mut Self, factor: f64| {
            studio.canvas.view.zoom_by(factor, area.center(), area, density);
        };
        match intent {
            Intent::New => self.file(FileRequest::New),
            Intent::Open => self.file(FileRequest::Open(None)),
            Intent::Save => self.file(FileRequest::Save),
            Intent::SaveAs => self.file(FileRequest::SaveAs),
            Intent::KeepRevision => self.file(FileRequest::KeepRevision),
            Intent::Export => self.file(FileRequest::Export),
            Intent::SaveRecording => self.file(FileRequest::SaveRecording),
            Intent::ExportTimelapse => self.file(FileRequest::ExportTimelapse),
            Intent::OpenReference => self.file(FileRequest::OpenReference(None)),
            Intent::Sample => self.file(FileRequest::Sample),
            Intent::ReferenceOver => self.panels.reference.toggle_over_canvas(),
            Intent::OpenLamp => self.file(FileRequest::OpenLamp),
            Intent::NewScene => self.show_volumes(context).open_new(),
            Intent::OpenScene => self.files.ask_for_scene(),
            Intent::ShowScene => self.shows_volumes = self.volumes.is_some(),
            Intent::Pen => self.visible.pen ^= true,
            Intent::BrushSets => self.visible.brush_sets ^= true,
            Intent::Preferences => self.file(FileRequest::Preferences),
            Intent::Quit => context.send_viewport_cmd(ViewportCommand::Close),
            // Over a picture that is drawn on, its last line.
            Intent::Undo if self.panels.reference.undo_under_pointer() => {}
            Intent::Undo => self.action(Action::Undo {}),
            Intent::Redo => self.action(Action::Redo {}),
            Intent::Dry => self.with_panels(|_, cx| dry(cx)),
            Intent::Wash => self.with_panels(|_, cx| wash(cx)),
            Intent::Wipe => self.with_panels(|_, cx| wipe(cx)),
            Intent::ScrapePalette => self.action(Action::Scrape { on: SurfaceId::Palette }),
            Intent::Crop => {
                let cells = self.painting.as_ref().map(|painting| painting.canvas_cells);
                self.crop = cells.map(CropTool::new);
            }
            Intent::OtherLight => self.with_panels(|panels, cx| panels.light.switch_illuminant(cx)),
            Intent::Larger => self.with_panels(|panels, cx| panels.brushes.resize(STEP, cx)),
            Intent::Smaller => {
                self.with_panels(|panels, cx| panels.brushes.resize(1.0 / STEP, cx));
            }
            Intent::TwistLeft => self.files.preferences.pen.grip.turn(-TURN_DEG),
            Intent::TwistRight => self.files.preferences.pen.grip.turn(TURN_DEG),
            Intent::Brush(number) => self.with_panels(|panels, cx| {
                panels.brushes.choose(usize::from(number), cx);
            }),
            Intent::Tool(mode) => self.tools.mode = mode,
            Intent::QuickPalette => self.toggle_quick_palette(context),
            Intent::DrawingAids => self.visible.aids ^= true,
            Intent::Ruler => self.toggle_guide(GuideKind::Ruler),
            Intent::Perspective => self.toggle_guide(GuideKind::Perspective),
            Intent::Snapping => self.toggle_snapping(),
            Intent::Symmetry => self.toggle_symmetry(),
            Intent::ZoomIn => zoom(self, ZOOM),
            Intent::ZoomOut => zoom(self, 1.0 / ZOOM),
            Intent::Fit => {
                self.canvas.fit();
                self.palette.fit();
            }
            Intent::ActualSize => self.canvas.view.actual_size(),
            Intent::Upright => {
                self.canvas.view.rotation = 0.0;
                self.canvas.view.mirror = false;
                self.canvas.fit();
            }
            Intent::TurnLeft => self.canvas.view.rotate(-TURN_DEG.to_radians()),
            Intent::TurnRight => self.canvas.view.rotate(TURN_DEG.to_radians()),
            Intent::Mirror => self.canvas.view.mirror ^= true,
            Intent::Panels => self.toggle_panels(context),
            Intent::Palette => self.visible.palette ^= true,
            Intent::Figures => self.tools.figures ^= true,
            Intent::FullScreen => {
                let full = context.input(|input| input.viewport().fullscreen.unwrap_or(false));
                context.send_viewport_cmd(ViewportCommand::Fullscreen(!full));
            }
            Intent::Theme(theme) => self.files.preferences.theme = theme,
            Intent::TouchTargets => self.files.preferences.touch_targets ^= true,
            Intent::LargerInterface => self.scale_interface(true),
            Intent::SmallerInterface => self.scale_interface(false),
            Intent::StandardLayout => self.panels.arrange_as_usual(),
            Intent::Keys => self.show_keys(Scope::Easel),
            Intent::FirstSteps => self.visible.first_steps ^= true,
            Intent::Tour => self.start_tour(),
        }
    }

    fn scale_interface(&mut self, larger: bool) {
        let scale = &mut self.files.preferences.interface_scale;
        *scale = theme::stepped_scale(*scale, larger);
    }

    /// Calls `ask` with the panels and their context, if a painting is open.
    pub(super) fn with_panels(&mut self, ask: impl FnOnce(&mut Panels, &mut PanelContext<'_>)) {
        let Some(painting) = self.painting.clone() else { return };
        let requests = &mut self.requests;
        ask(
            &mut self.panels,
            &mut PanelContext { painting: &painting, tools: &mut self.tools, requests },
        );
    }

    fn action(&mut self, action: Action) {
        self.requests.push(Request::Worker(Command::Apply(action)));
    }

    fn file(&mut self, request: FileRequest) {
        self.requests.push(Request::File(request));
    }
}
