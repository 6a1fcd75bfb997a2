//! `impasto match` (targets, prices, limits, lights and films), `impasto correct` (batches, recipes
//! and stock), and `impasto match --by spectrum`: its table, and that its recipes are less
//! metameric.

use serde_json::Value;
use suite::program::{impasto, repository};

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

fn matched(arguments: &[&str]) -> Value {
    let library = library();
    let all: Vec<&str> =
        ["match", library.as_str()].into_iter().chain(arguments.iter().copied()).collect();
    let run = impasto(&[all.as_slice(), &["--json"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    run.json()
}

fn refused(arguments: &[&str]) -> (u8, String) {
    let library = library();
    let all: Vec<&str> =
        ["match", library.as_str()].into_iter().chain(arguments.iter().copied()).collect();
    let run = impasto(&all);
    assert!(run.out.is_empty(), "{}", run.out);
    (run.status, run.err)
}

#[test]
fn a_hex_color_and_its_lab_are_one_target() {
    let both = matched(&["#7a6a50", "7A6A50"]);
    assert_eq!(both[0]["hex"], "#7a6a50");
    assert_eq!(both[0]["recipes"], both[1]["recipes"]);
    let lab: Vec<String> = both[0]["lab"]["D65"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap().to_string())
        .collect();
    let again = matched(&[&lab.join(",")]);
    let [one, other] =
        [&both, &again].map(|targets| targets[0]["recipes"][0]["pigments"][0]["name"].clone());
    assert_eq!(one, other);
    assert_eq!(again[0]["reached"], true);
}

#[test]
fn grams_sum_to_what_is_wanted_and_parts_are_whole() {
    let targets = matched(&["#7a6a50", "--grams", "40", "--parts", "12", "--count", "3"]);
    let recipes = targets[0]["recipes"].as_array().unwrap();
    assert_eq!(recipes.len(), 3);
    for recipe in recipes {
        let pigments = recipe["pigments"].as_array().unwrap();
        let [grams, parts] = ["grams", "parts"]
            .map(|key| pigments.iter().map(|p| p[key].as_f64().unwrap()).sum::<f64>());
        assert!((grams - 40.0).abs() < 1e-9, "{recipe}");
        assert!((1.0..=12.0).contains(&parts) && parts.fract() == 0.0, "{recipe}");
        for pigment in pigments {
            let share = pigment["share"].as_f64().unwrap();
            assert!((pigment["parts"].as_f64().unwrap() / parts - share).abs() < 1e-12);
        }
    }
}

#[test]
fn every_spectrum_of_a_file_is_a_target_of_a_batch() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("targets.csv");
    let text = "sample,400,500,600,700\nsand,0.3,0.4,0.5,0.55\nslate,0.15,0.17,0.16,0.15\n";
    std::fs::write(&path, text).unwrap();
    let path = path.display().to_string();
    let targets = matched(&[&path, "--illuminant", "D65", "--illuminant", "A=0.5"]);
    let names: Vec<&str> =
        targets.as_array().unwrap().iter().map(|t| t["target"].as_str().unwrap()).collect();
    assert_eq!(names, ["sand", "slate"]);
    let first = &targets[0]["recipes"][0]["delta_e"];
    assert!(first["D65"].is_f64() && first["A"].is_f64(), "{first}");
    let one = matched(&[&format!("{path}#slate"), "--illuminant", "D65", "--illuminant", "A=0.5"]);
    assert_eq!(one[0], targets[1]);
}

#[test]
fn bare_cards_are_targets_only_if_named_or_alone() {
    let folder = tempfile::tempdir().unwrap();
    let cards = "card,none,white,0.9,0.9,0.9,0.9\ncard,none,black,0.05,0.05,0.05,0.05\n";
    let paint = "sand,paint,white,0.3,0.4,0.5,0.55\nsand,paint,black,0.2,0.3,0.4,0.5\n\
                sand,none,white,0.9,0.9,0.9,0.8\n";
    let files = [("cards.csv", cards.to_owned()), ("both.csv", paint.to_owned() + cards)];
    let [alone, both] = files.map(|(name, rows)| {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("sample,film,backing,400,500,600,700\n{rows}")).unwrap();
        path.display().to_string()
    });
    for (target, wanted) in [
        (both.clone(), &["sand on white", "sand on black"][..]),
        (format!("{both}#sand"), &["sand on white", "sand on black"][..]),
        (format!("{both}#sand bare white"), &["sand bare white"][..]),
        (format!("{both}#card"), &["card bare white", "card bare black"][..]),
        (alone, &["card bare white", "card bare black"][..]),
    ] {
        let found = matched(&[&target, "--at-most", "2", "--count", "1"]);
        let targets = found.as_array().unwrap().iter();
        let names: Vec<&str> = targets.map(|target| target["target"].as_str().unwrap()).collect();
        assert_eq!(names, wanted);
    }
    let run = impasto(&["match", &library(), &both, "--at-most", "1"]);
    assert!(run.err.contains("skipped 3 bare cards"), "{}", run.err);
}

#[test]
fn a_target_out_of_reach_gets_the_nearest_and_is_told_so() {
    let targets = matched(&["#ff00ff"]);
    assert_eq!(targets[0]["reached"], false);
    assert!(targets[0]["nearest"].as_f64().unwrap() > 5.0);
    let run = impasto(&["match", &library(), "#ff00ff"]);
    assert!(run.out.contains("out of reach"), "{}", run.out);
    // In CIEDE2000 the nearest colour to this magenta is a grey. In CIE 1976 it is chromatic.
    let lab = &targets[0]["by_cie1976"][0]["lab"]["D65"];
    assert!(lab[1].as_f64().unwrap() > 30.0, "{lab}");
    assert!(matched(&["#7a6a50"])[0]["by_cie1976"].as_array().unwrap().is_empty());
}

#[test]
fn prices_decide_among_equals() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("prices.csv");
    let text = "pigment,price\nZinc White,0.1\nUltramarine,0.4\nCobalt Blue,2\nVermilion,3\n";
    std::fs::write(&path, text).unwrap();
    let path = path.display().to_string();
    let only = [
        "--only",
        "Zinc White",
        "--only",
        "Ultramarine",
        "--only",
        "Cobalt Blue",
        "--only",
        "Vermilion",
    ];
    let arguments = [&["#8090a8"], &only[..], &["--cost", &path, "--tolerance", "5"]].concat();
    let targets = matched(&arguments);
    let most = targets[0]["nearest"].as_f64().unwrap() + 5.0;
    let costs: Vec<f64> = targets[0]["recipes"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|recipe| recipe["distance"].as_f64().unwrap() <= most)
        .map(|recipe| recipe["cost"].as_f64().unwrap())
        .collect();
    assert!(costs.len() > 1 && costs.is_sorted(), "{costs:?}");
    std::fs::write(folder.path().join("prices.csv"), "pigment,price\nZinc White,dear\n").unwrap();
    let (status, err) = refused(&arguments);
    assert_eq!(status, 1);
    assert!(err.contains("row 2") && err.contains("`dear`"), "{err}");
}

