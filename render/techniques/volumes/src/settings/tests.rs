//! Settings: ranges, changes, presets.

use documents::hint::Explain;
use toml::{Table, Value};

use super::{Preset, Settings, Takes};

/// Every key of a table of TOML, with its group.
fn keys(table: &Table) -> Vec<String> {
    let mut keys = Vec::new();
    for (key, value) in table {
        match value {
            Value::Table(group) => keys.extend(group.keys().map(|inner| format!("{key}.{inner}"))),
            _ => keys.push(key.clone()),
        }
    }
    keys.sort();
    keys
}

#[test]
fn every_key_has_one_row_with_a_sentence() {
    let mut told: Vec<String> = Settings::all().map(|setting| setting.key.to_owned()).collect();
    told.sort();
    assert_eq!(told, keys(&Table::try_from(Settings::default()).unwrap()));
    for setting in Settings::all() {
        assert!(setting.about.ends_with('.') && setting.about.len() > 10, "{}", setting.key);
    }
}

#[test]
fn defaults_are_those_of_the_literature() {
    let Settings { motion, grid, drawing, hatching, light, .. } = Settings::default();
    let forces = [motion.pressure, motion.elastic, motion.cohesion, motion.friction];
    assert_eq!(forces, [400.0, 100.0, 200.0, 40.0]);
    assert_eq!([motion.kick, motion.microstructure, motion.grain], [0.3, 0.18, 0.35]);
    assert_eq!([motion.surface_pull, motion.gravity, motion.keep], [50.0, 0.0, 2000.0]);
    assert!((grid.cell - 1.0 / 12.0).abs() < 1e-6);
    assert_eq!([grid.film_mm, grid.rate, grid.slope], [0.02, 0.04, 0.0]);
    assert_eq!(drawing.shells, [1.0, 0.93, 0.86, 0.79]);
    assert_eq!([drawing.rim, drawing.edge, drawing.gate], [0.15, 0.5, -0.2]);
    assert_eq!((hatching.pencil, light.levels, grid.samples), (0.15, 6, 64));
    Settings::default().valid().unwrap();
}

#[test]
fn values_beyond_both_ends_of_a_range_are_refused_with_line_and_key() {
    for setting in Settings::all() {
        let values = match setting.takes {
            Takes::Number(least, most) => {
                vec![format!("{}", least - 1.0), format!("{}", most * 1.01)]
            }
            Takes::Numbers(least, most) => {
                vec![format!("[{}]", least - 1.0), format!("[{}]", most + 0.1), "[nan]".to_owned()]
            }
            Takes::Whole(_, most) => vec!["-1".to_owned(), format!("{}", most + 1)],
            Takes::Words(_) => vec!["\"other\"".to_owned()],
            Takes::Switch => vec!["1".to_owned()],
            Takes::Color => vec!["\"white\"".to_owned()],
        };
        for value in values.iter().map(String::as_str).chain(["{}", "nan"]) {
            let text = format!("\n{} = {value}", setting.key);
            let error = Settings::from_toml("s.toml", &text).unwrap_err();
            let start = format!("s.toml, line 2: {}", setting.key);
            assert!(error.to_string().starts_with(&start), "{text}: {error}");
            assert!(error.hint().is_some(), "{text}");
        }
    }
}

#[test]
fn the_ends_of_ranges_are_taken() {
    for setting in Settings::all() {
        let values = match setting.takes {
            Takes::Number(least, most) => vec![format!("{least}"), format!("{most}")],
            Takes::Whole(least, most) => vec![least.to_string(), most.to_string()],
            Takes::Words(words) => words.iter().map(|word| format!("\"{word}\"")).collect(),
            Takes::Switch => vec!["true".to_owned(), "false".to_owned()],
            Takes::Color => vec!["\"#fbf9f4\"".to_owned()],
            Takes::Numbers(..) => vec![],
        };
        for value in values {
            let text = format!("{} = {value}", setting.key);
            let settings = Settings::from_toml("s.toml", &text);
            assert!(settings.is_ok(), "{text}: {settings:?}");
        }
    }
}

