//! Files of art maps: OpenEXR, format `impasto-artmap`, version 1.
//!
//! One file has a part per key tile: `key.000`, `key.001` .. from dark to light. It has scan lines
//! of 32-bit float channels, so you can look at it with any program that reads OpenEXR. Tiles are
//! squares of one size.
//!
//! | channels | content |
//! | --- | --- |
//! | `R`, `G`, `B` | colour of a level surface, linear sRGB |
//! | `height` | height over the ground in mm, left out without relief |
//! | one per pigment, `vehicle` | paint in mm, left out without pigments |
//! | `source.x`, `source.y` | column and row of the sample that the texel shows, 0 to 65534 |
//!
//! Attribute `impasto` of the first part is JSON in ASCII. It holds format and version,
//! provenance, size and spacing of the tiles, their names and tones, the settings of the
//! synthesis, the channel of each pigment, and the pigment library. OpenEXR has no check sums. So
//! this description has a SHA-256 digest of every part and of itself (with the text of `digest`
//! left empty), and we refuse a damaged file. You get everything back bit for bit.

use std::path::Path;

use graphics::field::Field;
use paint::file::{PigmentChannel, channels_of_slots};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::ArtMap;
use crate::map::{KeyMap, Tile};
use crate::synthesis::SynthesisSettings;
use crate::texel_file::PaintOfSamples;
use crate::texel_file::{
    COLOR, HEIGHT, Opened, Origin, PartPlan, PartPlanes, TexelFileError, TexelFileKind, Texels,
    VEHICLE, decoded, encoded, encoded_library, of_planes, of_text, paint_of, proven,
    write as write_parts,
};

impl ArtMap {
    /// Reads a map from its file (OpenEXR, see [`crate::map::file`]).
    ///
    /// # Errors
    /// [`TexelFileError`] if the file cannot be read or holds no valid map.
    pub fn open(path: &Path) -> Result<Self, TexelFileError> {
        read(&path.display().to_string(), &documents::file::read(path)?)
    }

    /// Writes the map to a file (OpenEXR, see [`crate::map::file`]). This replaces the file as a
    /// whole or not at all.
    ///
    /// # Errors
    /// [`TexelFileError`] if the map is inconsistent or the file cannot be written.
    pub fn save(&self, path: &Path) -> Result<(), TexelFileError> {
        Ok(documents::file::write_whole(path, &write(self)?)?)
    }
}

const SOURCE: [&str; 2] = ["source.x", "source.y"];

