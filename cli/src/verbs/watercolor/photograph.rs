//! A photograph.

use render::photograph::Photograph;
use render::watercolor::{
    AbstractedPhotograph, AbstractionSettings, Morphology, PhotographSettings,
    SegmentationSettings, Stage, Textures, Watcher, Watercolor, from_photograph, paint as painted,
};

use super::sheets::{NamedStage, linear};
use super::{Glazing, Made, Work};
use crate::console::Console;
use crate::progress::Waiting;

pub(super) fn paint<B: Watercolor + Morphology>(
    backend: &mut B,
    work: Work,
    photograph: &Photograph,
    width: usize,
    console: &mut Console<'_>,
) -> anyhow::Result<Made> {
    let Work { title, settings, mut glazing, sheets, .. } = work;
    let (own_width, own_height) = photograph.size();
    let height = (width as f64 * own_height as f64 / own_width as f64).round().max(1.0) as usize;
    let settings = settings.for_size(width, height);
    let controls = sheets.controls(width, height)?;
    let waiting = Waiting::new("finding regions", console.screen.progress);
    let abstracted =
        from_photograph(backend, photograph, width, &abstraction(&settings.abstraction))?;
    drop(waiting);
    let AbstractedPhotograph { regions, .. } = abstracted;
    let mut stages: Vec<NamedStage> = Vec::new();
    if sheets.watched() {
        stages.push(("photograph".to_owned(), abstracted.original.clone()));
        stages.push(("regions".to_owned(), abstracted.segmented.clone()));
    }
    let mut wash = abstracted.into_wash();
    wash.controls = controls;
    let textures = Textures::new(width, height, &settings)?;
    let px_mm = textures.paper.px_mm;
    let plain = glazing.is_none();
    let mut picture = None;
    if plain || sheets.watched() {
        let there = wash.on(backend)?;
        let own = textures.clone().on(backend)?;
        let mut watch = |backend: &mut B, stage: Stage, color: &B::Color| {
            stages.push((stage.name().to_owned(), backend.color_field(color)?));
            Ok(())
        };
        let watcher: Option<Watcher<'_, B>> =
            if sheets.watched() { Some(&mut watch) } else { None };
        let (flow, dispersion) = (&own.flow, &own.dispersion);
        let color = painted(backend, there, flow, dispersion, &own.paper, &settings, watcher)?;
        if plain && sheets.exports.any() {
            picture = Some(linear(&backend.color_field(&color)?));
        }
    }
    sheets.write_stages(&stages)?;
    if let Some(picture) = picture {
        sheets.exports.write_picture(&picture, px_mm, console)?;
    } else if let Some(glazing) = &mut glazing
        && sheets.exports.any()
    {
        let waiting = Waiting::new("mixing glazes", console.screen.progress);
        let mut painting = glazing.painting(&title, &wash, &textures, &settings)?;
        drop(waiting);
        sheets.exports.write(&mut painting, console)?;
    }
    let pigments = glazing.iter().flat_map(Glazing::names).map(str::to_owned).collect();
    let size = (width, height);
    Ok(Made { size, backend: backend.name(), regions: Some(regions), frames: None, pigments })
}

/// What stands in pixels of this picture, as segmentation takes it.
fn abstraction(settings: &AbstractionSettings) -> PhotographSettings {
    let AbstractionSettings { spatial_px, range_luv, tone_luv, least_region_px, brush_px } =
        *settings;
    let most = PhotographSettings::MOST_SMOOTHING_PX as f32;
    PhotographSettings {
        segmentation: SegmentationSettings {
            spatial_radius_px: spatial_px.clamp(1.0, SegmentationSettings::MOST_SPATIAL_PX),
            range_radius: range_luv,
            least_region_px: least_region_px.round() as u32,
            tone_step: tone_luv,
        },
        smoothing_radius_px: (brush_px / 2.0).round().min(most) as u32,
    }
}
