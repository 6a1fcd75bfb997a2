//! Draws the swatches panel.

use eframe::egui::Ui;
use session::swatches::{SwatchBook, SwatchChange};

use super::chosen::{self, Place};
use super::colors::SwatchColors;
use super::grid::{self, GridRequest};
use crate::files::{FileRequest, SwatchFormat};
use crate::language::tr;
use crate::panels::controls::item;
use crate::panels::{PanelContext, Request};

/// State of the swatches panel.
#[derive(Debug, Clone, Default)]
pub struct Swatches {
    chosen: Option<usize>,
    /// Name of the chosen mixture while it is changed.
    typed: Option<String>,
    /// Whether mixtures of other libraries are shown too.
    all_libraries: bool,
    colors: SwatchColors,
}

impl Swatches {
    /// Draws the panel.
    pub fn show(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, book: &SwatchBook) {
        self.chosen = self.chosen.filter(|&index| index < book.swatches.len());
        self.header(ui, cx, book);
        let own = |index: usize| book.swatches[index].library == cx.painting.library.title;
        let shown: Vec<usize> =
            (0..book.swatches.len()).filter(|&index| self.all_libraries || own(index)).collect();
        if shown.is_empty() {
            ui.weak(
                tr("No mixture is kept. \u{201c}Keep\u{201d} in the panel Brush keeps what the brush holds, beside a \
                 recipe it keeps that."),
            );
            return;
        }
        let colors = self.colors.get(cx.painting, book);
        let mixtures = shown.iter().map(|&index| (index, &book.swatches[index]));
        match grid::show(ui, cx, mixtures, colors, self.chosen) {
            Some(GridRequest::Select(index)) => {
                (self.chosen, self.typed) = (Some(index), None);
            }
            Some(GridRequest::Load(index)) => {
                self.chosen = Some(index);
                let kept = &book.swatches[index];
                cx.load(kept.recipe.clone(), kept.vehicle);
            }
            Some(GridRequest::Move(from, to)) => self.change(cx, from, to),
            None => {}
        }
        if let Some(index) = self.chosen {
            ui.separator();
            let at = shown.iter().position(|&one| one == index);
            let beside = |at: Option<usize>| at.and_then(|at| shown.get(at)).copied();
            let before = beside(at.and_then(|at| at.checked_sub(1)));
            let place = Place { index, before, after: beside(at.map(|at| at + 1)) };
            let before = cx.requests.len();
            chosen::show(ui, cx, place, &book.swatches[index], &mut self.typed);
            self.follow(cx, before);
        }
    }

    fn change(&mut self, cx: &mut PanelContext<'_>, from: usize, to: usize) {
        cx.file(FileRequest::Swatches(SwatchChange::Move(from, to)));
        self.chosen = Some(to);
    }

    /// Keeps the selection on a mixture that the requests since `before` move or remove.
    fn follow(&mut self, cx: &PanelContext<'_>, before: usize) {
        for request in &cx.requests[before..] {
            let Request::File(FileRequest::Swatches(change)) = request else { continue };
            match change {
                SwatchChange::Move(_, to) => self.chosen = Some(*to),
                SwatchChange::Remove(_) => self.chosen = None,
                _ => {}
            }
        }
    }

    fn header(&mut self, ui: &mut Ui, cx: &mut PanelContext<'_>, book: &SwatchBook) {
        ui.horizontal(|ui| {
            let all = ui.checkbox(&mut self.all_libraries, tr("All libraries"));
            all.on_hover_text(tr("Shows mixtures that were kept from other libraries too"));
            ui.menu_button(tr("Import, export"), |ui| {
                let tip =
                    tr("Adds mixtures (.json), or colours (.gpl, .ase, .aco) to find recipes for");
                if item(ui, tr("Import..."), tip, None) {
                    cx.file(FileRequest::ImportSwatches);
                }
                let none = book.swatches.is_empty().then_some(tr("no mixture is kept"));
                for (format, name, tip) in [
                    (
                        SwatchFormat::Json,
                        tr("Export mixtures..."),
                        tr("Writes all recipes as JSON"),
                    ),
                    (
                        SwatchFormat::Gpl,
                        tr("Export colours (.gpl)..."),
                        tr("For GIMP, Inkscape and Krita"),
                    ),
                    (SwatchFormat::Ase, tr("Export colours (.ase)..."), tr("For Adobe programs")),
                ] {
                    if item(ui, name, tip, none) {
                        cx.file(FileRequest::ExportSwatches(format));
                    }
                }
            })
            .response
            .on_hover_text(tr("Imports and exports mixtures and their colours"));
        });
    }
}
