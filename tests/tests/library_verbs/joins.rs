//! `impasto library merge`, `convert`, `rename` and `subset` preserve the colours of mixtures. `check` and
//! `diff` report doubtful data, faults, and differences of two libraries.

use calibrate::library::{AmountKind, Pigment};
use serde_json::Value;
use suite::golden::assert_near;

use crate::{LibraryFolder, done, furthest, oils, read, refused, text, tried};

/// Largest change of a reflectance when K and S are rounded to six digits.
const ROUNDING: f64 = 1e-5;

#[test]
fn another_reference_keeps_every_mixture_and_back_is_the_same() {
    let folder = LibraryFolder::new();
    let lead = folder.path("lead.json");
    let back = folder.path("back.json");
    let run = done(&["convert", &oils(), "--reference", "Lead White", "--output", &lead]);
    assert!(run.err.contains("thickness of others is now relative to Lead White"), "{}", run.err);
    let first = read(&oils());
    let other = read(&lead);
    assert_eq!(other.reference.as_deref(), Some("Lead White"));
    let white = &other[other.find("Lead White").unwrap()];
    assert!(white.scattering.iter().all(|s| *s == 1.0), "{:?}", white.scattering);
    assert!(white.scattering_sd.iter().all(|s| *s == 0.0), "known by definition");
    assert_ne!(first.pigments[4].absorption, other.pigments[4].absorption);
    assert!(furthest(&first, &other) < ROUNDING, "{}", furthest(&first, &other));
    done(&["convert", &lead, "--reference", "Zinc White", "--output", &back]);
    for (a, b) in first.pigments.iter().zip(&read(&back).pigments) {
        for (a, b) in curves(a).into_iter().zip(curves(b)) {
            let ratios: Vec<f64> =
                (a.1.iter().zip(b.1)).map(|(a, b)| if a == b { 1.0 } else { a / b }).collect();
            assert_near(a.0, &ratios, &vec![1.0; ratios.len()], 2e-5);
        }
    }
}

fn curves(pigment: &Pigment) -> [(String, &Vec<f64>); 4] {
    [
        (format!("K of {}", pigment.name), &pigment.absorption),
        (format!("S of {}", pigment.name), &pigment.scattering),
        (format!("sd of K of {}", pigment.name), &pigment.absorption_sd),
        (format!("sd of S of {}", pigment.name), &pigment.scattering_sd),
    ]
}

#[test]
fn a_merged_library_mixes_as_its_sources_do() {
    let folder = LibraryFolder::new();
    let blues = folder.path("blues.json");
    let reds = folder.path("reds.json");
    let scaled = folder.path("scaled.json");
    done(&["subset", &oils(), "Zinc White", "Cobalt", "Ultramarine", "--output", &blues]);
    // The second library is relative to lead white and has another name for zinc white.
    done(&[
        "subset",
        &oils(),
        "Zinc White",
        "Lead White",
        "Vermilion",
        "Minium",
        "--output",
        &reds,
    ]);
    done(&["convert", &reds, "--reference", "Lead White", "--output", &scaled]);
    let other = folder.path("other.json");
    done(&["rename", &scaled, "Zinc White=Snow", "--output", &other]);
    let merged = folder.path("merged.json");
    refused(&["merge", &blues, &other, "--output", &merged], 1, &["Zinc White", "--as NAME"]);
    let run = done(&["merge", &blues, &other, "--as", "Snow", "--output", &merged, "--json"]);
    let said = run.json();
    assert_eq!(said["common"][0]["name"], "Zinc White");
    assert!(said["common"][0]["masstone_ciede2000"].as_f64().unwrap() < 1e-3, "{said}");
    let library = read(&merged);
    assert_eq!(library.pigments.len(), 6);
    assert_eq!(library.inputs.len(), 1, "the same file twice is one input");
    assert_eq!(library.licence, "CC0 1.0", "the same licence twice is one");
    assert!(library.evidence.is_none() && library.pigments[0].notes[0].contains("off by 1.39"));
    assert!(
        furthest(&read(&oils()), &library) < ROUNDING,
        "{}",
        furthest(&read(&oils()), &library)
    );
    let again = folder.path("again.json");
    done(&["merge", &blues, &other, "--as", "Snow", "--output", &again]);
    assert_eq!(text(&merged), text(&again), "a rerun is byte-equal");
}

