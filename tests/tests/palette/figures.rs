//! Figures of a palette in a report: which ones are drawn, their colours and their numbers.

use calibrate::PigmentId;
use calibrate::library::AmountKind;
use calibrate::palette::{
    Cards, MixingRow, PainterRules, Palette, graded, hiding_powers, mixing_chart,
};
use documents::Task;
use reports::figure::{Cell, Figure};
use reports::style::{Color, PAPER};
use reports::{Report, Subject};

use calibrate::evaluate::Viewing;
use calibrate::library::PigmentLibrary;

use crate::made::{Oils, band, even, five, grid, library};

const NAMES: [&str; 12] = [
    "graded-mixture-1",
    "graded-mixture-2",
    "graded-mixture-3",
    "mixing-chart",
    "tints",
    "drawdowns",
    "gamut",
    "gamut-lightness",
    "hiding-power",
    "tinting-strength",
    "colour-shift",
    "metamers",
];

fn report_of(library: &PigmentLibrary, pair: Option<(PigmentId, PigmentId)>) -> Report {
    let viewing = Viewing::default();
    let subject = Subject::of_library(library, &viewing, "impasto report").unwrap();
    let subject = Subject { pair, ..subject };
    Report::draw(&subject, &Task::default()).unwrap()
}

fn report_of_oils(oils: &Oils) -> Report {
    let subject = Subject {
        library: &oils.library,
        viewing: &oils.viewing,
        weights: oils.viewing.weights(oils.library.grid).unwrap(),
        command: "impasto report".to_owned(),
        comparison: Some(oils.comparable.with(&oils.library, &oils.viewing).unwrap()),
        validation: None,
        quadratures: Vec::new(),
        cards: oils.palette().cards().clone(),
        pair: None,
    };
    Report::draw(&subject, &Task::default()).unwrap()
}

fn figure<'a>(report: &'a Report, name: &str) -> &'a Figure {
    report.figures().find(|figure| figure.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn finite(report: &Report) {
    for figure in report.figures() {
        let text = figure.svg.clone() + &figure.data.csv();
        for wrong in ["NaN", "inf,", "\"inf", "-inf"] {
            assert!(!text.contains(wrong), "{}: {wrong}", figure.name);
        }
        assert!(!figure.data.rows.is_empty(), "{} has no numbers", figure.name);
    }
}

#[test]
fn the_oils_have_every_figure_and_the_same_bytes_again() {
    let oils = Oils::fitted();
    let report = report_of_oils(&oils);
    for name in NAMES {
        figure(&report, name);
    }
    finite(&report);
    assert_eq!(report.files(), report_of_oils(&oils).files());
}

#[test]
fn figures_show_the_colors_and_tell_the_numbers_that_were_computed() {
    let oils = Oils::fitted();
    let palette = oils.palette();
    let report = report_of_oils(&oils);

    let chart = mixing_chart(&palette);
    let drawn = figure(&report, "mixing-chart");
    let mut outside = 0;
    let count = chart.paints.len();
    for row in 0..count {
        for column in 0..count {
            let looks = if row < column { &chart.tinted } else { &chart.colors };
            let look = looks[row][column];
            let patch = format!("fill=\"{}\"", Color::from_rgb(look.srgb).hex());
            assert!(drawn.svg.contains(&patch), "row {row}, column {column}: {patch}");
            outside += usize::from(!look.srgb.in_gamut());
        }
    }
    let notch = format!("width=\"6.0\" height=\"6.0\" fill=\"{}\"", PAPER.hex());
    assert!(outside > 0, "some mixtures of the oils lie outside sRGB");
    assert_eq!(drawn.svg.matches(&notch).count(), outside);

    let rows = &figure(&report, "hiding-power").data.rows;
    for power in hiding_powers(&palette) {
        let name = Cell::from(palette.label(power.paint));
        let row = rows.iter().find(|row| row[0] == name).unwrap();
        assert_eq!(row[1], Cell::from(power.hides.thickness()));
    }

    let rules = PainterRules::of(&palette).unwrap();
    let pair = (oils.library.find("Bone Black").unwrap(), palette.white().unwrap());
    let mixture = graded(&palette, pair, &oils.measured(&palette), &rules);
    let drawn = figure(&report, "graded-mixture-1");
    let rows = &drawn.data.rows;
    let made = mixture.steps.iter().flat_map(|step| step.colors.iter().flatten());
    assert_eq!(rows.len(), made.clone().count());
    for look in made {
        assert!(drawn.svg.contains(&Color::from_rgb(look.srgb).hex()), "{look:?}");
    }
    let (mean, mixed) = mixture.mean_error(MixingRow::LinearRgb, true).unwrap();
    assert!(drawn.svg.contains(&format!(">{mean:.2} of {mixed}<")), "{mean} of {mixed}");
}

#[test]
fn the_users_pair_is_drawn_in_the_order_given() {
    let five = five();
    let report = report_of(&five, Some((PigmentId(3), PigmentId(1))));
    let names: Vec<&str> = report.figures().map(|figure| figure.name.as_str()).collect();
    assert!(names.contains(&"graded-mixture-1") && !names.contains(&"graded-mixture-2"));
    assert_eq!(figure(&report, "graded-mixture-1").title, "blue to red");
    finite(&report);
}

#[test]
fn a_pair_that_cannot_be_mixed_and_what_is_left_out_are_said() {
    let mut five = five();
    five.pigments[3].identified = false;
    let report = report_of(&five, Some((PigmentId(3), PigmentId(1))));
    let [graded, mixed] = ["Graded mixtures", "What the paints mix"].map(|title| {
        let mut sections = report.sections.iter();
        sections.find(|section| section.title == title).unwrap().paragraphs.join(" ")
    });
    assert!(graded.starts_with("blue"), "{graded}");
    assert!(mixed.contains("blue"), "{mixed}");
    assert!(report.figures().all(|figure| figure.name != "graded-mixture-1"));
    finite(&report);
}

#[test]
fn small_and_odd_libraries_draw_what_there_is() {
    let lone = library(vec![even("white", 0.001, 1.0)], AmountKind::Relative);
    finite_but_for_empty_tables(&report_of(&lone, None));
    let clear = vec![even("white", 0.0, 1.0), even("medium", 0.0, 0.0), even("ink", 2.0, 0.0)];
    finite(&report_of(&library(clear, AmountKind::Relative), None));
    let washes = vec![band("red", 120.0, 520.0, 0.0), band("blue", 100.0, 610.0, 4.0)];
    finite(&report_of(&library(washes, AmountKind::Absolute), None));
    let mut unknown = lone;
    unknown.pigments[0].identified = false;
    let report = report_of(&unknown, None);
    let viewing = Viewing::default();
    assert!(Palette::new(&unknown, &viewing, Cards::standard(grid())).is_err());
    assert!(report.figures().all(|figure| !NAMES.contains(&figure.name.as_str())));
}

/// Asserts that no figure has a NaN. Tables may be empty: a white alone has no tints, for example.
fn finite_but_for_empty_tables(report: &Report) {
    for figure in report.figures() {
        let text = figure.svg.clone() + &figure.data.csv();
        assert!(!text.contains("NaN"), "{}", figure.name);
    }
}