#[test]
fn what_cannot_be_is_refused_with_a_way_out() {
    for (arguments, status, words) in [
        (&["nonsense"][..], 2, "#rrggbb"),
        (&["#12345"], 2, "#12345"),
        (&["#123456", "--illuminant", "A", "--illuminant", "A=2"], 2, "A is given twice"),
        (&["#123456", "--only", "Unobtainium"], 1, "Unobtainium"),
        (&["#123456", "--least", "2"], 2, "--least"),
        (&["#123456", "--least", "1/0"], 2, "--least"),
        (&["#123456", "--with", "Viridian", "--without", "Viridian"], 2, "--without"),
        (&["#123456", "--cost", "Viridian=1"], 1, "no price"),
        (&["#123456", "--over", "0.5"], 2, "--thickness"),
        (&["#123456", "--thickness", "3:1"], 2, "3:1"),
        (&["#123456", "--grams", "-1"], 2, "--grams"),
        (&["#123456", "--count", "0"], 2, "--count"),
        (&["#123456", "--with", "Viridian=0.5", "--parts", "8"], 2, "--parts"),
        (
            &[
                "#123456", "--parts", "3", "--least", "0.9", "--with", "Viridian", "--with",
                "Minium",
            ],
            1,
            "--least",
        ),
    ] {
        let (found, err) = refused(arguments);
        assert!(err.contains(words) && err.contains("hint: "), "{arguments:?}: {err}");
        assert_eq!(found, status, "{arguments:?}: {err}");
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Pigments and shares of the first recipe for the first target.
fn first(targets: &Value) -> Vec<(String, f64)> {
    let pigments = targets[0]["recipes"][0]["pigments"].as_array().unwrap().iter();
    pigments
        .map(|p| (p["name"].as_str().unwrap().to_owned(), p["share"].as_f64().unwrap()))
        .collect()
}

#[test]
fn what_is_required_forbidden_and_bounded_reaches_the_search() {
    fn share(targets: &Value, name: &str) -> Option<f64> {
        first(targets).into_iter().find(|(known, _)| known == name).map(|(_, share)| share)
    }
    let plain = matched(&["#4a7d8c"]);
    let (taken, _) = first(&plain).remove(0);
    assert_eq!(share(&matched(&["#4a7d8c", "--without", &taken]), &taken), None);
    let with = matched(&["#4a7d8c", "--with", "bone=1/4", "--with", "Zinc White (linseed)"]);
    assert!((share(&with, "Bone Black").unwrap() - 0.25).abs() < 1e-9, "{with}");
    assert!(share(&with, "Zinc White (linseed)").unwrap() >= 0.02 - 1e-9, "{with}");
    assert_eq!(first(&matched(&["#4a7d8c", "--at-most", "2"])).len(), 2);
    let large = matched(&["#4a7d8c", "--least", "1/3"]);
    assert!(first(&large).iter().all(|(_, share)| *share >= 1.0 / 3.0 - 1e-9), "{large}");
}

#[test]
fn the_weights_of_lights_count() {
    let [day, lamp] = [["D65=9", "A"], ["D65", "A=9"]].map(|[first, second]| {
        let lights = ["--illuminant", first, "--illuminant", second, "--tolerance", "0.05"];
        let targets = matched(&[&["#4a7d8c"], &lights[..]].concat());
        let differences = targets[0]["recipes"][0]["delta_e"].clone();
        (differences["D65"].as_f64().unwrap(), differences["A"].as_f64().unwrap())
    });
    assert!(day.0 < lamp.0 && lamp.1 < day.1, "{day:?} {lamp:?}");
}

#[test]
fn a_film_is_laid_over_the_ground_that_is_told() {
    fn over(ground: &str, thickness: &str) -> f64 {
        let targets = matched(&["#c8b080", "--thickness", thickness, "--over", ground]);
        let recipe = targets[0]["recipes"][0].clone();
        let recipe_text: Vec<String> = recipe["pigments"]
            .as_array()
            .unwrap()
            .iter()
            .map(|p| format!("{}={}", p["name"].as_str().unwrap(), p["share"]))
            .collect();
        let told_thickness = recipe["thickness"].to_string();
        let library = library();
        let mut mix = vec!["mix", &library, "--json", "--over", ground, "--thickness"];
        mix.push(&told_thickness);
        mix.extend(recipe_text.iter().map(String::as_str));
        let mixed = impasto(&mix).json();
        let found = numbers(&recipe["lab"]["D65"]);
        suite::golden::assert_near("Lab", &found, &numbers(&mixed["lab"]), 1e-6);
        recipe["thickness"].as_f64().unwrap()
    }
    let chosen = over("0.3", "0.2:3");
    assert!((0.2..3.0 - 1e-6).contains(&chosen), "{chosen}");
    assert_eq!(over("0.8", "0.5"), 0.5);
}

#[test]
fn grams_multiply_the_price_of_one() {
    let only = ["#7a6a50", "--only", "Zinc White", "--only", "Minium", "--cost", "Zinc White=1"];
    let cost = |more: &[&str]| {
        let targets = matched(&[&only[..], &["--cost", "Minium=3"], more].concat());
        let recipe = targets[0]["recipes"][0].clone();
        let shares = first(&targets).into_iter();
        let of_one: f64 =
            shares.map(|(name, share)| if name == "Minium" { 3.0 * share } else { share }).sum();
        (recipe["cost"].as_f64().unwrap(), of_one)
    };
    let (one, of_one) = cost(&[]);
    assert!((one - of_one).abs() < 1e-9, "{one} for {of_one}");
    let (forty, of_one) = cost(&["--grams", "40"]);
    assert!((forty - 40.0 * of_one).abs() < 1e-6, "{forty} for {of_one}");
}

#[test]
fn numbers_out_of_range_name_the_option() {
    for (option, value) in
        [("--at-most", "9"), ("--least", "1"), ("--tolerance", "-1"), ("--parts", "0")]
    {
        let (_, err) = refused(&["#123456", option, value]);
        assert!(err.contains(&format!("hint: try {option}")), "{err}");
    }
    let (_, err) = refused(&["#123456", "--illuminant", "D65=0"]);
    assert!(err.contains("hint: give the weight behind the light"), "{err}");
}

#[test]
fn absolute_amounts_are_told_on_the_area_and_take_no_grams() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("absolute.json");
    let mut oils: Value =
        serde_json::from_str(&std::fs::read_to_string(library()).unwrap()).unwrap();
    (oils["amounts"], oils["reference"]) = ("absolute".into(), Value::Null);
    std::fs::write(&path, oils.to_string()).unwrap();
    let path = path.display().to_string();
    let run = impasto(&["match", &path, "#c8b080", "--over", "0.85", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let targets = run.json();
    let recipe = &targets[0]["recipes"][0];
    let pigments = recipe["pigments"].as_array().unwrap().iter();
    let amounts: Vec<String> =
        pigments.map(|p| format!("{}={}", p["name"].as_str().unwrap(), p["amount"])).collect();
    let mut mix = vec!["mix", &path, "--over", "0.85", "--json"];
    mix.extend(amounts.iter().map(String::as_str));
    let mixed = numbers(&impasto(&mix).json()["lab"]);
    suite::golden::assert_near("Lab", &numbers(&recipe["lab"]["D65"]), &mixed, 1e-6);
    let grams = impasto(&["match", &path, "#c8b080", "--grams", "4"]);
    assert!(grams.status == 2 && grams.err.contains("absolute"), "{}", grams.err);
}

#[test]
fn the_tolerance_follows_the_library_and_is_told() {
    let usual = matched(&["61.2,0.3,-44.5"]);
    let fine = matched(&["61.2,0.3,-44.5", "--tolerance", "0"]);
    let [few, many] = [&usual, &fine]
        .map(|targets| targets[0]["recipes"][0]["pigments"].as_array().unwrap().len());
    assert_eq!(usual[0]["tolerance_origin"], "library");
    assert!(usual[0]["tolerance"].as_f64().unwrap() > 1.0, "{}", usual[0]["tolerance"]);
    assert_eq!(
        (&fine[0]["tolerance"], &fine[0]["tolerance_origin"]),
        (&0.0.into(), &"given".into())
    );
    assert!(few == 2 && many > 2, "{few} and {many}");
    assert_eq!(usual[0]["nearest"], fine[0]["nearest"]);
    let run = impasto(&["match", &library(), "61.2,0.3,-44.5"]);
    assert!(run.out.contains("the mean error of this library's fit"), "{}", run.out);

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.json");
    let mut oils: Value =
        serde_json::from_str(&std::fs::read_to_string(library()).unwrap()).unwrap();
    oils.as_object_mut().unwrap().remove("evidence");
    std::fs::write(&path, oils.to_string()).unwrap();
    let run = impasto(&["match", path.to_str().unwrap(), "61.2,0.3,-44.5", "--json"]);
    assert_eq!(run.json()[0]["tolerance"], 0.05);
    assert_eq!(run.json()[0]["tolerance_origin"], "usual");
}

#[test]
fn amounts_at_their_measured_limit_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("absolute.json");
    let mut oils: Value =
        serde_json::from_str(&std::fs::read_to_string(library()).unwrap()).unwrap();
    (oils["amounts"], oils["reference"]) = ("absolute".into(), Value::Null);
    for pigment in oils["pigments"].as_array_mut().unwrap() {
        pigment["measured_amounts"] = serde_json::json!([0.2, 5.0]);
    }
    std::fs::write(&path, oils.to_string()).unwrap();
    let path = path.display().to_string();
    let arguments = ["match", &path, "#e8eef4", "--over", "0.85", "--at-most", "2"];
    let run = impasto(&arguments);
    assert!(run.out.contains("(the least that was measured)"), "{}", run.out);
    assert!(run.out.contains("without that limit"), "{}", run.out);
    let amounts = |more: &[&str]| -> Vec<f64> {
        let json = impasto(&[&arguments, more].concat()).json();
        let recipes = json[0]["recipes"].as_array().unwrap().clone();
        let pigments = recipes.iter().flat_map(|r| r["pigments"].as_array().unwrap().clone());
        pigments.map(|pigment| pigment["amount"].as_f64().unwrap()).collect()
    };
    assert!(amounts(&["--json"]).iter().all(|amount| *amount >= 0.2 - 1e-9));
    assert!(amounts(&["--json", "--beyond-measured"]).iter().any(|amount| *amount < 0.2));
}

/// A file with two spectra of zinc white and cobalt blue: a standard, and a batch with too little
/// blue.
fn spectra(folder: &tempfile::TempDir) -> String {
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let [standard, batch] = ["12", "8"].map(|blue| {
        impasto(&["mix", &library, "Zinc White=88", &format!("Cobalt Blue={blue}"), "--json"])
            .json()
    });
    let lists = [&standard["wavelengths_nm"], &standard["reflectance"], &batch["reflectance"]];
    let [wavelengths, standard, batch] = lists.map(|json| {
        let values = json.as_array().unwrap().iter();
        values.map(|value| format!(",{value}")).collect::<String>()
    });
    let csv = format!("sample{wavelengths}\nstandard{standard}\nbatch{batch}\n");
    let file = folder.path().join("pot.csv");
    std::fs::write(&file, csv).unwrap();
    file.to_str().unwrap().to_owned()
}

#[test]
fn a_batch_that_lacks_blue_is_told_how_much() {
    let folder = tempfile::tempdir().unwrap();
    let file = spectra(&folder);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let standard = format!("{file}#standard");
    let batch = format!("{file}#batch");
    let made = ["--made", "Zinc White=440", "Cobalt Blue=60"];
    let all = [&["correct", &library, &standard, &batch], &made[..]].concat();
    let run = impasto(&all);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("500 g") && run.out.contains("Cobalt Blue"), "{}", run.out);
    assert!(run.out.contains("the least addition first"), "{}", run.out);
    let json = impasto(&[&all[..], &["--json", "--at-most", "1"]].concat()).json();
    let first = &json["corrections"][0];
    assert_eq!(first["additions"][0]["name"], "Cobalt Blue");
    // 12 parts to 88 instead of 8 are 23 g more, or a little more if the blue is also weak. Less is within
    // the tolerance.
    let grams = first["grams"].as_f64().unwrap();
    assert!((10.0..26.0).contains(&grams), "{grams}");
    assert!(first["delta_e"]["D65"].as_f64().unwrap() <= 0.5, "{first}");
    let expected = first["expected"].as_f64().unwrap();
    assert!(expected > first["distance"].as_f64().unwrap() && expected < 1.0, "{first}");
    // The reading shows that blue is missing. Some of it may be a weak paint.
    let blue = &json["pot"][1];
    let [made, grams, strength] = ["made", "grams", "strength"].map(|k| blue[k].as_f64().unwrap());
    assert!(made == 60.0 && grams < 58.0 && strength < 1.0, "{blue}");
    let run = impasto(&[&all[..], &["--strength", "cobalt=1"]].concat());
    assert!(run.out.contains("Cobalt Blue (made 60.0 g, strength 0.99)"), "{}", run.out);
    let second = ["--before", &batch, "--added", "cobalt=2", "--at-most", "1", "--json"];
    let second = impasto(&[&all[..], &second].concat()).json();
    assert_eq!((&second["batch_grams"], &second["pot"][1]["made"]), (&502.0.into(), &62.0.into()));
    let spectral = impasto(&[&all[..], &["--by", "spectrum"]].concat()).out;
    assert!(spectral.contains("within 0.5 % of reflectance of the target"), "{spectral}");
    assert!(spectral.contains("; reflectance 0."), "{spectral}");
    let short = ["--stock", "cobalt=5", "--only", "Cobalt Blue"];
    let run = impasto(&[&all[..], &short].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("no addition comes within 0.5 CIEDE2000"), "{}", run.out);
    assert!(run.out.contains("(all that is in stock)"), "{}", run.out);
    let near = [&["correct", &library, &standard, &standard], &all[4..]].concat();
    assert!(impasto(&near).out.contains("nothing to add"));
}

#[test]
fn faults_name_the_option_and_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let file = spectra(&folder);
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let standard = format!("{file}#standard");
    let batch = format!("{file}#batch");
    for (target, pot, options, status, words) in [
        (standard.as_str(), file.as_str(), vec!["--made", "Zinc White=1"], 2, "holds 2"),
        (&standard, "#808080", vec!["--made", "Zinc White=1"], 2, "a batch is a measured spectrum"),
        (&standard, &batch, vec!["--made", "Zinc White"], 2, "--made takes PIGMENT=GRAMS"),
        (&standard, &batch, vec!["--made", "Gold=1"], 1, "`Gold`"),
        (
            &standard,
            &batch,
            vec!["--made", "Zinc White=1", "--added", "Cobalt Blue=1"],
            2,
            "--before",
        ),
        (&standard, &batch, vec!["--made", "Zinc White=1", "--strength", "Zinc White=0"], 2, "0.9"),
        (&standard, &batch, vec!["--made", "Zinc White=1", "--grams", "0"], 2, "try --grams 500"),
        (&standard, &batch, vec!["--made", "Zinc White=1", "--least", "0"], 2, "try --least 0.1"),
    ] {
        let all = [&["correct", &library, target, pot], &options[..]].concat();
        let run = impasto(&all);
        assert_eq!(run.status, status, "{options:?}: {}", run.err);
        assert!(run.err.contains(words) && run.err.contains("hint: "), "{options:?}: {}", run.err);
        assert!(run.out.is_empty(), "{}", run.out);
    }
}

