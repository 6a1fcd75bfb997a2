//! Encoding tiles of a picture as sRGB.

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use rayon::prelude::*;

use super::event::TilePixels;
use super::srgb::SrgbBytes;

/// Pixels of `tiles` on a canvas of `bounds`. `read` returns a rectangle of the picture in
/// linear sRGB; it is called once for each run of neighbouring tiles, as each call may be a
/// transfer from the device.
///
/// # Errors
/// The errors of `read`.
pub(super) fn encode<E: Send>(
    tiles: &TileSet,
    bounds: Rect,
    bytes: &SrgbBytes,
    mut read: impl FnMut(Rect) -> Result<Field<[f32; 4]>, E>,
) -> Result<Vec<TilePixels>, E> {
    let mut encoded = Vec::with_capacity(tiles.len());
    for (run, parts) in runs(tiles, bounds) {
        let picture = read(run)?;
        let tiles = parts.into_par_iter().map(|rect| {
            let mut pixels = Vec::with_capacity(rect.width * rect.height);
            for y in 0..rect.height {
                let row = picture.row(rect.y - run.y + y, rect.x - run.x, rect.width);
                pixels.extend(row.iter().map(|&color| bytes.pixel(color)));
            }
            TilePixels { rect, pixels }
        });
        encoded.par_extend(tiles);
    }
    Ok(encoded)
}

/// Runs of neighbouring tiles in a row: the rectangle of each, and its tiles.
pub(super) fn runs(tiles: &TileSet, bounds: Rect) -> Vec<(Rect, Vec<Rect>)> {
    let mut runs: Vec<(Rect, Vec<Rect>)> = Vec::new();
    for rect in tiles.iter().map(|tile| tile.rect(bounds)) {
        match runs.last_mut() {
            Some((run, parts)) if run.y == rect.y && run.x + run.width == rect.x => {
                run.width += rect.width;
                parts.push(rect);
            }
            _ => runs.push((rect, vec![rect])),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use graphics::export::png8;

    use super::*;

    /// A picture with colours inside and outside the gamut.
    fn picture(width: usize, height: usize) -> Field<[f32; 4]> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|index: usize| {
                    let value = |k: usize| ((index * k) % 1009) as f32 / 1000.0 - 0.004;
                    [value(1), value(31), value(577), 1.0]
                })
                .collect(),
        )
    }

    fn part(picture: &Field<[f32; 4]>, rect: Rect) -> Field<[f32; 4]> {
        let rows = rect.y..rect.y + rect.height;
        let values = rows.flat_map(|y| picture.row(y, rect.x, rect.width).to_vec()).collect();
        Field::from_values(rect.width, rect.height, values)
    }

    #[test]
    fn the_screen_shows_what_the_export_writes() {
        let picture = picture(150, 70);
        let bounds = picture.bounds();
        let bytes = SrgbBytes::new();
        let tiles = encode(&TileSet::all(bounds), bounds, &bytes, |rect| {
            Ok::<_, Infallible>(part(&picture, rect))
        })
        .unwrap();
        let file = png8(&picture, 0.1).unwrap().bytes;
        let exported = image::load_from_memory(&file).unwrap().into_rgb8();
        let mut cells = 0;
        for TilePixels { rect, pixels } in tiles {
            for (index, [r, g, b, a]) in pixels.into_iter().enumerate() {
                let x = rect.x + index % rect.width;
                let y = rect.y + index / rect.width;
                assert_eq!(exported[(x as u32, y as u32)].0, [r, g, b], "column {x}, row {y}");
                assert_eq!(a, 255, "pictures are opaque");
                cells += 1;
            }
        }
        assert_eq!(cells, 150 * 70, "every cell is encoded once");
    }

    #[test]
    fn tiles_side_by_side_are_read_at_once() {
        let bounds = Rect { x: 0, y: 0, width: 300, height: 200 };
        let mut tiles = TileSet::default();
        tiles.insert(Rect { x: 10, y: 10, width: 130, height: 60 });
        tiles.insert(Rect { x: 280, y: 10, width: 1, height: 1 });
        let found: Vec<Rect> = runs(&tiles, bounds).into_iter().map(|(run, _)| run).collect();
        let rect = |x, y, width| Rect { x, y, width, height: 64 };
        assert_eq!(found, [rect(0, 0, 192), rect(256, 0, 44), rect(0, 64, 192)]);
    }
}