const KIND: TexelFileKind = TexelFileKind {
    format: "impasto-artmap",
    version: 1,
    content: "art map",
    reserved: &[COLOR[0], COLOR[1], COLOR[2], HEIGHT, VEHICLE, SOURCE[0], SOURCE[1]],
};

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileHeader {
    format: String,
    version: u64,
    /// SHA-256 of the description with an empty text in this field.
    digest: String,
    provenance: String,
    size: usize,
    spacing: f64,
    mm_per_texel: Option<f64>,
    guessed_relief: bool,
    patch: usize,
    levels: usize,
    first: usize,
    settings: SynthesisSettings,
    keys: Vec<KeyHeader>,
    pigments: Option<Vec<PigmentChannel>>,
    library: Option<Value>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct KeyHeader {
    part: String,
    name: String,
    tone: f64,
    relief: bool,
    /// SHA-256 of the numbers of the part.
    digest: String,
}

fn header_part(index: usize) -> String {
    format!("key.{index:03}")
}

impl FileHeader {
    fn of(map: &ArtMap) -> Result<Self, TexelFileError> {
        let keys = map.keys.iter().enumerate().map(|(index, key)| KeyHeader {
            part: header_part(index),
            name: key.name.clone(),
            tone: key.tone,
            relief: key.tile.height_mm.is_some(),
            digest: String::new(),
        });
        let mut pigments = None;
        let mut library = None;
        if let Some(paint) = &map.paint {
            let used = channels_of_slots(&paint.library, &paint.slots, KIND.reserved);
            pigments =
                Some(used.ok_or_else(|| KIND.unwritable("a pigment lies beyond the library"))?);
            library = Some(encoded_library(&KIND, paint)?);
        }
        Ok(Self {
            format: KIND.format.to_owned(),
            version: KIND.version,
            digest: String::new(),
            provenance: map.provenance.clone(),
            size: map.size(),
            spacing: map.spacing,
            mm_per_texel: map.mm_per_texel,
            guessed_relief: map.guessed_relief,
            patch: map.patch,
            levels: map.levels,
            first: map.first,
            settings: map.settings.clone(),
            keys: keys.collect(),
            pigments,
            library,
        })
    }

    /// The description as JSON in ASCII, with its own digest.
    ///
    /// # Errors
    /// [`TexelFileError::Unwritable`] if reading this JSON would not give back the description and
    /// `paint`.
    fn into_json_with_digest(
        mut self,
        paint: Option<&PaintOfSamples>,
    ) -> Result<String, TexelFileError> {
        self.digest = self.own_digest()?;
        let json = encoded(&KIND, &self)?;
        let back = Self::from_json(Origin { kind: &KIND, file: "" }, &json);
        proven(&KIND, self, paint, back)?;
        Ok(json)
    }

    /// Parses and checks a description. Returns it with the library and slots in it.
    fn from_json(
        origin: Origin<'_>,
        json: &str,
    ) -> Result<(Self, Option<PaintOfSamples>), TexelFileError> {
        let header: Self = decoded(origin, json)?;
        header.check().map_err(|reason| origin.header(reason))?;
        if header.own_digest()? != header.digest {
            return Err(origin.header("`digest` is that of another description"));
        }
        let paint = paint_of(origin, header.pigments.as_deref(), header.library.as_ref())?;
        Ok((header, paint))
    }

    fn plans(&self) -> Vec<PartPlan> {
        self.keys
            .iter()
            .map(|key: &KeyHeader| {
                let mut channels = Texels::channels(key.relief, self.pigments.as_deref());
                channels.extend(SOURCE);
                PartPlan::new(&key.part, (self.size, self.size), &channels)
            })
            .collect()
    }

    fn own_digest(&self) -> Result<String, TexelFileError> {
        let bare = Self { digest: String::new(), ..self.clone() };
        Ok(of_text(&encoded(&KIND, &bare)?))
    }

    fn check(&self) -> Result<(), String> {
        let Self { size, spacing, mm_per_texel, patch, levels, first, keys, .. } = self;
        if keys.is_empty() {
            return Err("there is no tile".to_owned());
        }
        for (name, found) in [("size", size), ("patch", patch), ("levels", levels)] {
            if *found == 0 {
                return Err(format!("{name} is at least 1, found `{found}`"));
            }
        }
        if *first >= keys.len() {
            return Err(format!("first is one of {} tiles, found `{first}`", keys.len()));
        }
        for (name, found) in [("spacing", Some(spacing)), ("mm_per_texel", mm_per_texel.as_ref())] {
            if let Some(found) = found.filter(|found| !(found.is_finite() && **found > 0.0)) {
                return Err(format!("{name} is above 0, found `{found}`"));
            }
        }
        for (index, key) in keys.iter().enumerate() {
            if key.part != header_part(index) {
                let wanted = header_part(index);
                let found = &key.part;
                return Err(format!("tile {index} is part `{wanted}`, found `{found}`"));
            }
        }
        for pair in keys.windows(2) {
            // This also fails if one of them is not a number.
            if !matches!(pair[0].tone.partial_cmp(&pair[1].tone), Some(order) if order.is_le()) {
                let darker = pair[0].tone;
                let lighter = pair[1].tone;
                let name = &pair[1].name;
                return Err(format!(
                    "tiles are in order of tone, found `{lighter}` of `{name}` after `{darker}`"
                ));
            }
        }
        Ok(())
    }
}

/// The tone and the mean L* of its tile may differ by this: colours differ in their last bits
/// between machines.
const TONE: f64 = 0.01;

fn texels(tile: &Tile) -> Texels<'_> {
    Texels { color: &tile.color, paint: tile.paint.as_ref(), height_mm: tile.height_mm.as_ref() }
}

