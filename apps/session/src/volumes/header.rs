//! Converts parts of a script for the window: cameras, places that a script picks in a picture, and
//! amounts of paint in mm3.

use glam::Vec3;
use graphics::camera::{Camera, Framing, PictureView};
use graphics::mesh::Mesh;
use volumes::performance::FirstView;
use volumes::script::{self, CameraTable, KeyframeTable, Row, Script, ScriptCamera};
use volumes::world::Tally;

use super::event::SceneTally;

/// Scripts pick places in a picture of this size, as on the command line.
const FIRST_PICTURE: (usize, usize) = (1000, 750);

pub(super) fn script_steps(script: &Script) -> u64 {
    u64::from(script::steps_of(script.seconds))
}

/// A camera that frames a subject in a picture of 4 by 3. It sees a model from the right and above,
/// and a flat subject from the front.
pub(super) fn framed(mesh: &Mesh, flat: bool) -> Camera {
    let framing = Framing { field_of_view_deg: 35.0, aspect: 4.0 / 3.0, ..Framing::default() };
    match flat {
        true => Framing { azimuth_deg: 0.0, elevation_deg: 0.0, ..framing }.fit(&mesh.positions),
        false => framing.fit(&mesh.positions),
    }
}

/// Size of the first picture of a scene. If the scene is `flat`, it has the shape of its
/// photograph.
pub(super) fn first_size(mesh: &Mesh, flat: bool) -> (usize, usize) {
    let [low, high] = mesh.bounds();
    let [width, height] = [high.x - low.x, high.y - low.y];
    let rows = (FIRST_PICTURE.0 as f32 * height / width).round();
    if flat && rows >= 1.0 { (FIRST_PICTURE.0, rows as usize) } else { FIRST_PICTURE }
}

/// The camera of the first picture of a script. A `flat` scene, i.e. a photograph, fills its
/// picture. Its angles count from the front, as on the command line.
pub(super) fn first_camera(script: &Script, mesh: &Mesh, flat: bool) -> Camera {
    let table = script.camera.clone().unwrap_or_default();
    if flat && table.keyframes.is_empty() {
        let [right, up] = [table.azimuth_deg, table.elevation_deg].map(Option::unwrap_or_default);
        let view = PictureView::of(first_size(mesh, flat));
        return view.turned(right as f32, up as f32);
    }
    let aspect = FIRST_PICTURE.0 as f32 / FIRST_PICTURE.1 as f32;
    let framing = match script.camera.as_ref().map(|camera| camera.camera(1)) {
        Some(ScriptCamera::Path(path)) => {
            if let Some(first) = path.cameras(mesh.bounds()).into_iter().next() {
                return first;
            }
            Framing::default()
        }
        Some(ScriptCamera::Framing(framing)) => framing,
        None => Framing::default(),
    };
    Framing { aspect, ..framing }.fit(&mesh.positions)
}

/// A camera in the form of a script.
pub(super) fn camera_table(camera: &Camera) -> CameraTable {
    fn row(place: Vec3) -> Row<3> {
        Row(place.to_array().map(f64::from))
    }
    let keyframe = KeyframeTable {
        eye: row(camera.eye),
        target: row(camera.target),
        up: None,
        field_of_view_deg: Some(camera.field_of_view_deg.into()),
    };
    CameraTable { keyframes: vec![keyframe], ..CameraTable::default() }
}

/// A camera rounded to the digits of a file. If you show this one, the recording gives the same
/// bytes when it is played.
pub(super) fn recorded_camera(camera: &Camera, mesh: &Mesh) -> Camera {
    let mut script = Script::new("", 0.0);
    script.camera = Some(camera_table(camera));
    first_camera(&script.rounded(), mesh, false)
}

/// Replaces places picked in the first picture by places on the subject, so that a recording does
/// not depend on its camera. A pick that hits nothing stays, and is refused when the script is
/// played.
pub(super) fn resolve_picks(script: &mut Script, mesh: &Mesh, view: &FirstView) {
    let pours = script.pours.iter_mut().map(|pour| (&mut pour.at, &mut pour.picked));
    let lifts = script.lifts.iter_mut().map(|lift| (&mut lift.at, &mut lift.picked));
    for (at, picked) in pours.chain(lifts) {
        let place = picked.and_then(|Row(share)| view.place(mesh, share));
        if let Some(place) = place {
            (*at, *picked) = (Some(Row(place.to_array().map(f64::from))), None);
        }
    }
}

/// Where the paint is, in mm3.
pub(super) fn tally(tally: &Tally, quantum_mm3: f64, volumes: usize) -> SceneTally {
    let [poured_mm3, on_surfaces_mm3, lifted_mm3, left_mm3] =
        [tally.poured, tally.on_scene, tally.lifted, tally.in_tube]
            .map(|amounts| amounts.iter().sum::<u64>() as f64 * quantum_mm3);
    SceneTally { poured_mm3, on_surfaces_mm3, lifted_mm3, left_mm3, volumes }
}
