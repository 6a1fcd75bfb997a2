//! The steps to a picture, one by one, and pictures of the result or of one of its parts. You can
//! also write the parts into one OpenEXR file for compositing.

use std::str::FromStr;

use documents::hint::Explain;
use documents::similar_names;
use graphics::camera::Camera;
use graphics::export::{ExrPart, exr_parts};
use graphics::field::Field;
use graphics::surface::{NO_TRIANGLE, SurfacePoint};
use paint::amount::mm_from_quanta;
use paint::technique::Stage;

use super::drawer::{Drawer, averaged};
use super::error::PaintingError;
use super::films::CELL_MM;
use super::volume_painter::VolumePainter;
use crate::drawing::{DrawingLook, Inside, Region, TintTable, grey_of, shade_apart};
use crate::pigments::Glass;
use crate::surfaces::REGIONS;
use crate::world::World;

impl VolumePainter {
    /// The steps to the picture of [`Self::paint`]: the colours that are seen, light, hatching,
    /// colour, grey, count and tint of each region, volumes, mask, and the picture itself. Names are of
    /// letters, digits and dashes, and the fourth value of all pictures is 1.
    ///
    /// # Errors
    /// This fails like [`Self::paint`].
    pub fn stages(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Vec<Stage>, PaintingError> {
        let drawer = &mut self.drawer;
        let [seen, light] = drawer.seen_and_light(camera, size)?;
        let mut stages = vec![stage("seen", seen), stage("light", light)];
        for show in [Show::Hatching, Show::Color, Show::Grey] {
            stages.push(stage(show.name(), self.shown(world, camera, size, show)?));
        }
        stages.extend(self.drawer.region_stages(world, camera, size)?);
        for (name, show) in
            [("volumes", Show::Volumes), ("mask", Show::Mask), ("picture", Show::Final)]
        {
            stages.push(stage(name, self.shown(world, camera, size, show)?));
        }
        Ok(stages)
    }
}

impl Drawer {
    /// Colours without light, and the light alone in grey. Both are white where nothing is seen.
    fn seen_and_light(
        &mut self,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<[Field<[f32; 4]>; 2], PaintingError> {
        let seen = self.seen(camera, self.samples(size)?)?;
        let visible = seen.host();
        let hatching = &self.host.as_ref().unwrap_or(&self.scene).hatching;
        let bare = DrawingLook { lit: false, ..self.look.clone() };
        let (mut colors, _) = shade_apart(&self.packed, visible, camera, &bare, hatching)?;
        colors.values_mut().iter_mut().for_each(|color| color[3] = 1.0);
        let (look, towards) = (&self.look, self.look.light.direction(camera));
        let seen = visible.values().iter().zip(colors.values());
        let light = seen.map(|(fragment, &[red, green, blue, _])| {
            if fragment.triangle == NO_TRIANGLE {
                return 1.0;
            }
            look.tones.grey(match look.lit {
                true => SurfacePoint::new(&self.packed, *fragment).normal(camera.eye).dot(towards),
                false => grey_of([red, green, blue], look.weights),
            })
        });
        let light = Field::from_values(visible.width(), visible.height(), light.collect());
        Ok([averaged(colors, look.samples), greys(&averaged(light, look.samples))])
    }

    /// Count and tint of each region. They are black where no volume holds what you see, and white
    /// in all shells and at full tint.
    fn region_stages(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
    ) -> Result<Vec<Stage>, PaintingError> {
        let sight = self.sight(world, camera, size)?;
        let mut stages = Vec::new();
        for (index, counts) in sight.counts.iter().enumerate() {
            let name = plain(&self.region_name(index));
            let table = self.tints(index);
            let shells = self.regions[index].shells.scales().len() as f32;
            let count = self.of_counts(counts, |count| (count as f32 / shells).min(1.0))?;
            stages.push(stage(&format!("count-{name}"), greys(&count)));
            let tint = self.of_counts(counts, |count| table.tint(count))?;
            stages.push(stage(&format!("tint-{name}"), greys(&tint)));
        }
        Ok(stages)
    }
}

fn stage(name: &str, picture: Field<[f32; 4]>) -> Stage {
    Stage { name: name.to_owned(), picture }
}

fn greys(field: &Field<f32>) -> Field<[f32; 4]> {
    let values = field.values().iter().map(|&grey| [grey, grey, grey, 1.0]);
    Field::from_values(field.width(), field.height(), values.collect())
}

/// Replaces all characters except letters and digits by dashes.
fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '-' }).collect()
}