fn part(key: &KeyMap, plan: PartPlan, pigments: Option<&[PigmentChannel]>) -> PartPlanes {
    plan.with(|channel| match SOURCE.iter().position(|name| *name == channel) {
        Some(axis) => key.sources.values().iter().map(|place| f32::from(place[axis])).collect(),
        None => texels(&key.tile).plane(channel, pigments),
    })
}

/// Checks the numbers of a part.
///
/// # Errors
/// The channel with impossible numbers, and the reason.
fn check(part: &PartPlanes, pigments: Option<&[PigmentChannel]>) -> Result<(), (String, String)> {
    part.check_texels(pigments, |_| true)?;
    for channel in SOURCE {
        part.check(channel, "is not a whole number below 65535", |_, number| {
            (0.0..f32::from(u16::MAX)).contains(&number) && number.fract() == 0.0
        })?;
    }
    Ok(())
}

/// Checks that the tone of a tile agrees with its colours.
///
/// # Errors
/// The reason, with what was found.
fn check_tone(tile: &Tile, tone: f64) -> Result<(), String> {
    let wanted = tile.tone();
    if (tone - wanted).abs() <= TONE {
        return Ok(());
    }
    Err(format!("has a mean L* of {wanted:.3}, its tone is `{tone}`"))
}

fn key_map(header: &KeyHeader, part: &PartPlanes, pigments: Option<&[PigmentChannel]>) -> KeyMap {
    let [columns, rows] = SOURCE.map(|name| part.of(name));
    let places = columns.iter().zip(rows).map(|(x, y)| [*x as u16, *y as u16]);
    let sources: Field<[u16; 2]> = part.field(places.collect());
    let tile = Tile {
        color: part.color(),
        paint: pigments.map(|pigments| part.paint(pigments)),
        height_mm: part.height_mm(),
    };
    KeyMap { name: header.name.clone(), tile, sources, tone: header.tone }
}

/// Decodes a map from `bytes`, the content of `file`. Only errors use this name.
///
/// # Errors
/// [`TexelFileError`] if the content is not OpenEXR, holds no art map, is of a newer version,
/// truncated, inconsistent, or not what was written.
pub fn read(file: &str, bytes: &[u8]) -> Result<ArtMap, TexelFileError> {
    let origin = Origin { kind: &KIND, file };
    let opened = Opened::new(origin, bytes)?;
    let (header, paint) = FileHeader::from_json(origin, &opened.description()?)?;
    let pigments = header.pigments.as_deref();
    let parts = opened.planes(header.plans())?;
    let keys: Vec<_> = parts
        .into_par_iter()
        .zip(&header.keys)
        .map(|(part, of): (PartPlanes, &KeyHeader)| -> Result<KeyMap, TexelFileError> {
            check(&part, pigments).map_err(|fault| origin.channel(&of.part, fault))?;
            if of_planes(&part) != of.digest {
                return Err(origin.changed(&of.part));
            }
            let key = key_map(of, &part, pigments);
            check_tone(&key.tile, key.tone).map_err(|reason| origin.part(&of.part, reason))?;
            Ok(key)
        })
        .collect();
    Ok(ArtMap {
        keys: keys.into_iter().collect::<Result<_, _>>()?,
        first: header.first,
        paint,
        spacing: header.spacing,
        mm_per_texel: header.mm_per_texel,
        guessed_relief: header.guessed_relief,
        patch: header.patch,
        levels: header.levels,
        settings: header.settings,
        provenance: header.provenance,
    })
}

