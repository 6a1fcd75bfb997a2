//! `impasto watercolor --pigments` with glazes of calibrated pigments instead of RGB densities, and presets,
//! files of settings, and single settings.

use suite::program::{Run, impasto, repository};

use super::{Folder, decoded, difference, mean, opened, painted, picture};

const PALETTE: &str = "Vermilion,Chrome Yellow,Prussian Blue";

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

#[track_caller]
fn relit(painting: &str, options: &[&str]) -> Run {
    let run = impasto(&[&["relight", painting, "--backend", "cpu"], options].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    run
}

#[test]
fn a_painting_of_glazes_is_kept_and_relit() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let library = library();
    let out = folder.file("out.png");
    let painting = folder.file("out.exr");
    let maps = folder.file("maps");
    let options = [
        ["--pigments", &library],
        ["--palette", PALETTE],
        ["--picture", &out],
        ["--output", &painting],
        ["--pigment-maps", &maps],
    ];
    let run = painted(&photo, &[&options.concat()[..], &["--json"]].concat());
    let json = run.json();
    assert_eq!(json["pigments"].as_array().unwrap().len(), 3, "{json}");
    assert_eq!(json["pigments"][0], "Vermilion");
    let made = opened(&out);
    let [r, _, b] = mean(&made, 4, 40);
    let [far_r, _, far_b] = mean(&made, 120, 156);
    assert!(r > b + 30.0 && far_b > far_r, "{r} {b}, {far_r} {far_b}");

    let names = folder.names("maps");
    for pigment in ["vermilion", "chrome-yellow", "prussian-blue", "thickness"] {
        let name = format!("painting.{pigment}.png");
        assert!(names.contains(&name), "{name} is none of {names:?}");
    }
    let [red, no_red, blue, no_blue] = [
        ("vermilion", 4..40),
        ("vermilion", 120..156),
        ("prussian-blue", 120..156),
        ("prussian-blue", 4..40),
    ]
    .map(|(pigment, columns)| {
        let map = image::open(format!("{maps}/painting.{pigment}.png")).unwrap().into_luma16();
        let inside = map.enumerate_pixels().filter(|(x, ..)| columns.contains(x));
        inside.map(|(.., pixel)| u64::from(pixel.0[0])).sum::<u64>()
    });
    assert!(red > 2 * no_red);
    assert!(blue > 2 * no_blue);

    let [same, lamp] = ["D65", "A"].map(|light| {
        let again = folder.file(&format!("{light}.png"));
        relit(&painting, &["--illuminant", light, "--picture", &again]);
        opened(again)
    });
    assert_eq!(difference(&made, &same).1, 0, "another picture under the same light");
    assert!(difference(&made, &lamp).0 > 1.0, "an incandescent lamp changes nothing");
}

#[test]
fn pigments_are_chosen_and_paper_and_light_are_given() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let library = library();
    let out = folder.file("out.png");
    let with = |options: &[&str]| {
        let all =
            [&["--pigments", &library, "--width", "48", "--picture", &out, "--json"], options];
        let json = painted(&photo, &all.concat()).json();
        (opened(&out), json["pigments"].as_array().unwrap().len())
    };
    let (chosen, count) = with(&[]);
    assert!((3..=8).contains(&count), "{count}");
    let palette: &[&str] = &["--palette", PALETTE];
    let [white, grey] = ["0.95", "0.3"].map(|over| with(&[palette, &["--over", over]].concat()).0);
    let [light, dark] = [&white, &grey].map(|picture| mean(picture, 0, 48).iter().sum::<f64>());
    assert!(light > dark + 60.0, "{light} {dark}");
    let [red, blue] = ["paper.colour=#c06060", "paper.colour=#6060c0"].map(|set| {
        let [r, _, b] = mean(&with(&[palette, &["--set", set]].concat()).0, 0, 48);
        r / b
    });
    assert!(red > 1.5 * blue, "the paper's colour shows through: {red} {blue}");
    let lamp = with(&[palette, &["--over", "0.95", "--illuminant", "A"]].concat()).0;
    assert!(difference(&white, &lamp).0 > 1.0, "a lamp changes nothing");
    let plain = decoded(&picture(&folder, &photo, &["--width", "48"]));
    assert!(difference(&plain, &chosen).0 > 1.0, "pigments change nothing");
    assert!(difference(&plain, &chosen).0 < 60.0, "pigments change too much");
}

#[test]
fn a_mesh_turns_in_the_pigments_of_its_first_frame() {
    let folder = Folder::new();
    let mesh = folder.pyramid();
    let library = library();
    let frames = folder.file("frames");
    let options = ["--pigments", &library, "--width", "32", "--turntable", "3"];
    let more = ["--frames", &frames, "--json"];
    let turn = || painted(&mesh, &[&options[..], &more].concat()).json();
    let frame = |n: usize| std::fs::read(format!("{frames}/frame-000{n}.png")).unwrap();
    let first = turn();
    assert_eq!(first["frames_found"], 0);
    assert!(first["pigments"].as_array().unwrap().len() > 2, "{first}");
    let before = [1, 2, 3].map(frame);
    std::fs::remove_file(format!("{frames}/frame-0002.png")).unwrap();
    let again = turn();
    assert_eq!((&again["frames_found"], &again["pigments"]), (&2.into(), &first["pigments"]));
    assert!([1, 2, 3].map(frame) == before, "the frame that was missing has other pigments");
    assert_eq!(turn()["pigments"], first["pigments"], "pigments of complete frames");

    let still = folder.file("still.exr");
    painted(&mesh, &[&options[..4], &["--output", &still, "--palette", PALETTE]].concat());
    let json = relit(&still, &["--json"]).json();
    assert_eq!(json["canvas"], serde_json::json!([32, 24]));
}

#[test]
fn where_nothing_is_seen_there_is_bare_paper() {
    let folder = Folder::new();
    let mesh = folder.pyramid();
    let library = library();
    let out = folder.file("out.png");
    let path = "frames = 1\n[[keyframe]]\neye = [0.0, 1.0, 8.0]\ntarget = [0.0, 1.0, 99.0]\n";
    let away = folder.write("away.toml", path);
    let options = ["--pigments", &library, "--width", "32", "--camera", &away, "--picture", &out];
    painted(&mesh, &options);
    assert!(opened(&out).pixels().all(|pixel| pixel.0.iter().all(|value| *value > 200)));
}

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
    // If a key has two values, the last one applies.
    let twice = ["--preset", "sketch", "--set", "wash.density=3", "--set", "wash.density=.50"];
    assert!(made(&twice) == made(&["--preset", "sketch"]), "the first of two applies");
}

#[test]
fn numbers_words_and_colors_are_set() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let usual = decoded(&picture(&folder, &photo, &[]));
    let with = |set: &str| decoded(&picture(&folder, &photo, &["--set", set]));
    let thin = with("wash.density=0.2");
    let thick = with("wash.density = 2");
    let [light, middle, dark] =
        [&thin, &usual, &thick].map(|picture| mean(picture, 0, 160).iter().sum::<f64>());
    assert!(light > middle + 60.0 && middle > dark + 60.0);
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
