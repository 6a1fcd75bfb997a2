//! The cameras of a script.

use graphics::camera::{Camera, CameraPath, Framing, Keyframe, PictureView};
use graphics::mesh::Mesh;
use volumes::script::{CameraTable, KeyframeTable, Row, ScriptCamera};
use volumes::toml_text::{Fault, KeyPath};

use crate::failure::Result;
use crate::subject::{FARTHEST_DEG, SubjectOptions, picture_turns};

/// The camera that options choose, for a script of a model or a photograph.
pub(super) fn camera_table(options: &SubjectOptions, photograph: bool) -> Result<CameraTable> {
    let turntable = options.turntable().and_then(|frames| u32::try_from(frames).ok());
    if photograph {
        let way = options.picture_camera()?.map(|way| way.map(f64::from));
        let [azimuth_deg, elevation_deg] = [0, 1].map(|axis| way.map(|way| way[axis]));
        return Ok(CameraTable { azimuth_deg, elevation_deg, turntable, ..CameraTable::default() });
    }
    let Some(path) = options.camera_file()? else {
        let Framing { azimuth_deg, elevation_deg, field_of_view_deg, .. } = options.framing(1.0)?;
        return Ok(CameraTable {
            azimuth_deg: Some((azimuth_deg % 360.0).into()),
            elevation_deg: Some(elevation_deg.into()),
            field_of_view_deg: Some(field_of_view_deg.into()),
            turntable,
            ..CameraTable::default()
        });
    };
    let CameraPath { frames, closed, keyframes } = CameraPath::open(path)?;
    let keyframes = keyframes
        .into_iter()
        .map(|own: Keyframe| KeyframeTable {
            eye: Row(own.eye.map(f64::from)),
            target: Row(own.target.map(f64::from)),
            up: Some(Row(own.up.map(f64::from))),
            field_of_view_deg: Some(own.field_of_view_deg.into()),
        })
        .collect();
    let frames = u32::try_from(frames).ok();
    Ok(CameraTable { frames, closed, keyframes, ..CameraTable::default() })
}

/// The cameras of a model in a picture of this size; `frames` is the number of those of a path
/// without one of its own.
pub(super) fn model_cameras(
    table: &CameraTable,
    mesh: &Mesh,
    (width, height): (usize, usize),
    frames: usize,
) -> Vec<Camera> {
    let framing = match table.camera(frames) {
        ScriptCamera::Path(path) => return path.cameras(mesh.bounds()),
        ScriptCamera::Framing(framing) => framing,
    };
    let framing = Framing { aspect: width as f32 / height as f32, ..framing };
    match table.turntable {
        Some(frames) => framing.fit_turntable(&mesh.positions, frames as usize),
        None => vec![framing.fit(&mesh.positions)],
    }
}

/// The cameras before a photograph.
///
/// # Errors
/// [`Fault`] of degrees that are too far to its side, and of an angle of view, which it has itself.
pub(super) fn picture_cameras(
    table: &CameraTable,
    view: PictureView,
    mesh: &Mesh,
    frames: usize,
) -> Result<Vec<Camera>, Box<Fault>> {
    if let ScriptCamera::Path(path) = table.camera(frames) {
        return Ok(path.cameras(mesh.bounds()));
    }
    let degrees = |name, value: Option<f64>| match value {
        Some(value) if value.abs() > f64::from(FARTHEST_DEG) => {
            let wanted = format!("-{FARTHEST_DEG} to {FARTHEST_DEG} before a photograph");
            Err(fault(name, wanted, value, "0 is straight before it"))
        }
        value => Ok(value.unwrap_or(0.0) as f32),
    };
    let right = degrees("azimuth_deg", table.azimuth_deg)?;
    let up = degrees("elevation_deg", table.elevation_deg)?;
    if let Some(angle) = table.field_of_view_deg {
        let wanted = "no value before a photograph, which fills the picture";
        return Err(fault("field_of_view_deg", wanted.to_owned(), angle, "leave it out"));
    }
    let given = table.azimuth_deg.is_some() || table.elevation_deg.is_some();
    let turns = picture_turns(given.then_some([right, up]), table.turntable.map(u64::from));
    Ok(turns.into_iter().map(|[right, up]| view.turned(right, up)).collect())
}

/// The fault of a value of the table.
fn fault(name: &str, wanted: String, found: f64, hint: &str) -> Box<Fault> {
    let key = KeyPath::of("camera").key(name);
    let hint = hint.to_owned();
    Box::new(Fault { key, wanted, found: found.to_string(), hint })
}
