//! How thick a glaze lies, to what its recipe wants.

use rayon::prelude::*;

use crate::watercolor::density::excess;
use crate::watercolor::pipeline::reach;
use crate::watercolor::{
    Backend, ColorMask, ColorRange, Controls, Edges, OnCpu, Settings, Textures,
};
use graphics::field::Field;
use graphics::gpu::DeviceError;
use spectra::color::Rgb;

/// What a glaze's height is multiplied with, pixel by pixel: the product of all
/// densities d that would change its colour (see [`crate::watercolor::Density`]), of what
/// the dry brush leaves, and of coverage. `color` is the wash, displaced already;
/// settings are those for its size.
///
/// # Errors
/// Never with the processor.
///
/// # Panics
/// If sizes differ.
pub fn thickness(
    color: &Field<[f32; 4]>,
    controls: &Controls,
    textures: &Textures,
    settings: &Settings,
) -> Result<Field<f32>, DeviceError> {
    let (width, height) = (color.width(), color.height());
    let Textures { flow, dispersion, paper } = textures;
    let Controls { dry_brush, density } = controls;
    let greys = [flow, dispersion, &paper.heights].into_iter().chain(dry_brush).chain(density);
    for grey in greys {
        assert_eq!((grey.width(), grey.height()), (width, height), "a texture's size");
    }
    let edges = match settings.edges.strength {
        0.0 => OnCpu.grey_of(&Field::filled(width, height, 0.0))?,
        _ => OnCpu.edges(color, settings.edges.width_px)?,
    };
    let reach = reach(paper, settings);
    let like = settings.dry_brush.color.as_deref().and_then(Rgb::from_hex);
    let by_color = match like {
        Some(like) if reach.threshold > 0.0 => {
            let range = ColorRange::around(like, settings.dry_brush.tolerance);
            Some(OnCpu.color_mask(color, range, dry_brush.as_ref())?)
        }
        _ => None,
    };
    let dry_brush = by_color.as_ref().or(dry_brush.as_ref());
    let mut thickness = Field::filled(width, height, 0.0);
    thickness.values_mut().par_iter_mut().with_min_len(1024).enumerate().for_each(|(i, out)| {
        let at = |field: &Field<f32>| field.values()[i];
        let mask = density.as_ref().map_or(1.0, at);
        let layers = [
            excess(settings.edges.strength, 0.0, at(&edges), mask),
            excess(settings.flow.strength, 0.5, at(flow), mask),
            excess(settings.dispersion.strength, 0.5, at(dispersion), mask),
            excess(-settings.paper.strength, 0.5, at(&paper.heights), mask),
        ];
        let product = layers.into_iter().fold(settings.wash.density, |d, k| d * (1.0 + k));
        let kept = match reach.threshold > 0.0 {
            true => reach.kept(at(&paper.heights), at(flow), dry_brush.map_or(1.0, at)),
            false => 1.0,
        };
        *out = product * kept * color.values()[i][3];
    });
    Ok(thickness)
}
