//! Encodes linear light as 8-bit sRGB by a table. You get the same bytes as from the PNG export.

use graphics::field::Field;
use graphics::tile::{Rect, TileSet};
use rayon::prelude::*;
use spectra::color::Rgb;

use super::event::TilePixels;

/// Number of buckets of equal width between 0 and 1. A bucket is narrower than the smallest
/// distance between two entries of `least` (1 / 255 / 12.92), so it contains at most one of them.
const BUCKETS: usize = 4096;

/// Tables from linear sRGB to the bytes of a PNG of the same picture ([`graphics::export::png8`]).
#[derive(Debug, Clone)]
pub(super) struct SrgbBytes {
    /// Byte at the lower end of each bucket.
    lowest: Vec<u8>,
    /// Smallest linear value for each byte. The last entry, for 256, is infinite.
    least: [f32; 257],
}

impl SrgbBytes {
    /// Builds the tables. This takes about 0.1 ms.
    pub(super) fn new() -> Self {
        let mut least = [f32::INFINITY; 257];
        for (byte, least) in least.iter_mut().enumerate().take(256) {
            *least = least_giving(byte as u8);
        }
        // One more bucket, for the value 1.
        Self {
            lowest: (0..=BUCKETS)
                .map(|index: usize| exact(index as f32 / BUCKETS as f32))
                .collect(),
            least,
        }
    }

    /// Byte of one channel. Clips values outside 0 to 1.
    #[inline(always)]
    pub(super) fn byte(&self, linear: f32) -> u8 {
        let linear = linear.clamp(0.0, 1.0);
        // The product is exact, because the number of buckets is a power of two. NaN gives bucket
        // 0.
        let lowest = self.lowest[(linear * BUCKETS as f32) as usize];
        lowest + u8::from(linear >= self.least[usize::from(lowest) + 1])
    }

    /// The opaque pixel of a colour. Outside the gamut this preserves hue and lightness.
    #[inline(always)]
    pub(super) fn pixel(&self, [r, g, b, _]: [f32; 4]) -> [u8; 4] {
        if [r, g, b].iter().all(|value| (0.0..=1.0).contains(value)) {
            [self.byte(r), self.byte(g), self.byte(b), 255]
        } else {
            mapped([r, g, b])
        }
    }
}

/// The opaque pixel of a colour that may lie outside the gamut.
#[inline(never)]
fn mapped(linear: [f32; 3]) -> [u8; 4] {
    let [r, g, b] = Rgb(linear.map(f64::from)).mapped_into_gamut().encoded().to_bytes();
    [r, g, b, 255]
}

fn exact(linear: f32) -> u8 {
    Rgb([f64::from(linear); 3]).encoded().to_bytes()[0]
}

/// Smallest value from 0 to 1 that gives at least `byte`. Bisects the bit patterns, because they
/// have the same order as the non-negative numbers that they represent.
fn least_giving(byte: u8) -> f32 {
    let mut low = 0;
    let mut high = 1.0_f32.to_bits();
    while low < high {
        let middle = low.midpoint(high);
        if exact(f32::from_bits(middle)) >= byte {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    f32::from_bits(high)
}

/// Pixels of `tiles` on a canvas of `bounds`. `read` returns a rectangle of the picture in linear
/// sRGB. Each call may transfer data from the device, so this calls it only once for each run of
/// neighbouring tiles.
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
    use super::*;
    use graphics::export::png8;
    use std::convert::Infallible;

    #[test]
    fn bytes_are_those_of_the_curve_around_every_threshold_and_between() {
        let table = SrgbBytes::new();
        for least in &table.least[1..256] {
            for step in -3..=3_i32 {
                let value = f32::from_bits(least.to_bits().saturating_add_signed(step)).min(1.0);
                assert_eq!(table.byte(value), exact(value), "{value:e}");
            }
        }
        for index in 0..=200_000 {
            let value = index as f32 / 200_000.0;
            assert_eq!(table.byte(value), exact(value), "{value}");
        }
    }

    #[test]
    fn what_no_screen_shows_is_cut_off() {
        let table = SrgbBytes::new();
        for (value, byte) in [(-1.0, 0), (-0.0, 0), (1e-40, 0), (1.0, 255), (7.0, 255)] {
            assert_eq!(table.byte(value), byte, "{value}");
        }
        assert_eq!(table.byte(f32::NAN), 0, "no number is black");
        assert_eq!(table.byte(f32::INFINITY), 255, "without end is white");
    }

    /// A picture with colours inside and outside the gamut.
    fn picture(width: usize, height: usize) -> Field<[f32; 4]> {
        Field::from_values(
            width,
            height,
            (0..width * height)
                .map(|index: usize| {
                    let [r, g, b] =
                        [1, 31, 577].map(|k| ((index * k) % 1009) as f32 / 1000.0 - 0.004);
                    [r, g, b, 1.0]
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
        let wanted = [(0, 0, 192), (256, 0, 44), (0, 64, 192)];
        assert_eq!(found, wanted.map(|(x, y, width)| Rect { x, y, width, height: 64 }));
    }
}