fn run(arguments: &[&str]) -> suite::program::Run {
    let library = repository("measurements/van-gogh-oils.pigments.json");
    impasto(&[&["match", library.as_str()], arguments].concat())
}

/// A measured yellow. The library has its paint and others that make the same colour.
fn sample() -> String {
    repository("measurements/van-gogh-oils.csv") + "#14B"
}

fn best(arguments: &[&str]) -> Value {
    let found = run(&[arguments, &["--json", "--tolerance", "0", "--count", "1"]].concat());
    assert_eq!(found.status, 0, "{}", found.err);
    let json = found.json();
    // The film over the black card.
    let target = json.as_array().unwrap().iter().find(|t| t["target"] == "14B on black").unwrap();
    target["recipes"][0].clone()
}

#[test]
fn a_recipe_by_spectrum_is_less_metameric_than_one_by_colour() {
    let lights = ["--illuminant", "D65", "--illuminant", "A=1e-6", "--illuminant", "FL11=1e-6"];
    let [color, spectrum] = ["color", "spectrum"]
        .map(|by| best(&[&[sample().as_str(), "--by", by], &lights[..]].concat()));
    fn index(recipe: &Value, at: usize) -> f64 {
        recipe["metamerism"][at]["index"].as_f64().unwrap()
    }
    fn under(recipe: &Value, light: &str) -> f64 {
        recipe["delta_e"][light].as_f64().unwrap()
    }
    // The recipe by colour is exact under daylight and far off under lamps.
    assert!(under(&color, "D65") < 0.01 && index(&color, 0) > 1.0 && index(&color, 1) > 3.0);
    assert!(index(&spectrum, 0) < 0.2 && index(&spectrum, 1) < 0.6, "{spectrum}");
    assert!(under(&spectrum, "D65") < 0.7 && under(&spectrum, "FL11") < 0.7, "{spectrum}");
    let rms = [&spectrum, &color].map(|recipe| recipe["rms_percent"].as_f64().unwrap());
    assert!(rms[0] < 0.3 * rms[1], "{rms:?}");
    let metamerism = &spectrum["metamerism"][1];
    assert_eq!(metamerism["kind"], "special metamerism index, change of illuminant");
    assert_eq!((&metamerism["from"], &metamerism["to"]), (&"D65".into(), &"FL11".into()));
    assert_eq!(metamerism["unit"], "CIEDE2000");
}