#[test]
fn two_pigments_of_one_name_need_a_choice() {
    let folder = LibraryFolder::new();
    let batch = folder.changed("batch.json", &oils(), |library| {
        let viridian = library.find("Viridian").unwrap();
        library[viridian].absorption.iter_mut().for_each(|k| *k *= 1.5);
        library.licence = "CC BY 4.0".into();
    });
    let merged = folder.path("merged.json");
    let clash = ["merge", &oils(), &batch, "--output", &merged];
    refused(&clash, 1, &["`Viridian`", "--prefer first", "library rename"]);
    assert!(!std::path::Path::new(&merged).exists(), "nothing half written");
    fn k(path: &str) -> f64 {
        read(path)[read(path).find("Viridian").unwrap()].absorption[0]
    }
    done(&[&clash[..], &["--prefer", "first"]].concat());
    assert_eq!(k(&merged), k(&oils()));
    done(&[&clash[..], &["--prefer", "last"]].concat());
    assert_eq!(k(&merged), k(&batch));
    assert_eq!(read(&merged).pigments.len(), 20, "identical pigments are merged");
    assert_eq!(read(&merged).licence, "CC0 1.0; CC BY 4.0");
}

#[test]
fn what_does_not_fit_together_is_refused_with_its_reason() {
    let folder = LibraryFolder::new();
    let merged = folder.path("merged.json");
    let end = ["--output", &merged];
    let refuse = |other: &str, words: &[&str]| {
        refused(&[&["merge", &oils(), other], &end[..]].concat(), 1, words);
    };
    let surface = folder.changed("surface.json", &oils(), |library| library.saunderson.k1 = 0.02);
    refuse(&surface, &["the surface differs", "k1 = 0.02", "--any-surface"]);
    let run = done(&[&["merge", &oils(), &surface], &end[..], &["--any-surface"]].concat());
    assert!(run.err.contains("do not hold under the first's"), "{}", run.err);
    let amounts = folder.changed("amounts.json", &oils(), |library| {
        library.amounts = AmountKind::Absolute;
        library.reference = None;
    });
    refuse(&amounts, &["absolute", "relative", "library convert"]);
    let narrow = folder.path("narrow.json");
    done(&["convert", &oils(), "--grid", "420,680,10", "--output", &narrow]);
    refuse(&narrow, &["400", "--hold-ends"]);
    refused(
        &["merge", &amounts, &amounts, "--output", &merged],
        1,
        &["unit of amount", "--same-unit"],
    );
    let alone = tried(&["merge", &oils(), "--output", &merged]);
    assert!(alone.status == 2 && alone.err.contains("2 values required"), "{}", alone.err);
}

#[test]
fn amounts_become_shares_of_the_same_colors() {
    let folder = LibraryFolder::new();
    let washes = folder.changed("washes.json", &oils(), |library| {
        library.amounts = AmountKind::Absolute;
        library.reference = None;
        library.unevenness = 0.3;
        for pigment in &mut library.pigments {
            pigment.identified = true;
            pigment.absorption.iter_mut().for_each(|k| *k *= 40.0);
            pigment.scattering.iter_mut().for_each(|s| *s *= 40.0);
        }
    });
    let shares = folder.path("shares.json");
    let run = done(&["convert", &washes, "--reference", "lead white", "--output", &shares]);
    assert!(run.err.contains("amounts became shares"), "{}", run.err);
    let before = read(&washes);
    let after = read(&shares);
    assert_eq!((after.amounts, after.unevenness), (AmountKind::Relative, 0.0));
    assert!(after.evidence.is_none() && furthest(&before, &after) < ROUNDING);
}

#[test]
fn other_wavelengths_keep_the_values_they_share() {
    let folder = LibraryFolder::new();
    let fine = folder.path("fine.json");
    let back = folder.path("back.json");
    let run = done(&["convert", &oils(), "--grid", "400,700,5", "--output", &fine]);
    assert!(run.err.contains("steps of 5 nm"), "{}", run.err);
    assert_eq!(read(&fine).grid.count(), 61);
    done(&["convert", &fine, "--grid", "400,700,10", "--output", &back]);
    assert_eq!(read(&back).pigments, read(&oils()).pigments);
    let warnings = read(&back).evidence.unwrap().warnings;
    assert!(warnings.last().unwrap().contains("brought to 400 to 700 nm"), "{warnings:?}");
    let wrong = ["convert", &oils(), "--grid", "380,730,10", "--output", &fine];
    refused(&wrong, 1, &["`380` nm", "--hold-ends"]);
    done(&[&wrong[..], &["--hold-ends"]].concat());
    for grid in ["400,700", "400,700,0", "700,400,10", "400,705,10", "a,b,c", "400,700,nan"] {
        refused(&["convert", &oils(), "--grid", grid, "--output", &back], 2, &[grid]);
    }
}

