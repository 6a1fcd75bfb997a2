//! The parts of a picture for compositing, in one OpenEXR file.

use graphics::camera::Camera;
use graphics::export::{ExrPart, exr_parts};
use graphics::field::Field;
use paint::amount::mm_from_quanta;

use super::averaged::averaged;
use super::error::PaintingError;
use super::films::CELL_MM;
use super::volume_painter::VolumePainter;
use crate::world::World;

impl VolumePainter {
    /// An OpenEXR file of several parts of 32-bit floats, one value for each pixel of `pixel_mm`:
    /// `colour` (encoded sRGB, hatched) and `grey` of the drawing, `count.NAME` and `tint.NAME` of
    /// each region, `ink`, `place` and `normal` in the unit of the scene (0 where nothing is seen),
    /// and with pigments `heights` of the volumes' films in mm by pigment. Made on the processor.
    ///
    /// # Errors
    /// Those of [`Self::paint`]; [`PaintingError::Export`].
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

/// The first channels of a field by name.
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
