//! The thickness of a glaze relative to its recipe.

use rayon::prelude::*;
use spectra::color::Rgb;

use crate::watercolor::effects::{ColorRange, color_mask_on_cpu, density_excess, edges_on_cpu};
use crate::watercolor::pipeline::dry_brush_reach;
use crate::watercolor::settings::Settings;
use crate::watercolor::textures::Textures;
use crate::watercolor::wash::Controls;
use graphics::field::Field;

/// The factor of each pixel's glaze height: the product of all densities d that would change
/// its colour (see [`crate::watercolor::apply_density`]), of what the dry brush leaves, and
/// of coverage. `color` is the wash, displaced by the grain of the paper already;
/// `settings` are those for its size.
///
/// # Panics
/// If sizes differ.
#[must_use]
pub fn thickness(
    color: &Field<[f32; 4]>,
    controls: &Controls,
    textures: &Textures,
    settings: &Settings,
) -> Field<f32> {
    let (width, height) = (color.width(), color.height());
    let Textures { flow, dispersion, paper } = textures;
    let Controls { dry_brush, density } = controls;
    let greys = [flow, dispersion, &paper.heights].into_iter().chain(dry_brush).chain(density);
    for grey in greys {
        let size = (grey.width(), grey.height());
        assert_eq!(size, (width, height), "textures and controls must have the picture's size");
    }
    let edges = match settings.edges.strength {
        0.0 => Field::filled(width, height, 0.0),
        _ => edges_on_cpu(color, settings.edges.width_px),
    };
    let reach = dry_brush_reach(paper, settings);
    let center = settings.dry_brush.color.as_deref().and_then(Rgb::from_hex);
    let by_color = center.filter(|_| reach.threshold > 0.0).map(|center| {
        let range = ColorRange::around(center, settings.dry_brush.tolerance);
        color_mask_on_cpu(color, range, dry_brush.as_ref())
    });
    let dry_brush = by_color.as_ref().or(dry_brush.as_ref());
    let mut thickness = Field::filled(width, height, 0.0);
    thickness.values_mut().par_iter_mut().with_min_len(1024).enumerate().for_each(|(i, out)| {
        let at = |field: &Field<f32>| field.values()[i];
        let mask = density.as_ref().map_or(1.0, at);
        let layers = [
            density_excess(settings.edges.strength, 0.0, at(&edges), mask),
            density_excess(settings.flow.strength, 0.5, at(flow), mask),
            density_excess(settings.dispersion.strength, 0.5, at(dispersion), mask),
            density_excess(-settings.paper.strength, 0.5, at(&paper.heights), mask),
        ];
        let product = layers.into_iter().fold(settings.wash.density, |d, k| d * (1.0 + k));
        let kept = match reach.threshold > 0.0 {
            true => reach.kept(at(&paper.heights), at(flow), dry_brush.map_or(1.0, at)),
            false => 1.0,
        };
        *out = product * kept * color.values()[i][3];
    });
    thickness
}
