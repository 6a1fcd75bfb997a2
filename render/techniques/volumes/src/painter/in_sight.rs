//! Which volumes may hold something that a picture shows. This also loads a scene into the memory
//! of the processor or a device, turns the settings of a file into the look of a drawing, and
//! counts volumes and their shells at each visible point, region by region.

use glam::{Mat4, Vec3};
use graphics::camera::Camera;
use graphics::compute::{Compute, Image};
use graphics::distant_light::DistantLight;
use graphics::field::Field;
use graphics::gpu::{Device, DeviceError};
use graphics::surface::{
    Fragment, Gates, InsideCounter, Model, NO_TRIANGLE, PackedMesh, VisibilityBuffer,
};
use graphics::tones::ToneRamp;
use rayon::prelude::*;
use spectra::color::Rgb;

use crate::drawing::{DrawingLook, ShellError, Shells};
use crate::hatching::{Coordinates, Hatching, HatchingLook, ThresholdTexture};
use crate::pigments::{Facets, FilmProfile, InsidePaint};
use crate::script::RegionStyle;
use crate::settings::{DrawingTable, LightWith, Settings, StrokesAlong};
use crate::surfaces::VolumeSurfaces;
use crate::volume::Volume;

const TILE: usize = 16;

/// We treat depths this close as equal, because of rounding.
const MARGIN: f32 = 1e-5;

#[derive(Debug)]
pub(super) struct InSight {
    clip_from_model: Mat4,
    size: [f32; 2],
    columns: usize,
    /// Least and greatest seen depth of each tile. `None` for a picture on a device.
    depths: Option<Vec<[f32; 2]>>,
}

impl InSight {
    /// Takes what `camera` sees. If the picture is on a device, we do not know its depths, and test
    /// only whether volumes lie inside of the picture.
    pub(super) fn new(camera: &Camera, visible: &Image<Fragment>) -> Self {
        let (width, height) = visible.size();
        let depths = match visible {
            Image::Host(visible) => Some(tiles(visible)),
            Image::Device(_) => None,
        };
        Self {
            clip_from_model: camera.clip_from_model(width as f32 / height as f32),
            size: [width as f32, height as f32],
            columns: width.div_ceil(TILE),
            depths,
        }
    }

    /// Whether a volume may hold something that you see. This is false only if the box around the
    /// volume meets no tile in which you see something at its depth.
    pub(super) fn may_hold(&self, volume: &Volume) -> bool {
        let [low, high] = bounds(volume);
        let mut least = Vec3::INFINITY;
        let mut most = Vec3::NEG_INFINITY;
        for corner in 0..8 {
            let at =
                Vec3::from([0, 1, 2].map(|axis: usize| {
                    if corner >> axis & 1 == 0 { low[axis] } else { high[axis] }
                }));
            let clip = self.clip_from_model * at.extend(1.0);
            // What is behind the eye has no place in the picture.
            let before = clip.w > f32::MIN_POSITIVE && clip.is_finite();
            if !before {
                return true;
            }
            let at = clip.truncate() / clip.w;
            (least, most) = (least.min(at), most.max(at));
        }
        let [width, height] = self.size;
        // We add a sample on each side, for corners that are rounded.
        let columns = [(0.5 + 0.5 * least.x) * width - 1.0, (0.5 + 0.5 * most.x) * width + 1.0];
        let rows = [(0.5 - 0.5 * most.y) * height - 1.0, (0.5 - 0.5 * least.y) * height + 1.0];
        if columns[1] < 0.0 || rows[1] < 0.0 || columns[0] > width || rows[0] > height {
            return false;
        }
        let Some(depths) = &self.depths else { return true };
        fn range([from, to]: [f32; 2], side: f32) -> std::ops::RangeInclusive<usize> {
            let last = (side as usize).saturating_sub(1) / TILE;
            from as usize / TILE..=(to as usize / TILE).min(last)
        }
        let across = range(columns, width);
        let depths_of_row = depths.chunks(self.columns);
        let rows = range(rows, height);
        let rows = depths_of_row.take(rows.end() + 1).skip(*rows.start());
        let mut tiles = rows.flat_map(|row| &row[across.clone()]);
        tiles
            .any(|[nearest, farthest]| *nearest <= most.z + MARGIN && *farthest >= least.z - MARGIN)
    }
}

fn bounds(volume: &Volume) -> [Vec3; 2] {
    let axes = volume.particles.places.each_ref();
    let low = axes.map(|axis: &Vec<f32>| axis.iter().copied().fold(f32::INFINITY, f32::min));
    let high = axes.map(|axis: &Vec<f32>| axis.iter().copied().fold(f32::NEG_INFINITY, f32::max));
    [low, high].map(|corner| volume.center + Vec3::from(corner))
}

