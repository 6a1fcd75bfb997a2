//! The dialogs that are open, and what their answers begin.

use std::path::PathBuf;

use eframe::egui::Ui;
use pigment::library::PigmentLibrary;
use render::export::PictureFormat;
use render::paint::strokes::PaletteSpec;

use super::browser::{Answer, Browser, Filter, Wanted};
use super::dialogs::{self, Choice, NewPainting};
use super::exporting::Export;
use super::notices::Notice;
use super::revisions;
use super::state::{Files, Reference, Then};
use super::work::name;
use session::{Origin, PaintingState, blank_canvas};

const PAINTINGS: Filter = Filter { label: "Paintings", endings: &["exr"] };
const PICTURES: Filter = Filter { label: "Pictures", endings: &["png", "jpg", "jpeg"] };
const SCRIPTS: Filter = Filter { label: "Recordings and libraries", endings: &["json"] };
const LAMPS: Filter =
    Filter { label: "Spectra", endings: &["csv", "txt", "tsv", "cgats", "it8", "cxf", "json"] };
const OPENED: Filter =
    Filter { label: "All that can be opened", endings: &["exr", "json", "png", "jpg", "jpeg"] };

/// A dialog; the last one is the uppermost.
#[derive(Debug)]
pub(super) enum Dialog {
    Browser(Box<Browser>, ForWhat),
    /// Something waits for the painting to be safe.
    Unsaved(Then),
    Delete(PathBuf),
    Export(Export),
    New(NewPainting, Box<PaletteSpec>, Box<PigmentLibrary>),
    Preferences,
}

/// What a file is asked for.
#[derive(Debug)]
pub(super) enum ForWhat {
    Open,
    Save { then: Option<Then>, revision: bool },
    Export(Export),
    Recording,
    Reference,
    Lamp,
}

impl Files {
    /// Shows what is open and what is said.
    pub fn show(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        self.show_notices(&ctx);
        // Only the uppermost takes input.
        let Some(mut dialog) = self.dialogs.pop() else { return };
        let below = self.dialogs.len();
        let stays = match &mut dialog {
            Dialog::Browser(browser, _) => match browser.show(&ctx) {
                None => true,
                Some(answer) => {
                    let folder = Some(browser.folder().to_owned());
                    if let (Dialog::Browser(_, purpose), Answer::File(path)) = (dialog, answer) {
                        self.preferences.last_folder = folder;
                        self.chosen(purpose, path);
                    }
                    return;
                }
            },
            Dialog::Unsaved(_) => {
                let choice = dialogs::unsaved(&ctx, &self.title());
                match (choice, dialog) {
                    (Some(Choice::Yes), Dialog::Unsaved(then)) => match self.path.clone() {
                        Some(path) => self.save(path, Some(then)),
                        None => self.ask_where_to_save(Some(then), false),
                    },
                    (Some(Choice::No), Dialog::Unsaved(then)) => self.carry_out(then),
                    (None, unanswered) => self.dialogs.insert(below, unanswered),
                    _ => {}
                }
                return;
            }
            Dialog::Delete(path) => {
                let choice = dialogs::delete(&ctx, path);
                if choice == Some(Choice::Yes) {
                    self.delete(path.clone());
                }
                choice.is_none()
            }
            Dialog::Export(export) => {
                let choice = dialogs::export(&ctx, export);
                if choice == Some(Choice::Yes) {
                    let export = *export;
                    self.ask_where_to_export(export);
                    return;
                }
                choice.is_none()
            }
            Dialog::New(painting, palette, library) => {
                let choice = painting.show(&ctx);
                if choice == Some(Choice::Yes) {
                    let canvas = painting.canvas();
                    let (width, height) = (canvas.width_mm, canvas.height_mm);
                    let same = painting.same_pigments;
                    let library =
                        if same { (**library).clone() } else { PigmentLibrary::van_gogh_oils() };
                    if let Origin::Blank { mut script, library } =
                        blank_canvas(library, width, height, canvas.cell_mm)
                    {
                        script.canvas = canvas;
                        if same && !palette.pigments.is_empty() {
                            script.palette = (**palette).clone();
                        }
                        self.begin(*script, *library);
                    }
                    return;
                }
                choice.is_none()
            }
            Dialog::Preferences => dialogs::preferences(&ctx, &mut self.preferences),
        };
        if stays {
            // What was opened meanwhile lies above it.
            self.dialogs.insert(below, dialog);
        }
    }

