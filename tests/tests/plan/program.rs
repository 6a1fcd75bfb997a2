//! The verb `plan`: recipes, measurement file, prior, and the fit of the filled-in file.

use calibrate::PigmentId;
use calibrate::fit::ExpectedNoise;
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::plan::{Information, PaintSet, candidates, usual};
use suite::program::{impasto, repository};

use crate::painted::{OILS, filled, oils};

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
        let told = json["totals_g"][&name].as_f64().unwrap();
        assert!((told - total).abs() < 1e-6, "{name}: {told} for {total}");
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
    let weakest = |more: &[&str]| {
        let json = plan(&[more, &["--json"]].concat()).json();
        let swatches = json["swatches"].as_array().unwrap().clone();
        swatches
            .iter()
            .map(|s: &serde_json::Value| s["parts"]["Zinc White"].as_u64().unwrap_or(0))
            .max()
            .unwrap()
    };
    assert_eq!(weakest(&["--swatches", "50"]), 19);
    assert_eq!(weakest(&["--swatches", "52", "--grams", "40"]), 79);
    assert_eq!(weakest(&["--swatches", "52", "--balance", "0.001"]), 159);
    assert_eq!(weakest(&["--swatches", "50", "--grams", "5"]), 9);
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

#[test]
fn a_filled_in_file_gives_k_and_s_back_within_the_predicted_deviations() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let empty = path("empty.csv");
    let readings = path("readings.csv");
    let found = path("found.json");
    plan(&["--output", &empty]);
    let truth = oils();
    let sd = 0.003;
    let text = filled(&std::fs::read_to_string(&empty).unwrap(), &truth, sd, 7);
    std::fs::write(&readings, text).unwrap();
    let run = impasto(&[
        "fit",
        &readings,
        "--reference",
        "Zinc White",
        "--smoothness",
        "none",
        "--output",
        &found,
    ]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(!run.err.contains("identified"), "{}", run.err);

    let found = std::fs::read_to_string(&found).unwrap();
    let found = calibrate::library::PigmentLibrary::from_json("found", &found).unwrap();
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
    let of = |key: &str, name: &str| json["prior"][key][name]["scattering"].as_f64().unwrap();
    let sum = |key: &str| -> f64 {
        ["Cobalt Blue", "Viridian", "Vermilion", "Bone Black"].iter().map(|n| of(key, n).ln()).sum()
    };
    let own = sum("relative_deviations");
    let usual = sum("usual_relative_deviations");
    assert!(own < usual, "{own} for {usual}");
    // Doubling the noise about doubles the predicted deviation.
    let at = |noise: &str| {
        let run = plan(&["--prior", &prior, "--noise", noise, "--swatches", "19", "--json"]).json();
        run["prior"]["usual_relative_deviations"]["Viridian"]["scattering"].as_f64().unwrap()
    };
    let ratio = at("0.004,0.02") / at("0.002,0.01");
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