#[test]
fn a_library_on_other_wavelengths_joins_with_a_warning() {
    let folder = LibraryFolder::new();
    let fine = folder.path("fine.json");
    let merged = folder.path("merged.json");
    done(&["convert", &oils(), "--grid", "400,700,5", "--output", &fine]);
    let run = done(&["merge", &oils(), &fine, "--output", &merged]);
    assert!(run.err.contains("to 400 to 700 nm in steps of 10 nm (sprague)"), "{}", run.err);
    assert_eq!(read(&merged).pigments.len(), 20, "the same figures at the same wavelengths");
    let coarse = folder.path("coarse.json");
    let [sprague, linear] = ["sprague", "linear"].map(|method| {
        done(&["convert", &oils(), "--grid", "400,700,20", "--output", &coarse]);
        let more = ["--grid", "400,700,10", "--interpolation", method, "--output", &fine];
        done(&[&["convert", &coarse][..], &more].concat());
        let found = tried(&["diff", &oils(), &fine, "--json"]).json();
        let pairs = found["lights"][0]["pairs"].as_array().unwrap();
        pairs.iter().map(|pair| pair["ciede2000"].as_f64().unwrap()).sum::<f64>()
    });
    assert!(sprague < 0.5 * linear, "{sprague} {linear}");
    let few = ["convert", &oils(), "--grid", "400,700,100", "--output", &coarse];
    done(&few);
    let more = ["--grid", "400,700,10", "--interpolation", "sprague", "--output", &fine];
    refused(&[&["convert", &coarse][..], &more].concat(), 1, &["needs 6", "linear"]);
}

#[test]
fn renaming_changes_names_alone() {
    let folder = LibraryFolder::new();
    let there = folder.path("there.json");
    let back = folder.path("back.json");
    let names = ["Zinc White=Lead White", "Lead White=Zinc White", "Viridian=PG18 = green"];
    done(&[&["rename", &oils()][..], &names, &["--output", &there]].concat());
    let exchanged = read(&there);
    assert_eq!(exchanged.reference.as_deref(), Some("Lead White"), "the reference is renamed too");
    assert!(exchanged.find("PG18 = green").is_ok(), "a name may hold an equals sign");
    assert!(exchanged.pigments[1].scattering.iter().all(|s| *s == 1.0));
    let names = ["Zinc White=Lead White", "Lead White=Zinc White", "PG18=Viridian"];
    done(&[&["rename", &there][..], &names, &["--output", &back]].concat());
    assert_eq!(text(&back), text(&oils()), "renaming back restores the file");
    let index = ["--colour-index", "Ultramarine=PB29"];
    done(&[&["rename", &oils()][..], &index, &["--output", &there]].concat());
    assert_eq!(read(&there).pigments[14].color_index.as_deref(), Some("PB29"));
    let none = ["--colour-index", "Ultramarine="];
    done(&[&["rename", &there][..], &none, &["--output", &back]].concat());
    assert_eq!(text(&back), text(&oils()));
    let taken = ["rename", &oils(), "Viridian=Zinc White", "--output", &there];
    refused(&taken, 1, &["`Zinc White`"]);
    refused(&["rename", &oils(), "Viridian", "--output", &there], 2, &["`Viridian`"]);
    refused(&["rename", &oils(), "Nothing=X", "--output", &there], 1, &["`Nothing`", "Viridian"]);
}

#[test]
fn a_subset_keeps_figures_and_says_whose_errors_it_tells() {
    let folder = LibraryFolder::new();
    let few = folder.path("few.json");
    refused(
        &["subset", &oils(), "Viridian", "Cobalt", "--output", &few],
        1,
        &["`Zinc White` would be left out", "--white"],
    );
    done(&["subset", &oils(), "--without", "Viridian", "--without", "Minium", "--output", &few]);
    let all = read(&oils());
    let left = read(&few);
    assert_eq!(left.pigments.len(), 18);
    for pigment in &left.pigments {
        assert!(all.pigments.contains(pigment), "{} changed", pigment.name);
    }
    let evidence = left.evidence.unwrap();
    assert_eq!(evidence.delta_e, all.evidence.as_ref().unwrap().delta_e);
    assert!(evidence.per_sample.is_empty());
    assert!(evidence.warnings.last().unwrap().starts_with("18 of 20 pigments"));
    let other = ["subset", &oils(), "Viridian", "Lead", "--reference", "Lead", "--output", &few];
    done(&other);
    assert_eq!(read(&few).reference.as_deref(), Some("Lead White"));
    assert!(furthest(&all, &read(&few)) < ROUNDING, "{}", furthest(&all, &read(&few)));
    refused(
        &["subset", &oils(), "Viridian", "--without", "Viridian", "--output", &few],
        1,
        &["no pigment"],
    );
}

