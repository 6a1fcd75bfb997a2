//! The two surfaces that hold wet paint.

use std::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};

/// A surface of a painting session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceId {
    /// The canvas that is painted on.
    #[default]
    Canvas,
    /// The palette that paint is mixed on.
    Palette,
}

impl SurfaceId {
    /// Both surfaces, the canvas first.
    pub const ALL: [Self; 2] = [Self::Canvas, Self::Palette];

    /// Whether this is the canvas.
    #[must_use]
    pub fn is_canvas(&self) -> bool {
        *self == Self::Canvas
    }
}

/// One value for each surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct PerSurface<T> {
    /// Value of the canvas.
    pub canvas: T,
    /// Value of the palette.
    pub palette: T,
}

impl<T> PerSurface<T> {
    /// The value `of` each surface.
    #[must_use]
    pub fn from_fn(mut of: impl FnMut(SurfaceId) -> T) -> Self {
        Self { canvas: of(SurfaceId::Canvas), palette: of(SurfaceId::Palette) }
    }

    /// References to both values.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        [&self.canvas, &self.palette].into_iter()
    }
}

impl<T> Index<SurfaceId> for PerSurface<T> {
    type Output = T;

    fn index(&self, surface: SurfaceId) -> &T {
        match surface {
            SurfaceId::Canvas => &self.canvas,
            SurfaceId::Palette => &self.palette,
        }
    }
}

impl<T> IndexMut<SurfaceId> for PerSurface<T> {
    fn index_mut(&mut self, surface: SurfaceId) -> &mut T {
        match surface {
            SurfaceId::Canvas => &mut self.canvas,
            SurfaceId::Palette => &mut self.palette,
        }
    }
}
