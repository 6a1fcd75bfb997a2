//! The verb `plan`: recipes, measurement file, prior, and the fit of the filled-in file. Runs the
//! commands of docs/guide/measuring.md in order, and simulates readings of planned swatches from K
//! and S of the oils.

use calibrate::fit::ExpectedNoise;
use calibrate::library::PigmentLibrary;
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::plan::{Information, PaintSet, candidates, usual};
use calibrate::{PigmentId, Recipe};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use suite::program::{commands, impasto, repository};

const PAINTS: [&str; 7] =
    ["Cobalt Blue", "Viridian", "Vermilion", "--white", "Zinc White", "--black", "Bone Black"];

fn plan(more: &[&str]) -> suite::program::Run {
    let run = impasto(&[&["plan"], &PAINTS[..], more].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    run
}

#[test]
fn a_plan_names_recipes_that_can_be_weighed() {
    let json = plan(&["--json"]).json();
    let swatches = json["swatches"].as_array().unwrap();
    assert_eq!(swatches[0]["sample"], "01 Zinc White masstone");
    assert_eq!(json["identified"], true);
    let mut totals = std::collections::BTreeMap::new();
    for swatch in swatches {
        let grams = swatch["grams"].as_object().unwrap();
        let sum: f64 = grams.values().map(|g| g.as_f64().unwrap()).sum();
        assert!((sum - 10.0).abs() < 0.011, "{swatch}");
        for (name, grams) in grams {
            let grams = grams.as_f64().unwrap();
            assert!(grams >= 0.5, "fifty steps of the balance: {swatch}");
            assert!((100.0 * grams - (100.0 * grams).round()).abs() < 1e-9, "{swatch}");
            *totals.entry(name.clone()).or_insert(0.0) += grams;
        }
    }
    for (name, total) in totals {
        let reported = json["totals_g"][&name].as_f64().unwrap();
        assert!((reported - total).abs() < 1e-6, "{name}: {reported} for {total}");
    }
    // 5 masstones, 2 tints each of 4 paints, 3 shades, and 3 mixtures of two colours.
    assert_eq!(swatches.len(), 5 + 8 + 3 + 3);
    let table = plan(&[]).out;
    for word in ["01 Zinc White masstone", "Cobalt Blue tint 1:4", "0.5 g", "Paint for all"] {
        assert!(table.contains(word), "{word} in {table}");
    }
}

#[test]
fn more_paint_or_a_finer_balance_allows_weaker_tints() {
    for (more, wanted) in [
        (&["--swatches", "50"][..], 19),
        (&["--swatches", "52", "--grams", "40"][..], 79),
        (&["--swatches", "52", "--balance", "0.001"][..], 159),
        (&["--swatches", "50", "--grams", "5"][..], 9),
    ] {
        let json = plan(&[more, &["--json"]].concat()).json();
        let swatches = json["swatches"].as_array().unwrap().iter();
        let parts = swatches.map(|s| s["parts"]["Zinc White"].as_u64().unwrap_or(0));
        assert_eq!(parts.max().unwrap(), wanted);
    }
}

#[test]
fn the_empty_file_is_refused_where_it_is_empty() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.csv").display().to_string();
    plan(&["--output", &path]);
    let run = impasto(&["fit", &path]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("row 2, column `400`"), "{}", run.err);
    assert!(run.err.contains("hint: fill in the reading"), "{}", run.err);
}

#[test]
fn the_file_asks_for_bare_cards_and_for_every_swatch_over_both() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.csv").display().to_string();
    let count = plan(&["--output", &path, "--replicates", "3", "--json"]).json()["swatches"]
        .as_array()
        .unwrap()
        .len();
    let empty = std::fs::read_to_string(&path).unwrap();
    assert_eq!(empty.lines().count(), 1 + 6 + count * 6);
    let table = MeasurementTable::from_csv(
        "filled.csv",
        filled(&empty, &oils(), 0.0, 1).as_bytes(),
        ScaleChoice::ByFile,
    )
    .unwrap();
    assert_eq!((table.grid.start_nm(), table.grid.end_nm()), (400.0, 700.0));
    assert_eq!(
        table.pigments,
        ["Zinc White", "Cobalt Blue", "Viridian", "Vermilion", "Bone Black"]
    );
    let again = impasto(&[&["plan"], &PAINTS[..], &["--output", &path]].concat());
    assert_eq!(again.status, 2, "{}", again.err);
    assert!(again.err.contains("is not overwritten"), "{}", again.err);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), empty);
    let path = folder.path().join("fine.csv").display().to_string();
    let fine = plan(&["--output", &path, "--grid", "380,730,5"]);
    let header = std::fs::read_to_string(&path).unwrap();
    let header = header.lines().next().unwrap();
    assert!(header.ends_with(",725,730") && header.contains(",380,385,"), "{header}");
    assert!(fine.err.contains("--white \"Zinc White\""), "{}", fine.err);
}

