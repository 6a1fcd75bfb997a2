//! Photographs and other pictures as subjects. We paint them on a plane or a relief. You can give
//! them a form (depth, flow, guides). Each layer sees their colours at the size of its strokes.

use std::path::Path;
use std::sync::Arc;

use glam::{Vec2, Vec3};
use graphics::camera::PictureView;
use graphics::encoding::lab_from_linear;
use graphics::field::{Field, blurred};
use graphics::mesh::{
    DirectionField, DirectionSettings, GridSize, Guide, Line, Material, Mesh, Texture,
};
use graphics::orientation::OrientationField;
use graphics::picture::{Photograph, PhotographError, Picture};
use graphics::surface::PackedMesh;
use rayon::prelude::*;
use spectra::color::Rgb;

use super::coloring::{Coloring, SubjectKind};
use super::guides::{GuideSample, Guides, GuidesError};
use super::painter::{Brushwork, PainterError};
use super::places::{Detail, Directions, NORMAL_ROUNDS, Subject, Surface, interpolated};
use super::regions::{RegionMap, Regions};
use super::settings::{Settings, ToneSource};

/// Most vertices along the longer side of a plane, and of a relief.
const MOST_VERTICES: [f32; 2] = [160.0, 256.0];

/// Widest margin beyond the edges, relative to the longer side.
const MOST_MARGIN: f32 = 0.25;

/// Standard deviation of the structure tensor, in distances of strokes.
const TENSOR: f64 = 0.6;

/// We keep strokes up to this many times the density that the picture needs. Hardly more than 1,
/// because the picture is always seen at one size.
const MORE: f32 = 1.02;

/// The picture as a painter takes it, with its form.
pub(super) fn subject(
    picture: &Photograph,
    brushwork: &Brushwork<'_>,
    form: &PictureForm,
    settings: &Settings,
) -> Result<Subject, PainterError> {
    let (width, height) = picture.size();
    let size_px = [width as u32, height as u32];
    let regions = RegionMap::of_picture(&brushwork.regions, size_px, &brushwork.names(), settings)?;
    let layers = layer_colors(picture, settings);
    let [_, largest] = regions.sizes();
    let mut mesh = plane(PictureView::of((width, height)), form.depth.as_ref(), settings, largest);
    mesh.normals = mesh.smoothed_normals(settings.light.smoothing_rounds as usize);
    let directions =
        directions(&mesh, &layers[0], (&brushwork.regions, &regions, size_px), form, settings)?;
    let directions = Arc::new(directions);
    let regions = Arc::new(regions);
    let mesh = Arc::new(mesh);
    let lightness = (settings.light.tone != ToneSource::Light).then(|| layers[0].range());
    let colors: Vec<(Vec3, f64)> = {
        let texture = layers[0].texture();
        texture
            .texels
            .iter()
            .map(|texel: &u32| {
                let [r, g, b, _] = texel.to_le_bytes().map(|byte| f32::from(byte) / 255.0);
                (Vec3::new(r, g, b), 1.0)
            })
            .collect()
    };
    let maps = brushwork.art_maps();
    let coloring = Coloring::new(&maps, &colors, &settings.color, SubjectKind::Picture);
    let surfaces: Vec<Surface> = layers
        .into_iter()
        .map(|layer: LayerColors| Surface {
            mesh: Arc::clone(&mesh),
            packed: Arc::new(packed(&mesh, &layer)),
            directions: Arc::clone(&directions),
            detail: layer.shown.map_or(Detail::Everywhere, Detail::Pictured),
            regions: Arc::clone(&regions),
        })
        .collect();
    Ok(Subject {
        packed: Arc::clone(&surfaces[0].packed),
        surfaces,
        closed: vec![false; mesh.triangles.len()],
        coloring: Arc::new(coloring),
        lightness,
        units: 1.0,
        more: MORE,
    })
}

