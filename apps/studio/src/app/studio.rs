//! State of the studio window.

use std::sync::Arc;

use eframe::egui::{Context, Rect};
use paint::strokes::{StrokeScript, SurfaceId};

use super::crop::CropTool;
use super::dashes::Dashes;
use super::frames::Frames;
use super::guide::Tour;
use super::hover::{Hover, HoveringHead};
use super::key_editor::KeyEditor;
use super::keys::Keys;
use super::parts::{Parts, StartedWorker};
use super::quick::QuickPalette;
use super::side::Panels;
use super::status::Message;
use super::twins::TwinStrokes;
use super::volumes::Volumes;
use crate::files::{FiguresLog, Files};
use crate::keymap::{Changes, Keymap};
use crate::language::Language;
use crate::panels::own_brushes::OwnBrushes;
use crate::panels::pen::PenWindow;
use crate::panels::{FileRequest, Request, Tools};
use crate::pen::{DrawingAids, Pen};
use crate::theme;
use crate::view::{Outline, SurfaceView};
use session::volumes::Subject;
use session::{Command, HeadOnCanvas, PaintingState, Performance, Worker};

/// The studio window, independent of the window system.
#[derive(Debug)]
pub struct Studio {
    /// Selected tool, brush and tool settings.
    pub tools: Tools,
    /// View of the canvas.
    pub canvas: SurfaceView,
    /// View of the palette.
    pub palette: SurfaceView,
    /// Visible parts of the window.
    pub visible: VisibleParts,
    /// Input of pen, mouse and touch.
    pub pen: Pen,
    /// Ruler, perspective and symmetry over the canvas.
    pub aids: DrawingAids,
    /// Panels at the right and beside the palette.
    pub panels: Panels,
    /// File dialogs, tasks and preferences.
    pub files: Files,
    /// The crop that is being framed.
    pub crop: Option<CropTool>,
    /// The workspace of scenes, from the first scene on.
    pub volumes: Option<Volumes>,
    /// Whether the workspace of scenes is shown instead of the easel.
    pub shows_volumes: bool,
    pub(super) worker: Worker,
    pub(super) painting: Option<Arc<PaintingState>>,
    pub(super) keys: Keys,
    /// Tables of keys in use.
    pub(super) keymap: Keymap,
    /// Language and changes with which the tables were made; `None` before the first frame.
    pub(super) keymap_changes: Option<(Language, Changes)>,
    /// Faults of the changes that the painter was told.
    pub(super) key_faults: Vec<String>,
    pub(super) key_editor: KeyEditor,
    pub(super) pen_window: PenWindow,
    pub(super) own_brushes: OwnBrushes,
    pub(super) frames: Frames,
    pub(super) figures: Performance,
    pub(super) head: Option<Arc<HeadOnCanvas>>,
    /// Rectangle that the head covered when it was drawn last, in points.
    pub(super) head_rect: Option<Rect>,
    pub(super) hover: Option<Hover>,
    pub(super) hovering: Option<HoveringHead>,
    pub(super) quick: Option<QuickPalette>,
    pub(super) message: Option<Message>,
    pub(super) requests: Vec<Request>,
    pub(super) event_count: u64,
    pub(super) last_recording: Option<(u64, Arc<StrokeScript>)>,
    /// Surface of the last pick request, and its x and y in mm as the bits of an `f64`. A
    /// request for the same place is not sent again.
    pub(super) last_pick: Option<(SurfaceId, u64, u64)>,
    /// Points of the mask that is being drawn, in cells of the canvas.
    pub(super) mask_points: Vec<[f64; 2]>,
    /// Movement of the dashes around the mask.
    pub(super) mask_dashes: Dashes,
    /// Where the handles of the drawing aids were drawn, in the window.
    pub(super) aid_handles: Vec<Rect>,
    /// Way in mm from the pointer to the handle of a drawing aid that is dragged.
    pub(super) aid_grabbed: [f64; 2],
    /// Twins of the open stroke.
    pub(super) twins: Option<TwinStrokes>,
    /// Whether another command ended the open stroke.
    pub(super) stroke_cut: bool,
    pub(super) log: Option<FiguresLog>,
    pub(super) title: String,
    pub(super) tour: Tour,
    /// The look that was applied last.
    pub(super) look: theme::Look,
}

/// Which parts of the window are visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct VisibleParts {
    /// Menu bar, toolbar and panels.
    pub panels: bool,
    /// Sheet of panels over the canvas of a narrow window.
    pub sheet: bool,
    /// Palette and tubes.
    pub palette: bool,
    /// Table of keys.
    pub keys: bool,
    /// First steps over the painting.
    pub first_steps: bool,
    /// Window of the pen.
    pub pen: bool,
    /// Window of own brushes.
    pub brush_sets: bool,
    /// Window of the drawing aids.
    pub aids: bool,
}