#[test]
fn faults_of_a_file_name_line_key_and_way_out() {
    let sketch = Preset::Sketch.settings();
    for (text, wanted, hint) in [
        (
            "motion.frction = 3",
            "mine, line 1: motion.frction: unknown key `frction`",
            "did you mean friction?",
        ),
        (
            "[motions]\nkick = 3",
            "mine, line 1: motions: unknown key `motions`",
            "did you mean motion?",
        ),
        (
            "\n[grey]\nweights = \"rec602\"",
            "mine, line 3: grey.weights: unknown word `rec602`",
            "did you mean rec601?",
        ),
        ("[grid]\ncell = \"wide\"", "mine, line 2: grid.cell: invalid type", "write a value"),
        ("[grid\ncell = 1", "mine, line 1: ", "a line of TOML"),
        ("seed = 1\nseed = 2", "mine, line 2: duplicate key", "a line of TOML"),
        (
            "drawing.tint = [1.0, 0.0]",
            "mine, line 1: drawing.tint takes shares that rise",
            "[0, 1] is even",
        ),
        (
            "drawing.tint = [0.0]",
            "mine, line 1: drawing.tint takes 2 shares for 1 shell",
            "[0, 1] is even",
        ),
        (
            "drawing.shells = [0.8, 0.9]",
            "mine, line 1: drawing.shells takes sizes that fall",
            "[1.0, 0.93",
        ),
    ] {
        let error = sketch.changed("mine", text).unwrap_err();
        assert!(error.to_string().starts_with(wanted), "{error}");
        let found = error.hint().unwrap().to_string();
        assert!(found.starts_with(hint), "{text}: {found}");
    }
    let error = "washd".parse::<Preset>().unwrap_err();
    assert_eq!(error.to_string(), "there is no preset `washd`");
    assert_eq!(error.hint().unwrap().to_string(), "did you mean washed?");
}

#[test]
fn changes_keep_what_they_do_not_name() {
    let bleed = Preset::Bleed.settings();
    assert_eq!(bleed.changed("none", "").unwrap(), bleed);
    let text = "motion.kick = 2\ndrawing.shells = [1.0, 0.5]\ndrawing.tint = []\nunit_mm = 50";
    let changed = bleed.changed("some", text).unwrap();
    assert_eq!((changed.motion.kick, changed.unit_mm), (2.0, 50.0));
    assert_eq!(changed.motion.cohesion, bleed.motion.cohesion);
    let mut back = changed;
    back.motion.kick = bleed.motion.kick;
    back.drawing = bleed.drawing.clone();
    back.unit_mm = bleed.unit_mm;
    assert_eq!(back, bleed);
}

#[test]
fn presets_describe_every_key_and_are_read_to_the_bit() {
    for preset in Preset::ALL {
        let settings = preset.settings();
        assert_eq!(preset.text(), settings.documented(preset.about()), "{}", preset.name());
        assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
        let lines: Vec<&str> = preset.text().lines().collect();
        let keys =
            lines.windows(2).filter(|pair| !pair[1].starts_with('#') && pair[1].contains(" = "));
        let told = keys.inspect(|pair| assert!(pair[0].starts_with("# "), "{}", pair[1]));
        assert_eq!(told.count(), Settings::all().count(), "{}", preset.name());
    }
    let [sketch, washed, tinted, grisaille, bleed] = Preset::ALL.map(Preset::settings);
    assert_eq!((sketch.drawing.shells.len(), washed.drawing.shells.len()), (1, 4));
    assert_eq!(tinted.drawing.tint.last(), Some(&1.0));
    assert_eq!(grisaille.drawing.inside, super::Inside::Glaze);
    assert!(bleed.motion.microstructure > 2.0 * sketch.motion.microstructure);
    assert!(bleed.motion.cohesion < sketch.motion.cohesion / 2.0);
}