/// A plane, or a relief that looks the same from the camera of the picture. We continue it beyond
/// the picture by a margin, so that strokes cover the edges too.
fn plane(view: PictureView, depth: Option<&Field<f32>>, settings: &Settings, largest: f32) -> Mesh {
    let most = MOST_VERTICES[usize::from(depth.is_some())];
    let strokes = settings.reference_px / settings.strokes.width_px;
    let longer = if depth.is_some() { most } else { strokes.clamp(8.0, most) };
    let sides = view.sides();
    let eye = view.distance();
    let [_, length_px] = settings.strokes.radii_px();
    let margin = (largest * length_px / settings.reference_px).min(MOST_MARGIN);
    let [columns, rows] =
        ((sides + 2.0 * margin) * longer).round().to_array().map(|cells| (cells as usize).max(1));
    let mut mesh = Mesh { materials: vec![Material::plain([1.0; 3])], ..Mesh::default() };
    fn share(uv: Vec2, margin: f32, sides: Vec2) -> Vec2 {
        0.5 + (uv - 0.5) * (1.0 + 2.0 * margin / sides)
    }
    mesh.add_grid(GridSize { columns, rows }, 0, |uv| {
        let inside = share(uv, margin, sides).clamp(Vec2::ZERO, Vec2::ONE);
        let near = depth.map_or(0.5, |depth| interpolated(depth, inside));
        let height = settings.picture.relief * (near - 0.5);
        let at = (share(uv, margin, sides) - 0.5) * sides * (1.0 - height / eye);
        Vec3::new(at.x, -at.y, height)
    });
    for at in &mut mesh.texture_coordinates {
        *at = share(Vec2::from(*at), margin, sides).clamp(Vec2::ZERO, Vec2::ONE).to_array();
    }
    mesh
}

/// The mesh with the colours of a layer. Corners keep to the middles of the outer texels, since
/// textures repeat.
fn packed(mesh: &Mesh, layer: &LayerColors) -> PackedMesh {
    let texture = layer.texture();
    let half = [texture.width, texture.height].map(|side| 0.5 / side as f32);
    let material = Material { texture: Some(texture), ..Material::plain([1.0; 3]) };
    let mut packed = PackedMesh::new(&Mesh { materials: vec![material], ..mesh.clone() });
    for vertex in &mut packed.vertices {
        vertex.u = vertex.u.clamp(half[0], 1.0 - half[0]);
        vertex.v = vertex.v.clamp(half[1], 1.0 - half[1]);
    }
    packed
}

/// Directions along the edges of the picture, or as flow, guides and regions ask.
fn directions(
    mesh: &Mesh,
    layer: &LayerColors,
    (regions, map, size_px): (&Regions, &RegionMap, [u32; 2]),
    form: &PictureForm,
    settings: &Settings,
) -> Result<Directions, PainterError> {
    let width = layer.lab.width();
    let height = layer.lab.height();
    let cells = width.max(height) as f32 * settings.strokes.width_px / settings.reference_px;
    let edges = OrientationField::from_lab(&layer.lab, TENSOR * f64::from(cells));
    let own_px = Vec2::from(regions.size_px.unwrap_or(size_px).map(|px| px as f32));
    let mut arrows = vec![Vec2::ZERO; mesh.positions.len()];
    let mut strengths = vec![1.0; mesh.positions.len()];
    let mut lines = Vec::with_capacity(mesh.positions.len());
    for (vertex, share) in mesh.texture_coordinates.iter().enumerate() {
        let share = Vec2::from(*share);
        fn cell(at: f32, count: usize) -> usize {
            ((at * count as f32) as usize).min(count - 1)
        }
        let x = cell(share.x, width);
        let y = cell(share.y, height);
        let mut line =
            (Vec2::from(edges.direction(x, y).map(|part| part as f32)), edges.agreement(x, y));
        if let Some(flow) = &form.flow {
            let arrow = flow.at(share);
            strengths[vertex] = arrow.length().min(1.0);
            if arrow != Vec2::ZERO {
                (line, arrows[vertex]) = ((arrow, 1.0), arrow);
            }
        }
        let region =
            map.at(0, share).checked_sub(1).map(|region| &regions.list[usize::from(region)]);
        let asked = region.and_then(|region| match (region.angle_deg, region.around) {
            (Some(angle), _) => Some(Vec2::from_angle(angle.to_radians())),
            (None, Some(center)) => (share * own_px - Vec2::from(center)).perp().try_normalize(),
            _ => None,
        });
        if let Some(asked) = asked {
            (line, arrows[vertex]) = ((asked, 1.0), asked);
        }
        lines.push(Line { along: [line.0.x, -line.0.y, 0.0], weight: line.1 });
    }
    let guides: Vec<Guide> = form.guides.iter().map(|guide| on_plane(mesh, guide)).collect();
    let settings = DirectionSettings {
        normal_rounds: NORMAL_ROUNDS,
        smoothing: f64::from(settings.strokes.smoothing),
        ..DirectionSettings::default()
    };
    let field = DirectionField::of_lines(mesh, &lines, &settings, &guides)?;
    let any = arrows.iter().any(|arrow| *arrow != Vec2::ZERO);
    let given: Vec<[f32; 3]> = arrows.iter().map(|arrow| [arrow.x, -arrow.y, 0.0]).collect();
    Ok(Directions::new(mesh, field, any.then_some(&given[..])).with_strengths(strengths))
}

