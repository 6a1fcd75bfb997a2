//! The steps to a picture, one by one.

use graphics::camera::Camera;
use graphics::field::Field;
use graphics::surface::{NO_TRIANGLE, SurfacePoint};

use super::averaged::averaged;
use super::drawer::Drawer;
use super::error::PaintingError;
use super::shown::Show;
use super::volume_painter::VolumePainter;
use crate::drawing::{DrawingLook, grey_of, shade_apart};
use crate::world::World;

/// One step to a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Its name in letters, digits and dashes.
    pub name: String,
    /// The picture of it, encoded sRGB whose fourth value is 1.
    pub picture: Field<[f32; 4]>,
}

impl VolumePainter {
    /// The steps to the picture of [`Self::paint`]: the colours that are seen, light, hatching,
    /// colour, grey, count and tint of each region, volumes, mask, and the picture itself.
    ///
    /// # Errors
    /// Those of [`Self::paint`].
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
    /// Colours without light, and the light alone in grey; white where nothing is seen.
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

    /// Count and tint of each region: black where no volume holds what is seen, white in all shells
    /// and at full tint.
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

/// A field as greys.
fn greys(field: &Field<f32>) -> Field<[f32; 4]> {
    let values = field.values().iter().map(|&grey| [grey, grey, grey, 1.0]);
    Field::from_values(field.width(), field.height(), values.collect())
}

/// A name whose other characters than letters and digits are dashes.
fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '-' }).collect()
}
