//! Helpers that apply an effect to fields: upload, compute, download.

use graphics::compute::{Compute, GreyImage, Image};
use graphics::field::Field;
use watercolor::{self as effects, ColorRange, DensityLayer, DryBrushReach, PaperShading};

type Colors = Field<[f32; 4]>;
type Greys = Field<f32>;

/// A texture with its strength and pivot.
pub(super) type Layer<'a> = (&'a Greys, f32, f32);

fn uploaded(compute: &mut Compute, mask: Option<&Greys>) -> Option<GreyImage> {
    mask.map(|mask| compute.upload(mask).unwrap())
}

fn downloaded<T: bytemuck::Pod>(compute: &mut Compute, image: &Image<T>) -> Field<T> {
    compute.download(image).unwrap()
}

pub(super) fn apply_density(
    compute: &mut Compute,
    color: &Colors,
    overall: f32,
    layers: &[Layer<'_>],
    mask: Option<&Greys>,
) -> Colors {
    let image = compute.upload(color).unwrap();
    let textures: Vec<_> =
        layers.iter().map(|(texture, ..)| compute.upload(*texture).unwrap()).collect();
    let layers: Vec<_> = layers
        .iter()
        .zip(&textures)
        .map(|(&(_, strength, pivot), texture)| DensityLayer { texture, strength, pivot })
        .collect();
    let mask = uploaded(compute, mask);
    let found = effects::apply_density(compute, image, overall, &layers, mask.as_ref()).unwrap();
    downloaded(compute, &found)
}

pub(super) fn edges(compute: &mut Compute, color: &Colors, width_px: f32) -> Greys {
    let image = compute.upload(color).unwrap();
    let found = effects::edges(compute, &image, width_px).unwrap();
    downloaded(compute, &found)
}

pub(super) fn wobble(
    compute: &mut Compute,
    color: &Colors,
    heights: &Greys,
    px_per_slope: f32,
) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let found = effects::wobble(compute, image, &heights, px_per_slope).unwrap();
    downloaded(compute, &found)
}

pub(super) fn apply_dry_brush(
    compute: &mut Compute,
    color: &Colors,
    (heights, flow): (&Greys, &Greys),
    reach: DryBrushReach,
    (edges, mask): (Option<&Greys>, Option<&Greys>),
) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let flow = compute.upload(flow).unwrap();
    let [edges, mask] = [edges, mask].map(|greys| uploaded(compute, greys));
    let edges = edges.as_ref();
    let mask = mask.as_ref();
    let found =
        effects::apply_dry_brush(compute, image, &heights, &flow, reach, edges, mask).unwrap();
    downloaded(compute, &found)
}

pub(super) fn color_mask(
    compute: &mut Compute,
    color: &Colors,
    range: ColorRange,
    mask: Option<&Greys>,
) -> Greys {
    let image = compute.upload(color).unwrap();
    let mask = uploaded(compute, mask);
    let found = effects::color_mask(compute, &image, range, mask.as_ref()).unwrap();
    downloaded(compute, &found)
}

pub(super) fn shade_paper(
    compute: &mut Compute,
    color: &Colors,
    heights: &Greys,
    shading: PaperShading,
) -> Colors {
    let image = compute.upload(color).unwrap();
    let heights = compute.upload(heights).unwrap();
    let found = effects::shade_paper(compute, image, &heights, shading).unwrap();
    downloaded(compute, &found)
}
