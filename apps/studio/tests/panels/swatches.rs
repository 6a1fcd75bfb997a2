//! Tests of the swatches panel.

use eframe::egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use paint::strokes::{Action, PaletteSpec, Recipe};
use session::Command;
use session::swatches::{KeptMixture, SwatchBook, SwatchChange};
use studio::files::SwatchFormat;
use studio::panels::swatches::Swatches;
use studio::panels::{FileRequest, Request};

use super::fixture::{
    Fixture, PIGMENTS, assert_requests, click, is_disabled, painting, picture, show_panel,
};

fn kept(name: &str, library: &str, parts: &[(&str, f64)]) -> KeptMixture {
    let recipe: Recipe = parts.iter().map(|(name, part)| ((*name).to_owned(), *part)).collect();
    let color = "#4a7d8c".to_owned();
    let name = name.to_owned();
    let library = library.to_owned();
    KeptMixture { name, library, recipe, vehicle: 0.25, color, light: "D65".to_owned() }
}

fn book() -> SwatchBook {
    let own = painting().library.title.clone();
    SwatchBook {
        swatches: vec![
            kept("sky", &own, &[("Zinc White", 5.0), ("Ultramarine", 1.0)]),
            kept("far", "Acrylics", &[("Phthalo Green", 1.0)]),
            kept("lake", &own, &[("Zinc White", 2.0), ("Prussian Blue", 1.0)]),
        ],
    }
}

#[test]
fn moving_passes_over_mixtures_that_are_not_shown() {
    let mut harness = panel(book());
    click(&mut harness, "mixture sky");
    click(&mut harness, "Later");
    assert_requests(&mut harness, &[change(SwatchChange::Move(0, 2))]);
}

fn panel(book: SwatchBook) -> Harness<'static, Fixture<Swatches>> {
    show_panel(Swatches::default(), painting(), move |panel, ui, cx| panel.show(ui, cx, &book))
}

fn change(change: SwatchChange) -> Request {
    Request::File(FileRequest::Swatches(change))
}

#[test]
fn a_mixture_is_loaded_laid_moved_renamed_and_removed() {
    let mut harness = panel(book());
    assert!(harness.query_by_label("mixture far").is_none(), "of another library");
    click(&mut harness, "All libraries");
    picture(&mut harness, "swatches");
    click(&mut harness, "mixture sky");
    click(&mut harness, "Load the brush");
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let [Request::Worker(Command::Apply(Action::Load(load)))] = &requests[..] else {
        panic!("{requests:?}");
    };
    assert_eq!((&load.recipe, load.vehicle), (&book().swatches[0].recipe, 0.25));
    assert_eq!(harness.state().tools.recent[0].0, load.recipe, "it is among the last mixtures");
    click(&mut harness, "Lay on the palette");
    let requests = std::mem::take(&mut harness.state_mut().requests);
    let laid = matches!(&requests[..], [Request::Worker(Command::SqueezeInFreeSpace { .. })]);
    assert!(laid, "{requests:?}");
    assert!(is_disabled(&harness, "Earlier"), "it is the first");
    click(&mut harness, "Later");
    assert_requests(&mut harness, &[change(SwatchChange::Move(0, 1))]);
    click(&mut harness, "mixture lake");
    click(&mut harness, "Rename");
    harness.get_by_label("Name of the mixture").type_text(" of glass");
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    assert_requests(&mut harness, &[change(SwatchChange::Rename(2, "lake of glass".to_owned()))]);
    click(&mut harness, "Forget");
    assert_requests(&mut harness, &[change(SwatchChange::Remove(2))]);
    assert!(harness.query_by_label("Forget").is_none(), "nothing is selected any more");
}

#[test]
fn a_mixture_whose_pigments_are_missing_says_which_and_offers_the_way() {
    let mut harness = panel(book());
    click(&mut harness, "All libraries");
    click(&mut harness, "mixture far");
    assert!(is_disabled(&harness, "Load the brush") && is_disabled(&harness, "Lay on the palette"));
    assert!(harness.query_by_label("Phthalo Green is not in the open library.").is_some());
    assert!(harness.query_by_label("Add its tubes").is_none());
    click(&mut harness, "mixture lake");
    picture(&mut harness, "swatches-missing");
    assert!(is_disabled(&harness, "Load the brush"));
    assert!(harness.query_by_label("Prussian Blue is not on the palette.").is_some());
    click(&mut harness, "Add its tubes");
    let names = PIGMENTS.into_iter().chain(["Prussian Blue"]);
    let palette = Action::Palette(PaletteSpec::from_names(names));
    assert_requests(&mut harness, &[Request::Worker(Command::Apply(palette))]);
    let mut full = painting();
    full.slots[7] = full.library.find("Emerald Green").ok();
    harness.state_mut().painting = full;
    harness.run();
    assert!(is_disabled(&harness, "Add its tubes"), "the palette is full");
}

#[test]
fn files_are_asked_for_from_the_menu() {
    let mut harness = panel(book());
    for (name, wanted) in [
        ("Import...", FileRequest::ImportSwatches),
        ("Export mixtures...", FileRequest::ExportSwatches(SwatchFormat::Json)),
        ("Export colours (.gpl)...", FileRequest::ExportSwatches(SwatchFormat::Gpl)),
        ("Export colours (.ase)...", FileRequest::ExportSwatches(SwatchFormat::Ase)),
    ] {
        click(&mut harness, "Import, export");
        click(&mut harness, name);
        assert_requests(&mut harness, &[Request::File(wanted)]);
    }
    let harness = panel(SwatchBook::default());
    assert!(harness.query_by_label_contains("No mixture is kept").is_some());
}
