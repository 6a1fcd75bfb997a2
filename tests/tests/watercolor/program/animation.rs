//! `impasto watercolor` with a moving camera: frames, GIF and APNG, and resumed runs.

use std::fs::File;
use std::io::BufReader;
use std::time::Duration;

use image::codecs::gif::GifDecoder;
use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, RgbImage};
use suite::program::Run;

use super::{Folder, difference, opened, painted, watercolor};

const TURN: [&str; 4] = ["--width", "48", "--turntable", "4"];

/// Paints a turntable of four frames of the pyramid, with `into` as further options.
#[track_caller]
fn turned(folder: &Folder, into: &[&str]) -> Run {
    painted(&folder.pyramid(), &[&TURN[..], into, &["--json"]].concat())
}

fn frame(folder: &Folder, inside: &str, number: usize) -> String {
    folder.file(&format!("{inside}/frame-{number:04}.png"))
}

fn rgb(frames: Vec<image::Frame>) -> Vec<RgbImage> {
    frames
        .into_iter()
        .map(|frame: image::Frame| image::DynamicImage::from(frame.into_buffer()).into_rgb8())
        .collect()
}

#[test]
fn a_gif_and_an_apng_hold_every_frame() {
    let folder = Folder::new();
    let gif = folder.file("turn.gif");
    let apng = folder.file("turn.png");
    let told = turned(&folder, &["--animation", &gif, "--rate", "10"]).json();
    assert_eq!((told["frames"].as_u64(), told["frames_found"].as_u64()), (Some(4), Some(0)));
    let names =
        ["animation.json", "frame-0001.png", "frame-0002.png", "frame-0003.png", "frame-0004.png"];
    assert_eq!(folder.names("turn.frames"), names);
    let kept: Vec<_> = (1..=4).map(|n| opened(frame(&folder, "turn.frames", n))).collect();
    for pair in kept.windows(2) {
        assert!(difference(&pair[0], &pair[1]).0 > 1.0, "two frames are alike");
    }

    // Both animations use one folder of frames: another format and rate need no new frame.
    let told = turned(&folder, &["--animation", &apng]).json();
    assert_eq!(told["frames_found"], 4);
    let decoder = GifDecoder::new(BufReader::new(File::open(&gif).unwrap())).unwrap();
    let frames = decoder.into_frames().collect_frames().unwrap();
    assert!(frames.iter().all(|f| Duration::from(f.delay()) == Duration::from_millis(100)));
    let of_gif = rgb(frames);
    let decoder = PngDecoder::new(BufReader::new(File::open(&apng).unwrap())).unwrap();
    let frames = decoder.apng().unwrap().into_frames().collect_frames().unwrap();
    assert!(frames.iter().all(|f| Duration::from(f.delay()) == Duration::from_millis(40)));
    let of_apng = rgb(frames);
    assert_eq!(of_apng, kept, "an APNG has all colours");
    assert_eq!(of_gif.len(), 4);
    for (shown, kept) in of_gif.iter().zip(&kept) {
        let (mean, _) = difference(shown, kept);
        assert!(mean < 6.0, "{mean}");
    }
}

#[test]
fn a_run_that_was_broken_off_makes_what_is_missing() {
    let folder = Folder::new();
    let frames = folder.file("frames");
    let gif = folder.file("turn.gif");
    let found = |options: &[&str]| turned(&folder, options).json()["frames_found"].as_u64();
    let wish: &[&str] = &["--frames", &frames, "--animation", &gif];
    assert_eq!(found(wish), Some(0));
    let all = |folder: &Folder| -> Vec<Vec<u8>> {
        (1..=4).map(|n| std::fs::read(frame(folder, "frames", n)).unwrap()).collect()
    };
    let first = all(&folder);
    let animation = std::fs::read(&gif).unwrap();
    // One frame is missing, one is truncated, one is a picture of other software.
    std::fs::remove_file(frame(&folder, "frames", 2)).unwrap();
    std::fs::write(frame(&folder, "frames", 3), &first[2][..first[2].len() - 9]).unwrap();
    RgbImage::new(5, 5).save(frame(&folder, "frames", 4)).unwrap();
    std::fs::remove_file(&gif).unwrap();
    assert_eq!(found(wish), Some(1));
    assert!(all(&folder) == first, "other frames than before");
    assert!(std::fs::read(&gif).unwrap() == animation, "another animation");
    // Frames that exist are not painted again.
    let painted_over = RgbImage::new(48, 36);
    painted_over.save(frame(&folder, "frames", 1)).unwrap();
    assert_eq!(found(wish), Some(4));
    assert_eq!(opened(frame(&folder, "frames", 1)), painted_over);
    let words = painted(&folder.pyramid(), &[&TURN[..], wish].concat());
    assert_eq!(words.out, "48 x 36 pixels on cpu, 4 frames (4 of them existed already)\n");

    // With any other option, all frames are painted again.
    for more in [
        &["--set", "flow.seed=2"][..],
        &["--camera", "31,20"],
        &["--height", "40"],
        &["--preset", "sketch"],
    ] {
        assert_eq!(found(&[wish, more].concat()), Some(0), "{more:?}");
        assert!(all(&folder) != first, "{more:?}: old frames");
    }
    assert_eq!(found(wish), Some(0));
    assert!(all(&folder) == first, "the first options again");
    assert_eq!(folder.names("frames").len(), 5, "a partial file remains");
}

