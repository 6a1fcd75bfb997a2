//! `impasto watercolor` with presets, files of settings, and single settings.

use suite::program::impasto;

use super::{Folder, decoded, difference, mean, picture};

#[test]
fn presets_differ_and_each_is_its_own_file() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let mut all = vec![decoded(&picture(&folder, &photo, &[]))];
    for name in ["portrait", "landscape", "sketch"] {
        let shown = impasto(&["watercolor", "--show-preset", name]);
        assert_eq!((shown.status, shown.err.as_str()), (0, ""));
        let file = folder.write("own.toml", &shown.out);
        let preset = picture(&folder, &photo, &["--preset", name]);
        assert!(
            preset == picture(&folder, &photo, &["--settings", &file]),
            "{name} differs from its file"
        );
        // Settings in the file override the preset.
        let both = picture(&folder, &photo, &["--preset", "sketch", "--settings", &file]);
        assert!(preset == both, "the preset overrides {name}");
        let preset = decoded(&preset);
        for other in &all {
            assert!(difference(other, &preset).0 > 2.0, "{name} looks like another preset");
        }
        all.push(preset);
    }
}

#[test]
fn a_file_changes_what_it_names_and_an_option_changes_the_file() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let file = folder.write("own.toml", "[wash]\ndensity = 2.0\n\n[flow]\nseed = 9\n");
    let made = |options: &[&str]| picture(&folder, &photo, options);
    let own = made(&["--preset", "sketch", "--settings", &file]);
    let same = ["--preset", "sketch", "--set", "wash.density=2", "--set", "flow.seed=9"];
    assert!(own == made(&same), "the file differs from the options");
    let thinner = ["--preset", "sketch", "--settings", &file, "--set", "wash.density=0.5"];
    let back = ["--preset", "sketch", "--set", "flow.seed=9"];
    assert!(made(&thinner) == made(&back), "the preset's density is 0.5");
    // Of two values for a key the last applies.
    let twice = ["--preset", "sketch", "--set", "wash.density=3", "--set", "wash.density=.50"];
    assert!(made(&twice) == made(&["--preset", "sketch"]), "the first of two applies");
}

#[test]
fn numbers_words_and_colors_are_set() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let usual = decoded(&picture(&folder, &photo, &[]));
    let with = |set: &str| decoded(&picture(&folder, &photo, &["--set", set]));
    let sum = |picture: &_| mean(picture, 0, 160).iter().sum::<f64>();
    let thin = with("wash.density=0.2");
    let thick = with("wash.density = 2");
    assert!(sum(&thin) > sum(&usual) + 60.0 && sum(&usual) > sum(&thick) + 60.0);
    let word = with("paper.kind=rough");
    assert!(difference(&usual, &word).0 > 0.2, "a word changes nothing");
    assert_eq!(word, with("paper.kind=\"rough\""), "quotes change the value");
    let [r, g, b] = mean(&with("paper.colour=#8080ff"), 0, 160);
    let [usual_r, usual_g, usual_b] = mean(&usual, 0, 160);
    assert!(r < 0.7 * usual_r && g < 0.7 * usual_g && b > 0.9 * usual_b, "{r} {g} {b}");
    for (set, other) in [("dispersion.seed=7", "dispersion.seed=8"), ("flow.seed=7", "flow.seed=8")]
    {
        assert!(difference(&with(set), &with(other)).1 > 0, "{set}");
    }
}

#[test]
fn a_scan_of_paper_lies_beside_the_file_that_names_it() {
    let folder = Folder::new();
    let photo = folder.photograph();
    folder.mask();
    let file = folder.write("own.toml", "[paper]\nscan = \"mask.png\"\nscan_scale = 6.25\n");
    let by_file = picture(&folder, &photo, &["--settings", &file]);
    let scan = format!("paper.scan={}", folder.file("mask.png"));
    let by_option = picture(&folder, &photo, &["--set", &scan, "--set", "paper.scan_scale=6.25"]);
    assert!(by_file == by_option, "file and option differ");
    let usual = picture(&folder, &photo, &[]);
    assert!(difference(&decoded(&usual), &decoded(&by_file)).0 > 2.0, "the scan does nothing");
}
