//! Films on surfaces, counted at every pixel.

use graphics::surface::{Crossing, CrossingSum};

use super::film::{Film, FilmHeights};
use super::seen::SeenPlaces;

/// The heights of the films at each pixel: a volume's part is added where its faces are left behind
/// the seen place and taken away where they are entered there. The surfaces that are crossed are
/// those of the volumes, in their order.
#[derive(Debug, Clone, Copy)]
pub struct FilmOnSurface<'a> {
    /// The film of each volume.
    pub films: &'a [Film],
    /// Places that the pixels show.
    pub seen: &'a SeenPlaces<'a>,
}

impl CrossingSum for FilmOnSurface<'_> {
    type Sum = FilmHeights;

    #[inline]
    fn add(&self, sum: &mut FilmHeights, crossing: &Crossing) {
        let (place, normal) = self.seen.at(crossing.pixel);
        let film = &self.films[crossing.surface as usize];
        let foreign = film.wetted.is_foreign(self.seen.body(crossing.pixel));
        if let Some(heights) = film.at(place, normal).filter(|_| !foreign) {
            sum.add(&heights, crossing.sign);
        }
    }
}
