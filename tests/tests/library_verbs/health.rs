//! `impasto library check` and `diff`: doubtful data, faults, and differences of two libraries.

use serde_json::Value;

use crate::{Shelf, done, oils, refused, tried};

fn warnings(path: &str) -> String {
    done(&["check", path, "--json"]).json()["warnings"].to_string()
}

#[test]
fn the_oils_are_sound_with_known_doubts() {
    let found = done(&["check", &oils(), "--json"]).json();
    assert_eq!(found["faults"], Value::Array(vec![]));
    assert_eq!(found["evidence"]["worst"][0]["sample"], "17D");
    let warnings = found["warnings"].to_string();
    for word in ["Bone Black", "Zinc White (linseed)", "as dark as the surface"] {
        assert!(warnings.contains(word), "{word}: {warnings}");
    }
    assert!(!warnings.contains("licence") && !warnings.contains("jumps"), "{warnings}");
    let text = done(&["check", &oils()]).out;
    assert!(text.contains("worst samples: 17D (5.85)") && text.contains("warning: "), "{text}");
}

#[test]
fn what_was_made_doubtful_is_found() {
    let shelf = Shelf::new();
    let doubtful = shelf.changed("doubtful.json", &oils(), |library| {
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
        "K is known to 1",
        "no evidence",
    ] {
        assert!(found.contains(words), "{words}: {found}");
    }
    let narrow = shelf.path("narrow.json");
    done(&["convert", &oils(), "--grid", "450,650,25", "--output", &narrow]);
    let found = warnings(&narrow);
    assert!(found.contains("leaves out") && found.contains("coarse"), "{found}");
}

#[test]
fn a_faulty_library_ends_with_status_one() {
    let shelf = Shelf::new();
    let faulty = shelf.changed("faulty.json", &oils(), |library| {
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
    let none = shelf.path("none.json");
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
    let shelf = Shelf::new();
    let batch = shelf.changed("batch.json", &oils(), |library| {
        let cobalt = library.find("Cobalt").unwrap();
        // Half of both K and S leaves the masstone unchanged but halves the strength in mixtures.
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
    let shelf = Shelf::new();
    let fine = shelf.path("fine.json");
    let grid = ["--grid", "400,700,5", "--interpolation", "sprague"];
    done(&[&["convert", &oils()][..], &grid, &["--output", &fine]].concat());
    done(&["diff", &oils(), &fine, "--tolerance", "0.05"]);
    let narrow = shelf.path("narrow.json");
    done(&["convert", &oils(), "--grid", "420,680,10", "--output", &narrow]);
    let run = tried(&["diff", &oils(), &narrow, "--tolerance", "0.001"]);
    assert_eq!(run.status, 1, "{}", run.err);
}