/// A guide at the nearest vertex.
fn on_plane(mesh: &Mesh, &[at, [x, y]]: &[[f32; 2]; 2]) -> Guide {
    fn off(share: &[f32; 2], at: [f32; 2]) -> f32 {
        Vec2::from(*share).distance_squared(at.into())
    }
    let vertices = mesh.texture_coordinates.iter().enumerate();
    let nearest = vertices.min_by(|a, b| off(a.1, at).total_cmp(&off(b.1, at)));
    Guide { vertex: nearest.map_or(0, |(vertex, _)| vertex as u32), along: [x, -y, 0.0] }
}

#[cfg(test)]
mod flow_tests {
    //! Strokes that flow over a picture, as optical flow of the painted frames sees them.

    use glam::{DMat2, DVec2};

    use super::super::painter::Painter;
    use super::super::test_scenes::map;
    use super::tests::{photograph, view};
    use super::*;

    /// Side of the windows in which motion is found, in pixels.
    const WINDOW: usize = 60;

    /// Motion of each window from one frame to another in pixels, by least squares over the gradients
    /// (Lucas and Kanade 1981).
    fn motions(before: &Field<f32>, after: &Field<f32>) -> Vec<DVec2> {
        let width = before.width();
        let height = before.height();
        let mut found = Vec::new();
        for top in (2..height - WINDOW).step_by(WINDOW) {
            for left in (2..width - WINDOW).step_by(WINDOW) {
                let mut squares = DMat2::ZERO;
                let mut wanted = DVec2::ZERO;
                for y in top..top + WINDOW {
                    for x in left..left + WINDOW {
                        // Gradients of both frames, so that their mean counts.
                        let beside = [[(x - 1, y), (x + 1, y)], [(x, y - 1), (x, y + 1)]];
                        let slope = DVec2::from(beside.map(|[a, b]| {
                            f64::from(before[b] - before[a] + after[b] - after[a]) / 4.0
                        }));
                        let change = f64::from(after[(x, y)] - before[(x, y)]);
                        squares += DMat2::from_cols(slope * slope.x, slope * slope.y);
                        wanted -= slope * change;
                    }
                }
                found.push(squares.inverse() * wanted);
            }
        }
        found
    }

    #[test]
    fn texels_move_along_the_flow() {
        let even = photograph(320, 240, |_, _| [120; 3]);
        for degrees in [20.0_f32, 115.0, 250.0] {
            let wanted = Vec2::from_angle(degrees.to_radians());
            let flow = FlowPicture::of(Field::filled(2, 2, (0.9 * wanted).to_array()));
            let form = PictureForm { flow: Some(flow), ..PictureForm::default() };
            let mut settings = Settings { reference_px: 320.0, ..Settings::default() };
            settings.strokes.width_px = 14.0;
            (settings.flow.periods, settings.flow.loop_seconds) = (1, 100.0);
            let map = map(1);
            let brushwork = Brushwork::of(&map);
            let mut painter =
                Painter::of_picture_with(&even, &brushwork, &form, &settings).unwrap();
            // The map is 180 px long, a half pixel of motion.
            let [before, after] = [10.0, 10.3].map(|seconds: f64| {
                let color = painter.paint(&view(&even), (320, 240), seconds).unwrap().color;
                let greens = color.values().iter().map(|pixel| pixel[1]).collect();
                Field::from_values(320, 240, greens)
            });
            let mut off: Vec<f64> = motions(&before, &after)
                .into_iter()
                .map(|motion| motion.angle_to(wanted.as_dvec2()).to_degrees().abs())
                .collect();
            off.sort_unstable_by(f64::total_cmp);
            let median = off[off.len() / 2];
            assert!(median < 5.0, "{degrees}: {median} of {off:?}");
        }
    }
}

