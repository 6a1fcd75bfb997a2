//! Meshes as subjects.

use std::sync::Arc;

use super::brushwork::Brushwork;
use super::coloring::{Coloring, SubjectKind};
use super::error::PainterError;
use super::painter::Painter;
use super::places::{Detail, Directions, NORMAL_ROUNDS, Surface, colors};
use super::regions::RegionMap;
use super::settings::{Settings, ToneSource};
use super::subject::Subject;
use artmap::map::ArtMap;
use glam::Vec3;
use graphics::mesh::{DirectionField, DirectionSettings, Guide, Mesh};
use graphics::surface::PackedMesh;

/// Share of the longer side of a picture that a model fills at the size at which strokes have the
/// size of the settings: the height of a picture of 4 : 3, less a margin.
const FILLED: f32 = 0.69;

/// Strokes are kept up to this many times the density that a model needs which fills the picture.
const MORE: f32 = 2.0;

/// Radians by which a surface bends within half a stroke where usual settings show smaller ones.
const BEND: f32 = 0.6;

impl Painter {
    /// Paints a mesh, from any camera, in the brushwork of an art map. Lays the map out and finds the
    /// strokes: what does not depend on the view.
    ///
    /// ```
    /// use artmap::map::ArtMap;
    /// use graphics::camera::Framing;
    /// use graphics::mesh::Mesh;
    /// use painterly::{Painter, Settings};
    /// # fn example(map: &ArtMap) -> Result<(), Box<dyn std::error::Error>> {
    /// let mesh = Mesh::torus_knot(5000);
    /// let camera = Framing::default().fit(&mesh.positions);
    /// let mut painter = Painter::of_model(&mesh, map, &Settings::default())?;
    /// let painted = painter.paint(&camera, (320, 240), 0.0)?;
    /// assert_eq!(painted.color.width(), 320);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`PainterError`] for a mesh that cannot be drawn, a map without tiles, and settings out
    /// of their ranges.
    pub fn of_model(mesh: &Mesh, map: &ArtMap, settings: &Settings) -> Result<Self, PainterError> {
        Self::of_model_with(mesh, &Brushwork::of(map), &[], settings)
    }

    /// Paints a mesh with several maps, each for some materials of the mesh, and with
    /// directions that strokes must have.
    ///
    /// # Errors
    /// Those of [`Self::of_model`]; [`PainterError::Regions`] for regions that the mesh does not have,
    /// [`PainterError::Directions`] for guides that do not lie on the mesh.
    pub fn of_model_with(
        mesh: &Mesh,
        brushwork: &Brushwork<'_>,
        guides: &[Guide],
        settings: &Settings,
    ) -> Result<Self, PainterError> {
        settings.valid()?;
        mesh.check()?;
        brushwork.check()?;
        let subject = subject(mesh, brushwork, guides, settings)?;
        Self::new(subject, &brushwork.art_maps(), settings)
    }
}

/// A mesh as a subject.
fn subject(
    mesh: &Mesh,
    brushwork: &Brushwork<'_>,
    guides: &[Guide],
    settings: &Settings,
) -> Result<Subject, PainterError> {
    let regions = RegionMap::of_mesh(&brushwork.regions, mesh, &brushwork.names(), settings)?;
    let lines = DirectionSettings {
        along: settings.strokes.along.into(),
        normal_rounds: NORMAL_ROUNDS,
        smoothing: f64::from(settings.strokes.smoothing),
    };
    let field = DirectionField::of_curvature(mesh, &lines, guides)?;
    let directions = Arc::new(Directions::new(mesh, field, None));
    let rounds = settings.light.smoothing_rounds as usize;
    let lit = Arc::new(Mesh { normals: mesh.smoothed_normals(rounds), ..mesh.clone() });
    let packed = Arc::new(PackedMesh::new(&lit));
    let colors = colors(mesh, &packed);
    let maps = brushwork.art_maps();
    let coloring = Coloring::new(&maps, &colors, &settings.color, SubjectKind::Model);
    let lightness = (settings.light.tone == ToneSource::Color).then_some([0.0, 100.0]);
    let regions = Arc::new(regions);
    let units = 2.0 * radius(mesh) / FILLED;
    let surface = |layer: u32| {
        let detail = match layer.checked_sub(1) {
            None => Detail::Everywhere,
            Some(below) => {
                let below = settings.of_layer(below);
                let [_, length_px] = below.strokes.radii_px();
                let length = length_px * units / below.reference_px;
                Detail::Bends(length / BEND, settings.layers.clone())
            }
        };
        Surface {
            mesh: Arc::clone(&lit),
            packed: Arc::clone(&packed),
            directions: Arc::clone(&directions),
            detail,
            regions: Arc::clone(&regions),
        }
    };
    Ok(Subject {
        surfaces: (0..settings.layers.count).map(surface).collect(),
        packed: Arc::clone(&packed),
        closed: mesh.closed_parts(),
        coloring: Arc::new(coloring),
        lightness,
        units,
        more: MORE,
    })
}

/// Radius of the sphere around the middle of the bounding box that holds all vertices.
fn radius(mesh: &Mesh) -> f32 {
    let [low, high] = mesh.bounds();
    let middle = (low + high) / 2.0;
    let squares = mesh.positions.iter().map(|&at| Vec3::from(at).distance_squared(middle));
    squares.fold(0.0, f32::max).sqrt().max(f32::MIN_POSITIVE)
}

#[cfg(test)]
mod tests;

#[cfg(test)]
mod painting_tests;

#[cfg(test)]
mod baseline_tests;

#[cfg(test)]
mod strange_tests;

#[cfg(test)]
mod device_tests;