/// Least and greatest seen depth of each tile. They are infinite and minus infinite where nothing
/// is seen.
fn tiles(visible: &VisibilityBuffer) -> Vec<[f32; 2]> {
    let width = visible.width();
    let rows = visible.values().par_chunks(width.max(1) * TILE);
    let tiles = rows.flat_map_iter(|rows| {
        let mut tiles = vec![[f32::INFINITY, f32::NEG_INFINITY]; width.div_ceil(TILE)];
        for row in rows.chunks(width) {
            for (tile, seen) in tiles.iter_mut().zip(row.chunks(TILE)) {
                for fragment in seen.iter().filter(|seen| seen.triangle != NO_TRIANGLE) {
                    *tile = [tile[0].min(fragment.depth), tile[1].max(fragment.depth)];
                }
            }
        }
        tiles
    });
    tiles.collect()
}

#[derive(Debug)]
pub(super) struct LoadedScene {
    pub(super) compute: Compute,
    pub(super) model: Model,
    pub(super) hatching: Hatching,
    pub(super) normals: Image<[f32; 4]>,
    bodies: Vec<u32>,
    pub(super) counter: InsideCounter,
    /// Whether it can count volumes with gates, which limit them to surfaces of one body and
    /// direction. The processor can, and so can a device if its fragments can write to buffers.
    pub(super) gates: bool,
}

impl LoadedScene {
    pub(super) fn new(
        mut compute: Compute,
        packed: &PackedMesh,
        facets: &Facets,
        texture: &ThresholdTexture,
    ) -> Result<Self, DeviceError> {
        Ok(Self {
            model: Model::new(&mut compute, packed.clone())?,
            hatching: Hatching::new(&mut compute, texture, packed)?,
            normals: compute.upload(&gated(facets, &[]))?,
            bodies: Vec::new(),
            counter: InsideCounter::default(),
            gates: compute.device().is_none_or(Device::scatters),
            compute,
        })
    }

    /// Sets the bodies of the triangles. Use 0 for triangles that volumes of any body may hold.
    pub(super) fn tell_bodies(
        &mut self,
        facets: &Facets,
        bodies: &[u32],
    ) -> Result<(), DeviceError> {
        if self.bodies != bodies {
            self.normals = self.compute.upload(&gated(facets, bodies))?;
            self.bodies = bodies.to_vec();
        }
        Ok(())
    }

    pub(super) fn is_host(&self) -> bool {
        matches!(self.compute, Compute::Cpu)
    }
}

fn gated(facets: &Facets, bodies: &[u32]) -> Field<[f32; 4]> {
    let bodies = bodies.iter().copied().chain(std::iter::repeat(0));
    let own = facets.normals().iter().zip(bodies);
    let own: Vec<_> = own.map(|(normal, body)| normal.extend(body as f32).to_array()).collect();
    Field::from_values(own.len(), 1, own)
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct RegionLook {
    pub(super) name: String,
    pub(super) inside: InsidePaint,
    pub(super) shells: Shells,
    pub(super) stain: [f32; 3],
}

impl RegionLook {
    pub(super) fn of(style: &RegionStyle) -> Result<Self, ShellError> {
        Ok(Self {
            name: style.name.clone(),
            inside: style.inside,
            shells: Shells::new(style.shells.clone(), style.tints.clone())?,
            stain: encoded(&style.stain),
        })
    }
}

pub(super) fn drawing_look(settings: &Settings) -> DrawingLook {
    let light = &settings.light;
    let hatching = &settings.hatching;
    let with_camera = DistantLight::with_camera(light.azimuth_deg, light.elevation_deg);
    let direction = match (light.with, with_camera) {
        (LightWith::Model, DistantLight::WithCamera(towards)) => DistantLight::WithModel(towards),
        (_, direction) => direction,
    };
    DrawingLook {
        light: direction,
        tones: ToneRamp::steps(light.levels as usize, light.softness),
        lit: light.lit,
        shade: light.shade,
        pale: settings.grey.pale,
        weights: settings.grey.weights,
        hatching: HatchingLook {
            coordinates: match hatching.along {
                StrokesAlong::Axes => Some(Coordinates::ThreePlanes),
                StrokesAlong::Texture => None,
            },
            inside: hatching.inside,
            outside: hatching.outside,
            pencil: hatching.pencil,
            width_px: hatching.width_px,
            softness: hatching.softness,
            darkest: hatching.darkest,
            angle_deg: hatching.angle_deg,
        },
        samples: settings.picture.samples as usize,
    }
}

pub(super) fn paper(settings: &Settings) -> [f32; 3] {
    encoded(&settings.picture.paper)
}

/// A colour written `#rrggbb`. If the text is not a colour, you get white.
fn encoded(text: &str) -> [f32; 3] {
    Rgb::from_hex(text).unwrap_or(Rgb([1.0; 3])).0.map(|value| value as f32)
}

pub(super) fn profile(settings: &Settings) -> FilmProfile {
    let DrawingTable { rim, edge, gate, .. } = settings.drawing;
    FilmProfile { rim, edge, gate }
}

pub(super) fn inside(regions: &[RegionLook]) -> InsidePaint {
    let has_own_colors = regions.iter().any(|own| own.inside.has_own_colors());
    let has_films = regions.iter().any(|own| own.inside.has_films());
    match (has_own_colors, has_films) {
        (true, false) => InsidePaint::OwnColors,
        (false, _) => InsidePaint::Glaze,
        (true, true) => InsidePaint::Both,
    }
}

/// A gate without limits: the volume holds surfaces of any direction and any body.
const OPEN: [f32; 8] = [0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0];

#[derive(Debug, Clone, Copy)]
pub(super) struct Volumes<'a> {
    pub(super) volumes: &'a [Volume],
    /// Mean normal of each volume's cell. A single volume has zero.
    pub(super) facing: &'a [Vec3],
}

