//! Paints a 3D model in the brushwork of an art map.
//!
//! `cargo run --release -p impasto-painterly --example painterly_model -- STYLE MODEL OUT.png [TOML]`:
//! a style of painted samples (`oil-flat`), a sample model (`still-life`) or a file, and settings
//! in TOML (`overlap.sharpness = 1`). Without arguments it paints the still life in flat oils.

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use artmap::map::ArtMap;
use artmap::painted::{PaintedSettings, Style, painted_samples};
use artmap::synthesis::SynthesisSettings;
use graphics::camera::Framing;
use graphics::encoding::over_white;
use graphics::export::{frame_of, frame_png};
use graphics::mesh::{Mesh, SampleModel};
use painterly::{Painter, Settings};

const SIZE: (usize, usize) = (1000, 750);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |index: usize, usual: &str| {
        arguments.get(index).cloned().unwrap_or_else(|| usual.to_owned())
    };
    let style = Style::named(&argument(0, "oil-flat"))?;
    let samples = painted_samples(&style, &PaintedSettings::default())?;
    let map = ArtMap::of(&samples, &SynthesisSettings::default())?;
    println!("{} tiles, strokes {:.1} texels apart", map.keys.len(), map.spacing);
    let model = argument(1, "still-life");
    let mesh = match SampleModel::from_name(&model) {
        Some(shape) => shape.mesh(40_000),
        None => Mesh::open(Path::new(&model))?,
    };
    let settings = Settings::default().changed("settings", &argument(3, ""))?;
    let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
    let camera = framing.fit(&mesh.positions);
    let start = Instant::now();
    let mut painter = Painter::of_model(&mesh, &map, &settings)?;
    println!("prepared in {:.2?}, {:.0} % matched", start.elapsed(), 100.0 * painter.matched());
    let start = Instant::now();
    let painted = painter.paint(&camera, SIZE, 0.0)?;
    println!("painted in {:.2?}", start.elapsed());
    let out = argument(2, "painterly.png");
    std::fs::write(&out, frame_png(&frame_of(&over_white(&painted.color)))?)?;
    println!("Wrote {out}");
    Ok(())
}
