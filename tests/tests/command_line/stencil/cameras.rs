//! Cameras of options, which a script that is written has too.

use std::fs;

use image::{Rgb, RgbImage};

use super::{POUR, SMALL, done, folder, path, stencil};

/// Options of a film of five frames, if the camera has no number of its own.
const RATE: [&str; 2] = ["--rate", "8"];

/// Paints a still and a film of `subject` with these options of its camera, then with the script
/// that this wrote alone, and compares their bytes. Returns the still, the film and the script.
fn replayed(subject: &str, camera: &[&str]) -> (Vec<u8>, Vec<u8>, String) {
    let folder = tempfile::tempdir().unwrap();
    let [picture, film, script] = ["p.png", "f.gif", "s.toml"].map(|name| path(&folder, name));
    let [again, second, other] = ["q.png", "g.gif", "t.toml"].map(|name| path(&folder, name));
    let written = ["--picture", &picture, "--animation", &film, "--script-out", &script];
    done(&[&[subject], &SMALL[..], &POUR, &RATE, camera, &written].concat());
    let written = ["--picture", &again, "--animation", &second, "--script-out", &other];
    done(&[&[&script[..], "--width", "64"], &RATE[..], &written].concat());
    let read = |name: &str| fs::read(name).unwrap();
    let text = fs::read_to_string(&script).unwrap();
    assert!(read(&picture) == read(&again), "{camera:?}: the still");
    assert!(read(&film) == read(&second), "{camera:?}: the film");
    assert_eq!(text, fs::read_to_string(&other).unwrap(), "{camera:?}");
    (read(&picture), read(&film), text)
}

#[test]
fn a_script_that_was_written_has_the_camera_of_a_model() {
    let folder = folder();
    let [model, camera] = ["box.obj", "path.toml"].map(|name| path(&folder, name));
    let text = "frames = 4\n[[keyframe]]\neye = [3.123456789, 2.0, 5.0]\ntarget = [0.0, 0.5, 0.0]\n\
        [[keyframe]]\neye = [5.0, 3.0, 1.987654321]\ntarget = [0.0, 0.5, 0.0]\n\
        field_of_view_deg = 41.23456789\n";
    fs::write(&camera, text).unwrap();
    let plain = replayed(&model, &[]);
    let turning = replayed(&model, &["--turntable", "3"]);
    let turned = replayed(&model, &["--turntable", "3", "--camera", "400,25,35"]);
    let led = replayed(&model, &["--camera", &camera]);
    assert!(turning.2.contains("turntable = 3") && led.2.contains("frames = 4"), "{}", led.2);
    let stills = [&plain.0, &turned.0, &led.0];
    let films = [&plain.1, &turning.1, &turned.1, &led.1];
    assert!((0..3).all(|i| (0..i).all(|j| stills[i] != stills[j])));
    assert!((0..4).all(|i| (0..i).all(|j| films[i] != films[j])));
    let both = ["--turntable", "3", "--camera", &camera, "--mask", "m.png"];
    let run = stencil(&[&[&model[..]], &SMALL[..], &POUR, &both].concat());
    assert!(run.status == 2 && run.err.contains("both move the camera"), "{}", run.err);
}

#[test]
fn a_script_that_was_written_has_the_camera_of_a_photograph() {
    let folder = folder();
    let [photo, script, mask] = ["photo.png", "s.toml", "m.png"].map(|name| path(&folder, name));
    RgbImage::from_fn(60, 40, |x: u32, y: u32| {
        Rgb(if x < 30 { [40, 60, 140] } else { [210, 5 * y as u8, 60] })
    })
    .save(&photo)
    .unwrap();
    let plain = replayed(&photo, &[]);
    let turned = replayed(&photo, &["--camera", "18,-9"]);
    let swinging = replayed(&photo, &["--turntable", "3"]);
    assert!(plain.0 != turned.0 && plain.1 != swinging.1 && turned.1 != swinging.1);
    assert!(turned.2.contains("azimuth_deg = 18.0"), "{}", turned.2);
    let head = "format = \"paint-volumes\"\nversion = 1\nsubject = \"photo.png\"\nseconds = 0.5\n\
        [[pour]]\npicked = [0.5, 0.5]\nfor_s = 0.2\namount_mm3 = 20.0\n[camera]\n";
    for (key, words) in [
        ("elevation_deg = 85", "line 10: camera.elevation_deg takes -80 to 80"),
        ("field_of_view_deg = 40", "line 10: camera.field_of_view_deg takes no value before"),
    ] {
        fs::write(&script, format!("{head}{key}\n")).unwrap();
        let run = stencil(&[&script, "--mask", &mask]);
        assert!(run.status == 1 && run.err.contains(words), "{}", run.err);
        assert!(run.err.contains("hint: "), "{}", run.err);
    }
}