fn warnings(path: &str) -> String {
    done(&["check", path, "--json"]).json()["warnings"].to_string()
}

#[test]
fn the_oils_are_sound_with_known_doubts() {
    let found = done(&["check", &oils(), "--json"]).json();
    assert_eq!(found["faults"], Value::Array(vec![]));
    assert_eq!(found["evidence"]["worst"][0]["sample"], "17D");
    let warnings = found["warnings"].to_string();
    for word in ["Zinc White (linseed)", "Chrome Yellow (poppyseed)"] {
        assert!(warnings.contains(word), "{word}: {warnings}");
    }
    assert!(!warnings.contains("licence") && !warnings.contains("jumps"), "{warnings}");
    let text = done(&["check", &oils()]).out;
    assert!(text.contains("worst samples: 17D (5.88)") && text.contains("warning: "), "{text}");
}

#[test]
fn two_default_fits_are_merged_with_the_surface_of_one_of_them() {
    let folder = LibraryFolder::new();
    let [all, light, both] = ["all.json", "light.json", "both.json"].map(|name| folder.path(name));
    let readings = suite::program::repository("measurements/van-gogh-oils.csv");
    let fit = |more: &[&str], output: &str| {
        let method = ["--method", "weighted", "--white", "Zinc White", "--output", output];
        suite::program::impasto(&[&["fit", &readings], &method[..], more].concat())
    };
    // Without the darkest paint another k1 suffices.
    assert_eq!(fit(&[], &all).status, 0);
    assert_eq!(fit(&["--exclude", "11A"], &light).status, 0);
    let merge = ["merge", &all, &light, "--prefer", "first", "--output", &both];
    refused(&merge, 1, &["the surface differs", &format!("fit {light} again"), "--surface-of"]);
    let run = fit(&["--exclude", "11A", "--surface-of", &all], &light);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(read(&light).saunderson, read(&all).saunderson);
    done(&merge);
    let twice = fit(&["--surface-of", &all, "--saunderson", "0.03,0.6"], &light);
    assert_eq!(twice.status, 2, "{}", twice.err);
    // A fit whose options state nothing is told.
    let found = warnings(&light);
    for words in ["no licence is stated", "no source is stated", "geometry of the instrument"] {
        assert!(found.contains(words), "{words}: {found}");
    }
}

#[test]
fn what_was_made_doubtful_is_found() {
    let folder = LibraryFolder::new();
    let doubtful = folder.changed("doubtful.json", &oils(), |library| {
        library.licence = " ".into();
        library.source = String::new();
        let viridian = library.find("Viridian").unwrap();
        library[viridian].scattering[12] *= 2.0;
        library[viridian].absorption[3] = 0.0;
        let mut twin = library.pigments[6].clone();
        twin.name = "Red lead".into();
        twin.absorption_sd.iter_mut().for_each(|sd| *sd *= 20.0);
        library.pigments.push(twin);
        let mut near = library.pigments[7].clone();
        near.name = "vermilion".into();
        near.guessed = true;
        library.pigments.push(near);
        library.evidence = None;
    });
    let found = warnings(&doubtful);
    for words in [
        "no licence",
        "no source",
        "S jumps at 520 nm",
        "K is 0 at 1 of 31",
        "K jumps at 430 nm",
        "the same figures as Minium",
        "spelled almost as Vermilion",
        "guessed from a colour",
        "K is uncertain by 1",
        "no evidence",
    ] {
        assert!(found.contains(words), "{words}: {found}");
    }
    let narrow = folder.path("narrow.json");
    done(&["convert", &oils(), "--grid", "450,650,25", "--output", &narrow]);
    let found = warnings(&narrow);
    assert!(found.contains("leaves out") && found.contains("coarse"), "{found}");
}

#[test]
fn a_faulty_library_ends_with_status_one() {
    let folder = LibraryFolder::new();
    let faulty = folder.changed("faulty.json", &oils(), |library| {
        let white = library.find("Zinc White").unwrap();
        library[white].scattering[5] = 1.25;
        library.pigments[0].scattering[7] = 0.0;
        library.pigments[0].absorption[7] = 0.0;
    });
    let run = tried(&["check", &faulty, "--json"]);
    assert_eq!(run.status, 1, "{}", run.err);
    let faults = run.json()["faults"].to_string();
    assert!(faults.contains("is 1.25 at 450 nm"), "{faults}");
    assert!(faults.contains("K and S are both 0 at 470 nm"), "{faults}");
    let none = folder.path("none.json");
    std::fs::write(&none, "[]").unwrap();
    refused(&["check", &none], 1, &["none.json"]);
}

