//! `impasto watercolor` of a photograph.

use graphics::compute::Compute;
use graphics::encoding::linear_from_encoded;
use graphics::picture::Photograph;
use watercolor::{GlazePainter, PhotographPainter};

use super::job::{Job, Summary};
use super::pigments::open_painting;
use crate::console::Console;
use crate::failure::Result;
use crate::progress::{Waiting, waited};
use crate::stages::NamedStage;

/// Paints a photograph, and writes the picture and the stages.
pub(super) fn paint(
    compute: Compute,
    job: Job,
    photograph: &Photograph,
    width: usize,
    console: &mut Console<'_>,
) -> Result<Summary> {
    let Job { title, settings, mut glazes, outputs, .. } = job;
    let mut painter = PhotographPainter::new(settings)
        .with_compute(compute)
        .with_width_px(width)
        .with_masks(outputs.masks()?);
    let waiting = Waiting::new("finding regions", console.shows_progress());
    let prepared = painter.prepare(photograph)?;
    let regions = Some(prepared.regions);
    drop(waiting);
    let mut stages: Vec<NamedStage> = Vec::new();
    let mut picture = None;
    if outputs.wants_stages() {
        let (width, height) = painter.picture_size(photograph);
        stages.push(("photograph".to_owned(), photograph.with_opacity(width, height)));
        stages.push(("regions".to_owned(), prepared.flat_regions()));
        let mut keep = |stage: watercolor::Stage, color| {
            stages.push((stage.name().to_owned(), color));
        };
        picture = Some(painter.paint_prepared(&prepared, Some(&mut keep))?);
        outputs.write_stages(&stages, console)?;
    }
    if outputs.exports.any() {
        match &mut glazes {
            None => {
                let px_mm = prepared.textures.paper.px_mm;
                let picture = match picture {
                    Some(picture) => picture,
                    None => waited("painting", console, || painter.finish(prepared))?,
                };
                outputs.exports.write_picture(&linear_from_encoded(&picture), px_mm, console)?;
            }
            Some(glazes) => {
                let waiting = Waiting::new("mixing glazes", console.shows_progress());
                let wash = &prepared.wash;
                let textures = &prepared.textures;
                let document = glazes.paint(&title, wash, textures, &prepared.settings)?;
                let mut painting = open_painting(document, glazes)?;
                drop(waiting);
                outputs.exports.write(&mut painting, console)?;
            }
        }
    }
    Ok(Summary {
        size: painter.picture_size(photograph),
        backend: painter.compute_name().to_owned(),
        regions,
        frames: None,
        pigments: pigment_names(glazes.as_ref()),
    })
}

/// Names of the pigments that the glazes use; empty without glazes.
pub(super) fn pigment_names(glazes: Option<&GlazePainter>) -> Vec<String> {
    glazes.iter().flat_map(|glazes| glazes.pigments()).map(str::to_owned).collect()
}