#[test]
fn the_table_says_what_is_matched_and_under_which_lights_it_is_told() {
    let found = run(&[&sample(), "--by", "spectrum", "--count", "1"]);
    for words in [
        "by spectrum: rms of reflectance from 400 to 700 nm, each wavelength equally",
        "equally near within 0.2 % of reflectance",
        "special metamerism index, change of illuminant, in CIEDE2000",
        "D65 to A",
        "D65 to FL11",
        "rms, %",
    ] {
        assert!(found.out.contains(words), "{words}: {}", found.out);
    }
    assert!(found.out.lines().all(|line| line.chars().count() <= 100), "{}", found.out);
    let csv = run(&[&sample(), "--by", "weighted-spectrum", "--count", "1", "--csv"]);
    let heading = csv.out.lines().next().unwrap();
    for column in ["distance", "rms_percent", "delta_e_FL11", "metamerism_D65 to A"] {
        assert!(heading.split(',').any(|one| one == column), "{heading}");
    }
    // You cannot compare the spectrum of a colour.
    let colour = run(&["#4a7d8c", "--count", "1"]);
    assert!(colour.out.contains("(CIEDE2000)") && !colour.out.contains("rms"), "{}", colour.out);
    let refused = run(&["#4a7d8c", "--by", "spectrum"]);
    assert!(refused.status == 2 && refused.out.is_empty(), "{}", refused.out);
    assert!(refused.err.contains("only a colour") && refused.err.contains("--by color"));
}

