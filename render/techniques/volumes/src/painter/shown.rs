//! Pictures of the result, or of one of its parts.

use std::str::FromStr;

use documents::hint::{Explain, Fault, Hint};
use documents::similar_names;
use graphics::camera::Camera;
use graphics::field::Field;

use super::error::PaintingError;
use super::volume_painter::VolumePainter;
use crate::drawing::{Inside, Region, TintTable};
use crate::pigments::Glass;
use crate::surfaces::REGIONS;
use crate::world::World;

/// The subject of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Show {
    /// The result.
    #[default]
    Final,
    /// The volumes themselves, as coloured glass over the grey drawing.
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
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("pictures do not show `{name}`")]
pub struct ShowError {
    /// Name that was asked for.
    pub name: String,
}

impl Show {
    /// All that pictures can show.
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

impl Explain for ShowError {
    fn hint(&self) -> Option<Hint> {
        let names = Show::ALL.map(Show::name);
        let similar = similar_names(&self.name, names);
        Some(Hint::verbatim(match similar.is_empty() {
            true => format!("they show {}", names.join(", ")),
            false => format!("did you mean {}?", similar.join(" or ")),
        }))
    }

    fn fault(&self) -> Fault {
        Fault::Setting
    }
}

impl VolumePainter {
    /// A picture of the scene that shows `show`, like [`Self::paint`].
    ///
    /// # Errors
    /// Those of [`Self::paint`].
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
                // Black becomes white by the tint.
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
