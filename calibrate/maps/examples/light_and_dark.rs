//! Maps a scan into light and dark: `light_and_dark SCAN MAPS [WHITE]`.
//!
//! The share of light is the mean reflectance of a pixel, so that you can check every reader of the
//! maps against the scan. Pass the value of a white as WHITE if the scan does not state it.

use std::convert::Infallible;
use std::error::Error;

use documents::Task;
use maps::blocks::map_cube;
use maps::cube::{Block, Cube, CubeOptions, CubeScale};
use maps::pixel_maps::{BlockMaps, Mask};
use maps::store::{MapStore, MapsAbout, StoreMode};

fn light_and_dark(block: &Block) -> Result<BlockMaps, Infallible> {
    let mut maps = BlockMaps::without_values(block.pixels(), 2, Mask::Ignored);
    for (pixel, (values, mask)) in block.iter().enumerate() {
        maps.mask[pixel] = mask;
        if mask != Mask::Mapped {
            continue;
        }
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let light = mean.clamp(0.0, 1.0);
        for (pigment, share) in [light, 1.0 - light].into_iter().enumerate() {
            maps.share[2 * pixel + pigment] = share;
            maps.share_sd[2 * pixel + pigment] = 0.01;
            maps.presence[2 * pixel + pigment] = share;
        }
        maps.chi2[pixel] = mean;
        maps.rms[pixel] = 0.5 * mean;
        maps.second[pixel] = 0b01;
    }
    Ok(maps)
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scan, out, white @ ..] = &arguments[..] else {
        return Err("name a scan and the folder of the maps".into());
    };
    let mut options = CubeOptions::default();
    if let [white] = white {
        options.scale = CubeScale::White(white.parse()?);
    }
    let cube = Cube::open_with(scan, &options)?;
    let about = MapsAbout {
        pigments: ["light", "dark"].map(str::to_owned).to_vec(),
        library_sha256: String::new(),
        book_sha256: String::new(),
        scan: cube.sign()?,
        rows: 0..cube.lines(),
        columns: 0..cube.samples(),
        settings: serde_json::Map::new(),
    };
    let store = MapStore::create(out, &about, StoreMode::New)?;
    map_cube(&cube, &store, light_and_dark, &Task::default())?;
    Ok(())
}