/// If red and green are this near the middle, they give no direction, since 8 bits do not hold the
/// exact middle.
const STILL: f32 = 0.01;

/// Optional depth, directions and flow of a picture. By default it has none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PictureForm {
    /// Depth from 0 (far) to 1 (near), stretched over the picture.
    pub depth: Option<Field<f32>>,
    /// Directions and flow of strokes.
    pub flow: Option<FlowPicture>,
    /// Places, 0 to 1 over the width and height of the picture, and the direction of strokes at
    /// each. A direction is in px (x to the right, y downwards). You can give it any length.
    pub guides: Vec<[[f32; 2]; 2]>,
}

/// Arrows over a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct FlowPicture {
    /// Arrows, x to the right and y downwards. Their length is the strength, 0 to 1.
    arrows: Field<[f32; 2]>,
}

impl PictureForm {
    /// Reads guides drawn over the picture.
    ///
    /// # Errors
    /// [`GuidesError`] with the path and the guide.
    pub fn guides_of(path: &Path) -> Result<Vec<[[f32; 2]; 2]>, GuidesError> {
        let guides = Guides::open(path)?;
        let [width, height] = guides.size_px;
        let samples = guides.on_picture(width as usize, height as usize)?;
        Ok(samples
            .into_iter()
            .map(|sample: GuideSample| {
                let share = [sample.x / f64::from(width), sample.y / f64::from(height)];
                [share, sample.along].map(|pair| pair.map(|value| value as f32))
            })
            .collect())
    }

    /// Depth of a picture: white is near and black is far.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn depth_of(path: &Path) -> Result<Field<f32>, PhotographError> {
        let picture = Photograph::open(path)?;
        let (width, height) = picture.size();
        let encoded = picture.with_opacity(width, height);
        let grey = encoded.values().iter().map(|[r, g, b, _]| (r + g + b) / 3.0);
        Ok(Field::from_values(width, height, grey.collect()))
    }
}

impl FlowPicture {
    /// Reads a picture of arrows. Red gives the part to the right and green the part upwards, where
    /// one half is 0. Blue is the strength. Pixels with red and green of one half, or with no blue,
    /// have no arrow.
    ///
    /// # Errors
    /// [`PhotographError`] with the path.
    pub fn open(path: &Path) -> Result<Self, PhotographError> {
        let picture = Photograph::open(path)?;
        let (width, height) = picture.size();
        let encoded = picture.with_opacity(width, height);
        let arrows = encoded
            .values()
            .iter()
            .map(|&[red, green, blue, opacity]: &[f32; 4]| {
                let way = Vec2::new(red - 0.5, 0.5 - green);
                let way = if way.abs().max_element() < STILL { Vec2::ZERO } else { way };
                (way.normalize_or_zero() * blue * opacity).to_array()
            })
            .collect();
        Ok(Self { arrows: Field::from_values(width, height, arrows) })
    }

    /// Uses these arrows.
    #[must_use]
    pub fn of(arrows: Field<[f32; 2]>) -> Self {
        Self { arrows }
    }

    /// The arrow at a place, 0 to 1 over width and height.
    pub(super) fn at(&self, share: Vec2) -> Vec2 {
        fn cell(share: f32, count: usize) -> usize {
            ((share * count as f32) as usize).min(count - 1)
        }
        let width = self.arrows.width();
        let height = self.arrows.height();
        self.arrows[(cell(share.x, width), cell(share.y, height))].into()
    }
}

/// Number of cells of a layer for each distance of its strokes.
const CELLS: f32 = 3.0;

/// With default settings, smaller strokes show where colours differ by more than this in CIELAB.
const DIFFERENCE: f32 = 7.0;

/// A picture as the strokes of one layer show it.
#[derive(Debug)]
pub(super) struct LayerColors {
    /// Mean colours of cells, linear sRGB.
    pub(super) picture: Picture,
    pub(super) lab: Field<[f32; 3]>,
    /// Where strokes show, 0 to 1, `None` on the lowest layer.
    pub(super) shown: Option<Field<f32>>,
}

