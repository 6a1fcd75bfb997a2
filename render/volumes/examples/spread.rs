//! Pours paint onto a sample model and writes pictures of it: `cargo run -r -p impasto-volumes
//! --example spread -- FOLDER`.

use std::path::PathBuf;

use graphics::camera::Framing;
use graphics::export::{frame_of, frame_png};
use graphics::mesh::SampleModel;
use volumes::painter::VolumePainter;
use volumes::performance::{FirstView, Performance};
use volumes::script::Script;

const SCRIPT: &str = r#"
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

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let script = Script::from_text("spread", SCRIPT)?;
    let scene = SampleModel::Village.mesh(60_000);
    let size = (750, 570);
    let framing = Framing { aspect: 750.0 / 570.0, ..Framing::default() };
    let camera = framing.fit(&scene.positions);
    let settings = script.settings().map_err(|fault| fault.to_string())?;
    let view = FirstView::new(&scene, &camera, size);
    let mut performance = Performance::new(&script, &scene, &settings, &view)?;
    let mut painter = VolumePainter::new(&scene, &settings, &script.region_styles(&settings))?;
    for second in 0..=6_u64 {
        let start = std::time::Instant::now();
        performance.advance_to(120 * second)?;
        let played = start.elapsed();
        let start = std::time::Instant::now();
        let picture = painter.paint(performance.world(), &camera, size)?;
        println!(
            "{second} s: {} volumes, played in {played:?}, painted in {:?}, {:?}",
            performance.world().volumes().len(),
            start.elapsed(),
            performance.world().tally().on_scene
        );
        std::fs::write(folder.join(format!("{second}.png")), frame_png(&frame_of(&picture))?)?;
    }
    Ok(())
}