#[test]
fn a_library_does_not_differ_from_itself() {
    let arguments = ["diff", &oils(), &oils(), "--tolerance", "0", "--json"];
    let found = done(&arguments).json();
    assert_eq!(found["lights"][0]["largest"], 0.0);
    assert_eq!(found["lights"][0]["pigments"].as_array().unwrap().len(), 20);
    assert_eq!(found["lights"][0]["pairs"].as_array().unwrap().len(), 100);
    assert!(found["lights"][0]["pigments"][8]["tint"].is_null(), "S of the linseed white");
    assert_eq!(found["passed"], true);
}

#[test]
fn a_batch_that_differs_is_told_and_fails() {
    let folder = LibraryFolder::new();
    let batch = folder.changed("batch.json", &oils(), |library| {
        let cobalt = library.find("Cobalt").unwrap();
        // If both K and S are halved, the masstone stays, but the pigment is half as strong in
        // mixtures.
        for curve in [0, 1] {
            let pigment = &mut library[cobalt];
            let curve = [&mut pigment.absorption, &mut pigment.scattering].into_iter().nth(curve);
            curve.unwrap().iter_mut().for_each(|v| *v *= 0.5);
        }
        library.pigments.retain(|pigment| pigment.name != "Minium");
    });
    let arguments = ["diff", &oils(), &batch, "--illuminant", "D65", "--illuminant", "A", "--json"];
    let run = tried(&arguments);
    assert_eq!(run.status, 1, "{}", run.err);
    let found = run.json();
    assert_eq!(found["only_first"][0], "Minium");
    for light in found["lights"].as_array().unwrap() {
        let cobalt = light["pigments"].as_array().unwrap();
        let cobalt = cobalt.iter().find(|p| p["name"] == "Cobalt Blue").unwrap();
        assert!(cobalt["masstone"].as_f64().unwrap() < 1e-9, "{cobalt}");
        assert!(cobalt["tint"].as_f64().unwrap() > 3.0, "{cobalt}");
        let viridian = &light["pigments"].as_array().unwrap()[9];
        assert_eq!(viridian["tint"], 0.0, "{viridian}");
    }
    assert_ne!(found["lights"][0]["largest"], found["lights"][1]["largest"]);
    done(&[&arguments[..], &["--tolerance", "30"]].concat());
    assert!(run.err.contains("the tolerance is `1`"), "{}", run.err);
}

#[test]
fn libraries_on_two_grids_are_each_seen_on_their_own() {
    let folder = LibraryFolder::new();
    let fine = folder.path("fine.json");
    let grid = ["--grid", "400,700,5", "--interpolation", "sprague"];
    done(&[&["convert", &oils()][..], &grid, &["--output", &fine]].concat());
    done(&["diff", &oils(), &fine, "--tolerance", "0.05"]);
    let narrow = folder.path("narrow.json");
    done(&["convert", &oils(), "--grid", "420,680,10", "--output", &narrow]);
    let run = tried(&["diff", &oils(), &narrow, "--tolerance", "0.001"]);
    assert_eq!(run.status, 1, "{}", run.err);
}

#[test]
fn pigments_are_named_by_colour_index_and_by_words() {
    let folder = LibraryFolder::new();
    let few = folder.path("few.json");
    let stated = folder.path("stated.json");
    done(&["rename", &oils(), "--colour-index", "Eosin Lake=PR90:1", "--output", &stated]);
    for (name, wanted) in [
        ("PB29", "Ultramarine"),
        ("Pigment Blue 27", "Prussian Blue"),
        ("sulphate", "Barium Sulphate"),
        ("PR90", "Eosin Lake"),
    ] {
        done(&["subset", &stated, "Zinc White", name, "--output", &few]);
        assert!(read(&few).pigments.iter().any(|pigment| pigment.name == wanted), "{name}");
    }
    for (name, words) in [
        ("blue", &["Cobalt Blue, Ultramarine or Prussian Blue"][..]),
        ("PW6", &["`PW6`", "titanium white"]),
        ("ultramarin blue", &["did you mean Ultramarine?"]),
        ("sulfate", &["did you mean Barium Sulphate?"]),
    ] {
        refused(&["subset", &stated, "Zinc White", name, "--output", &few], 1, words);
    }
}