/// Encodes a map as a file. If you pass equal maps, you get equal bytes.
///
/// # Errors
/// [`TexelFileError::Unwritable`] for a map without tiles, tiles that are not squares of one size
/// or not in order of tone, paint without pigment, and impossible numbers.
pub fn write(map: &ArtMap) -> Result<Vec<u8>, TexelFileError> {
    check_tiles(map).map_err(|reason| KIND.unwritable(reason))?;
    let mut header = FileHeader::of(map)?;
    let pigments = header.pigments.as_deref();
    let parts: Vec<PartPlanes> = map
        .keys
        .par_iter()
        .zip(header.plans())
        .map(|(key, plan)| part(key, plan, pigments))
        .collect();
    for (key, part) in map.keys.iter().zip(&parts) {
        check(part, pigments).map_err(|(channel, reason)| {
            KIND.unwritable(format!("tile `{}`, channel `{channel}` {reason}", key.name))
        })?;
        check_tone(&key.tile, key.tone)
            .map_err(|reason| KIND.unwritable(format!("tile `{}` {reason}", key.name)))?;
    }
    let digests: Vec<String> = parts.par_iter().map(of_planes).collect();
    for (key, digest) in header.keys.iter_mut().zip(digests) {
        key.digest = digest;
    }
    write_parts(&KIND, &header.into_json_with_digest(map.paint.as_ref())?, parts)
}

