//! The picture of the scene over which we lay films.

use graphics::field::Field;
use serde::{Deserialize, Serialize};

use super::film::FilmHeights;

/// The layer under the films of volumes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum UnderPainting {
    /// The scene in grey, in white and black paint.
    #[default]
    Grisaille,
    /// The colours of the scene in mixtures of a palette.
    #[serde(rename = "own-colours")]
    OwnColors,
    /// The bare ground.
    None,
}

/// How the inside of volumes looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum InsidePaint {
    /// The colours of the scene, without a film.
    #[serde(rename = "own-colours")]
    OwnColors,
    /// The film of the volumes' pigments over the same layer as outside of volumes.
    #[default]
    Glaze,
    /// The film of the volumes' pigments over the colours of the scene.
    Both,
}

impl InsidePaint {
    /// Whether volumes show the colours of the scene.
    #[must_use]
    pub fn has_own_colors(self) -> bool {
        self != Self::Glaze
    }

    /// Whether volumes show a film of their pigments.
    #[must_use]
    pub fn has_films(self) -> bool {
        self != Self::OwnColors
    }
}

/// A picture of the scene without its volumes. Its last two fields say where volumes show the scene
/// and how high their films are. All fields have one value for each cell of the painting.
#[derive(Debug, Clone, Copy)]
pub struct Drawing<'a> {
    /// Encoded sRGB of the scene, lit and textured but not hatched, with its grey as the fourth
    /// value, 0..1.
    pub color: &'a Field<[f32; 4]>,
    /// Share of each cell that shows the scene, 0..1. If you leave this out, it is all of the
    /// cell.
    pub cover: Option<&'a Field<f32>>,
    /// Ink of the hatching, 0..1. If you leave this out, there is none.
    pub ink: Option<&'a Field<f32>>,
    /// Share of each cell that shows the inside of volumes, 0..1. If you leave this out, there is
    /// none.
    pub tint: Option<&'a Field<f32>>,
    /// Heights of the volumes' films. If you leave this out, there are none.
    pub films: Option<&'a Field<FilmHeights>>,
}

impl Drawing<'_> {
    pub(super) fn size(&self) -> (usize, usize) {
        let bounds = self.color.bounds();
        let greys = [self.cover, self.ink, self.tint];
        let fits = greys.into_iter().flatten().all(|field| field.bounds() == bounds);
        let fits = fits && self.films.is_none_or(|films| films.bounds() == bounds);
        assert!(fits, "the fields of a drawing differ in size");
        (self.color.width(), self.color.height())
    }
}
