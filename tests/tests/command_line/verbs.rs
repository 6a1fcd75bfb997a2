//! JSON output of the verbs, `impasto light` in every form of output, and `impasto demo`, which
//! reproduces the shipped library.

use serde_json::Value;
use suite::program::{Run, impasto, repository};

fn oils() -> String {
    repository("measurements/van-gogh-oils.csv")
}

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

fn json(arguments: &[&str]) -> Value {
    let run: Run = impasto(arguments);
    assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
    run.json()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

const FIT_KEYS: [&str; 8] = [
    "samples",
    "pigments",
    "rms",
    "delta_e",
    "per_sample",
    "shares_of_squares",
    "warnings",
    "seconds",
];

#[test]
fn fit_prints_its_keys_and_writes_what_it_printed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("oils.json");
    let path = path.to_str().unwrap();
    let fit = json(&["fit", &oils(), "--output", path, "--title", "Oils", "--json"]);
    assert_eq!(keys(&fit), FIT_KEYS);
    assert_eq!(keys(&fit["delta_e"]), ["mean", "median", "p90", "max"]);
    assert_eq!(keys(&fit["per_sample"][0]), ["sample", "delta_e"]);
    assert_eq!((&fit["samples"], &fit["pigments"]), (&82.into(), &20.into()));
    let library: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    assert_eq!(library["evidence"]["delta_e"], fit["delta_e"]);
    assert_eq!(library["title"], "Oils");
}

#[test]
fn excluded_samples_take_their_lone_pigments_along() {
    let fit = json(&["fit", &oils(), "--exclude", "07B", "--exclude", "14F", "--json"]);
    assert_eq!((&fit["samples"], &fit["pigments"]), (&82.into(), &18.into()));
    let warnings = fit["warnings"].to_string();
    assert!(!warnings.contains("not identified"), "{warnings}");
}

#[test]
fn every_option_of_the_fit_changes_the_fit() {
    let oils = oils();
    let mean = |options: &[&str]| {
        let fit = json(&[&["fit", oils.as_str(), "--json"], options].concat());
        fit["delta_e"]["mean"].as_f64().unwrap()
    };
    let usual = mean(&[]);
    let qp = mean(&["--method", "qp", "--saunderson", "none"]);
    let weighted = mean(&["--method", "weighted"]);
    assert!(qp > 11.0 && weighted < 3.0 && usual < 1.4, "{qp} {weighted} {usual}");
    for options in [
        ["--smoothness", "none"],
        ["--smoothness", "10"],
        ["--specular", "excluded"],
        ["--saunderson", "0.019,0.5"],
        ["--reference", "lead white"],
        ["--exclude", "17d"],
        ["--illuminant", "A"],
        ["--observer", "10"],
    ] {
        let found = mean(&options);
        assert!(found < 3.0 && (found - usual).abs() > 1e-5, "{options:?}: {found} {usual}");
    }
}

#[test]
fn validate_prints_its_keys() {
    let found = json(&["validate", &oils(), "--folds", "4", "--method", "weighted", "--json"]);
    assert_eq!(keys(&found)[..8], FIT_KEYS);
    assert_eq!(keys(&found)[8..], ["strength_free", "strengths", "by_pigment"]);
    let other = json(&["validate", &oils(), "--folds", "9", "--method", "weighted", "--json"]);
    assert_ne!(other["delta_e"], found["delta_e"], "the folds differ");
    let with = json(&[
        "validate",
        &oils(),
        "--folds",
        "4",
        "--method",
        "weighted",
        "--with",
        "Viridian",
        "--json",
    ]);
    assert_eq!(with["samples"], 6, "09B to 09E, 08E and 16E");
}