    fn chosen(&mut self, purpose: ForWhat, path: PathBuf) {
        match purpose {
            ForWhat::Open | ForWhat::Lamp => self.read(path),
            ForWhat::Save { then: None, revision: true } => self.save_and_keep(path),
            ForWhat::Save { then, .. } => self.save(path, then),
            ForWhat::Export(export) => self.export(export, path),
            ForWhat::Recording => self.record(path),
            ForWhat::Reference => self.reference = Some(Reference::Open(path)),
        }
    }

    fn delete(&mut self, path: PathBuf) {
        match revisions::delete(&path) {
            Ok(()) => self.notices.push(Notice::said(format!("deleted {}", name(&path)))),
            Err(failure) => self.say(failure),
        }
        self.list_revisions();
    }

    fn browse(&mut self, wanted: Wanted, purpose: ForWhat) {
        let beside = self.path.as_ref().and_then(|path| path.parent());
        let folder = beside.or(self.preferences.last_folder.as_deref());
        let browser = Browser::new(wanted, folder, &self.preferences.recent, &self.ctx);
        self.dialogs.push(Dialog::Browser(Box::new(browser), purpose));
    }

    fn wanted(&self, title: &'static str, filters: &'static [Filter]) -> Wanted {
        Wanted { title, saves: false, filters, ending: None, name: String::new() }
    }

    pub(super) fn ask_for_file(&mut self) {
        const KINDS: [Filter; 5] = [OPENED, PAINTINGS, SCRIPTS, PICTURES, Filter::ALL];
        self.browse(self.wanted("Open", &KINDS), ForWhat::Open);
    }

    pub(super) fn ask_for_reference(&mut self) {
        const KINDS: [Filter; 2] = [PICTURES, Filter::ALL];
        self.browse(self.wanted("Picture beside the canvas", &KINDS), ForWhat::Reference);
    }

    pub(super) fn ask_for_lamp(&mut self) {
        const KINDS: [Filter; 2] = [LAMPS, Filter::ALL];
        self.browse(self.wanted("Lamp, measured", &KINDS), ForWhat::Lamp);
    }

    pub(super) fn ask_where_to_save(&mut self, then: Option<Then>, revision: bool) {
        let name = format!("{}.exr", self.title());
        let wanted = Wanted {
            title: "Save the painting",
            saves: true,
            filters: &[PAINTINGS, Filter::ALL],
            ending: Some("exr"),
            name,
        };
        self.browse(wanted, ForWhat::Save { then, revision });
    }

    pub(super) fn ask_where_to_record(&mut self) {
        let name = format!("{}.json", self.title());
        let wanted = Wanted {
            title: "Save the recording",
            saves: true,
            filters: &[SCRIPTS, Filter::ALL],
            ending: Some("json"),
            name,
        };
        self.browse(wanted, ForWhat::Recording);
    }

    pub(super) fn ask_what_to_export(&mut self) {
        self.dialogs.push(Dialog::Export(Export::Picture(PictureFormat::Png8)));
    }

    fn ask_where_to_export(&mut self, export: Export) {
        let ending = export.ending();
        let filters: &[Filter] = match export {
            Export::Picture(PictureFormat::Png8 | PictureFormat::Png16) => &[PICTURES, Filter::ALL],
            Export::PigmentMaps => &[Filter::ALL],
            _ => &[PAINTINGS, Filter::ALL],
        };
        // Not the painting's own name.
        let kind = if export == Export::Picture(PictureFormat::LinearExr) { ".linear" } else { "" };
        let name = format!("{}{kind}.{ending}", self.title());
        let title = "Export";
        let wanted = Wanted { title, saves: true, filters, ending: Some(ending), name };
        self.browse(wanted, ForWhat::Export(export));
    }

    pub(super) fn ask_for_new(&mut self, easel: &PaintingState) {
        let names = easel.slots.iter().flatten();
        let names = names.filter_map(|&index| easel.library.pigments.get(index));
        let palette = PaletteSpec::from_names(names.map(|pigment| pigment.name.as_str()));
        let library = Box::new((*easel.library).clone());
        self.dialogs.push(Dialog::New(NewPainting::default(), Box::new(palette), library));
    }
}