#[derive(Debug, Clone, Default)]
pub(super) struct RegionSurfaces {
    surfaces: VolumeSurfaces,
    /// The gate of each surface: the direction that its volume faces, the least cosine to this
    /// direction, and the body.
    gates: Vec<[f32; 8]>,
}

impl RegionSurfaces {
    /// Replaces the surfaces by the surfaces of region `number` that may hold something you see.
    /// Volumes of the grid hold only what belongs to the body of their cell and faces the same
    /// way, by a cosine of at least `gate`.
    pub(super) fn update(
        &mut self,
        all: Volumes<'_>,
        (number, look): (usize, &RegionLook),
        gate: f32,
        in_sight: &InSight,
    ) {
        self.surfaces.clear();
        self.gates.clear();
        for (volume, &facing) in all.volumes.iter().zip(all.facing) {
            if usize::from(volume.region) != number || !in_sight.may_hold(volume) {
                continue;
            }
            let mut own = OPEN;
            if facing != Vec3::ZERO {
                own[..4].copy_from_slice(&facing.extend(gate).to_array());
            }
            own[4] = volume.body as f32;
            for &scale in look.shells.scales() {
                self.surfaces.add(volume, scale, self.gates.len() as u32);
                self.gates.push(own);
            }
        }
    }

    pub(super) fn gated(&self) -> bool {
        self.gates.iter().any(|gate| *gate != OPEN)
    }

    /// The count of each sample. If a surface has a gate, `scene` must be able to count with
    /// gates.
    pub(super) fn counts(
        &self,
        scene: &mut LoadedScene,
        visible: &Image<Fragment>,
        camera: &Camera,
    ) -> Result<Image<i32>, DeviceError> {
        let closed = self.surfaces.closed();
        let LoadedScene { compute, model, normals, counter, .. } = scene;
        if !self.gated() {
            return counter.counts(compute, (model, visible), camera, closed);
        }
        let gates = Gates { surfaces: &self.gates, normals };
        counter.gated(compute, visible, camera, (closed, gates))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surfaces::VolumeSurfaces;
    use crate::test_volumes::{bumpy, camera, plane};
    use graphics::field::Field;
    use graphics::surface::{Count, Crossings, visible};

    fn count(volume: &Volume, camera: &Camera, seen: &VisibilityBuffer) -> usize {
        let own = VolumeSurfaces::of(std::slice::from_ref(volume));
        let counts: Field<i32> = Crossings::default().sum(&Count, own.closed(), camera, seen);
        counts.values().iter().filter(|&&count| count != 0).count()
    }

    #[test]
    fn a_volume_that_holds_something_seen_is_in_sight() {
        let mut left_out = 0;
        let mut held = 0;
        for (turned, distance) in [(0.0, 6.0), (50.0, 5.0), (85.0, 2.5), (10.0, 0.4)] {
            let camera = camera(turned, distance);
            let seen = visible(&plane(20), &camera, 97, 61);
            let in_sight = InSight::new(&camera, &Image::from(seen.clone()));
            for i in 0..400_u64 {
                let [x, y, z, wide] = [7, 31, 97, 13].map(|by: u64| (i * by % 401) as f32 / 401.0);
                let center = Vec3::new(8.0 * x - 2.0, 8.0 * y - 2.0, 3.0 * z - 1.5);
                let volume = bumpy(center, 0.1 + 0.5 * wide, 1, i);
                let holds = count(&volume, &camera, &seen) > 0;
                let kept = in_sight.may_hold(&volume);
                assert!(kept || !holds, "{turned}: volume {i} at {center}");
                left_out += usize::from(!kept);
                held += usize::from(holds);
            }
        }
        assert!(left_out > 800 && held > 50, "{left_out} {held}");
    }

    #[test]
    fn without_depths_a_volume_in_the_picture_is_in_sight() {
        let camera = camera(0.0, 6.0);
        let seen = visible(&plane(4), &camera, 97, 61);
        let whole = InSight::new(&camera, &Image::from(seen));
        let without = InSight { depths: None, ..whole };
        fn ball(x: f32, z: f32) -> Volume {
            Volume::ball(Vec3::new(x, 2.0, z), 0.3, 1, 1)
        }
        assert!(without.may_hold(&ball(2.0, -1.0)) && !without.may_hold(&ball(12.0, 0.0)));
    }
}