#[test]
fn color_prints_its_keys_with_white_at_100() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("spectra.csv");
    std::fs::write(&file, "sample,400,500,600,700\nwhite,1,1,1,1\ngrey,0.2,0.2,0.2,0.2\n").unwrap();
    let file = file.to_str().unwrap();
    let list = json(&["color", file, "--illuminant", "A", "--observer", "10", "--json"]);
    let known = [
        "sample",
        "xyz",
        "xy",
        "lab",
        "chroma",
        "hue_deg",
        "whiteness",
        "tint",
        "whiteness_note",
        "srgb",
        "hex",
        "in_gamut",
    ];
    assert_eq!(keys(&list[0]), known);
    assert_eq!(list[0]["sample"], "white");
    assert!((list[0]["xyz"][1].as_f64().unwrap() - 100.0).abs() < 1e-9, "{}", list[0]);
    // CIE 15 gives 111.14, 100, 35.20 for the white of illuminant A and the 10 degree observer.
    assert!((list[0]["xyz"][0].as_f64().unwrap() - 111.14).abs() < 0.02, "{}", list[0]);
    assert!((list[0]["xyz"][2].as_f64().unwrap() - 35.20).abs() < 0.02, "{}", list[0]);
    assert_eq!(list[0]["hex"], "#ffffff");
    assert!((list[1]["xyz"][1].as_f64().unwrap() - 20.0).abs() < 1e-9, "{}", list[1]);
}

#[test]
fn color_passes_over_other_columns_and_takes_all_spectra_of_a_sample() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("export.csv");
    let text = "sample,L*,comment,backing,400,700\na,-3,dull,white,0.1,0.2\na,-4,,black,0.1,0.2\n";
    std::fs::write(&file, text).unwrap();
    let file = file.to_str().unwrap();
    let list = json(&["color", file, "--sample", "a", "--json"]);
    assert_eq!(list.as_array().unwrap().len(), 2);
    assert_eq!(list[1]["sample"], "a on black");
    let several = impasto(&["color", file, "--compare", "a"]);
    assert!(several.status == 1 && several.err.contains("a on white"), "{}", several.err);
}

#[test]
fn color_tells_differences_and_metamerism() {
    let list = json(&[
        "color",
        &oils(),
        "--sample",
        "09A on white",
        "--sample",
        "10A on white",
        "--compare",
        "10A on white",
        "--illuminant",
        "D65",
        "--illuminant",
        "A",
        "--json",
    ]);
    assert_eq!(list.as_array().unwrap().len(), 4, "two spectra under two lights");
    let difference = &list[0]["difference"];
    assert_eq!(keys(difference), ["from", "ciede2000", "cie1976", "cie94", "cmc_2_1"]);
    assert!(difference["ciede2000"].as_f64().unwrap() > 10.0, "{difference}");
    assert_eq!(list[2]["difference"]["ciede2000"], 0.0);
    // colour-science computes this from the four XYZ with CIEDE2000.
    let index = list[1]["metamerism"]["index"].as_f64().unwrap();
    assert!((index - 4.6387).abs() < 5e-4, "{index}");
    assert_eq!(list[1]["metamerism"]["kind"], "special metamerism index, change of illuminant");
    assert_eq!(list[1]["metamerism"]["change"], "D65 to A");
    assert!(list[0].get("metamerism").is_none(), "the first light is the reference");
}

/// Prints the colours of a file. No line may be wider than 100 columns.
fn color_table(file: &str, options: &[&str]) -> String {
    let run = impasto(&[&["color", file], options].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.lines().all(|line| line.chars().count() <= 100), "{}", run.out);
    run.out
}

#[test]
fn color_shows_the_columns_that_are_asked_for_within_100() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("papers.csv");
    let paper = "paper,0.85,0.97,0.91,0.89,0.89,0.89,0.89";
    let text = format!("sample,400,450,500,550,600,650,700\n{paper}\nochre,.1,.1,.2,.4,.5,.5,.5\n");
    std::fs::write(&path, text).unwrap();
    let file = path.to_str().unwrap();
    let usual = color_table(file, &[]);
    assert!(usual.contains("X       Y       Z") && !usual.contains("C*"), "{usual}");
    let chosen = color_table(file, &["--show", "xyy,lch,whiteness"]);
    for words in ["x       y       Y", "L*      C*       h", "W       T", "-4 < T < 2"] {
        assert!(chosen.contains(words), "{words}: {chosen}");
    }
    let [ochre, paper] =
        ["ochre", "paper"].map(|name| chosen.lines().find(|line| line.starts_with(name)).unwrap());
    assert!(ochre.contains("not white") && !paper.contains("not white"), "{chosen}");
    let lamp = color_table(file, &["--show", "whiteness", "--illuminant", "A"]);
    assert!(lamp.contains("not under A") && !lamp.contains("not white"), "{lamp}");
    let list = json(&["color", file, "--json"]);
    let paper = &list[0];
    let ochre = &list[1];
    assert!(paper["whiteness"].as_f64().unwrap() > 80.0 && paper["tint"].is_f64(), "{paper}");
    assert!(ochre["whiteness"].is_null() && ochre["tint"].is_null(), "{ochre}");
    let note = ochre["whiteness_note"].as_str().unwrap();
    assert!(note.starts_with("not white: W "), "{note}");
    let csv = impasto(&["color", file, "--csv"]).out;
    assert!(
        csv.starts_with(
            "sample,X,Y,Z,x,y,L,a,b,chroma,hue_deg,whiteness,tint,whiteness_note,R,G,B,"
        ),
        "{csv}"
    );
}