/// The colours of all layers, the lowest first.
pub(super) fn layer_colors(photograph: &Photograph, settings: &Settings) -> Vec<LayerColors> {
    let layers = (0..settings.layers.count).map(|number: u32| {
        let own = settings.of_layer(number);
        let picture = at_strokes(photograph, own.reference_px / own.strokes.width_px * CELLS);
        let lab = lab_from_linear(&picture);
        let shown = number.checked_sub(1).map(|_| {
            // This blur leaves what strokes of the layer below can show.
            let sigma = f64::from(CELLS / 2.0 / settings.layers.ratio);
            let below = blurred(&lab, sigma);
            let pairs = lab.values().par_iter().zip(below.values());
            let off = pairs.map(|(&own, &below)| [Vec3::from(own).distance(below.into())]);
            let off = Field::from_values(lab.width(), lab.height(), off.collect());
            let around = blurred(&off, f64::from(CELLS) / 2.0);
            let shown = around.values().iter().map(|[off]| settings.layers.shown(off / DIFFERENCE));
            Field::from_values(lab.width(), lab.height(), shown.collect())
        });
        LayerColors { picture, lab, shown }
    });
    layers.collect()
}

impl LayerColors {
    pub(super) fn texture(&self) -> Texture {
        Texture {
            width: self.picture.width() as u32,
            height: self.picture.height() as u32,
            texels: self
                .picture
                .values()
                .par_iter()
                .map(|rgb: &[f32; 3]| {
                    let linear = rgb.map(|value| f64::from(value.clamp(0.0, 1.0)));
                    let [r, g, b] = Rgb(linear).encoded().to_bytes();
                    u32::from_le_bytes([r, g, b, 255])
                })
                .collect(),
        }
    }

    /// One hundredth of the picture is darker than the first L*, and one hundredth is lighter than
    /// the second.
    pub(super) fn range(&self) -> [f32; 2] {
        let mut lightness: Vec<f32> = self.lab.values().iter().map(|lab| lab[0]).collect();
        lightness.sort_unstable_by(f32::total_cmp);
        fn at(share: f32, lightness: &[f32]) -> f32 {
            lightness[(share * (lightness.len() - 1) as f32) as usize]
        }
        let [dark, light] = [at(0.01, &lightness), at(0.99, &lightness)];
        [dark, light.max(dark + 1.0)]
    }
}

/// Mean colours of a picture, in about `cells` cells along its longer side. A picture with fewer
/// pixels keeps them.
fn at_strokes(photograph: &Photograph, cells: f32) -> Picture {
    let (width, height) = photograph.size();
    let longer = width.max(height) as f32;
    let scale = (cells / longer).min(1.0);
    fn side(px: usize, scale: f32) -> usize {
        ((px as f32 * scale).round() as usize).max(1)
    }
    photograph.on_canvas(side(width, scale), side(height, scale))
}

#[cfg(test)]
mod tests {
    use super::super::painter::Painter;
    use super::super::regions::{Region, RegionArea};
    use super::super::settings::{ColorSource, Offsets};
    use super::super::test_scenes::map;
    use super::*;
    use artmap::map::ArtMap;
    use graphics::camera::{Camera, PictureView};
    use graphics::encoding::lab_from_linear;
    use graphics::export::frame_png;
    use graphics::picture::Picture;
    use spectra::color::Rgb;

    /// A photograph from encoded bytes.
    pub(super) fn photograph(
        width: usize,
        height: usize,
        color: impl Fn(usize, usize) -> [u8; 3],
    ) -> Photograph {
        let values = (0..width * height).map(|at| color(at % width, at / width)).collect();
        let png = frame_png(&Field::from_values(width, height, values)).unwrap();
        Photograph::from_bytes("made up", &png).unwrap()
    }

    /// Diagonal stripes that fade to the right.
    fn stripes() -> Photograph {
        photograph(200, 120, |x, y| {
            let wave = ((x + y) as f32 * 0.25).sin() * (1.0 - x as f32 / 300.0);
            [128.0 + 90.0 * wave, 110.0 + 60.0 * wave, 90.0].map(|value| value as u8)
        })
    }

    /// The camera that sees exactly a picture.
    pub(super) fn view(picture: &Photograph) -> Camera {
        PictureView::of(picture.size()).camera()
    }

    fn settings() -> Settings {
        let mut settings = Settings { reference_px: 400.0, ..Settings::default() };
        settings.strokes.width_px = 8.0;
        settings
    }

    fn lab(picture: &Field<[f32; 4]>) -> Field<[f32; 3]> {
        fn linear([r, g, b, _]: &[f32; 4]) -> [f32; 3] {
            Rgb([r, g, b].map(|value| f64::from(*value))).linear().0.map(|value| value as f32)
        }
        let linear = picture.values().iter().map(linear).collect();
        lab_from_linear(&Picture::from_values(picture.width(), picture.height(), linear))
    }