/// Files of named colours, and one target of each: its text, and its name and CIELAB (D65) to one digit.
#[test]
fn swatch_files_and_tables_of_names_are_targets() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name).display().to_string();
    let tables = [
        ("semicolons.csv", "Number;L*;a*;b*\nRAL 5012;55,1;-15,3;-31,9\nRAL 9010;94,6;-0,8;6,9\n"),
        ("stated.csv", "name,L* (D50/2),a* (D50/2),b* (D50/2)\nSky,60,-5,-30\n"),
        ("xyz.csv", "name,X,Y,Z\nGrey,17.506,18.419,20.056\n"),
        (
            "codes.csv",
            "RAL,HEX,English\nRAL 5012,#3b83bd,Light blue\nRAL 9010,#f7f9ef,Pure white\n",
        ),
        ("list.txt", "Sky,#3b83bd\nSea,#003b83\n"),
    ];
    for (name, text) in tables {
        std::fs::write(place(name), text).unwrap();
    }
    for (name, space) in [("oils.ase", "lab"), ("oils.aco", "lab"), ("oils.gpl", "rgb")] {
        let run = impasto(&["library", "export", &library(), "--space", space, "-o", &place(name)]);
        assert_eq!(run.status, 0, "{}", run.err);
    }
    for (text, name, wanted) in [
        ("semicolons.csv#RAL 5012", "RAL 5012", [55.1, -15.3, -31.9]),
        ("semicolons.csv#2", "RAL 9010", [94.6, -0.8, 6.9]),
        // Adapted from D50 to D65 by the Bradford matrix.
        ("stated.csv#sky", "Sky", [60.405, -1.391, -29.483]),
        ("xyz.csv", "Grey", [50.0, 0.0, 0.0]),
        ("codes.csv#light blue", "RAL 5012", [52.77, -3.53, -36.91]),
        ("list.txt#Sea", "Sea", [26.06, 13.97, -45.01]),
        ("oils.ase#Viridian", "Viridian", [30.82, -11.15, -0.77]),
        ("oils.aco#11", "Viridian", [30.82, -11.15, -0.77]),
        ("oils.gpl#virid", "Viridian", [30.96, -11.48, -0.30]),
    ] {
        let found = matched(&[&place(text), "--at-most", "1", "--count", "1"]);
        assert_eq!(found[0]["target"], name, "{text}");
        for (value, wanted) in found[0]["lab"]["D65"].as_array().unwrap().iter().zip(wanted) {
            assert!((value.as_f64().unwrap() - wanted).abs() < 0.06, "{text} {}", found[0]["lab"]);
        }
    }
    let every = matched(&[&place("semicolons.csv"), "--at-most", "1", "--count", "1"]);
    assert_eq!(every.as_array().unwrap().len(), 2, "a whole file is a batch");
    let light = ["--target-light", "D50", "--illuminant", "D50", "--at-most", "1"];
    let under = matched(&[&[place("semicolons.csv#1").as_str()][..], &light].concat());
    let lab = under[0]["lab"]["D50"][0].as_f64().unwrap();
    assert!((lab - 55.1).abs() < 1e-9, "{lab}");
    let run = impasto(&["match", &library(), &place("semicolons.csv#1"), "--at-most", "1"]);
    for told in ["states no light", "D65", "--target-light"] {
        assert!(run.err.contains(told), "{}", run.err);
    }
    for (target, status, wanted) in [
        ("semicolons.csv#RAL", 1, "`RAL` may be 2 colours"),
        ("semicolons.csv#RAL 1", 1, "no colour is called `RAL 1`"),
        ("semicolons.csv#9", 1, "RAL 5012, RAL 9010"),
        ("missing.ase", 2, "missing.ase: cannot be read"),
        ("missing.csv#RAL 5012", 2, "missing.csv: cannot be read"),
    ] {
        let (found, err) = refused(&[&place(target)]);
        assert!(found == status && err.contains(wanted), "{target}: {found} {err}");
    }
    let (status, err) = refused(&["teal"]);
    assert!(status == 2 && err.contains("found `teal`") && err.contains("book.ase"), "{err}");
    let book = place("semicolons.csv");
    let run = impasto(&["correct", &library(), &book, &book, "--made", "Zinc White=3"]);
    assert_eq!(run.status, 2);
    assert!(run.err.contains("holds 2") && run.err.contains("RAL 5012, RAL 9010"), "{}", run.err);
}

#[test]
fn pigments_are_named_by_colour_index_and_by_words() {
    let named = |only: &[&str]| {
        let only: Vec<&str> = only.iter().flat_map(|name| ["--only", name]).collect();
        matched(&[&["#5698e4", "--count", "1"], &only[..]].concat())
    };
    assert_eq!(named(&["PB29", "PW1"]), named(&["Ultramarine", "Lead White"]));
    assert_eq!(named(&["Pigment Blue 27", "lead"]), named(&["Prussian Blue", "Lead White"]));
    for (name, status, words) in [
        ("blue", 1, "`blue` may be Cobalt Blue, Ultramarine or Prussian Blue"),
        ("PW6", 1, "PW6 is titanium white"),
        ("Viridan", 1, "did you mean Viridian?"),
        ("sulphat", 1, "Barium Sulphate"),
        ("ultramarin blue", 1, "the library has no pigment called `ultramarin blue`"),
    ] {
        let (found, err) = refused(&["#5698e4", "--only", name, "--only", "zink wite"]);
        let is_first = err.contains(words) || name == "sulphat" && err.contains("`zink wite`");
        assert!(found == status && is_first, "{name}: {found} {err}");
    }
}
