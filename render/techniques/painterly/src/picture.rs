//! Photographs and other pictures as subjects: a plane, or a relief.

use std::sync::Arc;

use artmap::map::ArtMap;
use glam::{Vec2, Vec3};
use graphics::camera::PictureView;
use graphics::field::Field;
use graphics::mesh::{DirectionField, DirectionSettings, GridSize, Guide, Line, Material, Mesh};
use graphics::orientation::OrientationField;
use graphics::picture::Photograph;
use graphics::surface::PackedMesh;

use super::brushwork::Brushwork;
use super::coloring::{Coloring, SubjectKind};
use super::error::PainterError;
use super::painter::Painter;
use super::picture_form::PictureForm;
use super::picture_layers::{LayerColors, layer_colors};
use super::places::{Detail, Directions, NORMAL_ROUNDS, Surface, interpolated};
use super::regions::{RegionMap, Regions};
use super::settings::{Settings, ToneSource};
use super::subject::Subject;

/// Most vertices along the longer side of a plane, and of a relief.
const MOST_VERTICES: [f32; 2] = [160.0, 256.0];

/// Widest margin beyond the edges, by the longer side.
const MOST_MARGIN: f32 = 0.25;

/// Standard deviation of the structure tensor, in distances of strokes.
const TENSOR: f64 = 0.6;

/// A picture shows each of its strokes once.
const MORE: f32 = 1.02;

impl Painter {
    /// Paints a photograph or another picture in the brushwork of an art map. Lays the map out and
    /// finds the strokes.
    ///
    /// ```
    /// use artmap::map::ArtMap;
    /// use graphics::camera::PictureView;
    /// use painterly::{Painter, Settings};
    /// use graphics::picture::Photograph;
    /// # fn example(map: &ArtMap, photograph: &Photograph) -> Result<(), Box<dyn std::error::Error>> {
    /// let mut painter = Painter::of_picture(photograph, map, &Settings::default())?;
    /// let camera = PictureView::of(photograph.size()).camera();
    /// let painted = painter.paint(&camera, (640, 480), 0.0)?;
    /// assert_eq!(painted.color.width(), 640);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`PainterError`] for a map without tiles and settings out of their ranges.
    pub fn of_picture(
        picture: &Photograph,
        map: &ArtMap,
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        Self::of_picture_with(picture, &Brushwork::of(map), &PictureForm::default(), settings)
    }

    /// Paints a picture with several maps, each for some regions of the picture, and with a
    /// form: depth, flow, guides.
    ///
    /// # Errors
    /// Those of [`Self::of_picture`]; [`PainterError::Regions`] for regions that pictures cannot have.
    pub fn of_picture_with(
        picture: &Photograph,
        brushwork: &Brushwork<'_>,
        form: &PictureForm,
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        settings.valid()?;
        brushwork.check()?;
        let subject = subject(picture, brushwork, form, settings)?;
        Self::new(subject, &brushwork.art_maps(), settings)
    }
}

/// A picture as a subject.
fn subject(
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
    let surface = |layer: LayerColors| Surface {
        mesh: Arc::clone(&mesh),
        packed: Arc::new(packed(&mesh, &layer)),
        directions: Arc::clone(&directions),
        detail: layer.shown.map_or(Detail::Everywhere, Detail::Pictured),
        regions: Arc::clone(&regions),
    };
    let surfaces: Vec<Surface> = layers.into_iter().map(surface).collect();
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

/// A plane, or a relief that looks the same from the camera of the picture. It goes on beyond the
/// picture by a margin, so that strokes cover the edges too.
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
    let share = |uv: Vec2| 0.5 + (uv - 0.5) * (1.0 + 2.0 * margin / sides);
    mesh.add_grid(GridSize { columns, rows }, 0, |uv| {
        let inside = share(uv).clamp(Vec2::ZERO, Vec2::ONE);
        let near = depth.map_or(0.5, |depth| interpolated(depth, inside));
        let height = settings.picture.relief * (near - 0.5);
        let at = (share(uv) - 0.5) * sides * (1.0 - height / eye);
        Vec3::new(at.x, -at.y, height)
    });
    for at in &mut mesh.texture_coordinates {
        *at = share(Vec2::from(*at)).clamp(Vec2::ZERO, Vec2::ONE).to_array();
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
        let cell = |at: f32, count: usize| ((at * count as f32) as usize).min(count - 1);
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
    let off = |share: &[f32; 2]| Vec2::from(*share).distance_squared(at.into());
    let vertices = mesh.texture_coordinates.iter().enumerate();
    let nearest = vertices.min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
    Guide { vertex: nearest.map_or(0, |(vertex, _)| vertex as u32), along: [x, -y, 0.0] }
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod flow_tests;
