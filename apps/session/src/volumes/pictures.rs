//! Answers questions about a scene: its pictures and its painting, what lies at a place of the
//! picture, and its script.

use glam::Vec3;
use graphics::camera::Camera;
use graphics::encoding::{linear_from_encoded, over_white};
use graphics::export::frame_of;
use graphics::field::Field;
use paint::amount::mm_from_quanta;
use paint::document::{Document, Slots};
use paint::layer::SLOTS;
use spectra::color::{ColorCode, Rgb};
use volumes::containing::Inside;
use volumes::painter::CELL_MM;
use volumes::pigments::{Film, FilmProfile, FilmScale, FilmSum, SampleLattice};
use volumes::script::RegionTable;
use volumes::volume::Volume;
use volumes::world::World;

use super::event::{Here, SceneImage, SceneRecording};
use super::gesture::Hit;
use super::header::{camera_table, recorded_camera};
use super::painters::{Quality, Sight};
use super::scene::Scene;
use crate::event::PickedLayer;
use crate::failure::FileFailure;

impl Scene {
    /// A camera rounded as the recording stores it. Pictures are drawn with this one.
    pub(super) fn recorded_camera(&self, camera: &Camera) -> Camera {
        recorded_camera(camera, &self.mesh)
    }

    /// The picture for export, with all samples.
    pub(super) fn image(&mut self, sight: &Sight) -> Result<SceneImage, FileFailure> {
        // If the user went to another moment, show that one.
        self.reach_moment()?;
        if self.painters.paints(&self.look) {
            return SceneImage::of_painting(self.painting(sight)?);
        }
        Ok(SceneImage::drawing(self.picture(sight)?))
    }

    /// The picture with all samples, in linear sRGB.
    pub(super) fn picture(&mut self, sight: &Sight) -> Result<Field<[f32; 4]>, FileFailure> {
        let world = self.timeline.now().world();
        let picture = self.painters.picture(world, sight, &self.look, Quality::BEST)?;
        // This is what the command line writes, to the bit.
        Ok(linear_from_encoded(&over_white(&picture)))
    }

    /// The painting that the scene makes.
    pub(super) fn painting(&mut self, sight: &Sight) -> Result<Document, FileFailure> {
        self.reach_moment()?;
        let world = self.timeline.now().world();
        let title = &self.recorded.base().title;
        self.painters.painting(world, sight, &self.look, title)
    }

    /// The bytes of the picture.
    pub(super) fn pixels(
        &mut self,
        sight: &Sight,
        quality: Quality,
    ) -> Result<Vec<[u8; 4]>, FileFailure> {
        let world = self.timeline.now().world();
        let picture = self.painters.picture(world, sight, &self.look, quality)?;
        let frame = frame_of(&picture);
        self.shown = Some(picture);
        Ok(frame.values().iter().map(|&[red, green, blue]| [red, green, blue, 255]).collect())
    }

    /// Surface, paint and colour at a place of the picture.
    pub(super) fn here(&self, sight: &Sight, at: [f32; 2]) -> Here {
        let srgb = self.shown.as_ref().map_or([0; 3], |shown| color_at(shown, at));
        let drawing = &self.settings.drawing;
        let profile = FilmProfile { rim: drawing.rim, edge: drawing.edge, gate: drawing.gate };
        let found = self.hit(sight, at).map(|hit| {
            let found = found_at(self.timeline.now().world(), &hit, profile);
            (hit.place, found)
        });
        described(found, srgb, self.materials.slots, &self.recorded.base().regions)
    }

    /// The script as it would be saved, seen by `camera`. Fails if it is too long for a file.
    pub(super) fn recording(&self, camera: Option<Camera>) -> Result<SceneRecording, FileFailure> {
        let mut script = self.script();
        script.camera = camera.map(|camera| camera_table(&camera)).or(script.camera);
        let text = script.to_text().map_err(|error| FileFailure::explained(&error))?;
        let folder = self.folder.clone();
        let subject = self.file.clone();
        let library = self.materials.file.clone();
        let revision = self.recorded.revision();
        Ok(SceneRecording { text: text.into(), folder, subject, library, revision })
    }
}

/// Volumes and paint at a place on a surface.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) volumes: usize,
    /// Index of the region of the last volume found. It is `None` if no volume is there.
    pub(super) region: Option<usize>,
    /// Heights of the films in mm by slot, and then of the vehicle.
    pub(super) heights_mm: [f64; SLOTS + 1],
}

/// Finds the volumes of `world` around a place on its surface, and the films of their paint there.
pub(super) fn found_at(world: &World, hit: &Hit, profile: FilmProfile) -> Found {
    let Hit { place, normal } = *hit;
    let nearest = world.grid().nearest(place);
    let body = nearest.map_or(0, |(sample, _)| world.grid().samples.bodies[sample]);
    let own = world
        .volumes()
        .iter()
        .filter(|volume: &&Volume| volume.body == 0 || body == 0 || volume.body == body);
    let holding = own.filter(|volume| Inside::of(volume).holds(place));
    let volumes: Vec<Volume> = holding.cloned().collect();
    let samples = &world.grid().samples;
    let lattice = SampleLattice::of(&samples.places, world.cell());
    let quantum_mm3 = world.quantum_mm3();
    let unit_mm = world.unit_mm();
    let scale = FilmScale { quantum_mm3, unit_mm, cell_mm: CELL_MM };
    let surface = (&samples.into(), &lattice);
    let films = Film::of_volumes(&volumes, profile, surface, &scale);
    let insides: Vec<Inside> = volumes.iter().map(Inside::of).collect();
    let heights = FilmSum { films: &films, insides: &insides }.at(place, normal);
    Found {
        volumes: volumes.len(),
        region: volumes.last().map(|volume| usize::from(volume.region)),
        heights_mm: heights.0.map(|quanta| mm_from_quanta(quanta.max(0) as u32, CELL_MM)),
    }
}

/// Colour of a picture at a share of its width and height.
pub(super) fn color_at(picture: &Field<[f32; 4]>, at: [f32; 2]) -> [u8; 3] {
    let sides = [picture.width(), picture.height()];
    let [x, y] = [0, 1].map(|axis: usize| {
        let place = (at[axis] * sides[axis] as f32).max(0.0) as usize;
        place.min(sides[axis].saturating_sub(1))
    });
    let [red, green, blue, _] = picture[(x, y)];
    [red, green, blue].map(|value| (value.clamp(0.0, 1.0) * 255.0).round() as u8)
}

/// Describes for the painter what is at a place (if there is a surface) and the colour shown there.
pub(super) fn described(
    found: Option<(Vec3, Found)>,
    srgb: [u8; 3],
    slots: Slots,
    regions: &[RegionTable],
) -> Here {
    let rgb = Rgb(srgb.map(|channel| f64::from(channel) / 255.0));
    let lab = ColorCode::Srgb(rgb).lab();
    let lab = [lab.lightness, lab.a, lab.b];
    let Some((place, found)) = found else {
        return Here { place: None, volumes: 0, region: None, paint: None, lab, srgb };
    };
    let amounts_mm = found.heights_mm;
    let has_paint = amounts_mm.iter().any(|height_mm| *height_mm > 0.0);
    let label = "Paint".to_owned();
    let paint = has_paint.then_some(PickedLayer { label, slots, amounts_mm, opacity: 1.0 });
    let region = found.region.and_then(|index| Some(regions.get(index)?.name.clone()));
    Here { place: Some(place), volumes: found.volumes, region, paint, lab, srgb }
}
