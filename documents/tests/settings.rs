//! Settings that are declared by the macros.

use documents::hint::{Explain, Fault};
use documents::settings::{Row, Scales, Table, Takes, digest, guide_table, rows};
use documents::text::{Checked, KeyPath, ValueFault};

/// A word among the settings.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finish {
    /// Smooth.
    #[default]
    HotPressed,
    /// Rough.
    Rough,
}

documents::settings! {
    /// The paper.
    pub struct PaperSettings {
        kind: Finish = Finish::Rough, Words(&["hot-pressed", "rough"]) => "How it was made";
        scan: Option<String> = None, Text => "Heights from a picture instead", like "paper.png";
        grain_px: f32 = 4.5, Number(1.0, 512.0), "px", Length => "Width of a bump";
        least_px: f32 = 40.0, Number(0.0, 1e6), "px", Area => "Area of the least bump";
        color as "colour": String = "#fbf9f4".to_owned(), Color => "Its colour";
    }
}

documents::settings! {
    /// Steps and shells.
    pub struct StepSettings {
        count: u32 = 4, Whole(1, 16) => "Number of steps";
        power: u32 = 4, OneOf(&[1, 2, 4]) => "Power of the weights";
        lit: bool = true, Switch => "Whether light falls";
        tint: Vec<f32> = vec![0.0, 1.0], Numbers(0.0, 1.0) => "Share of colour by step, rising; a sentence that is longer than a line of a comment";
    }
}

documents::settings! {
    /// A style.
    pub struct Settings: File(tints_rise) {
        reference_px: f32 = 1000.0, Number(16.0, 65536.0), "px" => "Longer side";
        seed: u64 = 1, Any => "The same seed, the same picture";
        [paper as "sheet"]: PaperSettings => "the paper";
        [steps]: StepSettings => "";
    }
}

documents::presets! {
    /// A shipped style.
    pub enum Preset of Settings {
        Plain = "plain", "settings/plain.toml" => "Plain: nothing changed.";
        Rough = "coarse", "settings/coarse.toml" => "Coarse: wide bumps.";
    }
}

fn tints_rise(settings: &Settings, base: &KeyPath) -> Checked {
    let tint = &settings.steps.tint;
    if tint.windows(2).all(|pair| pair[0] <= pair[1]) {
        return Ok(());
    }
    let key = base.key("steps").key("tint");
    Err(ValueFault::new(&key, "shares that rise", format!("{tint:?}"), "[0, 1] is even"))
}

#[test]
fn a_file_has_every_key_with_its_meaning_and_is_read_to_the_bit() {
    let mut settings = Settings::default();
    settings.paper.grain_px = 0.1 + 0.2;
    let wanted = "\
# Mine

# Longer side (px, 16 to 65536).
reference_px = 1000.0

# The same seed, the same picture.
seed = 1

[sheet] # the paper
# How it was made (\"hot-pressed\", \"rough\").
kind = \"rough\"
# Heights from a picture instead.
# scan = \"paper.png\"
# Width of a bump (px, 1 to 512).
grain_px = 0.3
# Area of the least bump (px, 0 to 1000000).
least_px = 40.0
# Its colour (a colour written #rrggbb).
colour = \"#fbf9f4\"

[steps]
# Number of steps (a whole number from 1 to 16).
count = 4
# Power of the weights (1, 2 or 4).
power = 4
# Whether light falls.
lit = true
# Share of colour by step, rising; a sentence that is longer than a line of a comment
# (numbers from 0 to 1).
tint = [0.0, 1.0]
";
    settings.paper.grain_px = 0.3;
    assert_eq!(settings.documented("Mine"), wanted);
    settings.paper.grain_px = 1.1 + 2.2;
    settings.paper.scan = Some("a \"b\".png".to_owned());
    let text = settings.documented("Mine");
    assert_eq!(Settings::from_toml("again", &text).unwrap(), settings);
}