    /// Mean colour of a part of a picture.
    fn mean(lab: &Field<[f32; 3]>, x: std::ops::Range<usize>, y: std::ops::Range<usize>) -> Vec3 {
        let cells = y.flat_map(|y| x.clone().map(move |x| (x, y)));
        let (sum, count) = cells
            .fold((Vec3::ZERO, 0.0), |(sum, count), at| (sum + Vec3::from(lab[at]), count + 1.0));
        sum / count
    }

    #[test]
    fn a_picture_keeps_its_colours_and_is_covered_to_its_edges() {
        let left = [150, 60, 40];
        let right = [70, 110, 160];
        let picture = photograph(160, 120, |x, _| if x < 80 { left } else { right });
        let mut painter = Painter::of_picture(&picture, &map(3), &settings()).unwrap();
        let painted = painter.paint(&view(&picture), (320, 240), 0.0).unwrap().color;
        assert!(painted.values().iter().all(|pixel| pixel[3] == 1.0));
        let lab = lab(&painted);
        for (color, columns) in [(left, 20..130), (right, 190..300)] {
            let texel = color.map(|byte| f64::from(byte) / 255.0);
            let linear = Rgb(texel).linear().0.map(|value| value as f32);
            let wanted = Vec3::from(lab_from_linear(&Field::filled(1, 1, linear)).values()[0]);
            let found = mean(&lab, columns, 20..220);
            assert!(found.distance(wanted) < 3.0, "{found} {wanted}");
        }
    }

    #[test]
    fn strokes_run_along_the_edges_of_the_picture() {
        let mut painter = Painter::of_picture(&stripes(), &map(2), &settings()).unwrap();
        let (_, splats) = painter.splats(&view(&stripes()), (400, 240), 0.0).unwrap();
        let inside = splats[0].iter().filter(|splat| splat.x > 20.0 && splat.x < 300.0);
        let mut along = 0;
        let mut count = 0;
        for splat in inside {
            // Lines of equal x + y rise to the right.
            let off = (splat.turn() + std::f32::consts::FRAC_PI_4).sin().abs();
            along += usize::from(off < 8.0_f32.to_radians().sin());
            count += 1;
        }
        assert!(count > 300 && along * 100 > count * 95, "{along} of {count}");
    }

    #[test]
    fn tones_follow_the_lightness_of_the_picture_or_light() {
        let picture = photograph(160, 120, |x, _| if x < 80 { [40; 3] } else { [200; 3] });
        fn of(text: &str, picture: &Photograph) -> f32 {
            let settings = settings().changed("test", text).unwrap();
            let mut painter = Painter::of_picture(picture, &map(3), &settings).unwrap();
            let painted = painter.paint(&view(picture), (160, 120), 0.0).unwrap().color;
            let lab = lab(&painted);
            mean(&lab, 90..150, 10..110).x - mean(&lab, 10..70, 10..110).x
        }
        assert!(of("colour.from = \"map\"", &picture) > 20.0);
        assert!(of("colour.from = \"map\"\nlight.tone = \"light\"", &picture).abs() < 2.0);
    }