#[test]
fn a_perfect_white_has_no_signed_zeros_and_colour_is_color() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("white.csv");
    let grid: String = (40..=70).map(|nm| format!(",{nm}0")).collect();
    std::fs::write(&path, format!("sample{grid}\nwhite{}\n", ",1".repeat(31))).unwrap();
    let file = path.to_str().unwrap();
    for light in ["D65", "C", "A"] {
        let table = impasto(&["colour", file, "--illuminant", light, "--show", "lab,whiteness"]);
        assert!(table.status == 0 && !table.out.contains("-0.00"), "{}{}", table.out, table.err);
    }
    let one = impasto(&["color", &format!("{file}#white")]);
    assert!(one.status == 2 && one.err.contains("--sample \"white\""), "{}", one.err);
}

#[test]
fn a_comparison_keeps_within_100_columns_and_cuts_no_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("papers.csv");
    let long =
        "Cotton rag, cold pressed, 640 g, lot of May, seen from the felt side and then once more";
    let text = format!(
        "sample,400,450,500,550,600,650,700\nochre,.1,.1,.2,.4,.5,.5,.5\n\
         blue,.3,.5,.4,.2,.1,.1,.1\n\"{long}\",.85,.97,.91,.89,.89,.89,.89\n"
    );
    std::fs::write(&path, text).unwrap();
    let file = path.to_str().unwrap();
    let short = color_table(file, &["--compare", "ochre", "--sample", "blue"]);
    let heading = short.lines().nth(1).unwrap();
    assert!(heading.contains("b*  CIEDE2000") && heading.ends_with("display"), "{short}");
    let lights = ["--compare", "ochre", "--illuminant", "D65", "--illuminant", "A"];
    let named = color_table(file, &lights);
    assert_eq!(named.lines().filter(|line| *line == long).count(), 4, "{named}");
    // Each of the two lights has its colours and, below them, the differences.
    let headings: Vec<&str> = named.lines().filter(|line| line.starts_with("sample")).collect();
    assert!(headings[0].ends_with("b*  display") && headings[1].ends_with("CMC2:1"), "{named}");
    assert!(headings[3].ends_with("metamerism D65 to A"), "{named}");
    let ochre: Vec<&str> = named.lines().filter(|line| line.starts_with("ochre")).collect();
    let last = ochre[3].split_whitespace().skip(1).collect::<Vec<_>>();
    assert_eq!(last, ["0.00"; 5], "the standard beside itself: {named}");
}

#[test]
fn mix_prints_its_keys_and_a_masstone_is_its_sample() {
    let mix = json(&["mix", &library(), "viridian=2", "--json"]);
    assert_eq!(
        keys(&mix),
        ["wavelengths_nm", "reflectance", "xyz", "lab", "srgb", "hex", "in_gamut"]
    );
    assert_eq!(mix["wavelengths_nm"].as_array().unwrap().len(), 31);
    // Sample 09A is a film that hides. It reads 6.1 % at 410 nm.
    let at_410 = mix["reflectance"][1].as_f64().unwrap();
    assert!((at_410 - 0.061).abs() < 0.004, "{at_410}");
}