#[test]
fn faults_name_line_key_and_what_is_usual() {
    for (text, message, hint) in [
        ("\nseed = -1", "a, line 2: seed: invalid value", "1 is usual"),
        ("sheet = 3", "a, line 1: sheet: invalid type", "write a value of the kind"),
        ("see = 1", "a, line 1: see: unknown key `see`", "did you mean seed?"),
        ("[sheet]\ngrain = 1", "a, line 2: sheet.grain: unknown key", "it takes the keys kind,"),
        ("[paper]", "a, line 1: paper: unknown key `paper`", "it takes the keys reference_px,"),
        (
            "sheet.grain_px = 0.5",
            "a, line 1: sheet.grain_px takes 1 to 512, found `0.5`",
            "4.5 is usual",
        ),
        ("reference_px = inf", "a, line 1: reference_px takes 16 to 65536, found `inf`", "1000 is"),
        (
            "[steps]\n\ncount = 17",
            "a, line 3: steps.count takes a whole number from 1 to 16, found `17`",
            "4 is usual",
        ),
        ("steps.power = 3", "a, line 1: steps.power takes 1, 2 or 4, found `3`", "4 is usual"),
        (
            "sheet.colour = \"white\"",
            "a, line 1: sheet.colour takes a colour written #rrggbb, found `white`",
            "#fbf9f4 is usual",
        ),
        ("sheet.kind = \"ruogh\"", "a, line 1: sheet.kind: unknown word", "it takes the words"),
        ("steps.tint = [2]", "a, line 1: steps.tint takes numbers from 0 to 1", "[0.0, 1.0] is"),
        ("steps.tint = [1, 0]", "a, line 1: steps.tint takes shares that rise", "[0, 1] is even"),
    ] {
        for read in [Settings::from_toml("a", text), Preset::Rough.settings().changed("a", text)] {
            let error = read.unwrap_err();
            assert!(error.to_string().starts_with(message), "{text}: {error}");
            let found = error.hint().unwrap().to_string();
            assert!(found.starts_with(hint), "{text}: {found}");
            assert_eq!(error.fault(), Fault::Input);
        }
    }
    let mut settings = Settings::default();
    settings.steps.count = 0;
    let wanted = "steps.count takes a whole number from 1 to 16, found `0`";
    assert_eq!(settings.valid().unwrap_err().to_string(), wanted);
    settings.steps.count = 1;
    settings.seed = u64::MAX;
    assert!(settings.valid().is_err(), "TOML has no such number");
}

#[test]
fn changes_keep_what_they_do_not_name() {
    let coarse = Preset::Rough.settings();
    assert_eq!(coarse.changed("none", "").unwrap(), coarse);
    let changed = coarse.changed("some", "seed = 7\n[sheet]\nscan = \"a\"").unwrap();
    let mut wanted = coarse;
    wanted.seed = 7;
    wanted.paper.scan = Some("a".to_owned());
    assert_eq!(changed, wanted);
}

#[test]
fn lengths_and_areas_change_with_the_picture() {
    let mut settings = Settings::default();
    settings.scale(0.1);
    assert_eq!(settings.paper.grain_px, 4.5_f32 * 0.1);
    assert_eq!(settings.paper.least_px, 40.0_f32 * (0.1 * 0.1));
    assert_eq!((settings.reference_px, settings.steps), (1000.0, StepSettings::default()));
}

#[test]
fn presets_are_what_differs_from_the_default() {
    assert_eq!(Preset::Plain.settings(), Settings::default());
    let coarse = Preset::Rough.settings();
    assert_eq!((coarse.paper.grain_px, coarse.paper.kind), (9.0, Finish::HotPressed));
    for preset in Preset::ALL {
        let settings = preset.settings();
        let found = documents::settings::differences(&settings, &Settings::default());
        assert_eq!(found, preset.changes());
        assert_eq!(Settings::from_toml("again", &preset.text()).unwrap(), settings);
        assert_eq!(preset.name().parse::<Preset>().unwrap(), preset);
        assert!(preset.text().starts_with(&format!("# {}", preset.about())));
    }
    let error = "corse".parse::<Preset>().unwrap_err();
    assert_eq!(error.to_string(), "there is no preset `corse`");
    assert_eq!(error.hint().unwrap().to_string(), "did you mean coarse?");
    let other = "fine-arts".parse::<Preset>().unwrap_err();
    let wanted = "presets are plain, coarse; a file of your own ends in .toml";
    assert_eq!(other.hint().unwrap().to_string(), wanted);
    assert_eq!(other.fault(), Fault::Setting);
}

#[test]
fn a_digest_differs_in_every_bit() {
    let settings = Settings::default();
    let mut other = settings.clone();
    assert_eq!(digest(&settings), digest(&other));
    other.steps.tint[1] = 1.0_f32.next_down();
    assert_ne!(digest(&settings), digest(&other));
}

#[test]
fn rows_are_listed_for_guides() {
    let all = rows::<Settings>();
    let keys: Vec<&str> = all.iter().map(|(path, _)| path.as_str()).collect();
    assert_eq!(keys[..3], ["reference_px", "seed", "sheet.kind"]);
    assert_eq!(keys.len(), 11);
    let Row { takes, scales, unit, .. } = all[4].1;
    assert_eq!((*takes, *scales, *unit), (Takes::Number(1.0, 512.0), Scales::Length, "px"));
    let table = guide_table::<Settings>();
    assert!(table.contains("| `sheet.grain_px` | `4.5` | px, 1 to 512 | Width of a bump |\n"));
    assert!(table.contains("| `sheet.scan` |  |  | Heights from a picture instead |\n"), "{table}");
}