/// The readings of a filled form as an instrument saves them: a name and the spectrum of each. `named` are
/// the names, in the order of the form.
fn as_an_instrument(full: &str, named: &[String]) -> String {
    let first_nm = full.lines().next().unwrap().split(',').position(|name| name == "400").unwrap();
    let mut names = std::iter::once("Name").chain(named.iter().map(String::as_str));
    let lines = full.lines().map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        format!("{},{}\n", names.next().unwrap(), cells[first_nm..].join(","))
    });
    lines.collect()
}

/// The cells of one column of a CSV without quotes.
fn column(text: &str, heading: &str) -> Vec<String> {
    let place = text.lines().next().unwrap().split(',').position(|name| name == heading).unwrap();
    text.lines().skip(1).map(|line| line.split(',').nth(place).unwrap().to_owned()).collect()
}

#[test]
fn files_of_an_instrument_are_fitted_with_the_recipes_of_the_plan_or_with_its_form() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).display().to_string();
    let printed = plan(&["--output", &file("form.csv")]).err;
    for word in ["fit FILE.. --recipes", "form-recipes.csv", "--white \"Zinc White\""] {
        assert!(printed.contains(word), "{word} in {printed}");
    }
    let form = std::fs::read_to_string(file("form.csv")).unwrap();
    let recipes = std::fs::read_to_string(file("form-recipes.csv")).unwrap();
    let full = filled(&form, &oils(), 0.001, 5);
    std::fs::write(file("full.csv"), &full).unwrap();
    let readings = column(&recipes, "reading");
    assert_eq!(readings[4..6], ["01 white 1", "01 white 2"]);
    let expected = impasto(&["fit", &file("full.csv"), "--method", "qp", "--json"]).json();
    for (recipes, named, in_order) in
        [("form-recipes.csv", readings, false), ("form.csv", column(&form, "sample"), true)]
    {
        std::fs::write(file("saved.csv"), as_an_instrument(&full, &named)).unwrap();
        let options = ["--recipes", &file(recipes), "--method", "qp", "--json"];
        let run = impasto(&[&["fit", &file("saved.csv")], &options[..]].concat());
        assert_eq!(run.status, 0, "{recipes}: {}", run.err);
        assert_eq!(run.err.contains("order of the files"), in_order, "{recipes}: {}", run.err);
        assert_eq!(run.json()["per_sample"], expected["per_sample"], "{recipes}");
    }
}

#[test]
fn a_short_plan_says_what_it_loses() {
    let prior = repository(OILS);
    for (more, swatches, spare, says) in [
        (&["--swatches", "fewest"][..], 9, 0, "without 4 tints, 3 shades, 3 crosses; no swatch"),
        (&["--swatches", "12"], 12, 3, "3 swatches check the fit"),
        (&["--minutes", "139"], 13, 4, "13 swatches instead of 19"),
        (&["--minutes", "60", "--minutes-each", "5"], 12, 3, "12 swatches instead of 19"),
        (&["--minutes", "900"], 19, 10, ""),
        (&["--minutes", "100", "--prior", &prior], 10, 1, "(median of 5 paints)"),
    ] {
        let run = plan(&[more, &["--json"]].concat());
        let json = run.json();
        assert_eq!(json["swatches"].as_array().unwrap().len(), swatches, "{more:?}");
        if says.is_empty() {
            assert!(json["loss"].is_null() && !run.err.contains("instead of"), "{}", run.err);
            continue;
        }
        assert_eq!(json["loss"]["full_swatches"], 19, "{more:?}");
        assert_eq!(json["loss"]["spare_swatches"], spare, "{more:?}");
        assert!(run.err.contains("warning: ") && run.err.contains(says), "{more:?}: {}", run.err);
        let mean = |deviations: &serde_json::Value| -> f64 {
            let paints = deviations.as_object().unwrap().values();
            paints.map(|paint| paint["absorption"].as_f64().unwrap().ln()).sum()
        };
        let full = &json["loss"]["full_relative_deviations"];
        assert_eq!(full.is_null(), json["prior"].is_null());
        if !full.is_null() {
            assert!(mean(&json["prior"]["relative_deviations"]) > mean(full), "{json}");
        }
    }
}

