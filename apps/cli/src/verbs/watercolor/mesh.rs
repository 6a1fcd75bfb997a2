//! `impasto watercolor` of a mesh: a picture, or the frames of a moving camera.

use graphics::camera::Camera;
use graphics::compute::Compute;
use graphics::encoding::{encoded_from_linear, linear_from_encoded};
use graphics::export::frame_of;
use graphics::mesh::Mesh;
use paint::document::Document;
use watercolor::{ModelPainter, Stage};

use super::job::{Job, Summary};
use super::photograph::pigment_names;
use super::pigments::open_painting;
use crate::animation::FramesDigest;
use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::progress::waited;

/// Paints a mesh. The picture and the stages show it from the first camera, the animation from all
/// cameras.
pub(super) fn paint(
    compute: Compute,
    job: Job,
    mesh: Mesh,
    cameras: &[Camera],
    size: (usize, usize),
    console: &mut Console<'_>,
) -> Result<Summary> {
    let Job { title, settings, mut glazes, outputs, animation } = job;
    let (width, height) = size;
    let controls = outputs.masks()?.controls(width, height);
    let mut digest =
        FramesDigest::default().add(&env!("CARGO_PKG_VERSION")).add(&settings).add(&cameras);
    if animation.is_some() {
        digest = digest.add(&mesh).add(&compute.name()).add(&glazes);
        // The settings hold only the paths of these pictures, so add their content.
        digest = digest.add(&settings.paper.scan.as_ref().map(std::fs::read));
        digest = digest.add(&settings.toon.greys.as_ref().map(std::fs::read));
        digest = digest.add(&controls);
    }
    let mut painter = waited("preparing the model", console, || {
        ModelPainter::new(compute, mesh, &settings, size)
    })?;
    painter.set_controls(controls);
    let Some(first) = cameras.first() else {
        return Err(Failure::data("the camera path has no frames", "give frames = 60"));
    };
    let recording = match animation {
        Some(animation) => Some(animation.begin(digest, cameras.len(), size)?),
        None => None,
    };
    if outputs.wants_stages() {
        let mut stages = vec![("surface".to_owned(), painter.unlit(first)?)];
        let mut keep = |stage: Stage, color| stages.push((stage.name().to_owned(), color));
        painter.paint_stages(first, Some(&mut keep))?;
        outputs.write_stages(&stages, console)?;
    }
    if outputs.exports.any() {
        match &mut glazes {
            None => {
                let painted = waited("painting", console, || painter.paint(first))?;
                let picture = linear_from_encoded(&painted);
                outputs.exports.write_picture(&picture, painter.paper().px_mm, console)?;
            }
            Some(glazes) => {
                let document = waited("painting", console, || -> Result<Document> {
                    let (wash, textures) = painter.wash(first)?;
                    Ok(glazes.paint(&title, &wash, &textures, painter.settings())?)
                })?;
                outputs.exports.write(&mut open_painting(document, glazes)?, console)?;
            }
        }
    }
    let mut frames = None;
    if let Some(recording) = recording {
        if let Some(glazes) = &mut glazes {
            // Pigments are chosen from the first camera, so that a resumed run chooses the same.
            glazes.choose(&painter.wash(first)?.0)?;
        }
        let found = recording.paint(console, |index| {
            let camera = &cameras[index];
            let picture = match &mut glazes {
                None => painter.paint(camera)?,
                Some(glazes) => {
                    let (wash, textures) = painter.wash(camera)?;
                    let document = glazes.paint("frame", &wash, &textures, painter.settings())?;
                    encoded_from_linear(&open_painting(document, glazes)?.picture()?)
                }
            };
            Ok(frame_of(&picture))
        })?;
        frames = Some((cameras.len(), found));
    }
    Ok(Summary {
        size,
        backend: painter.compute_name().to_owned(),
        regions: None,
        frames,
        pigments: pigment_names(glazes.as_ref()),
    })
}
