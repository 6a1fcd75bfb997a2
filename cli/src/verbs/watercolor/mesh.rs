//! A mesh, from one camera or many.

use render::camera::Camera;
use render::export::frame_of;
use render::field::Field;
use render::mesh::Mesh;
use render::watercolor::{ModelPainter, MovingBackend as Backend};

use super::moving::Wish;
use super::sheets::{encoded, linear};
use super::{Glazing, Made, Work};
use crate::console::Console;
use crate::failure::Refusal;

/// Samples along each side of a pixel: silhouettes are smooth.
const SAMPLES: usize = 2;

pub(super) fn paint<B: Backend>(
    backend: &mut B,
    work: Work,
    mesh: Mesh,
    cameras: &[Camera],
    size: (usize, usize),
    console: &mut Console<'_>,
) -> anyhow::Result<Made> {
    let Work { title, settings, mut glazing, sheets, moving } = work;
    let (width, height) = size;
    let controls = sheets.controls(width, height)?;
    let mut wish = Wish::default().and(&env!("CARGO_PKG_VERSION")).and(&settings).and(&cameras);
    if moving.is_some() {
        wish = wish.and(&mesh).and(&backend.name()).and(&glazing.as_ref().map(Glazing::wish));
        // Settings have the names of pictures alone.
        wish = wish.and(&settings.paper.scan.as_ref().map(std::fs::read));
        wish = wish.and(&settings.toon.greys.as_ref().map(std::fs::read));
        wish = wish.and(&controls);
    }
    let settings = settings.for_size(width, height);
    let mut painter = ModelPainter::new(backend, mesh, settings, size, SAMPLES)?;
    painter.set_controls(controls);
    let Some(first) = cameras.first() else {
        return Err(Refusal::data("a camera's path without a frame", "give frames = 60"));
    };
    let shots = (cameras.len(), width, height);
    let shooting = moving.map(|moving| moving.begin(wish, shots)).transpose()?;
    let mut stages = Vec::new();
    if sheets.watched() {
        let flat = painter.flat(backend, first)?;
        stages.push(("surface".to_owned(), backend.color_field(&flat)?));
        painter.frame(
            backend,
            first,
            Some(&mut |backend, stage, color| {
                stages.push((stage.name().to_owned(), backend.color_field(color)?));
                Ok(())
            }),
        )?;
        sheets.write_stages(&stages)?;
    }
    if sheets.exports.any() {
        match &mut glazing {
            None => {
                let color = painter.frame(backend, first, None)?;
                let picture = linear(&backend.color_field(&color)?);
                let cell_mm = painter.textures().paper.texture.px_mm;
                sheets.exports.write_picture(&picture, cell_mm, console)?;
            }
            Some(glazing) => {
                let (wash, textures) = painter.at_rest(backend, first)?;
                let mut painting =
                    glazing.painting(&title, &wash, &textures, painter.settings())?;
                sheets.exports.write(&mut painting, console)?;
            }
        }
    }
    let backend_name = backend.name();
    let mut frames = None;
    if let Some(shooting) = shooting {
        if let Some(glazing) = &mut glazing {
            // By the first camera, whichever frames are still to be made.
            let (wash, _) = painter.at_rest(backend, first)?;
            glazing.choose(&wash)?;
        }
        let found = shooting.make(console, |index| {
            let camera = &cameras[index];
            let picture: Field<[f32; 4]> = match &mut glazing {
                None => {
                    let color = painter.frame(backend, camera, None)?;
                    backend.color_field(&color)?
                }
                Some(glazing) => {
                    let (wash, textures) = painter.at_rest(backend, camera)?;
                    let settings = painter.settings();
                    encoded(&glazing.painting("frame", &wash, &textures, settings)?.picture()?)
                }
            };
            Ok(frame_of(&picture))
        })?;
        frames = Some((cameras.len(), found));
    }
    let pigments = glazing.iter().flat_map(Glazing::names).map(str::to_owned).collect();
    Ok(Made { size, backend: backend_name, regions: None, frames, pigments })
}