#[test]
fn a_filled_in_file_gives_k_and_s_back_within_the_predicted_deviations() {
    let folder = tempfile::tempdir().unwrap();
    let [empty, readings, found] = ["empty.csv", "readings.csv", "found.json"]
        .map(|name| folder.path().join(name).display().to_string());
    plan(&["--output", &empty]);
    let truth = oils();
    let sd = 0.003;
    let text = filled(&std::fs::read_to_string(&empty).unwrap(), &truth, sd, 7);
    std::fs::write(&readings, text).unwrap();
    let options = ["--reference", "Zinc White", "--smoothness", "none", "--output", &found];
    let run = impasto(&[&["fit", &readings], &options[..]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(!run.err.contains("identified"), "{}", run.err);

    let found = std::fs::read_to_string(&found).unwrap();
    let found = PigmentLibrary::from_json("found", &found).unwrap();
    let colors = PAINTS[..3].iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
    let paints = PaintSet::new(&colors, "Zinc White", Some("Bone Black")).unwrap();
    let pigments: Vec<PigmentId> = paints.names.iter().map(|n| truth.find(n).unwrap()).collect();
    let pool = candidates(&paints, 0.05);
    let design = usual(&paints, &pool, 19).unwrap();
    // The mean of two readings over each card has noise sd / sqrt(2).
    let noise = ExpectedNoise { constant: sd / 2f64.sqrt(), even: 0.0 };
    let deviations = Information::new(&truth, &pigments, &pool, noise).log_deviations(&design);
    let mut pulls = Vec::new();
    for (paint, name) in paints.names.iter().enumerate() {
        let got = &found[found.find(name).unwrap()];
        let wanted = &truth[pigments[paint]];
        for at in 0..truth.grid.count() {
            let k = (got.absorption[at] / wanted.absorption[at]).ln();
            let s = (got.scattering[at] / wanted.scattering[at]).ln();
            for (error, deviation) in
                [(k, deviations[paint].absorption[at]), (s, deviations[paint].scattering[at])]
            {
                if deviation > 0.0 && deviation < 0.3 {
                    pulls.push((error / deviation).powi(2));
                }
            }
        }
    }
    assert!(pulls.len() > 150, "{}", pulls.len());
    pulls.sort_by(f64::total_cmp);
    let median = pulls[pulls.len() / 2];
    let high = pulls[pulls.len() * 95 / 100];
    assert!((0.1..1.0).contains(&median), "median squared error in deviations: {median}");
    assert!(high < 9.0, "95 % of squared errors below {high}");
}

#[test]
fn a_prior_gives_a_better_plan_and_says_by_how_much() {
    let prior = repository(OILS);
    let run = plan(&["--prior", &prior, "--json"]);
    assert_eq!(run.out, plan(&["--prior", &prior, "--json"]).out, "the same bytes");
    let json = run.json();
    let efficiency = json["prior"]["usual_efficiency"].as_f64().unwrap();
    assert!((0.2..0.99).contains(&efficiency), "{efficiency}");
    assert_eq!(json["swatches"][0]["sample"], "01 Zinc White masstone");
    assert!(json["prior"]["relative_deviations"]["Zinc White"]["scattering"].is_null());
    let keys = ["relative_deviations", "usual_relative_deviations"];
    let [own, usual] = keys.map(|key| -> f64 {
        let names = ["Cobalt Blue", "Viridian", "Vermilion", "Bone Black"].iter();
        let deviations =
            names.map(|&name| json["prior"][key][name]["scattering"].as_f64().unwrap().ln());
        deviations.sum()
    });
    assert!(own < usual, "{own} for {usual}");
    // With twice the noise, the predicted deviation is about twice as large.
    let [noisy, usual] = ["0.004,0.02", "0.002,0.01"].map(|noise| {
        let run = plan(&["--prior", &prior, "--noise", noise, "--swatches", "19", "--json"]).json();
        run["prior"]["usual_relative_deviations"]["Viridian"]["scattering"].as_f64().unwrap()
    });
    let ratio = noisy / usual;
    assert!((1.8..2.1).contains(&ratio), "{ratio}");
    let short = impasto(&["plan", "viri", "--white", "Zinc White", "--prior", &prior]);
    assert!(short.out.contains("01 Zinc White masstone"), "{}", short.err);
    assert!(short.out.contains("Viridian"), "a name may be cut short: {}", short.out);
}

#[test]
fn what_cannot_be_planned_is_refused_with_a_way_out() {
    let prior = repository(OILS);
    for (arguments, what, hint) in [
        (&["400", "--white", "W"][..], "`400`", "no number"),
        (&["sample", "--white", "W"], "`sample`", "thickness_mm"),
        (&["A", "A", "--white", "W"], "`A`", "another name"),
        (&["W", "--white", "W"], "beside the white", "Cobalt Blue"),
        (&["A", "B", "--white", "W", "--swatches", "4"], "found `4`", "--swatches 5"),
        (&["A", "--white", "W", "--swatches", "900"], "found `900`", "--replicates"),
        (&["A", "--white", "W", "--balance", "0.1"], "found `10`", "--grams 25"),
        (&["A", "--white", "W", "--grams", "-1"], "found `-1`", "--balance 0.01"),
        (&["A", "--white", "W", "--swatches", "few"], "found `few`", "--swatches fewest"),
        (&["A", "--white", "W", "--minutes", "29"], "found `29`", "--minutes 30"),
        (&["A", "--white", "W", "--minutes", "0"], "found `0`", "--minutes 240"),
        (&["A", "--white", "W", "--minutes", "60", "--swatches", "3"], "exclude", "--minutes"),
        (&["A", "--white", "W", "--grid", "400,705,10"], "`400,705,10`", "400,700,10"),
        (&["A", "--white", "W", "--replicates", "0"], "found `0`", "--replicates 2"),
        (&["A", "--white", "W", "--prior", &prior], "called `A`", "Cobalt Blue"),
        (
            &["Viridian", "--white", "Zinc White", "--prior", &prior, "--noise", "0,0"],
            "`0,0`",
            "--noise 0.002,0.01",
        ),
    ] {
        let run = impasto(&[&["plan"], arguments].concat());
        assert!(run.status == 1 || run.status == 2, "{arguments:?}: {}", run.status);
        assert!(run.err.contains(what), "{arguments:?}: {}", run.err);
        assert!(run.err.contains("hint: "), "{arguments:?}: {}", run.err);
        assert!(run.err.contains(hint), "{arguments:?}: {}", run.err);
        assert!(run.out.is_empty(), "{arguments:?}: {}", run.out);
    }
}

/// Splits a filled measurement file into a file of spectra and a file of recipes.
fn parted(full: &str) -> (String, String) {
    let header: Vec<&str> = full.lines().next().unwrap().split(',').collect();
    let first_nm = header.iter().position(|name| *name == "400").unwrap();
    let mut spectra = String::new();
    let mut amounts = String::new();
    let mut last = "";
    for line in full.lines() {
        let cells: Vec<&str> = line.split(',').collect();
        spectra += &format!("{},{}\n", cells[..3].join(","), cells[first_nm..].join(","));
        if cells[0] != last && cells[1] != "none" {
            amounts += &format!("{},{}\n", cells[0], cells[4..first_nm].join(","));
        }
        last = cells[0];
    }
    (spectra, amounts)
}

/// Readings of bare paper, and of washes of two paints on it with invented K and S.
fn washes() -> String {
    let nm: Vec<f64> = (0..16).map(|step| 400.0 + 20.0 * f64::from(step)).collect();
    fn wash(amounts: [f64; 2], nm: f64) -> f64 {
        let [blue, brown] =
            [590.0, 430.0].map(|center| (-((nm - center) / 70.0_f64).powi(2)).exp());
        let paper = 0.8 + 0.1 * (nm - 400.0) / 300.0;
        let k = amounts[0] * (1.5 + 100.0 * blue) + amounts[1] * (6.0 + 90.0 * brown);
        let s = amounts[0] * 4.0 + amounts[1] * 12.0;
        if s == 0.0 {
            return paper;
        }
        // Kubelka (1948), a layer on a ground.
        let a = 1.0 + k / s;
        let b = (a * a - 1.0).sqrt();
        let b_coth = b / (b * s).tanh();
        (1.0 - paper * (a - b_coth)) / (a - paper + b_coth)
    }
    let header = nm.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let mut text = format!("sample,film,Ultramarine,Burnt Sienna,{header}\n");
    let ladder = [0.01, 0.02, 0.04, 0.08];
    let alone = ladder.iter().flat_map(|&amount| [[amount, 0.0], [0.0, amount]]);
    for amounts in std::iter::once([0.0, 0.0]).chain(alone).chain([[0.02, 0.02], [0.04, 0.01]]) {
        let (name, film) = match amounts {
            [0.0, 0.0] => ("paper".to_owned(), "none"),
            [first, second] => (format!("U {first} S {second}"), "paint"),
        };
        let values: Vec<String> =
            nm.iter().map(|&nm| format!("{:.4}", wash(amounts, nm))).collect();
        let [first, second] = amounts;
        text += &format!("{name},{film},{first},{second},{}\n", values.join(","));
    }
    text
}

#[test]
fn every_command_of_the_page_on_measuring_runs() {
    let page = std::fs::read_to_string(repository("docs/guide/measuring.md")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let oils = oils();
    for (name, light) in [("white.txt", 20_000.0), ("dark.txt", 200.0), ("swatch.txt", 9_000.0)] {
        let text: String = (0..31)
            .map(|step: u32| format!("{} {}\n", 400 + 10 * step, light + f64::from(step)))
            .collect();
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    std::fs::write(folder.path().join("washes.csv"), washes()).unwrap();
    let mut ran = 0;
    for command in commands(&page) {
        let words = command.words.iter().skip(1).map(|word| {
            // A spectrum of a file is named after the file.
            let file = word.split('#').next().unwrap_or_default();
            let is_file = [".csv", ".json", ".txt"].iter().any(|end| file.ends_with(end));
            if is_file { folder.path().join(word).display().to_string() } else { word.clone() }
        });
        let words: Vec<String> = words.collect();
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let run = impasto(&words);
        assert_eq!(run.status, 0, "{}\n{}", command.line, run.err);
        assert!(!run.err.contains("left out: card"), "the cards are lost\n{}", run.err);
        ran += 1;
        // The file of a plan is filled in before the next command reads it.
        if let Some(at) = words.iter().position(|word| *word == "-o")
            && words[0] == "plan"
        {
            let empty = std::fs::read_to_string(words[at + 1]).unwrap();
            let full = filled(&empty, &oils, 0.002, 3);
            std::fs::write(words[at + 1], &full).unwrap();
            let recipes = words[at + 1].replace(".csv", "-recipes.csv");
            let readings = column(&std::fs::read_to_string(recipes).unwrap(), "reading");
            let saved = as_an_instrument(&full, &readings);
            std::fs::write(folder.path().join("saved.csv"), saved).unwrap();
            let (spectra, amounts) = parted(&full);
            std::fs::write(folder.path().join("spectra.csv"), spectra).unwrap();
            std::fs::write(folder.path().join("amounts.csv"), amounts).unwrap();
        }
    }
    assert!(ran >= 11, "{ran} commands");
}

/// Reflectances of the bare cards, equal at all wavelengths.
const WHITE_CARD: f64 = 0.85;
const BLACK_CARD: f64 = 0.05;
/// Thickness of the films, in units where zinc white has S d = 1. Such films nearly hide.
const THICKNESS: f64 = 8.0;

pub(crate) const OILS: &str = "measurements/van-gogh-oils.pigments.json";

pub(crate) fn oils() -> PigmentLibrary {
    let text = std::fs::read_to_string(repository(OILS)).unwrap();
    PigmentLibrary::from_json(OILS, &text).unwrap()
}

/// Fills in the empty file of a plan with readings predicted from `oils` plus normal noise of
/// standard deviation `sd`. The file must have the wavelengths of `oils`.
pub(crate) fn filled(empty: &str, oils: &PigmentLibrary, sd: f64, seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let header: Vec<&str> = empty.lines().next().unwrap().split(',').collect();
    let first_nm = header.iter().position(|name| *name == "400").unwrap();
    let mut text = format!("{}\n", header.join(","));
    for line in empty.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        assert!(cells[first_nm..].iter().all(|cell| cell.is_empty()), "{line}");
        let card = if cells[2] == "white" { WHITE_CARD } else { BLACK_CARD };
        let card = vec![card; oils.grid.count()];
        let recipe: Recipe = (4..first_nm)
            .filter(|&column| !cells[column].is_empty())
            .map(|column| (oils.find(header[column]).unwrap(), cells[column].parse().unwrap()))
            .collect();
        let read = match cells[1] {
            "none" => card,
            _ => oils.mix(&recipe).unwrap().film(THICKNESS, &card, oils.film()),
        };
        text.push_str(&cells[..first_nm].join(","));
        for value in read {
            let error: f64 = StandardNormal.sample(&mut random);
            text.push_str(&format!(",{:.5}", (value + sd * error).max(0.0305)));
        }
        text.push('\n');
    }
    text
}