#[test]
fn a_thick_film_hides_and_a_thin_one_shows_its_ground() {
    fn film(thickness: &str, over: &str) -> f64 {
        let film = ["--thickness", thickness, "--over", over, "--json"];
        let mix = json(&[&["mix", &library(), "Viridian=1"], &film[..]].concat());
        mix["reflectance"][10].as_f64().unwrap()
    }
    let hiding = json(&["mix", &library(), "Viridian=1", "--json"]);
    let hiding = hiding["reflectance"][10].as_f64().unwrap();
    assert!((film("1000", "black") - hiding).abs() < 1e-6);
    assert!((film("1000", "white") - hiding).abs() < 1e-6);
    assert!((film("0.000001", "0.5") - 0.5).abs() < 1e-3, "{}", film("0.000001", "0.5"));
    assert!(film("0.2", "white") > film("0.2", "black") + 0.01);
}

#[test]
fn parts_are_shares_so_that_thickness_keeps_its_meaning() {
    let [one, seven] = ["Viridian=1", "Viridian=7"].map(|parts| {
        let mix = json(&["mix", &library(), parts, "--thickness", "0.2", "--json"]);
        mix["reflectance"].clone()
    });
    assert_eq!(one, seven);
}

#[test]
fn a_ground_may_come_from_a_file() {
    let ground = format!("{}#01A bare white", oils());
    let over =
        ["mix", &library(), "Zinc White=1", "--thickness", "0.1", "--over", &ground, "--json"];
    assert!(json(&over)["reflectance"].is_array());
    let missing = format!("{}#99Z", oils());
    let run = impasto(&["mix", &library(), "Zinc White=1", "--thickness", "1", "--over", &missing]);
    assert_eq!(run.status, 1, "{}", run.err);
    assert!(run.err.contains("`99Z`"), "{}", run.err);
}

#[test]
fn a_mixture_with_an_unidentified_pigment_warns() {
    let recipe = ["mix", &library(), "Zinc White=1", "Zinc White (linseed)=1"];
    let run = impasto(&recipe);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.err.contains("warning: Zinc White (linseed)"), "{}", run.err);
    let alone = impasto(&["mix", &library(), "Zinc White (linseed)=1"]);
    assert!(!alone.err.contains("warning"), "its masstone is known: {}", alone.err);
}

#[test]
fn quadrature_prints_its_keys_and_its_error_on_unseen_mixtures() {
    let of_library = ["quadrature", &library(), "--method", "library", "--json", "--seed"];
    let rule = json(&[&of_library[..], &["3"]].concat());
    assert_eq!(keys(&rule), ["nodes_nm", "weights", "error"]);
    assert_eq!(rule["nodes_nm"].as_array().unwrap().len(), 8);
    assert_eq!(rule["weights"][0].as_array().unwrap().len(), 3);
    assert_eq!(keys(&rule["error"]), ["mean", "p95", "max"]);
    assert!(rule["error"]["mean"].as_f64().unwrap() < 0.25, "{}", rule["error"]);
    let other = json(&[&of_library[..], &["4"]].concat());
    assert_eq!(other["nodes_nm"], rule["nodes_nm"], "the seed only selects the unseen mixtures");
    assert_ne!(other["error"], rule["error"]);
    let effective = json(&["quadrature", &library(), "--json"]);
    let [moved, begun] = [&effective, &rule]
        .map(|rule| -> Vec<f64> { serde_json::from_value(rule["nodes_nm"].clone()).unwrap() });
    for (moved, begun) in moved.into_iter().zip(begun) {
        assert!((moved - begun).abs() < 15.0 && moved != begun, "{moved} from {begun}");
    }
    let [error, over_grounds] =
        ["error", "error_over_grounds"].map(|key| effective[key]["mean"].as_f64().unwrap());
    assert!(error < 0.06 && over_grounds < 0.12, "{effective}");
    assert!(over_grounds > error, "{effective}");
    assert_eq!(effective["pigments"][1]["name"], "Zinc White");
    assert_eq!(effective["pigments"][1]["absorption"].as_array().unwrap().len(), 8);
    let paper =
        json(&["quadrature", "--method", "gauss", "-n", "4", "--illuminant", "5600K", "--json"]);
    assert_eq!(paper["nodes_nm"].as_array().unwrap().len(), 4);
    assert!(paper["error"].is_null(), "without a library there is nothing to mix");
}