    #[test]
    fn guides_flow_pictures_and_regions_turn_strokes() {
        let even = photograph(160, 120, |_, _| [120; 3]);
        let map = map(1);
        fn turned(
            form: &PictureForm,
            regions: Vec<Region>,
            even: &Photograph,
            map: &ArtMap,
        ) -> Vec<(Vec2, f32)> {
            let regions = Regions { list: regions, ..Regions::default() };
            let brushwork = Brushwork { regions, ..Brushwork::of(map) };
            let mut painter =
                Painter::of_picture_with(even, &brushwork, form, &settings()).unwrap();
            let (_, splats) = painter.splats(&view(even), (160, 120), 0.0).unwrap();
            splats[0]
                .iter()
                .map(|splat| (Vec2::new(splat.x, splat.y), splat.turn()))
                .collect::<Vec<_>>()
        }
        fn off(turn: f32, wanted: Vec2) -> f32 {
            Vec2::from_angle(turn).perp_dot(wanted.normalize()).abs()
        }
        let guide = [[0.2, 0.5], [3.0, 3.0]];
        let form = PictureForm { guides: vec![guide], ..PictureForm::default() };
        assert!(
            turned(&form, Vec::new(), &even, &map)
                .iter()
                .all(|(_, turn)| off(*turn, Vec2::ONE) < 0.1)
        );
        let arrows = Field::filled(2, 2, [0.0, -0.5]);
        let form = PictureForm { flow: Some(FlowPicture::of(arrows)), ..PictureForm::default() };
        assert!(
            turned(&form, Vec::new(), &even, &map)
                .iter()
                .all(|(_, turn)| off(*turn, Vec2::Y) < 0.1)
        );
        let whole =
            RegionArea::Polygon(vec![[0.0, 0.0], [160.0, 0.0], [160.0, 120.0], [0.0, 120.0]]);
        let around = Region { around: Some([80.0, 60.0]), ..Region::new("a", whole.clone()) };
        let swirl = turned(&PictureForm::default(), vec![around], &even, &map);
        let far = swirl.iter().filter(|(at, _)| at.distance(Vec2::new(80.0, 60.0)) > 25.0);
        assert!(far.clone().count() > 50);
        for (at, turn) in far {
            assert!(off(*turn, (*at - Vec2::new(80.0, 60.0)).perp()) < 0.3, "{at} {turn}");
        }
        let angle = Region { angle_deg: Some(30.0), ..Region::new("a", whole) };
        let wanted = Vec2::from_angle(30_f32.to_radians());
        let slanted = turned(&PictureForm::default(), vec![angle], &even, &map);
        assert!(slanted.iter().all(|(_, turn)| off(*turn, wanted) < 0.05));
    }

    #[test]
    fn regions_have_their_map_size_and_tones() {
        let even = photograph(160, 120, |_, _| [120; 3]);
        let first = map(1);
        let mut second = map(1);
        // Blue strokes instead of ochre ones.
        second.keys[0].tile.color.values_mut().iter_mut().for_each(|rgb| rgb.reverse());
        let area = RegionArea::Polygon(vec![[0.0, 0.0], [80.0, 0.0], [80.0, 120.0], [0.0, 120.0]]);
        let region =
            Region { map: Some("blue".to_owned()), size: 2.0, ..Region::new("left", area) };
        let regions = Regions { list: vec![region], ..Regions::default() };
        let brushwork = Brushwork { maps: vec![("ochre", &first), ("blue", &second)], regions };
        let mut settings = settings();
        settings.color.from = ColorSource::Map;
        let form = PictureForm::default();
        let mut painter = Painter::of_picture_with(&even, &brushwork, &form, &settings).unwrap();
        let camera = view(&even);
        let lab = lab(&painter.paint(&camera, (320, 240), 0.0).unwrap().color);
        let [left, right] = [10..130, 190..310].map(|columns| mean(&lab, columns, 10..230));
        assert!(left.z < -5.0 && right.z > 5.0, "{left} {right}");
        let (_, splats) = painter.splats(&camera, (320, 240), 0.0).unwrap();
        let mut widths = [0.0; 2];
        let mut counts = [0.0_f32; 2];
        for splat in splats[0].iter().filter(|splat| (splat.x - 160.0).abs() > 20.0) {
            let side = usize::from(splat.x > 160.0);
            widths[side] += 1.0 / Vec2::from(splat.across).length();
            counts[side] += 1.0;
        }
        let ratio = (widths[0] / counts[0]) / (widths[1] / counts[1]);
        assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
        assert!((counts[1] / counts[0] - 4.0).abs() < 1.0, "{counts:?}");
    }

    #[test]
    fn twinkling_changes_tones_in_a_loop_that_closes() {
        let even = photograph(160, 120, |_, _| [120; 3]);
        let mut settings = settings();
        (settings.flow.twinkle, settings.flow.loop_seconds) = (0.3, 2.0);
        let mut painter = Painter::of_picture(&even, &map(3), &settings).unwrap();
        let camera = view(&even);
        let [first, then, last] = [0.0, 0.6, 2.0]
            .map(|seconds: f64| painter.paint(&camera, (160, 120), seconds).unwrap().color);
        assert_eq!(first, last);
        let change = first.values().iter().zip(then.values()).map(|(a, b)| (a[1] - b[1]).abs());
        assert!(change.sum::<f32>() / first.values().len() as f32 > 0.02);
    }