/// Contents of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Show {
    /// The result.
    #[default]
    Final,
    /// The volumes themselves. They look like coloured glass over the grey drawing.
    Volumes,
    /// White where volumes bring colour, black elsewhere.
    Mask,
    /// The grey drawing without volumes.
    Grey,
    /// The scene in colour, lit and hatched.
    Color,
    /// The pencil strokes alone.
    Hatching,
}

/// There is nothing of this name to show.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Explain)]
#[error("pictures do not show `{name}`")]
#[hint(verbatim, "{}", way_to_show(name))]
#[fault(Setting)]
pub struct ShowError {
    /// Name that you asked for.
    pub name: String,
}

/// The name that was meant, or all names.
fn way_to_show(name: &str) -> String {
    let names = Show::ALL.map(Show::name);
    let similar = similar_names(name, names);
    match similar.is_empty() {
        true => format!("they show {}", names.join(", ")),
        false => format!("did you mean {}?", similar.join(" or ")),
    }
}

impl Show {
    /// Everything that pictures can show.
    pub const ALL: [Self; 6] =
        [Self::Final, Self::Volumes, Self::Mask, Self::Grey, Self::Color, Self::Hatching];

    /// The name as users write it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Final => "final",
            Self::Volumes => "volumes",
            Self::Mask => "mask",
            Self::Grey => "grey",
            Self::Color => "colour",
            Self::Hatching => "hatching",
        }
    }
}

impl FromStr for Show {
    type Err = ShowError;

    fn from_str(name: &str) -> Result<Self, ShowError> {
        let found = Self::ALL.into_iter().find(|show| show.name() == name);
        found.ok_or_else(|| ShowError { name: name.to_owned() })
    }
}

impl VolumePainter {
    /// A picture of the scene that shows `show`. Otherwise this is like [`Self::paint`].
    ///
    /// # Errors
    /// This fails like [`Self::paint`].
    pub fn shown(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
        show: Show,
    ) -> Result<Field<[f32; 4]>, PaintingError> {
        if show == Show::Final {
            return self.paint(world, camera, size);
        }
        let drawer = &mut self.drawer;
        let paper = drawer.paper();
        match show {
            Show::Final | Show::Grey => {
                let sight = drawer.sight(world, camera, size)?;
                drawer.revealed(&sight, &[], Some(paper))
            }
            Show::Color => {
                let sight = drawer.sight(world, camera, size)?;
                let everywhere = Region {
                    counts: drawer.uploaded(&Field::filled(
                        sight.visible.width(),
                        sight.visible.height(),
                        1,
                    ))?,
                    table: TintTable::hard(),
                    inside: Inside::OwnColors,
                    stain: Region::UNSTAINED,
                };
                drawer.revealed(&sight, &[everywhere], Some(paper))
            }
            Show::Mask => {
                let mut sight = drawer.sight(world, camera, size)?;
                let regions = drawer.regions_of(&sight);
                let (width, height) = sight.visible.size();
                // The tint turns black into white.
                sight.shaded =
                    drawer.uploaded(&Field::filled(width, height, [1.0, 1.0, 1.0, 0.0]))?;
                drawer.revealed(&sight, &regions, Some([0.0; 3]))
            }
            Show::Hatching => drawer.strokes(camera, size),
            Show::Volumes => {
                let sight = drawer.sight(world, camera, size)?;
                let scene = drawer.revealed(&sight, &[], Some(paper))?;
                let (visible, places) = drawer.places(camera, size)?;
                let volumes = world.volumes();
                let colors: Vec<[f32; 3]> = volumes
                    .iter()
                    .map(|volume: &crate::volume::Volume| {
                        REGIONS[usize::from(volume.region) % REGIONS.len()]
                    })
                    .collect();
                let glass = Glass::default();
                Ok(glass.picture(&scene, (volumes, &colors), camera, &visible, &places))
            }
        }
    }
}

