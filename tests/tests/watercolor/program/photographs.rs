//! `impasto watercolor` of photographs: colours, formats, stages, masks, and the GPU.

use super::{Folder, decoded, difference, mean, opened, painted, picture, watercolor};

const KEYS: [&str; 6] = ["backend", "frames", "frames_found", "pigments", "regions", "size"];

#[test]
fn a_photograph_becomes_a_picture_of_its_colors() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let out = folder.file("out.png");
    let run = painted(&photo, &["--picture", &out, "--json"]);
    let told = run.json();
    let mut keys: Vec<_> = told.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    assert_eq!(keys, KEYS);
    assert_eq!(told["size"], serde_json::json!([160, 120]));
    assert_eq!(
        (told["backend"].as_str(), &told["frames"]),
        (Some("cpu"), &serde_json::Value::Null)
    );
    assert!((3..60).contains(&told["regions"].as_u64().unwrap()), "{told}");
    assert_eq!(told["pigments"], serde_json::json!([]));
    let made = opened(&out);
    let original = opened(&photo);
    assert_eq!(made.dimensions(), (160, 120));
    let [r, _, b] = mean(&made, 4, 40);
    let [far_r, _, far_b] = mean(&made, 120, 156);
    assert!(r > b + 40.0 && far_b > far_r + 40.0, "{r} {b}, {far_r} {far_b}");
    let (off, _) = difference(&made, &original);
    assert!((5.0..80.0).contains(&off), "{off}");

    let words = painted(&photo, &["--picture", &out]);
    assert!(words.out.starts_with("160 x 120 pixels on cpu, "), "{}", words.out);
    assert!(
        words.out.ends_with(" regions\n")
            && words.err.lines().all(|line| line.starts_with("Wrote ")),
        "{words:?}"
    );
    let smaller = decoded(&picture(&folder, &photo, &["--width", "80"]));
    assert_eq!(smaller.dimensions(), (80, 60));
}

#[test]
fn the_same_wish_gives_the_same_bytes_and_other_formats_the_same_picture() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let first = picture(&folder, &photo, &["--preset", "landscape"]);
    assert!(first == picture(&folder, &photo, &["--preset", "landscape"]), "other bytes");
    let deep = picture(&folder, &photo, &["--preset", "landscape", "--bits", "16"]);
    let deep = image::load_from_memory(&deep).unwrap();
    assert_eq!(deep.color(), image::ColorType::Rgb16);
    let (_, most) = difference(&decoded(&first), &deep.into_rgb8());
    assert!(most <= 1, "{most}");
    let exr = folder.file("out.exr");
    painted(&photo, &["--picture", &exr]);
    assert!(std::fs::read(exr).unwrap().starts_with(&[0x76, 0x2f, 0x31, 0x01]));
}

#[test]
fn stages_are_written_in_their_order_and_the_last_is_the_picture() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let out = folder.file("out.png");
    let stages = folder.file("stages");
    painted(&photo, &["--stages", &stages, "--picture", &out, "--preset", "sketch"]);
    let names = [
        "01-photograph.png",
        "02-regions.png",
        "03-wash.png",
        "04-wobble.png",
        "05-edges.png",
        "06-flow.png",
        "07-back-runs.png",
        "08-dispersion.png",
        "09-paper.png",
        "10-dry-brush.png",
        "11-sheet.png",
    ];
    assert_eq!(folder.names("stages"), names);
    let all = names.map(|name| opened(format!("{stages}/{name}")));
    assert_eq!(all[0], opened(&photo), "the photograph is unchanged");
    for (pair, names) in all.windows(2).zip(names.windows(2)) {
        assert!(difference(&pair[0], &pair[1]).1 > 0, "{names:?} are alike");
    }
    let (_, most) = difference(&all[10], &opened(&out));
    assert!(most <= 1, "{most}");
    // `--stages` alone is enough output.
    let alone = folder.file("alone");
    painted(&photo, &["--stages", &alone, "--preset", "sketch"]);
    assert_eq!(folder.names("alone"), names);
    let file = |folder: &str| std::fs::read(format!("{folder}/11-sheet.png")).unwrap();
    assert!(file(&alone) == file(&stages), "the picture changed the stages");
}

#[test]
fn masks_say_where_density_changes_and_where_the_brush_is_dry() {
    let folder = Folder::new();
    let photo = folder.photograph();
    let mesh = folder.pyramid();
    let mask = folder.mask();
    let black = image::RgbImage::new(20, 10);
    let none = folder.file("none.png");
    black.save(&none).unwrap();
    let dry: &[&str] = &[
        "--set",
        "dry_brush.amount=0.6",
        "--set",
        "dry_brush.patches=0",
        "--set",
        "dry_brush.outline_px=0",
    ];
    let size: &[&str] = &["--width", "160", "--height", "120"];
    for (subject, size) in [(&photo, &[][..]), (&mesh, size)] {
        for (option, look) in [("--density-mask", &[][..]), ("--dry-brush-mask", dry)] {
            let with =
                |more: &[&str]| decoded(&picture(&folder, subject, &[size, look, more].concat()));
            let all = with(&[]);
            let half = with(&[option, &mask]);
            let nothing = with(&[option, &none]);
            assert!(difference(&all, &nothing).0 > 0.5, "{option} does nothing");
            for (x, y, pixel) in half.enumerate_pixels() {
                let wanted = if x < 80 { &all } else { &nothing };
                assert_eq!(pixel, wanted.get_pixel(x, y), "{option} at {x}, {y}");
            }
        }
    }
}

#[test]
fn a_device_paints_the_same_photograph() {
    let Some(device) = suite::adapter::device() else { return };
    drop(device);
    let folder = Folder::new();
    let photo = folder.photograph();
    let look = ["--preset", "sketch"];
    let on_cpu = decoded(&picture(&folder, &photo, &look));
    let out = folder.file("device.png");
    let options = [&look[..], &["--backend", "gpu", "--picture", &out, "--json"]].concat();
    let run = watercolor(&photo, &options);
    assert_eq!(run.status, 0, "{}", run.err);
    assert_ne!(run.json()["backend"], "cpu");
    let (_, most) = difference(&on_cpu, &opened(&out));
    assert!(most <= 2, "{most} of 255");
}

#[test]
fn small_and_narrow_photographs_are_painted() {
    let folder = Folder::new();
    for (width, height) in [(1, 16), (3, 200), (200, 2)] {
        let name = folder.file("odd.png");
        image::RgbImage::from_pixel(width, height, image::Rgb([200, 90, 40])).save(&name).unwrap();
        let made = decoded(&picture(&folder, &name, &["--preset", "landscape"]));
        assert_eq!(made.dimensions(), (width, height));
    }
}