fn check_tiles(map: &ArtMap) -> Result<(), String> {
    let size = map.size();
    if size == 0 {
        return Err("it has no texels".to_owned());
    }
    for key in &map.keys {
        let whose = format!("tile `{}`", key.name);
        let width = key.tile.color.width();
        let height = key.tile.color.height();
        if (width, height) != (size, size) {
            return Err(format!("{whose} has `{width} x {height}` texels for {size} x {size}"));
        }
        if key.sources.bounds() != key.tile.color.bounds() {
            return Err(format!("fields of {whose} differ in size"));
        }
        texels(&key.tile).check(&whose, map.paint.as_ref())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::{KeyMap, Tile};
    use crate::synthesis::{Features, SynthesisSettings};
    use crate::texel_file::{Opened, Origin, PartPlanes, encoded, of_planes, write as write_parts};
    use crate::texel_file::{PaintOfSamples, TexelPaint};
    use documents::hint::Explain;
    use graphics::field::Field;
    use paint::layer::Slots;
    use pigment::{PigmentId, PigmentLibrary};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rayon::ThreadPoolBuilder;
    use std::sync::Arc;

    const SIZE: usize = 40;

    /// A number that loses bits in anything but lossless storage.
    fn number(index: usize) -> f32 {
        0.001 + (index as f32 * 0.618_034).fract() / 3.0
    }

    fn key(name: &str, light: f32) -> KeyMap {
        let color = (0..SIZE * SIZE).map(|i| [light * number(i), light * number(i + 7), -0.0]);
        let paint = (0..SIZE * SIZE).map(|i| TexelPaint {
            pigments_mm: [number(i), 0.0, number(i + 3), 0.0, 0.0, 0.0, 0.0, number(i + 5)],
            vehicle_mm: number(i + 1),
        });
        let height = (0..SIZE * SIZE).map(|i| number(2 * i));
        let sources = (0..SIZE * SIZE).map(|i| [(i * 977 % 65535) as u16, (i % 301) as u16]);
        let tile = Tile {
            color: Field::from_values(SIZE, SIZE, color.collect()),
            paint: Some(Field::from_values(SIZE, SIZE, paint.collect())),
            height_mm: Some(Field::from_values(SIZE, SIZE, height.collect())),
        };
        let sources = Field::from_values(SIZE, SIZE, sources.collect());
        KeyMap { name: name.to_owned(), tone: tile.tone(), tile, sources }
    }

    fn map() -> ArtMap {
        let mut slots = Slots::default();
        (slots[0], slots[2], slots[7]) =
            (Some(PigmentId(1)), Some(PigmentId(2)), Some(PigmentId(4)));
        let library = Arc::new(PigmentLibrary::van_gogh_oils());
        ArtMap {
            keys: vec![key("dark", 0.2), key("h\u{f6}her", 0.9), key("light", 2.5)],
            first: 1,
            paint: Some(PaintOfSamples { library, slots }),
            spacing: 7.25 / 3.0,
            mm_per_texel: Some(0.1 + 0.2),
            guessed_relief: true,
            patch: 16,
            levels: 2,
            settings: SynthesisSettings {
                first: Some("h\u{f6}her".to_owned()),
                features: Features::Paper,
                follow: 0.3,
                seed: u64::MAX,
                ..SynthesisSettings::default()
            },
            provenance: "a test".to_owned(),
        }
    }

    /// The map without paint, and with relief in one tile only.
    fn plain() -> ArtMap {
        let mut map = map();
        (map.paint, map.mm_per_texel, map.settings.first) = (None, None, None);
        map.keys.iter_mut().for_each(|key| key.tile.paint = None);
        (map.keys[0].tile.height_mm, map.keys[2].tile.height_mm) = (None, None);
        map
    }

    #[test]
    fn maps_come_back_bit_for_bit_and_files_are_the_same_bytes() {
        let single = ArtMap { keys: vec![key("only", 1.0)], first: 0, ..map() };
        for map in [map(), plain(), single] {
            let bytes = write(&map).unwrap();
            let back = read("a.exr", &bytes).unwrap();
            assert!(back == map);
            // Zeros of either sign are equal numbers but different bits.
            let [found, wanted] =
                [&back, &map].map(|map| map.keys[0].tile.color.values()[5].map(f32::to_bits));
            assert_eq!(found, wanted);
            for threads in [1, 2] {
                let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
                assert!(pool.install(|| write(&back)).unwrap() == bytes, "{threads} threads");
            }
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("oil.artmap.exr");
        map().save(&path).unwrap();
        assert!(ArtMap::open(&path).unwrap() == map());
    }

    /// The file of `map` after `change` changed its description and parts. The digests fit the
    /// changed values, as if another program had written them.
    fn forged(map: &ArtMap, change: impl FnOnce(&mut FileHeader, &mut [PartPlanes])) -> Vec<u8> {
        let mut header = FileHeader::of(map).unwrap();
        let plans = header.plans().into_iter();
        let pigments = header.pigments.clone();
        let tiles = map.keys.iter().zip(plans);
        let mut parts: Vec<PartPlanes> =
            tiles.map(|(key, plan)| part(key, plan, pigments.as_deref())).collect();
        change(&mut header, &mut parts);
        for (key, part) in header.keys.iter_mut().zip(&parts) {
            key.digest = of_planes(part);
        }
        header.digest = header.own_digest().unwrap();
        write_parts(&KIND, &encoded(&KIND, &header).unwrap(), parts).unwrap()
    }

    fn refused(bytes: &[u8]) -> TexelFileError {
        let error = read("a.exr", bytes).unwrap_err();
        assert!(error.to_string().starts_with("a.exr: "), "{error}");
        assert!(error.hint().is_some(), "{error}");
        error
    }

    #[test]
    fn impossible_values_are_named_with_part_channel_and_texel() {
        assert!(read("a.exr", &forged(&map(), |_, _| ())).unwrap() == map());
        let cases = [
            ("R", f32::NAN, "is impossible at x 3, y 2: `NaN`"),
            ("height", -0.1, "is impossible at x 3, y 2: `-0.1`"),
            ("vehicle", f32::INFINITY, "is impossible at x 3, y 2: `inf`"),
            ("source.x", 0.5, "is not a whole number below 65535 at x 3, y 2: `0.5`"),
            ("source.y", 65535.0, "is not a whole number below 65535 at x 3, y 2: `65535`"),
            ("source.y", -1.0, "is not a whole number below 65535 at x 3, y 2: `-1`"),
        ];
        for (channel, value, wanted) in cases {
            let bytes = forged(&map(), |_, parts| {
                let at = parts[1].plan.channels.iter().position(|name| name == channel).unwrap();
                parts[1].planes[at][2 * SIZE + 3] = value;
            });
            let error = refused(&bytes).to_string();
            assert_eq!(error, format!("a.exr: part `key.001`, channel `{channel}` {wanted}"));
        }
        let pigment = PigmentLibrary::van_gogh_oils().pigments[2].name.clone();
        let mut negative = map();
        negative.keys[0].tile.paint.as_mut().unwrap()[(0, 1)].pigments_mm[2] = -1.0;
        let error = write(&negative).unwrap_err().to_string();
        let wanted = format!("tile `dark`, channel `{pigment}` is impossible at x 0, y 1: `-1`");
        assert_eq!(error, format!("the art map cannot be saved: {wanted}"));
    }

    #[test]
    fn descriptions_that_contradict_the_parts_are_refused() {
        type Change = fn(&mut FileHeader, &mut [PartPlanes]);
        let cases: [(Change, &str); 9] = [
            (|header, _| header.size = 41, "part `key.000` has `40 x 40` texels"),
            (|header, _| header.keys.truncate(2), "it names 2 parts, the file has `3`"),
            (|header, _| header.keys[1].relief = false, "channel `height` is none that"),
            (|header, _| header.keys.swap(0, 1), "tile 0 is part `key.000`, found `key.001`"),
            (|header, _| header.keys[0].tone += 0.5, "part `key.000` has a mean L* of"),
            (
                |header, _| header.keys[2].tone = 0.0,
                "tiles are in order of tone, found `0` of `light`",
            ),
            (|header, _| header.first = 3, "first is one of 3 tiles, found `3`"),
            (|header, _| header.levels = 0, "levels is at least 1, found `0`"),
            (|header, _| header.spacing = -1.0, "spacing is above 0, found `-1`"),
        ];
        for (change, wanted) in cases {
            let error = refused(&forged(&map(), change)).to_string();
            assert!(error.contains(wanted), "{error} for {wanted}");
        }
        let error = refused(&forged(&plain(), |header, _| header.keys[0].relief = true));
        assert!(
            error.to_string().contains("part `key.000`, channel `height` is missing"),
            "{error}"
        );
    }

    #[test]
    fn parts_that_are_no_squares_are_refused() {
        let bytes = forged(&map(), |_, parts| {
            parts[2].plan.height -= 1;
            parts[2].planes.iter_mut().for_each(|plane| plane.truncate(SIZE * (SIZE - 1)));
        });
        let error = refused(&bytes).to_string();
        assert!(error.contains("part `key.002` has `40 x 39` texels, attribute `impasto` says"));
    }

    #[test]
    fn a_library_that_lacks_a_pigment_is_refused() {
        let bytes = forged(&map(), |header, _| {
            header.pigments.as_mut().unwrap()[1].name = "Octarine".to_owned();
        });
        let error = refused(&bytes).to_string();
        assert!(error.contains("names no pigment of the library: `Octarine`"), "{error}");
        let bytes = forged(&map(), |header, _| header.pigments = None);
        assert!(refused(&bytes).to_string().contains("`pigments` and `library` go together"));
    }

    #[test]
    fn other_versions_formats_and_changed_values_are_refused() {
        let bytes = write(&map()).unwrap();
        let replaced = |from: &str, to: &str| {
            assert_eq!(from.len(), to.len(), "same length");
            let at =
                bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
            let mut bytes = bytes.clone();
            bytes[at..at + to.len()].copy_from_slice(to.as_bytes());
            bytes
        };
        let error = refused(&replaced("\"version\":1", "\"version\":2"));
        let wanted = "a.exr: art map of version `2`, this program reads versions up to 1";
        assert_eq!(error.to_string(), wanted);
        let error = refused(&replaced("impasto-artmap", "impasto-artmop"));
        assert!(matches!(error, TexelFileError::Format { .. }), "{error}");
        let error = refused(&replaced("\"patch\":16", "\"patch\":17"));
        assert!(error.to_string().contains("`digest` is that of another description"), "{error}");
        let error = refused(&replaced("source.y\0", "source.z\0"));
        assert!(error.to_string().contains("channel `source.z` is none that"), "{error}");
        let mut other = map();
        other.keys[2].tile.color[(0, 0)][0] += 1e-6;
        let origin = Origin { kind: &KIND, file: "a.exr" };
        let description = Opened::new(origin, &bytes).unwrap().description().unwrap();
        let (header, _) = FileHeader::from_json(origin, &description).unwrap();
        let parts = other.keys.iter().zip(header.plans());
        let parts = parts.map(|(key, plan)| part(key, plan, header.pigments.as_deref())).collect();
        let error = refused(&write_parts(&KIND, &description, parts).unwrap());
        assert!(matches!(error, TexelFileError::Changed { ref part, .. } if part == "key.002"));
    }

    #[test]
    fn truncated_files_are_errors() {
        let bytes = write(&map()).unwrap();
        let step = bytes.len() / 300;
        for cut in (0..bytes.len()).step_by(step).chain([bytes.len() - 1]) {
            refused(&bytes[..cut]);
        }
    }

    #[test]
    fn damaged_files_are_errors_or_the_map_that_was_written() {
        let map = map();
        let bytes = write(&map).unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut survived = 0;
        for _ in 0..400 {
            let mut damaged = bytes.clone();
            for _ in 0..random.random_range(1..3) {
                let at = random.random_range(0..bytes.len());
                damaged[at] ^= 1 << random.random_range(0..8);
            }
            match read("a.exr", &damaged) {
                Ok(back) => {
                    assert!(back == map);
                    survived += 1;
                }
                Err(error) => assert!(error.hint().is_some(), "{error}"),
            }
        }
        assert!(survived < 40, "{survived} of 400 damaged files were read");
    }

    #[test]
    fn inconsistent_maps_are_not_written() {
        fn refused(change: &dyn Fn(&mut ArtMap)) -> String {
            let mut map = map();
            change(&mut map);
            let error = write(&map).unwrap_err();
            assert!(matches!(error, TexelFileError::Unwritable { .. }), "{error}");
            error.to_string()
        }
        let none = refused(&|map| map.keys.clear());
        assert_eq!(none, "the art map cannot be saved: it has no texels");
        let other =
            refused(&|map| map.keys[2].tile.color = Field::filled(SIZE, SIZE - 1, [1.0; 3]));
        assert!(other.contains("tile `light` has `40 x 39` texels for 40 x 40"), "{other}");
        let fields = refused(&|map| map.keys[0].sources = Field::filled(SIZE, 3, [0; 2]));
        assert!(fields.contains("fields of tile `dark` differ in size"), "{fields}");
        assert!(refused(&|map| map.keys[1].tile.paint = None).contains("has no paint"));
        assert!(refused(&|map| map.paint = None).contains("paint of no library"));
        assert!(refused(&|map| map.keys.swap(0, 2)).contains("tiles are in order of tone"));
        assert!(refused(&|map| map.keys[0].tone = f64::NAN).contains("its tone is `NaN`"));
        assert!(refused(&|map| map.first = 7).contains("first is one of 3 tiles"));
        let beyond = refused(&|map| {
            map.paint.as_mut().unwrap().slots[3] = Some(PigmentId(99));
        });
        assert!(beyond.contains("a pigment lies beyond the library"), "{beyond}");
        refused(&|map| map.mm_per_texel = Some(f64::INFINITY));
        refused(&|map| map.settings.follow = f32::NAN);
        let place = refused(&|map| map.keys[0].sources[(1, 0)] = [0, u16::MAX]);
        assert!(place.contains("channel `source.y` is not a whole number"), "{place}");
    }
}