impl Studio {
    /// Creates the window's state from its parts.
    #[must_use]
    pub fn new(context: &Context, parts: Parts) -> Self {
        let Parts { worker, pen, files, open, log } = parts;
        let look = files.preferences.look();
        theme::apply_look(context, look);
        context.options_mut(|options| {
            // Ctrl and plus zoom the canvas, not the user interface.
            options.zoom_with_keyboard = false;
        });
        context.set_zoom_factor(files.preferences.interface_scale);
        let StartedWorker { worker, window } = worker;
        // The slot is empty: a worker has only one window.
        let _ = window.set(context.clone());
        let saved = &files.preferences.tools;
        let tools = Tools {
            brush: saved.brush.clone(),
            vehicle: saved.vehicle,
            load_mm: saved.load_mm,
            squeeze_mm3: saved.squeeze_mm3,
            dry_share: saved.dry_share,
            ..Tools::default()
        };
        let subject = open.as_deref().and_then(|path| Subject::from_text(path.to_str()?));
        let open = open.filter(|_| subject.is_none());
        let open = open.map(|path| Request::File(FileRequest::Open(Some(path))));
        let first_steps = !files.preferences.first_steps_seen;
        let mut panels = Panels::default();
        panels.arrange(&files.preferences.arrangement);
        let mut studio = Self {
            tools,
            canvas: SurfaceView::new("Canvas", Outline::Rectangle, 22.0),
            palette: SurfaceView::new("Palette", Outline::Palette, 10.0),
            visible: VisibleParts {
                panels: true,
                sheet: false,
                palette: true,
                keys: false,
                first_steps,
                pen: false,
                brush_sets: false,
                aids: false,
            },
            pen,
            aids: DrawingAids::default(),
            panels,
            files,
            crop: None,
            volumes: None,
            shows_volumes: false,
            worker,
            painting: None,
            keys: Keys::default(),
            keymap: Keymap::default(),
            keymap_changes: None,
            key_faults: Vec::new(),
            key_editor: KeyEditor::default(),
            pen_window: PenWindow::default(),
            own_brushes: OwnBrushes::default(),
            frames: Frames::default(),
            figures: Performance::default(),
            head: None,
            head_rect: None,
            hover: None,
            hovering: None,
            quick: None,
            message: None,
            requests: open.into_iter().collect(),
            event_count: 0,
            last_recording: None,
            last_pick: None,
            mask_points: Vec::new(),
            mask_dashes: Dashes::default(),
            aid_handles: Vec::new(),
            aid_grabbed: [0.0; 2],
            twins: None,
            stroke_cut: false,
            log,
            title: String::new(),
            tour: Tour::default(),
            look,
        };
        if let Some(subject) = subject {
            studio.open_scene(context, subject);
        }
        studio
    }

    /// State of the painting as last reported by the worker; `None` before the first.
    #[must_use]
    pub fn painting(&self) -> Option<&PaintingState> {
        self.painting.as_deref()
    }

    /// Performance figures of the worker.
    #[must_use]
    pub fn figures(&self) -> Performance {
        self.figures
    }

    /// Last message shown to the user.
    #[must_use]
    pub fn message(&self) -> Option<&Message> {
        self.message.as_ref()
    }

    /// Number of worker events handled so far.
    #[must_use]
    pub fn event_count(&self) -> u64 {
        self.event_count
    }

    /// Number of the recording request that the worker answered last.
    #[must_use]
    pub fn last_recording(&self) -> Option<u64> {
        self.last_recording.as_ref().map(|(number, _)| *number)
    }

    /// The recording that the worker answered last.
    #[must_use]
    pub fn recorded(&self) -> Option<&StrokeScript> {
        self.last_recording.as_ref().map(|(_, script)| &**script)
    }

    /// Shows the workspace of scenes; it starts when it is shown first.
    pub fn show_volumes(&mut self, context: &Context) -> &mut Volumes {
        self.shows_volumes = true;
        self.volumes.get_or_insert_with(|| Volumes::new(context))
    }

    /// Opens a scene in the workspace of scenes.
    pub fn open_scene(&mut self, context: &Context, subject: Subject) {
        self.show_volumes(context).open(subject);
    }

    /// The guided tour.
    #[must_use]
    pub fn tour(&self) -> &Tour {
        &self.tour
    }

    /// Queues a command for the worker, after the requests of the panels.
    pub fn ask(&mut self, command: Command) {
        self.requests.push(Request::Worker(command));
    }

    /// View of a surface.
    pub(super) fn view(&self, surface: SurfaceId) -> &SurfaceView {
        match surface {
            SurfaceId::Canvas => &self.canvas,
            SurfaceId::Palette => &self.palette,
        }
    }

    /// Surfaces visible in the window, topmost first.
    pub(super) fn visible_surfaces(&self) -> Vec<SurfaceId> {
        let palette = self.visible.palette && self.visible.panels;
        if palette { vec![SurfaceId::Palette, SurfaceId::Canvas] } else { vec![SurfaceId::Canvas] }
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        self.worker.ask(Command::Quit);
    }
}
