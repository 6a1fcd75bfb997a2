//! Performs the intents of menus, toolbar and keyboard, and connects the window to the system:
//! title, dropped files, performance log, closing.
//!
//! This also draws what lies over the whole window, e.g. the windows of pen and own brushes, the
//! quick palette and the guided tour.
//!
//! [`Between`] holds the changes by a stroke between two frames. A page in a browser shows only
//! this part, because a whole frame takes long without a graphics card.

use std::path::{Path, PathBuf};

use eframe::egui::{
    Align2, Area, Color32, Context, FontId, Frame, Id, LayerId, Order, Popup, Pos2, Rect, RichText,
    Sense, Stroke, Ui, UiBuilder, ViewportCommand, pos2, vec2,
};
use graphics::picture_formats::has_picture_ending;
use paint::strokes::{Action, SurfaceId};
use session::Command;
use session::brushes::BrushSet;
use session::volumes::{Subject, VolumeCommand};
use web_time::{Duration, Instant};

use super::crop::CropTool;
use super::dock::Drawn;
use super::guide::{Arrow, Facts, TourStep, outline, plate};
use super::intent::{self, Intent, Part};
use super::quick::{QuickAnswer, QuickChoice, QuickPalette, quick_choices};
use super::side::{Panels, Tab};
use super::studio::Studio;
use super::volumes::Volumes;
use crate::arrangement::Side;
use crate::files::{FrameFigures, bottom_of_notices};
use crate::keymap::{Scope, text};
use crate::language::{speak, tr, tr_format};
use crate::panels::brushes::{wash, wipe};
use crate::panels::eyedropper::Eyedropper;
use crate::panels::layers::dry;
use crate::panels::own_brushes::OwnBrushRequest;
use crate::panels::pen::PenContext;
use crate::panels::{FileRequest, Mode, PanelContext, Request, tubes};
use crate::pen::GuideKind;
use crate::theme::is_narrow;
use crate::view::{HeadLines, Patch};
use crate::{floating, keymap, pace, theme};

/// One key press rotates view or brush by this angle, in degrees.
const TURN_DEG: f64 = 15.0;

const STEP: f64 = 1.15;

const ZOOM: f64 = std::f64::consts::SQRT_2;