#[test]
fn library_lists_and_shows() {
    let list = json(&["library", "list", &library(), "--json"]);
    assert_eq!(list.as_array().unwrap().len(), 20);
    assert_eq!(list[1]["name"], "Zinc White");
    let show = json(&["library", "show", &library(), "Cobalt", "--json"]);
    assert_eq!(show["name"], "Cobalt Blue");
    assert_eq!(show["absorption"].as_array().unwrap().len(), 31);
    let white = json(&["library", "show", &library(), "Zinc White", "--json"]);
    assert!(white["scattering"].as_array().unwrap().iter().all(|s| *s == 1.0), "the reference");
}

#[test]
fn absolute_amounts_are_fitted_validated_and_mixed() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("washes.csv");
    std::fs::write(&csv, suite::watercolors::Watercolors::exact().csv()).unwrap();
    let csv = csv.to_str().unwrap();
    let path = folder.path().join("washes.json");
    let path = path.to_str().unwrap();
    let even = ["--amounts", "absolute", "--saunderson", "none", "--json"];
    let fit = json(&[&["fit", csv, "--output", path], even.as_slice()].concat());
    assert!(fit["delta_e"]["max"].as_f64().unwrap() < 0.2, "{}", fit["delta_e"]);
    let found = json(&[&["validate", csv, "--folds", "2"], even.as_slice()].concat());
    assert_eq!(found["samples"], 702);
    // W000 is 0.01 mL of cadmium red on the paper.
    let over = format!("{csv}#bare");
    let mix = json(&["mix", path, "cadmium red=0.01", "--over", &over, "--json"]);
    let on_white = json(&["mix", path, "cadmium red=0.01", "--json"]);
    let white = json(&["mix", path, "cadmium red=0.01", "--over", "white", "--json"]);
    assert_eq!(on_white, white, "the default ground of amounts is white");
    assert_ne!(white, mix);
    let color = json(&["color", csv, "--sample", "W000", "--json"]);
    for channel in 0..3 {
        let a = &mix["lab"][channel];
        let b = &color[0]["lab"][channel];
        assert!((a.as_f64().unwrap() - b.as_f64().unwrap()).abs() < 0.1, "{a} {b}");
    }
}

