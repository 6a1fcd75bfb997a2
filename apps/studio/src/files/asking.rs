//! Opens and shows the dialogs, and carries out the painter's answers.

use std::path::{Path, PathBuf};

use eframe::egui::Ui;
use graphics::export::PictureFormat;
use graphics::picture_formats;
use paint::scene::PixelsPerCell;

use super::browser::{Answer, Browser, BrowserOptions, Filter, pictures_and};
use super::dialogs::{self, Choice};
use super::drawing::{DrawingKind, DrawnFile};
use super::exporting::{Export, ExportKind};
use super::new_dialog::NewAnswer;
use super::notice::Notice;
use super::open_dialog::{FilePurpose, OpenDialog};
use super::pending::PendingAction;
use super::preferences::Preferences;
use super::reference_change::ReferenceChange;
use super::revisions;
use super::scene_file::SceneExport;
use super::state::Files;
use super::swatch_format::SwatchFormat;
use super::timelapse::TimelapseExport;
use super::work::{Purpose, file_name};
use crate::language::{english, tr, tr_format};

const PAINTINGS: Filter = Filter { label: english("Paintings"), endings: &["exr"] };
pub(super) const PICTURES: Filter =
    Filter { label: english("Pictures"), endings: &picture_formats::ENDINGS };
const REFERENCES: Filter =
    Filter { label: english("Pictures and paintings"), endings: &pictures_and::<7>(&["exr"]) };
const SCRIPTS: Filter = Filter { label: english("Recordings and libraries"), endings: &["json"] };
const DRAWINGS: Filter = Filter { label: english("Marks and guides"), endings: &["toml"] };
const SWATCHES: Filter =
    Filter { label: english("Mixtures and swatches"), endings: &["json", "gpl", "ase", "aco"] };
const LAMPS: Filter = Filter {
    label: english("Spectra"),
    endings: &["csv", "txt", "tsv", "cgats", "it8", "cxf", "json"],
};
const OPENABLE: Filter = Filter {
    label: english("All that can be opened"),
    endings: &pictures_and::<8>(&["exr", "json"]),
};