impl Studio {
    /// Performs one intent: changes the view, or queues a request.
    pub(super) fn perform(&mut self, intent: Intent, context: &Context) {
        let area = self.canvas.rect();
        let density = context.pixels_per_point();
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
            // Over a picture that you draw on, undo takes its last line back.
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
            Intent::ZoomIn => self.canvas.view.zoom_by(ZOOM, area.center(), area, density),
            Intent::ZoomOut => {
                self.canvas.view.zoom_by(1.0 / ZOOM, area.center(), area, density);
            }
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

    /// Prepares to close: stores the tool settings in the preferences, waits for files
    /// being written and stops the worker.
    pub fn finish(&mut self) {
        self.keep_tools();
        self.files.finish();
        self.worker.ask(Command::Quit);
    }

    /// Stores the tool settings in the preferences.
    pub fn keep_tools(&mut self) {
        let saved = &mut self.files.preferences.tools;
        saved.brush.clone_from(&self.tools.brush);
        saved.vehicle = self.tools.vehicle;
        saved.load_mm = self.tools.load_mm;
        saved.squeeze_mm3 = self.tools.squeeze_mm3;
        saved.dry_share = self.tools.dry_share;
    }

    /// Opens a file where its kind belongs. For example, a scene opens in the workspace of scenes,
    /// and a painting at the easel.
    pub fn open_path(&mut self, context: &Context, path: PathBuf) {
        if Eyedropper::takes(&path) {
            self.panels.eyedropper.open_swatches(&path);
            self.panels.select(Tab::Color);
            return;
        }
        let is_library = path.extension().is_some_and(|ending| ending == "json");
        if let Some(volumes) = self.volumes.as_mut().filter(|_| self.shows_volumes && is_library) {
            volumes.ask(VolumeCommand::Library(path));
            return;
        }
        if let Some(subject) = self.scene_subject(&path) {
            self.open_scene(context, subject);
            return;
        }
        self.requests.push(Request::File(FileRequest::Open(Some(path))));
    }

    /// Opens files dropped on the window, and shows a hint while files hover over it.
    pub(super) fn open_dropped(&mut self, context: &Context) {
        let (dropped, hovering) = context.input(|input| {
            let paths = input.raw.dropped_files.iter().map(|file| file.path().to_owned());
            (paths.collect::<Vec<_>>(), !input.raw.hovered_files.is_empty())
        });
        for path in dropped {
            self.open_path(context, path);
        }
        if hovering {
            let layer = LayerId::new(Order::Foreground, Id::unique("dropping"));
            let painter = context.layer_painter(layer);
            let whole = context.content_rect();
            painter.rect_filled(whole, 0.0, theme::BOARD);
            let font = FontId::proportional(18.0);
            let text = tr("Drop to open");
            painter.text(whole.center(), Align2::CENTER_CENTER, text, font, theme::BOARD_TEXT);
        }
    }

    /// The subject if the dropped file opens as a scene. A picture does so only while a scene is
    /// shown.
    fn scene_subject(&self, path: &Path) -> Option<Subject> {
        let subject = Subject::from_text(path.to_str()?);
        subject.or_else(|| {
            (self.shows_volumes && has_picture_ending(path)).then(|| Subject::of_file(path))
        })
    }

    pub(super) fn update_title(&mut self, context: &Context) {
        let mark = if self.files.has_unsaved_changes() { "*" } else { "" };
        let title = match self.volumes.as_ref().filter(|_| self.shows_volumes) {
            Some(volumes) => volumes.title(),
            None => format!("{}{mark}", self.files.title()),
        };
        if self.title != title {
            context.send_viewport_cmd(ViewportCommand::Title(format!("{title} - impasto")));
            self.title = title;
        }
    }

    /// Appends the performance figures to the log, if there is one.
    pub(super) fn log_figures(&mut self, context: &Context, now: Instant) {
        let Some(log) = &mut self.log else { return };
        let rate = self.frames.rate();
        let (width, height) = self.canvas.cells();
        let placement = self.canvas.placement();
        let corners = [[0, 0], [width, 0], [0, height], [width, height]];
        let sheet = corners.map(|corner| placement.point(corner.map(|cells| cells as f64)));
        let scene = self.volumes.as_ref().filter(|_| self.shows_volumes);
        let sheet = scene.map_or_else(|| Rect::from_points(&sheet), Volumes::rect);
        let sheet = sheet * context.pixels_per_point();
        let frames = FrameFigures {
            frames_a_second: rate.frames_a_second,
            latency_ms: rate.latency_ms,
            worst_latency_ms: rate.worst_ms,
            canvas_px: [sheet.left(), sheet.top(), sheet.right(), sheet.bottom()],
        };
        log.append_when_due(now, &frames, &self.figures);
        context.request_repaint_after(Duration::from_secs(1));
    }

    pub(super) fn draw_pen_windows(&mut self, context: &Context) {
        let brush = self.tools.brush.clone();
        let label = self.panels.brushes.label(&brush).to_owned();
        let preferences = &mut self.files.preferences;
        let mut options = preferences.options_of(&brush);
        let settings = &mut preferences.pen;
        let options_before = options.clone();
        let cx = PenContext { pen: &self.pen, settings, options: &mut options, brush: &label };
        self.pen_window.show(context, &mut self.visible.pen, cx);
        if options != options_before {
            preferences.set_options(&brush, options);
        }
        if self.visible.brush_sets {
            let open = &mut self.visible.brush_sets;
            let sets = &mut self.files.brush_sets;
            if let Some(request) = self.own_brushes.show(context, open, sets) {
                self.use_own_brushes(request);
            }
        }
    }

    fn use_own_brushes(&mut self, request: OwnBrushRequest) {
        match request {
            OwnBrushRequest::Use(preset) => {
                let mut name = None;
                self.with_panels(|panels, cx| name = Some(panels.brushes.take(&preset, cx)));
                if let Some(name) = name {
                    self.files.preferences.set_options(&name, preset.options);
                }
            }
            OwnBrushRequest::Keep { with_paint } => {
                let options = self.files.preferences.options_of(&self.tools.brush);
                let mut kept = None;
                self.with_panels(|panels, cx| {
                    kept = panels.brushes.kept(options, with_paint, cx);
                });
                if let Some(preset) = kept {
                    self.files.brush_set().put(preset);
                }
            }
            OwnBrushRequest::AddSet(name) => self.files.add_brush_set(BrushSet::new(&name)),
            OwnBrushRequest::Import => {
                self.requests.push(Request::File(FileRequest::ImportBrushes));
            }
            OwnBrushRequest::Export => {
                self.requests.push(Request::File(FileRequest::ExportBrushes));
            }
        }
    }

    /// Whether the sheet of panels covers canvas and palette.
    pub(super) fn shows_sheet(&self, context: &Context) -> bool {
        self.visible.sheet && self.visible.panels && is_narrow(context)
    }

    /// Whether you can see the panels, in their columns or on the sheet of a narrow window.
    pub(super) fn shows_panels(&self, context: &Context) -> bool {
        if is_narrow(context) { self.shows_sheet(context) } else { self.visible.panels }
    }

    /// Shows or hides the panels. In a narrow window this concerns only the sheet.
    pub(super) fn toggle_panels(&mut self, context: &Context) {
        if is_narrow(context) && self.visible.panels {
            self.visible.sheet ^= true;
        } else {
            self.visible.panels ^= true;
        }
    }

    /// Draws the panels of both columns below each other.
    pub(super) fn draw_sheet(&mut self, ui: &mut Ui) {
        let Some(painting) = self.painting.clone() else { return };
        let sides = Side::ALL.into_iter().filter(|side| self.panels.has_column(*side));
        let sides: Vec<Side> = sides.collect();
        let whole = ui.available_rect_before_wrap();
        let size = vec2(whole.width(), whole.height() / sides.len().max(1) as f32);
        let mut drawn = Drawn::default();
        for (at, side) in sides.into_iter().enumerate() {
            let top = whole.min + vec2(0.0, at as f32 * size.y);
            let salt = Id::unique(("sheet", at));
            let place = UiBuilder::new().id_salt(salt).max_rect(Rect::from_min_size(top, size));
            let requests = &mut self.requests;
            let mut cx = PanelContext { painting: &painting, tools: &mut self.tools, requests };
            let part = &mut ui.new_child(place);
            self.panels.show(part, side, (&mut cx, &self.files), &mut drawn);
        }
        self.panels.drop_dragged(ui.ctx(), drawn, Rect::NOTHING);
    }

    /// Opens the quick palette at the pointer, or in the middle of the canvas if the pointer is
    /// elsewhere. Closes it if it is open. It never opens over a dialog or during a stroke.
    pub(super) fn toggle_quick_palette(&mut self, context: &Context) {
        if self.quick.take().is_some() {
            return;
        }
        let pointer = context.input(|input| input.pointer.hover_pos());
        let point = pointer
            .filter(|point| {
                self.visible_surfaces()
                    .into_iter()
                    .any(|one| self.view(one).rect().contains(*point))
            })
            .unwrap_or_else(|| self.canvas.rect().center());
        self.open_quick_palette(context, point, false);
    }

    /// Opens the quick palette around a point, unless e.g. a dialog is open.
    pub(super) fn open_quick_palette(&mut self, context: &Context, point: Pos2, by_button: bool) {
        let Some(painting) = self.painting.clone() else { return };
        let busy = self.files.has_dialog()
            || self.visible.keys
            || painting.stroke_open
            || context.input(|input| input.pointer.primary_down())
            || context.memory(|memory| memory.top_modal_layer().is_some());
        if busy {
            return;
        }
        Popup::close_all(context);
        let choices = quick_choices(&painting, &self.tools, self.files.swatches());
        let brush = painting.brushes.iter().find(|brush| brush.name == self.tools.brush);
        let held = brush.and_then(|brush| brush.color);
        self.quick = Some(QuickPalette::at(context, point, by_button, choices, held));
        context.request_repaint();
    }

    /// Draws the quick palette if it is open, and does what you chose in it.
    pub(super) fn show_quick_palette(&mut self, context: &Context) {
        let Some(quick) = &self.quick else { return };
        let Some(answer) =
            quick.show(context, &keymap::keys(context, &Intent::QuickPalette.name()))
        else {
            return;
        };
        self.quick = None;
        if let QuickAnswer::Chosen(choice) = answer {
            self.with_panels(|panels, cx| match choice {
                QuickChoice::Tube { slot, .. } => {
                    cx.tools.tube = slot;
                    tubes::load(cx, slot);
                }
                QuickChoice::Mixture { recipe, vehicle, .. } => cx.load(recipe, vehicle),
                QuickChoice::Size(size_mm) => {
                    panels.brushes.set_size(size_mm, cx);
                    cx.tools.mode = Mode::Paint;
                }
            });
        }
    }

    /// Passes on the reports of the stylus without waiting for a frame. Returns whether
    /// [`Studio::between`] can show this stroke. If it cannot, this call does nothing, and you must
    /// draw a frame.
    pub fn take_stylus(&mut self, context: &Context) -> bool {
        let shown = self.is_shown_between(context);
        if shown {
            speak(self.files.preferences.language);
            let mode = self.keys.mode(self.tools.mode);
            self.update_pen(context, &[], mode);
            self.send_requests();
        }
        shown
    }

    /// Changes by the open stroke since the last call or frame. `None` if you must draw a frame of
    /// the whole window instead. This asks for such a frame if there was none for a while. Do not
    /// call this during a frame.
    pub fn between(&mut self, context: &Context) -> Option<Between> {
        if !self.take_stylus(context) {
            self.end_between(context);
            return None;
        }
        self.handle_events();
        let rare = if self.figures.paint_is_behind { RARE_BEHIND } else { RARE };
        pace::set_rare(context, Some(rare));
        let canvas = self.head.as_deref().filter(|head| head.surface == SurfaceId::Canvas);
        let head = canvas.map(|head| self.canvas.head_lines(head, self.head_paint()));
        let head = head.unwrap_or_default();
        let rect = head.bounds();
        let fresh = self.canvas.take_fresh();
        if fresh.is_none() && rect == self.head_rect {
            return Some(Between::default());
        }
        let before = std::mem::replace(&mut self.head_rect, rect);
        let parts = [fresh, before, rect].into_iter().flatten();
        let region = parts.fold(Rect::NOTHING, |all, part| all.union(part));
        if is_covered(context, region) {
            self.end_between(context);
            return None;
        }
        self.frames.begin(Instant::now(), None);
        Some(Between { patch: self.canvas.patch(region), head })
    }

    /// Whether the open stroke changes only paint and brush head on the canvas.
    fn is_shown_between(&self, context: &Context) -> bool {
        let one_light = self
            .painting
            .as_ref()
            .is_some_and(|painting| painting.second_lighting.is_none() && painting.mask.is_none());
        let aided = self.aids.guide.is_some() || self.aids.symmetry.on;
        self.pen.stylus_on() == Some(SurfaceId::Canvas)
            && one_light
            && !aided
            && !self.tools.figures
            && !self.shows_volumes
            && !self.is_framing()
            && self.quick.is_none()
            && !self.panels.reference.is_over_canvas()
            && self.pen.string_line().is_none()
            && !self.files.has_dialog()
            && !self.shows_sheet(context)
    }

    /// Allows frequent frames again.
    fn end_between(&self, context: &Context) {
        if pace::set_rare(context, None) {
            context.request_repaint();
        }
    }

    /// Draws hints over canvas, palette and tubes. You can click through them.
    pub(super) fn draw_first_steps(&self, ui: &Ui) {
        let busy = self.tour.is_running() || self.crop.is_some();
        if !self.visible.first_steps || self.painting.is_none() || busy {
            return;
        }
        let painter = ui.painter();
        let canvas = self.canvas.rect();
        let width = WIDTH.min(canvas.width() - 16.0);
        // Messages at the top of the window would cover the hints.
        let covered = bottom_of_notices(ui.ctx()).unwrap_or(f32::MIN);
        let top = canvas.top().max(covered) + 14.0;
        let lines = canvas_lines(ui.ctx());
        plate(painter, pos2(canvas.center().x, top), Arrow::None, width, &lines);
        if !self.visible.palette || !self.visible.panels {
            return;
        }
        let palette = self.palette.rect();
        let mixing = palette_lines(ui.ctx());
        let mut arrows: Vec<(Pos2, f32, &[String])> =
            vec![(pos2(palette.center().x, palette.top()), palette.width(), &mixing)];
        let filling = TUBES.map(|line| tr(line).to_owned());
        if let Some(tubes) = intent::rect(ui.ctx(), Part::Tubes) {
            arrows.push((pos2(tubes.center().x, tubes.top()), tubes.width(), &filling));
        }
        for (tip, width, lines) in arrows {
            plate(painter, tip, Arrow::Down, width.min(WIDTH), lines);
        }
    }

    /// Starts the tour, or continues where you left it.
    pub(super) fn start_tour(&mut self) {
        self.tour.start();
        self.visible.panels = true;
        self.visible.palette = true;
    }

    /// Shows the tour and handles its buttons. Escape leaves it.
    pub(super) fn show_tour(&mut self, context: &Context) {
        if !self.tour.is_running() {
            return;
        }
        match &self.painting {
            // While a recording plays, it paints, not you. The tour does not count this.
            _ if self.files.is_playing() => self.tour.forget(),
            Some(painting) => {
                self.tour.observe(Facts::of(painting));
            }
            None => {}
        }
        let place = self.tour.step().and_then(|step| self.place_of(step, context));
        let dialog = context.memory(|memory| memory.top_modal_layer().is_some());
        if let Some((place, ..)) = place.filter(|_| !dialog) {
            let layer = LayerId::new(Order::Foreground, Id::unique("place of the tour"));
            outline(&context.layer_painter(layer), place.shrink(2.0));
        }
        let canvas = self.canvas.rect();
        let at_canvas = (canvas.right_top() + vec2(-GAP, GAP), Align2::RIGHT_TOP);
        let (at, pivot) = place.map_or(at_canvas, |(_, at, pivot)| (at, pivot));
        // The card stands beside the toolbar, so that you can use its buttons, and above the status
        // line.
        let room = floating::room(context);
        let left = self.canvas.rect().left().clamp(room.left(), room.right());
        let area = Area::new(Id::unique("tour"))
            .order(Order::Foreground)
            .pivot(pivot)
            .fixed_pos(at)
            .constrain_to(room.with_min_x(left));
        let pressed = area.show(context, |ui| {
            Frame::popup(ui.style()).inner_margin(10).show(ui, |ui| self.tour_card(ui)).inner
        });
        let left = floating::take_escape(context).then_some(Pressed::Leave);
        match pressed.inner.or(left) {
            Some(Pressed::Back) => self.tour.back(),
            Some(Pressed::Next) => self.tour.next(),
            Some(Pressed::Leave) => {
                self.tour.leave();
                let hint = tr("Help, Guided tour goes on with it").to_owned();
                self.show_message(tr("the tour was left").to_owned(), Some(hint), false);
            }
            None => {}
        }
    }

    /// The place that a step points at, and where its card stands: the point that the card touches,
    /// and which corner or side of the card touches it.
    fn place_of(&self, step: TourStep, context: &Context) -> Option<(Rect, Pos2, Align2)> {
        match step {
            TourStep::Load => intent::rect(context, Part::Tubes).map(above),
            TourStep::Mix => Some(above(self.palette.rect())),
            TourStep::Paint => {
                let canvas = self.canvas.rect();
                Some((canvas, canvas.right_top() + vec2(-GAP, GAP), Align2::RIGHT_TOP))
            }
            TourStep::Dry => {
                let place = intent::rect(context, Part::Button(Intent::Dry))?;
                Some((place, place.right_center() + vec2(GAP, 0.0), Align2::LEFT_CENTER))
            }
            TourStep::Glaze => self.beside_tab(Tab::Brush, context),
            TourStep::Relight => self.beside_tab(Tab::Light, context),
        }
    }

    fn beside_tab(&self, tab: Tab, context: &Context) -> Option<(Rect, Pos2, Align2)> {
        let place = intent::rect(context, Part::Tab(tab.name()))?;
        let canvas = self.canvas.rect();
        let left = canvas.right() - GAP;
        // Beside a tab low in the window, the card would hide the tubes.
        if place.top() > canvas.center().y {
            return Some((place, Pos2::new(left, canvas.bottom() - GAP), Align2::RIGHT_BOTTOM));
        }
        Some((place, Pos2::new(left, place.top()), Align2::RIGHT_TOP))
    }

    fn tour_card(&self, ui: &mut Ui) -> Option<Pressed> {
        ui.set_width(TOUR_CARD_WIDTH);
        let number = self.tour.number();
        let of = TourStep::ALL.len();
        match self.tour.step() {
            Some(step) => {
                ui.horizontal(|ui| {
                    ui.label(RichText::new(tr(step.title())).heading().strong());
                    ui.weak(tr_format!("step {number} of {of}", number = number + 1, of));
                });
                for line in
                    step.lines(|intent: Intent| text(ui.ctx(), &intent.name()).unwrap_or_default())
                {
                    ui.label(line);
                }
            }
            None => {
                ui.label(RichText::new(tr("That was the tour")).heading().strong());
                ui.label(tr("What was painted stays. Help, Keys lists all keys."));
            }
        }
        ui.add_space(4.0);
        let mut pressed = None;
        ui.horizontal(|ui| {
            self.dots(ui);
            let back = ui.add_enabled(number > 0, eframe::egui::Button::new(tr("Back")));
            if back.on_hover_text(tr("The step before")).clicked() {
                pressed = Some(Pressed::Back);
            }
            if number < of
                && ui.button(tr("Next")).on_hover_text(tr("Goes on without it")).clicked()
            {
                pressed = Some(Pressed::Next);
            }
            let leave = if number < of { tr("Leave the tour") } else { tr("Close the tour") };
            if ui
                .button(leave)
                .on_hover_text(tr("Help, Guided tour shows it again (Esc)"))
                .clicked()
            {
                pressed = Some(Pressed::Leave);
            }
        });
        pressed
    }

    /// One dot for each step; full if it is done.
    fn dots(&self, ui: &mut Ui) {
        let colors = theme::colors(ui.ctx());
        ui.spacing_mut().item_spacing.x = 3.0;
        for (index, done) in self.tour.done().into_iter().enumerate() {
            let (rect, _) = ui.allocate_exact_size(vec2(9.0, 16.0), Sense::hover());
            let here = index == self.tour.number();
            let edge = Stroke::new(if here { 2.0 } else { 1.0 }, colors.text);
            let fill = if done { colors.text } else { Color32::TRANSPARENT };
            ui.painter().circle(rect.center(), 4.0, fill, edge);
        }
        ui.spacing_mut().item_spacing.x = 6.0;
        ui.add_space(4.0);
    }
}

/// Shortest time between two frames of the whole window while [`Studio::between`] shows the stroke.
/// The figures in the panels change as often.
const RARE: Duration = Duration::from_millis(500);

/// Used instead of [`RARE`] while the paint is behind the pen.
const RARE_BEHIND: Duration = Duration::from_millis(1500);

/// The part of the window that a stroke has changed. You get it from [`Studio::between`].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Between {
    /// The changed pixels without the head; empty if nothing changed.
    pub patch: Patch,
    /// The head. It lies within the patch, over its pixels.
    pub head: HeadLines,
}

