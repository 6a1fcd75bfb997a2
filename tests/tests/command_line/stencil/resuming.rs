//! Animations that were interrupted, and runs that fail before anything is written.

use std::fs;
use std::path::Path;

use serde_json::Value;
use suite::program::repository;

use super::{POUR, done, files, folder, path, stencil};

/// Two steps of the world a frame, 157 frames.
const LONG: [&str; 10] = [
    "--width",
    "16",
    "--seconds",
    "2.6",
    "--rate",
    "60",
    "--set",
    "grid.cell=0.2",
    "--set",
    "picture.samples=1",
];

/// A folder that has the manifest of `whole`, and in which frame `number` cannot be written.
fn blocked(whole: &str, folder: &str, number: usize) {
    fs::create_dir_all(folder).unwrap();
    fs::copy(Path::new(whole).join("animation.json"), Path::new(folder).join("animation.json"))
        .unwrap();
    fs::create_dir(obstacle(folder, number)).unwrap();
}

fn obstacle(folder: &str, number: usize) -> std::path::PathBuf {
    Path::new(folder).join(format!("frame-{number:04}.png"))
}

fn copied(from: &str, to: &str) {
    fs::create_dir(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), Path::new(to).join(entry.file_name())).unwrap();
    }
}

#[track_caller]
fn same_frames(whole: &str, other: &str) {
    let names = files(whole, ".png");
    assert_eq!((names.len(), &names), (157, &files(other, ".png")), "all frames, in both folders");
    let read = |folder: &str, name: &String| fs::read(Path::new(folder).join(name)).unwrap();
    for name in &names {
        assert!(read(whole, name) == read(other, name), "{other}: {name}");
    }
    assert_eq!(files(other, ".world"), [""; 0], "an animation that is complete needs none");
}

#[test]
fn a_run_that_was_cut_goes_on_from_its_snapshot_to_the_same_bytes() {
    let temporary = folder();
    let [model, whole, cut] = ["box.obj", "whole", "cut"].map(|name| path(&temporary, name));
    let [near, far, none] = ["near", "far", "none"].map(|name| path(&temporary, name));
    let scene = [&[&model[..]], &LONG[..], &POUR, &["--json", "--frames"]].concat();
    let told = |folder: &str| {
        let run = done(&[&scene[..], &[folder]].concat());
        let told = run.json();
        (
            [
                told["frames_found"].clone(),
                told["from_seconds"].clone(),
                told["steps_computed"].clone(),
            ],
            run.err,
        )
    };
    let numbers = |found: u64, from: Option<f64>, steps: u64| {
        [found.into(), from.map_or(Value::Null, Value::from), steps.into()]
    };
    // Everything is played twice: before the first frame is painted, and for the frames.
    assert_eq!(told(&whole).0, numbers(0, None, 2 * 312));
    blocked(&whole, &cut, 121);
    let run = stencil(&[&scene[..], &[&cut]].concat());
    assert!(run.status == 2 && run.err.contains("frame-0121.png"), "{}", run.err);
    fs::remove_dir(obstacle(&cut, 121)).unwrap();
    assert_eq!(files(&cut, ".png").len(), 120);
    assert_eq!(files(&cut, ".world"), ["frame-0051.world", "frame-0101.world"]);
    [&near, &far, &none].iter().for_each(|folder| copied(&cut, folder));

    let (found, err) = told(&near);
    assert_eq!(found, numbers(120, Some(200.0 / 120.0), 2 * 112), "nothing before frame 101");
    assert!(!err.contains("snapshot"), "{err}");
    same_frames(&whole, &near);

    let newest = Path::new(&far).join("frame-0101.world");
    let mut bytes = fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&newest, bytes).unwrap();
    let (found, err) = told(&far);
    assert_eq!(found, numbers(120, Some(100.0 / 120.0), 2 * 212));
    let words = ["frame-0101.world: cut short or damaged", "from the snapshot after 0.83 s"];
    assert!(words.iter().all(|words| err.contains(words)), "{err}");
    same_frames(&whole, &far);

    // Both are useless, and the run is cut once more: then the newest two are there.
    let shortened = fs::read(Path::new(&none).join("frame-0051.world")).unwrap();
    fs::write(Path::new(&none).join("frame-0051.world"), &shortened[..100]).unwrap();
    fs::write(Path::new(&none).join("frame-0101.world"), "no world at all").unwrap();
    fs::create_dir(obstacle(&none, 155)).unwrap();
    let run = stencil(&[&scene[..], &[&none]].concat());
    let words = ["frame-0051.world: cut", "frame-0101.world: not a saved", "from the beginning"];
    assert!(words.iter().all(|words| run.err.contains(words)), "{}", run.err);
    assert_eq!(files(&none, ".world"), ["frame-0101.world", "frame-0151.world"]);
    fs::remove_dir(obstacle(&none, 155)).unwrap();
    assert_eq!(told(&none).0, numbers(154, Some(300.0 / 120.0), 2 * 12));
    same_frames(&whole, &none);

    // Snapshots of another animation are told, and go with its frames.
    let other = ["--seconds", "0.1", "--json", "--frames", &cut];
    let short: Vec<&str> =
        LONG.into_iter().filter(|own| !["--seconds", "2.6"].contains(own)).collect();
    let run = done(&[&[&model[..]], &short[..], &POUR, &other].concat());
    assert!(run.err.contains("frame-0101.world: saved for another scene"), "{}", run.err);
    assert_eq!(run.json()["from_seconds"], Value::Null);
    assert_eq!((files(&cut, ".png").len(), files(&cut, ".world").len()), (7, 0));
}

