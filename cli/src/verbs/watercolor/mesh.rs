//! `impasto watercolor` of a mesh, from one camera or many.

use render::camera::Camera;
use render::compute::Compute;
use render::encoding::{encoded_from_linear, linear_from_encoded};
use render::export::frame_of;
use render::mesh::Mesh;
use render::watercolor::{ModelPainter, Stage};

use super::animation::FramesDigest;
use super::job::{Job, Made};
use super::photograph::pigment_names;
use super::pigments::opened;
use crate::console::Console;
use crate::failure::{Failure, Result};

pub(super) fn paint(
    compute: Compute,
    job: Job,
    mesh: Mesh,
    cameras: &[Camera],
    size: (usize, usize),
    console: &mut Console<'_>,
) -> Result<Made> {
    let Job { title, settings, mut glazes, outputs, animation } = job;
    let (width, height) = size;
    let controls = outputs.masks()?.controls(width, height);
    let mut digest =
        FramesDigest::default().add(&env!("CARGO_PKG_VERSION")).add(&settings).add(&cameras);
    if animation.is_some() {
        digest = digest.add(&mesh).add(&compute.name()).add(&glazes);
        // Settings name pictures, whose content matters too.
        digest = digest.add(&settings.paper.scan.as_ref().map(std::fs::read));
        digest = digest.add(&settings.toon.greys.as_ref().map(std::fs::read));
        digest = digest.add(&controls);
    }
    let mut painter = ModelPainter::new(compute, mesh, &settings, size)?;
    painter.set_controls(controls);
    let Some(first) = cameras.first() else {
        return Err(Failure::data("a camera's path without a frame", "give frames = 60"));
    };
    let recording = match animation {
        Some(animation) => Some(animation.begin(digest, cameras.len(), size)?),
        None => None,
    };
    if outputs.wants_stages() {
        let mut stages = vec![("surface".to_owned(), painter.unlit(first)?)];
        let mut keep = |stage: Stage, color| stages.push((stage.name().to_owned(), color));
        painter.paint_stages(first, Some(&mut keep))?;
        outputs.write_stages(&stages)?;
    }
    if outputs.exports.any() {
        match &mut glazes {
            None => {
                let picture = linear_from_encoded(&painter.paint(first)?);
                outputs.exports.write_picture(&picture, painter.paper().px_mm, console)?;
            }
            Some(glazes) => {
                let (wash, textures) = painter.wash(first)?;
                let document = glazes.paint(&title, &wash, &textures, painter.settings())?;
                outputs.exports.write(&mut opened(document, glazes)?, console)?;
            }
        }
    }
    let mut frames = None;
    if let Some(recording) = recording {
        if let Some(glazes) = &mut glazes {
            // The first camera decides, whichever frames are still to be made.
            glazes.choose(&painter.wash(first)?.0)?;
        }
        let found = recording.paint(console, |index| {
            let camera = &cameras[index];
            let picture = match &mut glazes {
                None => painter.paint(camera)?,
                Some(glazes) => {
                    let (wash, textures) = painter.wash(camera)?;
                    let document = glazes.paint("frame", &wash, &textures, painter.settings())?;
                    encoded_from_linear(&opened(document, glazes)?.picture()?)
                }
            };
            Ok(frame_of(&picture))
        })?;
        frames = Some((cameras.len(), found));
    }
    Ok(Made {
        size,
        backend: painter.compute_name().to_owned(),
        regions: None,
        frames,
        pigments: pigment_names(glazes.as_ref()),
    })
}