/// Whether a floating window or a message lies over a part of the window.
fn is_covered(context: &Context, region: Rect) -> bool {
    context.memory(|memory| {
        memory.areas().visible_layer_ids().iter().any(|layer| {
            let rect = memory.area_rect(layer.id).unwrap_or(Rect::NOTHING);
            layer.order != Order::Background && rect.height() > 1.0 && rect.intersects(region)
        })
    })
}

/// A `place` with a card above it.
fn above(place: Rect) -> (Rect, Pos2, Align2) {
    (place, place.center_top() - vec2(0.0, GAP), Align2::CENTER_BOTTOM)
}

fn canvas_lines(context: &Context) -> [String; 3] {
    let dry = by_key(context, Intent::Dry, tr("Edit, Dry"));
    [
        tr("Press here and draw, with a pen, a mouse or a finger.").to_owned(),
        tr_format!("Alt + click tells a colour. {dry} dries the paint, to paint over it.", dry),
        tr("File, Sample painting opens one to try; Help, Guided tour shows more.").to_owned(),
    ]
}

fn palette_lines(context: &Context) -> [String; 2] {
    let wash = by_key(context, Intent::Wash, tr("Edit, Wash the brush"));
    [tr("Mix here with the brush.").to_owned(), tr_format!("{wash} washes it.", wash)]
}

/// The key of an intent, or its place in the menus if it has no key.
fn by_key(context: &Context, intent: Intent, menu: &str) -> String {
    text(context, &intent.name()).filter(|key| !key.is_empty()).unwrap_or_else(|| menu.to_owned())
}

const TUBES: [&str; 2] =
    ["Double click a tube: its paint is on the brush.", "Click, then click the palette: a heap."];

/// Largest width of the hints over the canvas, in points.
const WIDTH: f32 = 440.0;

const TOUR_CARD_WIDTH: f32 = 392.0;

/// Distance from the card to the place that it points at, in points.
const GAP: f32 = 12.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pressed {
    Back,
    Next,
    Leave,
}