impl VolumePainter {
    /// Encodes the parts of a picture as an OpenEXR file of several parts, each of 32-bit floats
    /// with one value per pixel of `pixel_mm`. The processor makes them.
    ///
    /// You get `colour` (encoded sRGB, hatched) and `grey` of the drawing, `count.NAME` and
    /// `tint.NAME` of each region, `ink`, and `place` and `normal` in the unit of the scene (0
    /// where nothing is seen). If you use pigments, there is also `heights` of the volumes' films
    /// in mm by pigment.
    ///
    /// # Errors
    /// This fails like [`Self::paint`], and with [`PaintingError::Export`] if a layer cannot be written.
    pub fn passes(
        &mut self,
        world: &World,
        camera: &Camera,
        size: (usize, usize),
        pixel_mm: f64,
    ) -> Result<Vec<u8>, PaintingError> {
        let Self { drawer, films } = self;
        let samples = drawer.samples_a_pixel();
        let sight = drawer.sight(world, camera, size)?;
        let shaded = averaged(drawer.downloaded(&sight.shaded)?, samples);
        let mut parts: Vec<ExrPart> = vec![
            ("colour".to_owned(), channels(&shaded, ["R", "G", "B"])),
            ("grey".to_owned(), vec![("Y".to_owned(), channel(&shaded, 3))]),
        ];
        for (index, counts) in sight.counts.iter().enumerate() {
            let name = drawer.region_name(index);
            let table = drawer.tints(index);
            let count = drawer.of_counts(counts, |count| count as f32)?.values().to_vec();
            let tint = drawer.of_counts(counts, |count| table.tint(count))?.values().to_vec();
            parts.push((format!("count.{name}"), vec![("N".to_owned(), count)]));
            parts.push((format!("tint.{name}"), vec![("A".to_owned(), tint)]));
        }
        let ink = averaged(drawer.ink(camera, size)?, samples);
        parts.push(("ink".to_owned(), vec![("A".to_owned(), ink.values().to_vec())]));
        let [places, normals] = drawer.surfaces_seen(camera, size)?;
        for (name, field) in [("place", places), ("normal", normals)] {
            parts.push((name.to_owned(), channels(&averaged(field, samples), ["X", "Y", "Z"])));
        }
        if let Some(films) = films {
            let parts_of = drawer.parts(films, world, camera, size)?;
            let library = &films.painter.material().library;
            let mut heights = Vec::new();
            for (slot, id) in films.painter.slots().iter().enumerate() {
                let Some(id) = id else { continue };
                let values = parts_of
                    .heights
                    .values()
                    .iter()
                    .map(|quanta: &crate::pigments::FilmHeights| {
                        mm_from_quanta(quanta.0[slot].max(0) as u32, CELL_MM) as f32
                    })
                    .collect();
                heights.push((library[*id].name.clone(), values));
            }
            parts.push(("heights".to_owned(), heights));
        }
        Ok(exr_parts(size, pixel_mm, parts)?)
    }
}

fn channels<const N: usize, const M: usize>(
    field: &Field<[f32; N]>,
    names: [&str; M],
) -> Vec<(String, Vec<f32>)> {
    let named = names.iter().enumerate();
    named.map(|(index, name)| ((*name).to_owned(), channel(field, index))).collect()
}

fn channel<const N: usize>(field: &Field<[f32; N]>, index: usize) -> Vec<f32> {
    field.values().iter().map(|value| value[index]).collect()
}
