//! Paints a 3D model as a watercolour.
//!
//! Run `cargo run --release -p impasto-watercolor --example watercolor_model -- MODEL.obj OUT.png`.
//! If you give no arguments, this paints the sample still life into `watercolor.png`.

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::error::Error;
use std::path::PathBuf;

use graphics::camera::Framing;
use graphics::compute::Compute;
use graphics::export::{frame_of, frame_png};
use graphics::mesh::{Mesh, SampleModel};
use watercolor::{ModelPainter, Preset};

const SIZE: (usize, usize) = (480, 360);

fn main() -> Result<(), Box<dyn Error>> {
    let mut paths = std::env::args_os().skip(1).map(PathBuf::from);
    let mesh = match paths.next() {
        Some(path) => Mesh::open(&path)?,
        None => SampleModel::StillLife.mesh(20_000),
    };
    let out = paths.next().unwrap_or_else(|| "watercolor.png".into());
    let framing = Framing { aspect: SIZE.0 as f32 / SIZE.1 as f32, ..Framing::default() };
    let camera = framing.fit(&mesh.positions);
    let style = Preset::Landscape.settings();
    let picture = ModelPainter::new(Compute::cpu(), mesh, &style, SIZE)?.paint(&camera)?;
    std::fs::write(&out, frame_png(&frame_of(&picture))?)?;
    println!("Wrote {}", out.display());
    Ok(())
}
