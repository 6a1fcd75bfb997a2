//! Plays a script of paint volumes and writes a picture of every second of it. Run it like this:
//! `cargo run -r -p impasto-volumes --example spread -- FOLDER [SCRIPT.toml]`.
//!
//! If you give no script, colour wakes a village.

use std::error::Error;
use std::path::{Path, PathBuf};

use graphics::camera::{Camera, PictureView};
use graphics::export::{frame_of, frame_png};
use graphics::mesh::Mesh;
use graphics::picture::Photograph;
use graphics::picture_formats::has_picture_ending;
use volumes::painter::VolumePainter;
use volumes::performance::{FirstView, Performance};
use volumes::script::{Script, ScriptCamera, Subject};
use volumes::world::STEPS_PER_SECOND;

const SIZE: (usize, usize) = (750, 570);

const TRIANGLES: usize = 60_000;

const VILLAGE: &str = r#"
format = "paint-volumes"
version = 1
subject = "shape:village"
seconds = 6.0
preset = "washed"

[[pour]]
picked = [0.5, 0.5]
for_s = 5.0
amount_mm3 = 300

[[pour]]
picked = [0.3, 0.6]
from_s = 1.0
for_s = 4.0
amount_mm3 = 100
"#;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let folder = arguments.next().map_or_else(|| PathBuf::from("."), PathBuf::from);
    let (name, text) = match arguments.next().map(PathBuf::from) {
        Some(path) => (path.display().to_string(), std::fs::read_to_string(&path)?),
        None => ("village".to_owned(), VILLAGE.to_owned()),
    };
    let script = Script::from_text(&name, &text)?;
    let (scene, camera) = subject(&script, Path::new(&name).parent().unwrap_or(Path::new("")))?;
    let settings = script.settings().map_err(|fault| fault.to_string())?;

    // We play the world from the first second to the last.
    let view = FirstView::new(&scene, &camera, SIZE);
    let mut performance = Performance::new(&script, &scene, &settings, &view)
        .map_err(|error| error.located(&name, &text))?;
    // Its pictures are grey outside of the volumes, and in colour inside.
    let mut painter = VolumePainter::new(&scene, &settings, &script.region_styles(&settings))?;
    for second in 0..=script.seconds as u64 {
        performance
            .advance_to(second * u64::from(STEPS_PER_SECOND))
            .map_err(|error| error.located(&name, &text))?;
        let picture = painter.paint(performance.world(), &camera, SIZE)?;
        std::fs::write(folder.join(format!("{second}.png")), frame_png(&frame_of(&picture))?)?;
    }
    Ok(())
}

/// The scene of a script, with its files in `folder`, and the camera that sees it first.
fn subject(script: &Script, folder: &Path) -> Result<(Mesh, Camera), Box<dyn Error>> {
    let aspect = SIZE.0 as f32 / SIZE.1 as f32;
    let scene = match script.subject_in(folder).map_err(|fault| fault.to_string())? {
        Subject::Shape(shape) => shape.mesh(TRIANGLES),
        Subject::File(path) if has_picture_ending(&path) => {
            let photograph = Photograph::open(&path)?;
            let (width, height) = photograph.size();
            let mesh = Mesh::of_picture(&photograph.with_opacity(width, height));
            return Ok((mesh, PictureView::of(SIZE).camera()));
        }
        Subject::File(path) => Mesh::open(&path)?,
    };
    let camera = match script.camera.clone().unwrap_or_default().camera(1) {
        ScriptCamera::Framing(framing) => {
            graphics::camera::Framing { aspect, ..framing }.fit(&scene.positions)
        }
        ScriptCamera::Path(path) => path.cameras(scene.bounds())[0],
    };
    Ok((scene, camera))
}
