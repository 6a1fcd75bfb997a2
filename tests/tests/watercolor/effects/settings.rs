//! Settings of watercolour: presets, TOML files and their errors, scaling to a picture.

use std::collections::BTreeSet;

use documents::hint::{Explain, Fault};
use watercolor::{Preset, Settings};

/// `group.key` of every key, and whether a comment is on the line above it. Includes keys that
/// are commented out.
fn keys(text: &str) -> Vec<(String, bool)> {
    let mut group = String::new();
    let mut found = Vec::new();
    let mut above = "";
    for line in text.lines() {
        if let Some(header) = line.strip_prefix('[') {
            group = format!("{}.", header.split(']').next().unwrap());
        }
        let shown = line.strip_prefix("# ").filter(|rest| rest.contains(" = \""));
        if let Some((key, _)) = shown.unwrap_or(line).split_once(" = ")
            && (shown.is_some() || !line.starts_with('#'))
        {
            found.push((format!("{group}{key}"), above.starts_with("# ")));
        }
        above = line;
    }
    found
}

#[test]
fn presets_are_read_and_tell_of_every_key() {
    // All keys, including those without a default value.
    let mut settings = Settings::default();
    settings.paper.scan = Some("x".to_owned());
    settings.toon.greys = Some("x".to_owned());
    settings.dry_brush.color = Some("x".to_owned());
    let all = keys(&toml::to_string(&settings).unwrap());
    let all: BTreeSet<String> = all.into_iter().map(|(key, _)| key).collect();
    assert!(all.contains("paper.scan") && all.contains("reference_px") && all.len() > 40);
    let mut seen = vec![Settings::default()];
    for preset in Preset::ALL {
        let settings = preset.settings();
        assert!(!seen.contains(&settings), "{preset:?} equals another preset");
        seen.push(settings);
        let found = keys(&preset.text());
        for (key, documented) in &found {
            assert!(documented, "{preset:?}: no comment above {key}");
        }
        let found: BTreeSet<String> = found.into_iter().map(|(key, _)| key).collect();
        assert_eq!(found, all, "{preset:?}");
        assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
    }
    let error = "oil".parse::<Preset>().unwrap_err();
    assert_eq!(error.to_string(), "there is no preset `oil`");
    assert!(error.hint().unwrap().to_string().contains("portrait, landscape, sketch"));
}

#[test]
fn what_a_file_leaves_out_is_usual() {
    let read = Settings::from_toml("a.toml", "[edges]\nstrength = 4\n").unwrap();
    let mut wanted = Settings::default();
    wanted.edges.strength = 4.0;
    assert_eq!(read, wanted);
    assert_eq!(Settings::from_toml("a.toml", "").unwrap(), Settings::default());
    let written = toml::to_string(&wanted).unwrap();
    assert_eq!(Settings::from_toml("a.toml", &written).unwrap(), wanted);
}

#[test]
fn broken_files_are_told_by_line_and_key() {
    for (text, told) in [
        ("[edges]\n\nstrenght = 4.0", "a.toml, line 3: edges.strenght: unknown key `strenght`"),
        ("\n[edge]\nstrength = 4.0", "a.toml, line 2: edge: unknown key `edge`"),
        (
            "[edges]\nstrength = \"much\"",
            "a.toml, line 2: edges.strength: invalid type: text \"much\"",
        ),
        ("[flow]\nstrength = 1\nstrength = 2", "a.toml, line 3: duplicate key"),
        ("[flow\nstrength = 1", "a.toml, line 1: "),
        ("[flow]\noctaves = 2.5", "a.toml, line 2: flow.octaves: invalid type: number `2.5`"),
        ("[flow]\nseed = -1", "a.toml, line 2: flow.seed: invalid value: number `-1`"),
        ("[paper]\nkind = \"glossy\"", "a.toml, line 2: paper.kind: unknown word `glossy`"),
        (
            "[flow]\n\noctaves = 9",
            "a.toml, line 3: flow.octaves takes a whole number from 1 to 8, found `9`",
        ),
        (
            "[wobble]\namount_px = -0.1",
            "a.toml, line 2: wobble.amount_px takes 0 to 50, found `-0.1`",
        ),
        ("reference_px = nan", "a.toml, line 1: reference_px takes 16 to 65536, found `NaN`"),
        ("dry_brush.amount = inf", "a.toml, line 1: dry_brush.amount takes 0 to 1, found `inf`"),
        (
            "paper = {grain_px = 1e9}",
            "a.toml, line 1: paper.grain_px takes 1 to 512, found `1000000000`",
        ),
        (
            "[paper]\ncolour = \"white\"",
            "a.toml, line 2: paper.colour takes a colour written #rrggbb, found `white`",
        ),
        (
            "[dry_brush]\ncolour = \"#12345\"",
            "a.toml, line 2: dry_brush.colour takes a colour written #rrggbb",
        ),
        ("\u{feff}[flow]\nseed = 9", ""),
    ] {
        let read = Settings::from_toml("a.toml", text);
        if told.is_empty() {
            assert_eq!(read.unwrap().flow.seed, 9, "{text}");
            continue;
        }
        let error = read.unwrap_err();
        assert!(error.to_string().starts_with(told), "{text}: {error}");
        assert!(error.hint().is_some(), "{text}");
    }
    let missing = Settings::open(std::path::Path::new("no/such.toml")).unwrap_err();
    assert!(missing.to_string().starts_with("no/such.toml"), "{missing}");
    assert!(missing.hint().is_some() && missing.fault() == Fault::Environment);
}

#[test]
fn lengths_follow_the_picture_once() {
    let settings = Settings::default();
    let double = settings.for_size(1500, 2000);
    assert_eq!(double.reference_px, 2000.0);
    assert_eq!(double.wobble.amount_px, 2.0 * settings.wobble.amount_px);
    assert_eq!(double.paper.grain_px, 2.0 * settings.paper.grain_px);
    let area = settings.abstraction.least_region_px;
    assert_eq!(double.abstraction.least_region_px, 4.0 * area);
    assert_eq!(double.edges.strength, settings.edges.strength);
    assert_eq!(double.for_size(1500, 2000), double);
}