#[test]
fn a_script_that_cannot_be_played_leaves_nothing_behind() {
    let folder = folder();
    let script = path(&folder, "s.toml");
    let text = "format = \"paint-volumes\"\nversion = 1\nsubject = \"box.obj\"\nseconds = 0.5\n\
        grid.cell = 0.2\npalette.V = \"Viridian\"\n[[volume]]\ncentre = [0.0, 1.0, 0.0]\n\
        radius = 0.2\nfrom_s = 0.4\nrecipe = { V = 1 }\n[[split]]\nat_s = 0.1\nvolume = 1\n";
    fs::write(&script, text).unwrap();
    let library = repository("measurements/van-gogh-oils.pigments.json");
    let names = ["stages", "volumes", "maps", "frames", "p.png", "s2.toml"];
    let [stages, volumes, maps, frames, picture, second] = names.map(|name| path(&folder, name));
    let written = ["--stages", &stages, "--volumes", &volumes, "--pigment-maps", &maps];
    let more = ["--frames", &frames, "--picture", &picture, "--script-out", &second];
    let paint = ["--pigments", &library, "--width", "64"];
    let run = stencil(&[&[&script[..]], &written[..], &more, &paint].concat());
    assert!(run.status == 1 && run.err.contains("volume 1 is not there"), "{}", run.err);
    let left = names.into_iter().filter(|name| Path::new(&path(&folder, name)).exists());
    assert_eq!(left.collect::<Vec<_>>(), [""; 0]);
    // With the volume there in time, all of them are made.
    fs::write(&script, text.replace("from_s = 0.4", "from_s = 0.0")).unwrap();
    done(&[&[&script[..]], &written[..], &more, &paint].concat());
    let made = names.into_iter().filter(|name| Path::new(&path(&folder, name)).exists());
    assert_eq!(made.collect::<Vec<_>>(), names);
    // Folders that cannot be made are told at once.
    let inside = path(&folder, "box.obj/inside");
    for option in ["--stages", "--volumes", "--pigment-maps", "--frames"] {
        let run = stencil(&[&[&script[..]], &paint[..], &[option, &inside]].concat());
        let told = run.err.contains("inside: this folder cannot be created");
        assert!(
            run.status == 2 && told && run.err.contains("hint: name another"),
            "{option}: {}",
            run.err
        );
    }
}
