//! Camera paths: interpolation of keyframes, closed paths, and invalid files.

use documents::hint::{Explain, Fault};
use glam::Vec3;
use graphics::camera::{Camera, CameraPath};

const PATH: &str = "
frames = 9
[[keyframe]]
eye = [0, 0, 10]
target = [0, 0, 0]
field_of_view_deg = 40
[[keyframe]]
eye = [10.0, 0.0, 0.0]
target = [0.0, 1.0, 0.0]
field_of_view_deg = 20
[[keyframe]]
eye = [0.0, 0.0, -10.0]
target = [0.0, 0.0, 0.0]
";

const BOUNDS: [Vec3; 2] = [Vec3::NEG_ONE, Vec3::ONE];

fn cameras(text: &str) -> Vec<Camera> {
    CameraPath::from_text("a path", text).unwrap().cameras(BOUNDS)
}

#[test]
fn a_path_goes_through_its_keyframes_evenly() {
    let cameras = cameras(PATH);
    assert_eq!(cameras.len(), 9);
    for (frame, eye, field) in [
        (0, Vec3::new(0.0, 0.0, 10.0), 40.0),
        (4, Vec3::new(10.0, 0.0, 0.0), 20.0),
        (8, Vec3::new(0.0, 0.0, -10.0), 35.0),
    ] {
        let camera = cameras[frame];
        assert!(camera.eye.distance(eye) < 1e-4, "{frame}: {camera:?}");
        assert!((camera.field_of_view_deg - field).abs() < 1e-3, "{frame}: {camera:?}");
    }
    assert!(cameras[4].target.distance(Vec3::Y) < 1e-5);
    // The path is smooth: consecutive steps have similar directions.
    let steps: Vec<Vec3> = cameras.windows(2).map(|pair| pair[1].eye - pair[0].eye).collect();
    assert!(steps.windows(2).all(|pair| pair[0].normalize().dot(pair[1].normalize()) > 0.6));
    for camera in &cameras {
        for corner in [Vec3::NEG_ONE, Vec3::ONE, Vec3::new(1.0, -1.0, 1.0)] {
            let clip = camera.clip_from_model(1.0) * corner.extend(1.0);
            assert!(clip.z > 0.0 && clip.z < clip.w, "{camera:?} cuts {corner}");
        }
    }
}

#[test]
fn a_closed_path_comes_back_and_one_keyframe_stands_still() {
    let closed = cameras(&PATH.replace("frames = 9", "frames = 9\nclosed = true"));
    for (frame, eye) in [(0, [0.0, 0.0, 10.0]), (3, [10.0, 0.0, 0.0]), (6, [0.0, 0.0, -10.0])] {
        assert!(closed[frame].eye.distance(eye.into()) < 1e-4, "{frame}: {:?}", closed[frame]);
    }
    // The step from the last frame to the first is about as long as the others.
    let last = closed[0].eye.distance(closed[8].eye);
    assert!((2.0..8.0).contains(&last), "{last}");
    let still = cameras("frames = 3\n[[keyframe]]\neye = [1, 2, 3]\ntarget = [0, 0, 0]\n");
    assert!(still.iter().all(|camera| *camera == still[0]) && still.len() == 3);
    assert_eq!(still[0].eye, Vec3::new(1.0, 2.0, 3.0));
}

#[test]
fn a_way_through_the_target_has_a_sight_everywhere() {
    let text = "frames = 21\n[[keyframe]]\neye = [0, 0, 1]\ntarget = [0, 0, -1]\n\
                [[keyframe]]\neye = [0, 0, -1]\ntarget = [0, 0, 1]\nup = [0, -1, 0]\n";
    for camera in cameras(text) {
        let [right, up, back] = camera.axes();
        assert!(right.is_finite() && up.is_finite() && back.is_finite(), "{camera:?}");
    }
}

#[test]
fn bad_paths_are_refused_with_their_place() {
    for (from, to, wanted) in [
        ("frames = 9", "frames = 0", "`frames`: 0"),
        ("frames = 9", "frames = 9000000", "`frames`: 9000000"),
        ("frames = 9", "", "line 1: the key `frames` is missing"),
        ("frames = 9", "frames = 9\nfps = 3", "line 3: fps: unknown key `fps`"),
        ("target = [0, 0, 0]", "target = [0, 0, 10]", "`keyframe 1: target`"),
        ("target = [0, 0, 0]", "target = [0, 0]", "line 5"),
        ("target = [0, 0, 0]", "target = [0, nan, 0]", "`keyframe 1: target`"),
        ("= 40", "= 180", "`keyframe 1: field_of_view_deg`: `180`"),
        (
            "= 20",
            "= 20\nup = [1, 0, 0]\nroll = 3",
            "line 12: [[keyframe]] 2, roll: unknown key `roll`",
        ),
        ("target = [0, 0, 0]", "target = [0, 0, 0]\nup = [0, 0, 2]", "`keyframe 1: up`"),
        ("eye = [0, 0, 10]\n", "", "the key `eye` is missing"),
        ("[[keyframe]]", "[keyframe]", "duplicate key"),
    ] {
        let text = PATH.replacen(from, to, 1);
        assert_ne!(text, PATH);
        let error = CameraPath::from_text("a path", &text).unwrap_err();
        let told = error.to_string();
        assert!(told.contains(wanted) && told.contains("a path"), "no `{wanted}` in: {told}");
        assert!(!told.contains('\n') && error.hint().is_some());
    }
    assert!(CameraPath::from_text("a path", "frames = 3").is_err());
    let error = CameraPath::open(std::path::Path::new("no/such.toml")).unwrap_err();
    assert_eq!(error.fault(), Fault::Environment, "{error}");
}
