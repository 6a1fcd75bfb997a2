//! Validations that leave out samples, grounds, pigments or files, and the strengths that mixtures share.

use std::fmt::Write;

use calibrate::library::AmountKind;
use calibrate::{
    FitRequest, FitValidation, FittingError, LeaveOut, PigmentLibrary, ReadingOptions, Readings,
    Recipe, ValidationRequest, validate,
};
use documents::hint::Explain;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::Specular;

const WHITE: &str = "Lead White";
const PAINTS: [&str; 4] = ["Viridian", "Cobalt Blue", "Vermilion", "Bone Black"];

/// Readings of these samples as a table, with an error of 3 % in each weighing. `strength` multiplies
/// the amounts of pigments in the paint that is read, and not in the recipe.
fn readings(
    samples: &[(String, Vec<(&str, f64)>)],
    strength: impl Fn(&str) -> f64,
    seed: u64,
) -> String {
    let oils = PigmentLibrary::van_gogh_oils();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let names = [&[WHITE][..], &PAINTS].concat();
    let nm: Vec<String> = (0..oils.grid.count()).map(|at| oils.grid.nm(at).to_string()).collect();
    let mut text = format!("sample,{},{}\n", names.join(","), nm.join(","));
    for (sample, parts) in samples {
        let recipe = parts.iter().map(|(name, amount)| {
            let weighed = amount * (1.0 + 0.03 * random.random_range(-1.0..1.0));
            (oils.find(name).unwrap(), weighed * strength(name))
        });
        let film = oils.mix(recipe.collect::<Recipe>()).unwrap().hiding(oils.saunderson);
        write!(text, "{sample}").unwrap();
        for name in &names {
            let amount = parts.iter().find(|(part, _)| part == name).map_or(0.0, |(_, a)| *a);
            write!(text, ",{amount}").unwrap();
        }
        film.iter().for_each(|value| write!(text, ",{value:.5}").unwrap());
        text.push('\n');
    }
    text
}