#[test]
fn lamps_are_described_by_name_and_by_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bulb.csv");
    // A black body of 2700 K, measured at steps of 10 nm.
    let lines = (36..=83).map(|ten| {
        let nm = f64::from(ten * 10);
        let power = (560.0 / nm).powi(5) / (1.4388e7 / (nm * 2700.0)).exp_m1();
        format!("{nm},{power:e}\n")
    });
    std::fs::write(&path, "nm,power\n".to_owned() + &lines.collect::<String>()).unwrap();
    let bulb = path.to_str().unwrap();
    let run = impasto(&["light", "FL11", bulb, "FL2", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    let number = |at: usize, key: &str| json[at][key].as_f64().unwrap();
    assert!(
        (number(0, "ra") - 82.9).abs() < 0.1 && (number(0, "rf") - 80.15).abs() < 0.1,
        "{json}"
    );
    assert!((number(1, "kelvin") - 2700.0).abs() < 1.0, "{}", json[1]);
    assert!(number(1, "ra") > 99.9 && number(1, "rf") > 99.9 && number(1, "rg") > 99.8);
    assert_eq!(json[1]["light"], bulb);
    assert_eq!(json[2]["special"].as_array().unwrap().len(), 14);
    assert_eq!(json[2]["samples"].as_array().unwrap().len(), 99);
    // R9 of the tube FL2 is below 0, so reds look brown.
    assert!(json[2]["special"][8].as_f64().unwrap() < 0.0, "{}", json[2]["special"]);
}

#[test]
fn the_table_has_the_figures_of_a_lamp_and_all_samples_on_demand() {
    let table = impasto(&["light", "A", "FL11", "LED-B3"]).out;
    let line = table.lines().find(|line| line.starts_with("FL11")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(cells[..4], ["FL11", "0.3805", "0.3771", "4001"], "{table}");
    for words in ["CCT, K", "Duv", "Ra", "R9", "Rf", "Rg"] {
        assert!(table.lines().next().unwrap().contains(words), "{words}: {table}");
    }
    assert!(!table.contains("R14") && table.lines().count() == 4, "{table}");
    let all = impasto(&["light", "FL11", "--samples"]).out;
    assert!(all.contains("R14") && all.contains("Rf, hue"), "{all}");
    assert!(all.lines().all(|line| line.chars().count() <= 100), "{all}");
    let csv = impasto(&["light", "FL11", "--csv"]).out;
    let heading = csv.lines().next().unwrap();
    assert!(heading.starts_with("light,kelvin,duv,x,y,ra,R1,R2,"), "{heading}");
    assert!(heading.contains(",R13,R14,distance_from_reference,"), "{heading}");
    assert!(heading.contains(",rf,rg,Rf_hue_1,Rf_hue_2,"), "{heading}");
    assert!(heading.ends_with("Rf_hue_16"), "{heading}");
}

#[test]
fn lights_without_colour_rendering_are_refused_or_marked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("green.csv");
    std::fs::write(&path, "nm,power\n400,0\n500,0\n530,1\n560,0\n700,0\n").unwrap();
    let green = impasto(&["light", path.to_str().unwrap()]);
    assert!(green.status == 1 && green.out.is_empty(), "{}", green.out);
    assert!(
        green.err.contains("not a white light") && green.err.contains("hint: "),
        "{}",
        green.err
    );
    let unknown = impasto(&["light", "F11"]);
    assert!(unknown.status == 2 && unknown.err.contains("did you mean FL11?"), "{}", unknown.err);
    let far = impasto(&["light", "FL3.3", "HP1", "LED-V1"]).out;
    let marked = ["FL3.3", "HP1", "LED-V1"]
        .map(|name| far.lines().find(|l| l.starts_with(name)).unwrap().ends_with('*'));
    assert_eq!(marked, [true, false, false], "{far}");
    assert!(far.lines().last().unwrap().starts_with("* farther than 0.0054"), "{far}");
}

#[test]
fn the_shipped_library_is_what_the_demo_makes_byte_for_byte() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("deep/out");
    let run = impasto(&["demo", "--out", out.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.err);
    let made = std::fs::read_to_string(out.join("van-gogh-oils.pigments.json")).unwrap();
    let shipped = repository("measurements/van-gogh-oils.pigments.json");
    let same = std::fs::read_to_string(shipped).unwrap() == made;
    assert!(same, "to renew it: cargo run --release -- demo --out measurements");
}

#[test]
fn the_demo_shows_pigments_errors_findings_and_mixtures() {
    let folder = tempfile::tempdir().unwrap();
    let run = impasto(&["demo", "--out", folder.path().to_str().unwrap()]);
    for word in ["Viridian", "colour error: mean", "not identified", "a sky", "#"] {
        assert!(run.out.contains(word), "`{word}` is missing: {}", run.out);
    }
    assert!(!run.out.contains('\x1b'), "no colour codes where there is no terminal");
    assert!(run.err.contains("Wrote "), "{}", run.err);
}

#[test]
fn the_library_records_its_input() {
    let text = std::fs::read(repository("measurements/van-gogh-oils.csv")).unwrap();
    let library =
        std::fs::read_to_string(repository("measurements/van-gogh-oils.pigments.json")).unwrap();
    let library: Value = serde_json::from_str(&library).unwrap();
    let recorded = library["inputs"][0]["sha256"].as_str().unwrap();
    // A fit of the same bytes records the same hash, and a fit of other bytes records another one.
    let folder = tempfile::tempdir().unwrap();
    let hashes = [text.clone(), [text, b"\n".to_vec()].concat()].map(|bytes| {
        let [csv, out] = ["a.csv", "a.json"].map(|name| folder.path().join(name));
        std::fs::write(&csv, bytes).unwrap();
        let run = impasto(&["fit", csv.to_str().unwrap(), "--output", out.to_str().unwrap()]);
        assert_eq!(run.status, 0, "{}", run.err);
        let text = std::fs::read_to_string(out).unwrap();
        let library: Value = serde_json::from_str(&text).unwrap();
        library["inputs"][0]["sha256"].as_str().unwrap().to_owned()
    });
    assert_eq!(hashes[0], recorded);
    assert_ne!(hashes[1], recorded);
}
