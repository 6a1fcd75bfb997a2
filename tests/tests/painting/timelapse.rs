//! Timelapses, layers and TIFF of `impasto paint`.

use std::path::Path;

use image::AnimationDecoder;
use image::codecs::gif::GifDecoder;
use suite::program::impasto;

use super::program::{place, script};

fn refused(arguments: &[&str], wanted: &str) {
    let run = impasto(arguments);
    assert_eq!(run.status, 2, "{arguments:?}: {}", run.err);
    assert!(run.err.contains(wanted), "{arguments:?}: {}", run.err);
}

#[test]
fn a_timelapse_ends_with_the_picture_and_is_continued() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let [gif, png, frames] = ["film.gif", "picture.png", "film.frames"].map(|n| place(folder, n));
    let every = ["--timelapse", &gif, "--timelapse-every", "1", "--timelapse-hold", "1"];
    let base = ["paint", &script, "--backend", "cpu"];
    let run = impasto(&[&base[..], &every, &["--picture", &png, "--json"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let told = run.json();
    assert_eq!((told["frames"].as_u64(), told["frames_found"].as_u64()), (Some(6), Some(0)));
    assert_eq!(told["size"], serde_json::json!([120, 80]));
    assert_eq!(told["actions"].as_u64(), Some(9), "the picture is painted too");
    let whole = std::fs::read(&gif).unwrap();
    let decoder = GifDecoder::new(std::io::Cursor::new(&whole)).unwrap();
    let decoded = decoder.into_frames().collect_frames().unwrap();
    assert_eq!(decoded.len(), 6, "start, two strokes, drying, a stroke done again, the light");
    assert_eq!(decoded[5].delay().numer_denom_ms(), (1000, 1));
    let last = image::open(Path::new(&frames).join("frame-0006.png")).unwrap().into_rgb8();
    assert!(last == image::open(&png).unwrap().into_rgb8(), "the end is the picture");

    std::fs::remove_file(&gif).unwrap();
    std::fs::remove_file(Path::new(&frames).join("frame-0003.png")).unwrap();
    let run = impasto(&[&base[..], &every].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(run.out.contains("6 frames of 120 x 80 pixels, 5 found"), "{}", run.out);
    assert!(std::fs::read(&gif).unwrap() == whole, "the same bytes");
}

#[test]
fn timelapses_are_checked_before_anything_is_painted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let png = place(folder, "a.png");
    let base = ["paint", &script, "--backend", "cpu", "--timelapse"];
    for (more, wanted) in [
        (&["a.mp4"][..], "ends in .gif, .png or .apng"),
        (&[&png, "--picture", &png], "two outputs have this file name"),
        (&[&png, "--timelapse-every", "0"], "every takes 1 action and up"),
        (&[&png, "--timelapse-seconds", "-1"], "seconds takes 0.01 to 86400 s"),
        (&[&png, "--timelapse-size", "3"], "size takes 16 to 16384 px"),
        (&[&png, "--timelapse-hold", "1000"], "hold takes 0 to 60 s"),
        (&[&png, "--timelapse-rate", "0"], "--timelapse-rate"),
        (&[&png, "--timelapse-every", "2", "--timelapse-count", "9"], "cannot be used with"),
        (&["/no/such/folder/a.gif"], "cannot be written"),
    ] {
        refused(&[&base[..], more].concat(), wanted);
        assert!(!Path::new(&png).exists(), "{more:?} left a file");
    }
}

#[test]
fn layers_and_tiff_agree_with_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let script = script(folder, "", "");
    let [ora, png, tif, painting] = ["a.ora", "a.png", "a.tif", "a.exr"].map(|n| place(folder, n));
    let base = ["paint", &script, "--backend", "cpu", "--layers", &ora];
    let run = impasto(&[&base[..], &["--picture", &png, "--bits", "16"]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    let run =
        impasto(&["paint", &script, "--backend", "cpu", "--picture", &tif, "--output", &painting]);
    assert_eq!(run.status, 0, "{}", run.err);
    let [ora, png, tif] = [&ora, &png, &tif].map(|path| std::fs::read(path).unwrap());
    assert_eq!(&ora[30..54], b"mimetypeimage/openraster");
    assert!(ora.windows(png.len()).any(|part| part == png), "the merged picture");
    assert_eq!(&tif[..4], b"II*\0");
    let again = place(folder, "b.ora");
    let run = impasto(&["relight", &painting, "--backend", "cpu", "--layers", &again]);
    assert_eq!(run.status, 0, "{}", run.err);
    assert!(std::fs::read(&again).unwrap() == ora, "relight writes the same layers");
    refused(&["paint", &script, "--layers", "a.png"], "that ends in .ora");
}