    #[test]
    fn a_relief_looks_the_same_from_the_front_and_shifts_from_the_side() {
        let picture = stripes();
        let depth =
            Field::from_values(20, 12, (0..240).map(|at| (at % 20) as f32 / 19.0).collect());
        let form = PictureForm { depth: Some(depth), ..PictureForm::default() };
        let map = map(2);
        let mut settings = settings();
        settings.overlap.offsets = Offsets::Random;
        let brushwork = Brushwork::of(&map);
        let mut relief = Painter::of_picture_with(&picture, &brushwork, &form, &settings).unwrap();
        let [front, side] =
            [0.0, 20.0].map(|right_deg| PictureView::of(picture.size()).turned(right_deg, 0.0));
        let size = (200, 120);
        let (flat, _) = relief.splats(&front, size, 0.0).unwrap();
        assert!(flat.values().iter().all(|depth| *depth < 1.0), "it fills the picture");
        assert!(flat[(190, 60)] < flat[(10, 60)], "white is near");
        let (turned, _) = relief.splats(&side, size, 0.0).unwrap();
        assert!(turned.values().contains(&1.0));
        // The camera of the picture sees every point of the relief at its own place.
        let painted = relief.paint(&front, size, 0.0).unwrap().color;
        let mut plane = Painter::of_picture(&picture, &map, &settings).unwrap();
        let wanted = plane.paint(&front, size, 0.0).unwrap().color;
        let [found, wanted] = [lab(&painted), lab(&wanted)];
        fn part(lab: &Field<[f32; 3]>) -> Vec3 {
            mean(lab, 30..90, 30..90)
        }
        assert!(part(&found).distance(part(&wanted)) < 3.0);
    }

    #[test]
    fn layers_show_detail_that_large_strokes_blur() {
        let picture = photograph(320, 240, |x, y| {
            let fine = x > 160 && (x / 8 + y / 8).is_multiple_of(2);
            if fine { [220, 200, 160] } else { [70, 60, 60] }
        });
        let [one, three] = [1, 3].map(|layers: u32| {
            let mut settings = settings();
            settings.strokes.width_px = 16.0;
            settings.layers.count = layers;
            let mut painter = Painter::of_picture(&picture, &map(3), &settings).unwrap();
            let painted = painter.paint(&view(&picture), (320, 240), 0.0).unwrap().color;
            let found = lab(&painted);
            let wanted = lab_from_linear(&picture.on_canvas(320, 240));
            let off = found.values().iter().zip(wanted.values());
            off.map(|(a, b)| Vec3::from(*a).distance(Vec3::from(*b))).sum::<f32>() / 76_800.0
        });
        assert!(three < 0.75 * one, "{three} {one}");
    }

    #[test]
    fn strange_pictures_are_painted() {
        for (width, height) in [(1, 1), (3, 200), (200, 2)] {
            let picture = photograph(width, height, |_, _| [90, 120, 30]);
            let mut painter = Painter::of_picture(&picture, &map(1), &settings()).unwrap();
            let camera = view(&picture);
            let painted = painter.paint(&camera, (width.max(2), height.max(2)), 0.0).unwrap();
            assert!(painted.color.values().iter().flatten().all(|value| value.is_finite()));
        }
    }

    #[test]
    fn small_strokes_show_where_large_ones_would_blur() {
        // An even half, and one of fine stripes.
        fn color(x: usize) -> [u8; 3] {
            if x >= 128 && (x / 4).is_multiple_of(2) { [230, 220, 210] } else { [60, 70, 80] }
        }
        let values = (0..256 * 128).map(|index| color(index % 256)).collect();
        let png = frame_png(&Field::from_values(256, 128, values)).unwrap();
        let photograph = Photograph::from_bytes("stripes", &png).unwrap();
        let mut settings = Settings { reference_px: 256.0, ..Settings::default() };
        settings.layers.count = 2;
        settings.strokes.width_px = 12.0;
        let layers = layer_colors(&photograph, &settings);
        assert!(layers[0].shown.is_none());
        assert_eq!((layers[0].picture.width(), layers[1].picture.width()), (64, 128));
        let shown = layers[1].shown.as_ref().unwrap();
        assert!(shown[(10, 30)] == 0.0 && shown[(100, 30)] > 0.9, "{}", shown[(100, 30)]);
        let [dark, light] = layers[0].range();
        assert!((20.0..40.0).contains(&dark) && light > dark + 20.0, "{dark} {light}");
    }
}