/// The white, and masstone and tints of each paint.
fn tints() -> Vec<(String, Vec<(&'static str, f64)>)> {
    let mut samples = vec![("white".to_owned(), vec![(WHITE, 1.0)])];
    for paint in PAINTS {
        samples.push((paint.to_owned(), vec![(paint, 1.0)]));
        for share in [0.05, 0.2, 0.5] {
            samples.push((format!("{paint} {share}"), vec![(WHITE, 1.0 - share), (paint, share)]));
        }
    }
    samples
}

/// Two mixtures of each two paints with white.
fn mixtures() -> Vec<(String, Vec<(&'static str, f64)>)> {
    let mut samples = Vec::new();
    for (first, one) in PAINTS.iter().enumerate() {
        for other in &PAINTS[first + 1..] {
            for [a, b] in [[0.1, 0.05], [0.05, 0.2]] {
                let parts = vec![(WHITE, 1.0 - a - b), (*one, a), (*other, b)];
                samples.push((format!("{one} {other} {a}"), parts));
            }
        }
    }
    samples
}

/// A validation of tints, and of mixtures of another batch that are left out as a file.
fn of_batches(strength: impl Fn(&str) -> f64) -> FitValidation {
    let files = [
        ("tints.csv", readings(&tints(), |_| 1.0, 1)),
        ("factory.csv", readings(&mixtures(), strength, 2)),
    ];
    let readings = Readings::from_files(&files, &ReadingOptions::default()).unwrap();
    validate(&readings, &request(LeaveOut::File)).unwrap()
}

fn request(leave_out: LeaveOut) -> ValidationRequest {
    let surface = Some(PigmentLibrary::van_gogh_oils().saunderson);
    let fit = FitRequest { surface, reference: Some(WHITE.to_owned()), ..FitRequest::default() };
    ValidationRequest { fit, leave_out: Some(leave_out), ..ValidationRequest::default() }
}

#[test]
fn a_white_that_was_weighed_wrongly_shows_as_one_factor_of_all_mixtures() {
    let found = of_batches(|name| if name == WHITE { 1.0 / 1.18 } else { 1.0 });
    let factory: Vec<_> =
        found.errors.strengths.iter().filter(|change| change.file == "factory.csv").collect();
    let [change] = factory[..] else { panic!("{factory:?}") };
    assert_eq!((&change.pigment, change.mixtures), (&None, 12));
    assert!((change.factor / 1.18 - 1.0).abs() < 0.04, "{change:?}");
    assert!(change.delta_e[1] < 0.5 * change.delta_e[0], "{change:?}");
    let report = found.report().to_string();
    assert!(report.contains("12 mixtures of 3 pigments (factory.csv)"), "{report}");
    assert!(report.contains("was the white weighed wrongly?"), "{report}");
}

#[test]
fn a_paint_of_another_batch_is_named_also_beside_a_wrong_white() {
    for white in [1.0, 1.0 / 1.18] {
        let found = of_batches(|name| match name {
            WHITE => white,
            "Viridian" => 0.4,
            _ => 1.0,
        });
        let factory: Vec<_> =
            found.errors.strengths.iter().filter(|change| change.file == "factory.csv").collect();
        let named: Vec<Option<&str>> =
            factory.iter().map(|change| change.pigment.as_deref()).collect();
        let wanted =
            if white == 1.0 { vec![Some("Viridian")] } else { vec![None, Some("Viridian")] };
        assert_eq!(named, wanted, "{factory:?}");
        let viridian = factory.last().unwrap();
        assert!((viridian.factor / 0.4 - 1.0).abs() < 0.1, "{viridian:?}");
        assert_eq!(viridian.mixtures, 6);
    }
}

#[test]
fn mixtures_of_more_pigments_are_compared_with_tints_of_the_same_file() {
    let tints = readings(&tints(), |_| 1.0, 1);
    let factory = readings(&mixtures(), |name| if name == WHITE { 0.7 } else { 1.0 }, 2);
    let rows = factory.split_once('\n').unwrap().1;
    let both = Readings::from_csv("all.csv", format!("{tints}{rows}").as_bytes()).unwrap();
    let found = validate(&both, &request(LeaveOut::Mixture)).unwrap();
    let all: Vec<_> =
        found.errors.strengths.iter().filter(|change| change.pigment.is_none()).collect();
    let more = all.iter().find(|change| change.sizes == [3, 3]).unwrap();
    assert!(more.mixtures == 12 && more.factor > 1.1, "{all:?}");
}

#[test]
fn errors_of_single_weighings_are_no_batch() {
    let found = of_batches(|_| 1.0);
    assert!(found.errors.strengths.is_empty(), "{:?}", found.errors.strengths);
}

#[test]
fn samples_pigments_and_files_are_left_out_as_asked() {
    let text = readings(&tints(), |_| 1.0, 3);
    let tints = Readings::from_csv("tints.csv", text.as_bytes()).unwrap();
    let counts = [LeaveOut::Mixture, LeaveOut::Sample, LeaveOut::Pigment].map(|leave_out| {
        let found = validate(&tints, &request(leave_out)).unwrap();
        let title = found.report().to_string().lines().next().unwrap().to_owned();
        (found.errors.per_sample.len(), found.errors.needed.len(), title)
    });
    // Without its masstone the white is still known from all tints together.
    assert_eq!((counts[0].0, counts[0].1), (12, 0), "{counts:?}");
    assert_eq!((counts[1].0, counts[1].1), (17, 0), "{counts:?}");
    assert_eq!((counts[2].0, counts[2].1), (5, 0), "{counts:?}");
    assert!(counts[0].2.contains("12 mixtures, left out one by one"), "{counts:?}");
    assert!(counts[2].2.contains("5 samples, left out pigment by pigment"), "{counts:?}");
    for (leave_out, words) in [(LeaveOut::Ground, "ground"), (LeaveOut::File, "tints.csv")] {
        let error = validate(&tints, &request(leave_out)).unwrap_err();
        assert!(error.to_string().contains(words) && error.hint().is_some(), "{error}");
    }
    let found = validate(&tints, &request(LeaveOut::Sample)).unwrap();
    assert_eq!(found.residuals(), Err(FittingError::ResidualsOfMixtures));
}

/// A line of a table.
fn row(head: &str, values: &[f64]) -> String {
    let values: Vec<String> = values.iter().map(|value| format!("{value:.5}")).collect();
    format!("{head},{}\n", values.join(","))
}

/// Series of amounts of two washes over white and over grey paper.
fn ladders() -> Readings {
    let oils = PigmentLibrary::van_gogh_oils();
    let surface = spectra::optics::Surface { k1: 0.0, k2: 0.0, specular: Specular::Included };
    let film = spectra::optics::UnevenFilm { surface, unevenness: 0.0 };
    let nm: Vec<String> = (0..oils.grid.count()).map(|at| oils.grid.nm(at).to_string()).collect();
    let mut text = format!("sample,backing,film,Viridian,Vermilion,{}\n", nm.join(","));
    let papers = [("white", 0.85), ("grey", 0.3)];
    for (name, level) in papers {
        let bare = vec![level; oils.grid.count()];
        text += &row(&format!("{name},{name},bare,,"), &bare);
        for (index, paint) in ["Viridian", "Vermilion"].iter().enumerate() {
            let curves = oils.curves(oils.find(paint).unwrap());
            for amount in [0.1, 0.3, 1.0] {
                let values = curves.film(amount, &bare, film);
                let mut amounts = [String::new(), String::new()];
                amounts[index] = amount.to_string();
                let head = format!("{paint} {amount},{name},paint,{}", amounts.join(","));
                text += &row(&head, &values);
            }
        }
    }
    Readings::from_csv("ladders.csv", text.as_bytes()).unwrap()
}

fn absolute(leave_out: Option<LeaveOut>) -> ValidationRequest {
    let fit = FitRequest {
        amounts: AmountKind::Absolute,
        unevenness: Some(0.0),
        surface: Some(spectra::optics::Surface::NONE),
        ..FitRequest::default()
    };
    ValidationRequest { fit, leave_out, ..ValidationRequest::default() }
}

#[test]
fn series_of_one_pigment_have_held_out_errors() {
    let ladders = ladders();
    let usual = validate(&ladders, &absolute(None)).unwrap();
    assert_eq!((usual.leave_out, usual.errors.per_sample.len()), (LeaveOut::Sample, 12));
    assert!(usual.errors.delta_e.mean < 1.0, "{:?}", usual.errors.delta_e);
    let ground = validate(&ladders, &absolute(Some(LeaveOut::Ground))).unwrap();
    assert_eq!(ground.errors.per_sample.len(), 12);
    assert!(ground.errors.delta_e.mean > usual.errors.delta_e.mean, "a ground tells more");
    let title = ground.report().to_string();
    assert!(title.contains("12 films, left out ground by ground"), "{title}");
    let error = validate(&ladders, &absolute(Some(LeaveOut::Pigment))).unwrap_err();
    assert!(error.to_string().contains("no sample can be left out"), "{error}");
    let error = validate(&ladders, &absolute(Some(LeaveOut::Mixture))).unwrap_err();
    assert!(error.to_string().contains("there is no mixture to leave out"), "{error}");
}