#[test]
fn other_content_of_an_input_is_another_wish() {
    let folder = Folder::new();
    let frames = folder.file("frames");
    let scan = folder.mask();
    let set = format!("paper.scan={scan}");
    let mesh = folder.pyramid();
    let found = || {
        let options = ["--frames", &frames, "--set", &set, "--json"];
        painted(&mesh, &[&TURN[..], &options].concat()).json()["frames_found"].as_u64()
    };
    assert_eq!((found(), found()), (Some(0), Some(4)));
    RgbImage::from_fn(40, 40, |x, y| image::Rgb([(6 * (x ^ y)) as u8; 3])).save(&scan).unwrap();
    assert_eq!(found(), Some(0), "frames with the old paper");
    std::fs::write(&mesh, std::fs::read_to_string(&mesh).unwrap().replace("v 0 2 0", "v 0 3 0"))
        .unwrap();
    assert_eq!(found(), Some(0), "frames of the old mesh");
}

#[test]
fn noise_follows_the_mesh_unless_it_is_static() {
    let folder = Folder::new();
    // A ball of one colour, lit from the camera, looks the same from all sides; only noise
    // changes between two frames.
    let look = ["--width", "64", "--turntable", "8", "--set", "flow.strength=3"];
    let mut first_frames = Vec::new();
    for (method, moves) in [("static", false), ("particles", true), ("features", true)] {
        let frames = folder.file(method);
        let set = format!("coherence.method={method}");
        painted("shape:sphere", &[&look[..], &["--set", &set, "--frames", &frames]].concat());
        let [one, next] = [1, 2].map(|n| opened(frame(&folder, method, n)));
        let (mean, _) = difference(&one, &next);
        assert!(if moves { mean > 2.0 } else { mean < 0.5 }, "{method}: {mean}");
        first_frames.push(one);
    }
    let (mean, _) = difference(&first_frames[1], &first_frames[2]);
    assert!(mean > 1.0, "both methods give the same noise");
}

#[test]
fn a_path_is_followed_from_a_file() {
    let folder = Folder::new();
    let mesh = folder.pyramid();
    let path = "frames = 3\n[[keyframe]]\neye = [0.0, 1.0, 8.0]\ntarget = [0.0, 1.0, 0.0]\n\
                [[keyframe]]\neye = [0.0, 1.0, 16.0]\ntarget = [0.0, 1.0, 0.0]\n";
    let camera = folder.write("path.toml", path);
    let frames = folder.file("frames");
    let options = ["--width", "48", "--camera", &camera, "--frames", &frames, "--json"];
    assert_eq!(painted(&mesh, &options).json()["frames"], 3);
    let seen = [1, 2, 3].map(|n: usize| {
        let picture = opened(frame(&folder, "frames", n));
        picture.pixels().filter(|pixel| pixel.0.iter().any(|value| *value < 200)).count()
    });
    assert!(seen[0] > 2 * seen[2] && seen[1] > seen[2] && seen[0] > seen[1], "{seen:?}");
}

#[test]
fn a_device_makes_the_frames_of_the_processor() {
    let Some(device) = suite::adapter::device() else { return };
    drop(device);
    let folder = Folder::new();
    let mesh = folder.pyramid();
    for method in ["particles", "features"] {
        let set = format!("coherence.method={method}");
        let [cpu, gpu] = ["cpu", "gpu"].map(|backend| {
            let frames = folder.file(&format!("{method}-{backend}"));
            let options = ["--set", &set, "--frames", &frames, "--backend", backend];
            let run = watercolor(&mesh, &[&TURN[..], &options].concat());
            assert_eq!(run.status, 0, "{}", run.err);
            opened(format!("{frames}/frame-0002.png"))
        });
        let (mean, most) = difference(&cpu, &gpu);
        assert!(most <= 2, "{method}: {most} of 255, {mean} in the mean");
    }
}
