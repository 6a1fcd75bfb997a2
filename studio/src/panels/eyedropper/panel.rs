//! The panel of the eyedropper.

use std::path::Path;
use std::sync::Arc;

use eframe::egui::{Align2, DragValue, Key, TextEdit, Ui, vec2};
use spectra::swatch_file::{SwatchFile, SwatchFileError, read_aco, read_ase, read_gpl};

use super::super::desk::Desk;
use super::super::tools::Mode;
use super::picked_place::picked_place;
use super::search::Search;
use super::swatch::swatch;
use super::wanted::{Color, Wanted};

/// What was picked, what is wanted, and recipes for it.
#[derive(Debug, Default)]
pub struct Eyedropper {
    wanted: Option<Wanted>,
    /// The colour from the reference picture that was taken up last.
    taken: Option<[f64; 3]>,
    text: String,
    fault: Option<String>,
    swatches: Vec<Wanted>,
    search: Search,
}

impl Eyedropper {
    /// Whether a file is one of colours, by its ending: `.gpl`, `.ase`, `.aco`.
    #[must_use]
    pub fn takes(path: &Path) -> bool {
        reader(path).is_some()
    }

    /// Shows the colours of a palette of another painting program, to be wanted
    /// by a click. A fault is told in the panel.
    pub fn open_swatches(&mut self, path: &Path) {
        self.fault = None;
        match colors(path) {
            Ok(palette) => self.swatches = wanted_of(&palette),
            Err(fault) => self.fault = Some(fault),
        }
    }

    /// The colour that recipes are for.
    #[must_use]
    pub fn wanted(&self) -> Option<&Wanted> {
        self.wanted.as_ref()
    }

    /// Makes a colour the wanted one and searches recipes for it.
    pub fn want(&mut self, ui: &Ui, desk: &Desk<'_>, wanted: Wanted) {
        self.search.begin(ui, desk.easel, &wanted);
        self.wanted = Some(wanted);
        self.fault = None;
    }

    /// Shows the panel, and asks for what is changed.
    pub fn show(&mut self, ui: &mut Ui, desk: &mut Desk<'_>) {
        if desk.tools.wanted != self.taken {
            self.taken = desk.tools.wanted;
            if let Some(linear) = self.taken {
                self.want(ui, desk, Wanted::screen("From the reference picture", linear));
            }
        }
        pick_controls(ui, desk);
        match desk.tools.picked.clone() {
            None => {
                ui.weak("Click with the eyedropper, or with Alt held, to see what lies there.");
            }
            Some(picked) => {
                if picked_place(ui, desk, &picked) {
                    let name = format!("Picked at {:.1}, {:.1} mm", picked.x_mm, picked.y_mm);
                    let color = Color::Reflectance(Arc::new(picked.reflectance.clone()));
                    self.want(ui, desk, Wanted { name, color });
                }
            }
        }
        ui.separator();
        self.wanted_color(ui, desk);
        self.search.show(ui, desk, self.wanted.as_ref());
    }

    fn wanted_color(&mut self, ui: &mut Ui, desk: &Desk<'_>) {
        let (grid, viewing) = (desk.easel.library.grid, &desk.easel.light.viewing);
        ui.horizontal(|ui| {
            if let Some(wanted) = &self.wanted {
                let color = wanted.shown(grid, viewing);
                let patch = swatch(ui, "Wanted colour", vec2(40.0, 22.0), &[color]);
                let [l, a, b] = wanted.lab(grid, viewing).to_array();
                patch.on_hover_text(format!("{}: Lab {l:.2} {a:.2} {b:.2}", wanted.name));
            }
            let field = TextEdit::singleline(&mut self.text)
                .hint_text("Wanted: #rrggbb or L,a,b")
                .desired_width(f32::INFINITY)
                .align(Align2::LEFT_CENTER);
            let field = ui.add(field).on_hover_text(
                "A wanted colour: sRGB as #rrggbb, or CIELAB as L,a,b under the light of the \
                 painting. Enter searches recipes for it",
            );
            if field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
                match Wanted::from_text(&self.text) {
                    Some(wanted) => self.want(ui, desk, wanted),
                    None => {
                        let found = self.text.trim();
                        self.fault = Some(format!(
                            "A colour is #rrggbb or L,a,b, found `{found}`; try #4a7d8c or 52,-10,8"
                        ));
                    }
                }
            }
        });
        if let Some(wanted) = &self.wanted {
            ui.weak(&wanted.name).on_hover_text("Where the wanted colour comes from");
        }
        if let Some(fault) = &self.fault {
            ui.label(fault);
        }
        self.swatch_rows(ui, desk);
    }

    fn swatch_rows(&mut self, ui: &mut Ui, desk: &Desk<'_>) {
        if self.swatches.is_empty() {
            return;
        }
        let (grid, viewing) = (desk.easel.library.grid, &desk.easel.light.viewing);
        let mut clicked = None;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(3.0, 3.0);
            for one in &self.swatches {
                let color = one.shown(grid, viewing);
                let patch = swatch(ui, &one.name, vec2(18.0, 18.0), &[color]);
                let hover = format!("{}. Click to search recipes for it", one.name);
                if patch.on_hover_text(hover).clicked() {
                    clicked = Some(one.clone());
                }
            }
        });
        if let Some(wanted) = clicked {
            self.want(ui, desk, wanted);
        }
    }
}

fn pick_controls(ui: &mut Ui, desk: &mut Desk<'_>) {
    ui.horizontal(|ui| {
        let picking = desk.tools.mode == Mode::Pick;
        let pick = ui.selectable_label(picking, "Eyedropper");
        if pick.on_hover_text("Clicks tell what lies there; also with Alt held").clicked() {
            desk.tools.mode = if picking { Mode::Paint } else { Mode::Pick };
        }
        let radius = DragValue::new(&mut desk.tools.pick_radius_mm)
            .range(0.0..=10.0)
            .speed(0.02)
            .fixed_decimals(1)
            .prefix("radius ")
            .suffix(" mm");
        let radius = ui.add(radius).accessible_name("Radius of the eyedropper");
        radius.on_hover_text("The mean over cells this near is told; 0 is one cell");
    });
}

type Reader = fn(&str, &[u8]) -> Result<SwatchFile, SwatchFileError>;

fn reader(path: &Path) -> Option<Reader> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    match ending.as_str() {
        "gpl" => Some(read_gpl),
        "ase" => Some(read_ase),
        "aco" => Some(read_aco),
        _ => None,
    }
}

fn colors(path: &Path) -> Result<SwatchFile, String> {
    let name = path.display().to_string();
    let reader = reader(path)
        .ok_or_else(|| format!("{name}: a palette of colours is a .gpl, .ase or .aco file"))?;
    let bytes = std::fs::read(path).map_err(|error| format!("{name}: {error}"))?;
    reader(&name, &bytes).map_err(|error| error.to_string())
}

/// Inks, which have no colour of their own, are left out.
fn wanted_of(palette: &SwatchFile) -> Vec<Wanted> {
    let swatches = palette.swatches.iter();
    let wanted = swatches.filter_map(|one| {
        let rgb = one.color.srgb()?;
        let name = if one.name.is_empty() { rgb.to_hex() } else { one.name.clone() };
        Some(Wanted::screen(&name, rgb.linear().0))
    });
    wanted.collect()
}
