//! Paints swatches in a style, makes an art map of them, and writes its tiles as one picture. Run
//! it like this:
//!
//! `cargo run --release -p impasto-artmap --example art_map -- oil-flat tiles.png`

#![expect(clippy::print_stdout, reason = "an example prints what it did")]

use std::time::Instant;

use artmap::map::{ArtMap, Between};
use artmap::measures::{
    Texture, co_occurrence_error, coherence, contrast, most_used, stroke_length, wrap_ratio,
};
use artmap::painted::{PaintedSettings, Style, painted_samples};
use artmap::synthesis::SynthesisSettings;
use graphics::export::{PictureFormat, picture_file};
use graphics::field::Field;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let style = arguments.next().unwrap_or_else(|| "oil-flat".to_owned());
    let path = arguments.next().unwrap_or_else(|| "tiles.png".to_owned());

    let start = Instant::now();
    let samples = painted_samples(&Style::named(&style)?, &PaintedSettings::default())?;
    println!("{} samples painted in {:.1} s", samples.samples.len(), start.elapsed().as_secs_f64());
    let start = Instant::now();
    let map = ArtMap::of(&samples, &SynthesisSettings::default())?;
    println!(
        "{} tiles of {} texels, strokes {} apart, in {:.1} s",
        map.keys.len(),
        map.size(),
        map.spacing,
        start.elapsed().as_secs_f64()
    );

    println!("tone      L*  (sample)  coherence  error  floor  contrast  length  border  use");
    let first = Texture::tiled(&map.keys[map.first].tile.color);
    // Unevenness over more than this is not a stroke.
    let far = 4.0 * map.spacing;
    for key in &map.keys {
        let sample = samples.samples.iter().find(|sample| sample.name == key.name);
        let sample = sample.ok_or("a tile has no sample")?;
        let tile = Texture::tiled(&key.tile.color);
        let whole = Texture::masked(&sample.color, &sample.mask);
        let (width, height) = sample.size();
        let [left, right] = [false, true].map(|right| {
            let inside = (0..width * height).map(|at| (at % width >= width / 2) == right);
            let mask = Field::from_values(width, height, inside.collect());
            Texture::masked(&sample.color, &mask)
        });
        println!(
            "{:8} {:4.1} {:9.1} {:10.2} {:6.2} {:6.2} {:9.2} {:7.2} {:7.2} {:4.1}",
            key.name,
            key.tone,
            whole.tone(),
            coherence(&first, &tile, map.spacing),
            co_occurrence_error(&whole, &tile),
            co_occurrence_error(&left, &right),
            contrast(&tile) / contrast(&whole),
            stroke_length(&tile.levelled(far)) / stroke_length(&whole.levelled(far)),
            wrap_ratio(&tile),
            most_used(&key.sources, &sample.mask, map.patch),
        );
    }

    // The picture shows the key tiles, and below each the tile half way to the next one.
    let size = map.size();
    let mut sheet = Field::filled(map.keys.len() * size, 2 * size, [1.0; 4]);
    for (index, key) in map.keys.iter().enumerate() {
        let between =
            map.transition(index, Between::default()).map(|transition| transition.at(0.5));
        for (row, tile) in [Some(&key.tile), between.as_ref()].into_iter().enumerate() {
            let Some(tile) = tile else { continue };
            let pixels = tile.color.values().iter().map(|&[r, g, b]| [r, g, b, 1.0]).collect();
            sheet.put((index * size, row * size), &Field::from_values(size, size, pixels));
        }
    }
    std::fs::write(path, picture_file(&sheet, 1.0, PictureFormat::Png8)?.bytes)?;
    Ok(())
}