impl Files {
    /// Shows the topmost dialog, which takes all input, and carries out its answer.
    pub(super) fn show_dialog(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let Some(mut dialog) = self.dialogs.pop() else { return };
        let below = self.dialogs.len();
        let stays = match &mut dialog {
            OpenDialog::Browser(browser, _) => match browser.show(&ctx, &mut self.thumbnails) {
                None => {
                    self.preferences.browser = browser.look;
                    true
                }
                Some(answer) => {
                    let folder = Some(browser.folder().to_owned());
                    if let (OpenDialog::Browser(_, purpose), Answer::File(path)) = (dialog, answer)
                    {
                        self.preferences.last_folder = folder;
                        self.use_file(purpose, path);
                    }
                    return;
                }
            },
            OpenDialog::Unsaved(_) => {
                let choice = dialogs::unsaved(&ctx, &self.title());
                match (choice, dialog) {
                    (Some(Choice::Yes), OpenDialog::Unsaved(next)) => match self.path.clone() {
                        Some(path) => self.save(path, Some(next)),
                        None => self.ask_where_to_save(Some(next), false),
                    },
                    (Some(Choice::No), OpenDialog::Unsaved(next)) => self.carry_out(next),
                    (None, unanswered) => self.dialogs.insert(below, unanswered),
                    _ => {}
                }
                return;
            }
            OpenDialog::UnsavedDrawings(action) => {
                let lost = self.drawings_lost_by(action);
                let choice = dialogs::unsaved_drawings(&ctx, &lost);
                match (choice, dialog) {
                    (Some(Choice::Yes), OpenDialog::UnsavedDrawings(next)) => {
                        match lost.into_iter().next() {
                            Some(drawn) => self.ask_where_to_draw(drawn, Some(next)),
                            None => self.carry_out_safely(next),
                        }
                    }
                    (Some(Choice::No), OpenDialog::UnsavedDrawings(next)) => {
                        self.carry_out_without_drawings(next);
                    }
                    (None, unanswered) => self.dialogs.insert(below, unanswered),
                    _ => {}
                }
                return;
            }
            OpenDialog::DeleteRevision(path) => {
                let choice = dialogs::delete(&ctx, path);
                if choice == Some(Choice::Yes) {
                    self.delete_revision(path.clone());
                }
                choice.is_none()
            }
            OpenDialog::Export(export) => {
                let choice = dialogs::export(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = *export;
                    self.ask_where_to_export(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::ExportOfScene(export) => {
                let choice = dialogs::export(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = SceneExport::OfPainting(*export);
                    self.ask_where_to_export_scene(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::Timelapse(export) => {
                let choice = dialogs::timelapse(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = *export;
                    self.ask_where_to_film(export);
                    return;
                }
                choice.is_none()
            }
            OpenDialog::New(new) => match new.show(&ctx, &mut self.preferences.new_painting) {
                Some(NewAnswer::Begin) => return self.begin_new(new),
                Some(NewAnswer::Cancelled) => false,
                Some(NewAnswer::Choose(picture)) => {
                    self.ask_for_canvas_picture(picture);
                    true
                }
                None => true,
            },
            OpenDialog::Preferences => dialogs::preferences(&ctx, &mut self.preferences),
        };
        if stays {
            // The answer may have opened other dialogs, which stay above this one.
            self.dialogs.insert(below, dialog);
        }
    }

    fn use_file(&mut self, purpose: FilePurpose, path: PathBuf) {
        match purpose {
            FilePurpose::Open | FilePurpose::Lamp => self.read(path),
            FilePurpose::Save { next, keep_revision } => {
                self.request_snapshot(Purpose::Save { path, next, keep_revision });
            }
            FilePurpose::Export(export) => {
                self.request_snapshot(Purpose::Export { export, path });
            }
            FilePurpose::Timelapse(export) => {
                self.request_recording(Purpose::Timelapse { export, path });
            }
            FilePurpose::Recording => self.request_recording(Purpose::Recording { path }),
            FilePurpose::Canvas(picture) => self.use_canvas_picture(picture, path),
            FilePurpose::Reference => self.change_reference(ReferenceChange::Open(path)),
            FilePurpose::SaveDrawing { drawing, next } => self.save_drawing(*drawing, path, next),
            FilePurpose::OpenDrawing(kind) => self.read_drawing(kind, path),
            FilePurpose::ImportBrushes => self.import_brushes(path),
            FilePurpose::ExportBrushes(set) => self.export_brushes(*set, path),
            FilePurpose::ImportSwatches => self.import_swatches(path),
            FilePurpose::ExportSwatches(format) => self.export_swatches(format, path),
            FilePurpose::Scene(purpose) => self.choose_for_scene(purpose, path),
        }
    }

    /// Endings, without points, of the files that a dialog asks for since the last call; empty if it
    /// takes all. For a page, which asks with the browser's own dialog.
    pub fn take_wanted(&mut self) -> Option<Vec<&'static str>> {
        self.wanted.take()
    }

    /// Answers the topmost dialog with the file at `path`, if it asks for a file to open. Returns
    /// whether it did.
    pub fn choose(&mut self, path: &Path) -> bool {
        if !self.dialogs.last().is_some_and(|dialog: &OpenDialog| match dialog {
            OpenDialog::Browser(browser, _) => !browser.is_saving(),
            _ => false,
        }) {
            return false;
        }
        if let Some(OpenDialog::Browser(_, purpose)) = self.dialogs.pop() {
            self.use_file(purpose, path.to_owned());
        }
        true
    }

    fn delete_revision(&mut self, path: PathBuf) {
        match revisions::delete(&path) {
            Ok(()) => {
                let text = tr_format!("deleted {path}", path = file_name(&path));
                self.notices.push(Notice::done(&text));
            }
            Err(problem) => self.report(problem),
        }
        self.list_revisions();
    }

    pub(super) fn browse(&mut self, options: BrowserOptions, purpose: FilePurpose) {
        let beside = self.path.clone();
        self.browse_beside(beside.as_deref(), options, purpose);
    }

    /// Asks for a file in the folder of another one.
    fn browse_beside(
        &mut self,
        beside: Option<&Path>,
        options: BrowserOptions,
        purpose: FilePurpose,
    ) {
        let beside = beside.and_then(|path| path.parent());
        let folder = beside.or(self.preferences.last_folder.as_deref());
        let Preferences { recent, browser: look, .. } = &self.preferences;
        if !options.saving {
            let endings = options.filters.iter().flat_map(|filter| filter.endings);
            self.wanted = Some(endings.copied().collect());
        }
        let browser = Browser::new(options, folder, recent, *look, &self.ctx);
        self.dialogs.push(OpenDialog::Browser(Box::new(browser), purpose));
    }

    pub(super) fn ask_for_file(&mut self) {
        const KINDS: [Filter; 5] = [OPENABLE, PAINTINGS, SCRIPTS, PICTURES, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Open"), &KINDS), FilePurpose::Open);
    }

    pub(super) fn ask_for_reference(&mut self) {
        const KINDS: [Filter; 2] = [REFERENCES, Filter::ALL];
        let options = BrowserOptions::open(tr("Picture beside the canvas"), &KINDS);
        self.browse(options, FilePurpose::Reference);
    }

    pub(super) fn ask_for_lamp(&mut self) {
        const KINDS: [Filter; 2] = [LAMPS, Filter::ALL];
        self.browse(BrowserOptions::open(tr("Measured lamp"), &KINDS), FilePurpose::Lamp);
    }

    pub(super) fn ask_where_to_save(&mut self, next: Option<PendingAction>, keep_revision: bool) {
        let options = BrowserOptions {
            title: tr("Save the painting"),
            saving: true,
            filters: &[PAINTINGS, Filter::ALL],
            ending: Some("exr"),
            others: &[],
            name: format!("{}.exr", self.title()),
        };
        self.browse(options, FilePurpose::Save { next, keep_revision });
    }

    pub(super) fn ask_where_to_record(&mut self) {
        let options = BrowserOptions {
            title: tr("Save the recording"),
            saving: true,
            filters: &[SCRIPTS, Filter::ALL],
            ending: Some("json"),
            others: &[],
            name: format!("{}.json", self.title()),
        };
        self.browse(options, FilePurpose::Recording);
    }

    pub(super) fn ask_for_drawing(&mut self, kind: DrawingKind, picture: &Path) {
        const KINDS: [Filter; 2] = [DRAWINGS, Filter::ALL];
        let title = match kind {
            DrawingKind::Marks => tr("Open marks"),
            DrawingKind::Guides => tr("Open guides"),
        };
        let options = BrowserOptions::open(title, &KINDS);
        self.browse_beside(Some(picture), options, FilePurpose::OpenDrawing(kind));
    }

    pub(super) fn ask_where_to_draw(
        &mut self,
        DrawnFile { drawing, path }: DrawnFile,
        next: Option<PendingAction>,
    ) {
        let options = BrowserOptions {
            title: match drawing.kind() {
                DrawingKind::Marks => tr("Save the marks"),
                DrawingKind::Guides => tr("Save the guides"),
            },
            saving: true,
            filters: &[DRAWINGS, Filter::ALL],
            ending: Some("toml"),
            others: &[],
            name: file_name(&path),
        };
        let purpose = FilePurpose::SaveDrawing { drawing: Box::new(drawing), next };
        self.browse_beside(Some(&path), options, purpose);
    }

    pub(super) fn ask_for_swatches(&mut self) {
        const KINDS: [Filter; 2] = [SWATCHES, Filter::ALL];
        let options = BrowserOptions::open(tr("Import mixtures or colours"), &KINDS);
        self.browse(options, FilePurpose::ImportSwatches);
    }

    pub(super) fn ask_where_to_keep_swatches(&mut self, format: SwatchFormat) {
        let options = BrowserOptions {
            title: tr("Export the kept mixtures"),
            saving: true,
            filters: &[SWATCHES, Filter::ALL],
            ending: Some(format.ending()),
            others: &[],
            name: format!("mixtures.{}", format.ending()),
        };
        self.browse(options, FilePurpose::ExportSwatches(format));
    }

    pub(super) fn ask_what_to_export(&mut self) {
        let kind = ExportKind::Picture(PictureFormat::Png8);
        let export = Export { kind, pixels: PixelsPerCell::default() };
        self.dialogs.push(OpenDialog::Export(export));
    }

    fn ask_where_to_export(&mut self, export: Export) {
        let options = export_options(export.kind, &self.title());
        self.browse(options, FilePurpose::Export(export));
    }

    pub(super) fn ask_for_timelapse(&mut self) {
        self.dialogs.push(OpenDialog::Timelapse(TimelapseExport::default()));
    }

    fn ask_where_to_film(&mut self, export: TimelapseExport) {
        let ending = export.ending();
        let options = BrowserOptions {
            title: tr("Export the timelapse"),
            saving: true,
            filters: &[Filter::ALL],
            ending: Some(ending),
            others: &[],
            // A picture may have the plain name already.
            name: format!("{}-timelapse.{ending}", self.title()),
        };
        self.browse(options, FilePurpose::Timelapse(export));
    }
}

/// The browser that asks where to write an export of a painting with this title.
pub(super) fn export_options(kind: ExportKind, title: &str) -> BrowserOptions {
    let ending = kind.ending();
    let filters: &[Filter] = match kind {
        ExportKind::Picture(PictureFormat::Png8 | PictureFormat::Png16) => &[PICTURES, Filter::ALL],
        ExportKind::Picture(PictureFormat::Tiff16) | ExportKind::Layers => &[Filter::ALL],
        ExportKind::PigmentMaps => &[Filter::ALL],
        _ => &[PAINTINGS, Filter::ALL],
    };
    // A linear EXR must not get the name of the painting's own file.
    let linear = kind == ExportKind::Picture(PictureFormat::LinearExr);
    let mark = if linear { ".linear" } else { "" };
    let name = format!("{title}{mark}.{ending}");
    let title = tr("Export");
    let ending = Some(ending);
    let others = &[][..];
    BrowserOptions { title, saving: true, filters, ending, others, name }
}
