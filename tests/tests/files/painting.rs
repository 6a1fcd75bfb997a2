//! Painting files. A painting with random amounts of paint is read back the same to the quantum.
//! Faulty and damaged files are refused with the place, without a panic, and before memory is
//! allocated.

use std::io::Cursor;

use calibrate::PigmentId;
use documents::hint::Explain;
use exr::prelude::{
    AnyChannel, AttributeValue, FlatImage, FlatSamples, ReadChannels, ReadLayers, Text,
    WritableImage,
};
use graphics::field::Field;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use paint::amount::{MAX_COLUMN, mm_from_quanta};
use paint::document::{Document, DryLayer, LayerId, Lighting, Medium, Slots};
use paint::file::{PaintingFileError, read, read_within, write};
use paint::ground::Ground;
use paint::layer::{Cell, Layer, SLOTS, SLOTS as ROUND_TRIP_SLOTS};
use paint::optics::Gloss;

pub(crate) use suite::oils::library;

/// A layer with paint on about a third of the cells in a random rectangle: 0 to `highest` quanta of
/// each pigment and of vehicle.
fn paint(rng: &mut ChaCha8Rng, size: (usize, usize), slots: &Slots, highest: u32) -> Layer {
    let mut layer = Layer::empty(size.0, size.1);
    let left = rng.random_range(0..size.0);
    let top = rng.random_range(0..size.1);
    for y in top..size.1 {
        for x in left..size.0 {
            if rng.random_range(0..3) > 0 {
                continue;
            }
            let mut cell = Cell::default();
            for (amount, slot) in cell.pigments.iter_mut().zip(slots) {
                let some = slot.is_some() && rng.random_bool(0.5);
                *amount = if some { rng.random_range(0..=highest) } else { 0 };
            }
            cell.vehicle = rng.random_range(0..=highest);
            layer.set_cell(y * size.0 + x, cell);
        }
    }
    layer
}

/// A painting of `width` x `height` cells with `dry` dry layers and at most `highest` quanta of a
/// pigment in a cell.
pub(crate) fn painting(
    seed: u64,
    (width, height): (usize, usize),
    dry: usize,
    highest: u32,
) -> Document {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let library = library();
    let count = library.pigments.len();
    let palettes: Vec<Slots> = (0..=dry)
        .map(|_| {
            std::array::from_fn(|_| {
                rng.random_bool(0.7).then(|| PigmentId(rng.random_range(0..count)))
            })
        })
        .collect();
    let rise = i32::try_from(highest.min(i32::MAX as u32)).unwrap();
    let heights = (0..width * height).map(|_| rng.random_range(-rise..=rise)).collect();
    let mut layers: Vec<DryLayer> = palettes
        .iter()
        .enumerate()
        .map(|(index, slots)| DryLayer {
            id: LayerId(if index % 2 == 0 { 40 - index as u32 } else { index as u32 }),
            name: ["", "r\u{f6}tel, first coat", "sky"][index % 3].to_owned(),
            visible: index % 4 != 2,
            slots: *slots,
            opacity: rng.random_range(0.0..2.0),
            paint: paint(&mut rng, (width, height), slots, highest),
        })
        .collect();
    let wet = layers.remove(0);
    Document {
        title: "caf\u{e9} \u{1f3a8} \"quoted\"\n".to_owned(),
        cell_mm: rng.random_range(0.01..1.0),
        ground: Ground {
            name: "linen, seed 1".to_owned(),
            height: Field::from_values(width, height, heights),
            reflectance: (0..library.grid.count()).map(|_| rng.random_range(0.0..1.0)).collect(),
            gloss: Gloss { strength: 0.1, exponent: 17.3 },
        },
        library,
        medium: Medium { scattering_per_mm: rng.random_range(1.0..100.0), ..Medium::default() },
        dry: layers,
        next_layer: if dry == 0 { LayerId::FIRST } else { LayerId(41 + dry as u32) },
        slots: wet.slots,
        wet: wet.paint,
        lighting: Lighting { azimuth_deg: rng.random_range(0.0..360.0), ..Lighting::default() },
    }
}

/// A painting of 40 x 33 cells with two dry layers and at most 2^20 quanta of a pigment in a cell.
pub(crate) fn small() -> Document {
    let document = painting(5, (40, 33), 2, 1 << 20);
    assert!(document.slots.iter().filter(|slot| slot.is_some()).count() <= SLOTS, "a palette");
    document
}

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(config(40))]

    #[test]
    fn a_painting_comes_back_the_same(
        seed in any::<u64>(),
        width in 1_usize..60,
        height in 1_usize..60,
        dry in 0_usize..4,
        // No paint, a thin film, amounts about where f32 loses integers (2^24), and the largest
        // equal amounts of eight pigments and vehicle in a cell.
        highest in prop::sample::select(vec![0, 1000, (1 << 23) - 1, 1 << 25, MAX_COLUMN / 9]),
    ) {
        let document = painting(seed, (width, height), dry, highest);
        let bytes = write(&document).unwrap();
        prop_assert_eq!(read("a.exr", &bytes).unwrap(), document);
    }
}

#[test]
fn the_same_painting_gives_the_same_bytes() {
    assert_eq!(write(&small()).unwrap(), write(&small()).unwrap());
}

#[test]
fn an_empty_painting_and_one_cell_come_back() {
    for size in [(1, 1), (300, 2)] {
        let document = painting(1, size, 1, 0);
        let bytes = write(&document).unwrap();
        assert_eq!(read("a.exr", &bytes).unwrap(), document, "{size:?}");
    }
}

#[test]
fn a_cell_filled_to_the_brim_comes_back() {
    let mut document = small();
    let slot = document.slots.iter().position(Option::is_some).unwrap();
    for amount in [MAX_COLUMN, MAX_COLUMN - 1, (1 << 23) + 1, 1 << 24, 16_777_217] {
        let cell = Cell::default();
        document.wet.set_cell(7, cell);
        document.wet.pigments.values_mut()[7][slot] = amount;
        let bytes = write(&document).unwrap();
        assert_eq!(read("a.exr", &bytes).unwrap().wet, document.wet, "{amount}");
    }
}

/// A painting in which wet and dry paint have skins, one of them beyond what a float holds.
fn skinned() -> Document {
    let mut document = small();
    let slot = document.slots.iter().position(Option::is_some).unwrap();
    let mut skin = Cell { vehicle: 77, ..Cell::default() };
    skin.pigments[slot] = (1 << 24) + 1;
    let index = document.wet.vehicle.values().len() - 1;
    let body = document.wet.cell(index);
    document.wet.set_films(index, [body, skin]);
    let thin = Cell { vehicle: 5, ..Cell::default() };
    document.dry[1].paint.set_films(0, [Cell::default(), thin]);
    document
}

#[test]
fn skins_come_back_in_parts_of_their_own_and_only_their_files_have_version_2() {
    let document = skinned();
    let bytes = write(&document).unwrap();
    let back = read("a.exr", &bytes).unwrap();
    assert_eq!(back, document);
    assert_ne!(back.digest_of_paint(), small().digest_of_paint());
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(&bytes))
        .unwrap();
    let names: Vec<_> =
        image.layer_data.iter().map(|l| l.attributes.layer_name.clone().unwrap()).collect();
    let names: Vec<_> = names.iter().map(ToString::to_string).collect();
    assert_eq!(names, ["base", "wet", "dry.000", "dry.001", "wet.skin", "dry.001.skin"]);
    for (document, version) in [(document, 2), (small(), 1)] {
        let bytes = write(&document).unwrap();
        let wanted = format!("\"format\":\"impasto-painting\",\"version\":{version},");
        assert!(String::from_utf8_lossy(&bytes).contains(&wanted), "{wanted}");
    }
}

#[test]
fn other_programs_find_parts_and_channels_in_millimetres() {
    let document = small();
    let bytes = write(&document).unwrap();
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(&bytes))
        .unwrap();
    let names: Vec<_> =
        image.layer_data.iter().map(|l| l.attributes.layer_name.clone().unwrap()).collect();
    let names: Vec<_> = names.iter().map(ToString::to_string).collect();
    assert_eq!(names, ["base", "wet", "dry.000", "dry.001"]);

    let wet = &image.layer_data[1];
    let x = wet.attributes.layer_position.x() as usize;
    let y = wet.attributes.layer_position.y();
    let first = y as usize * document.wet.width() + x;
    let cell = document.wet.cell(first);
    let assert_mm = |name: &str, quanta: u32| {
        let list = &wet.channel_data.list;
        let channel = list.iter().find(|channel| channel.name.eq(name));
        let channel = channel.unwrap_or_else(|| panic!("no `{name}`"));
        let got = channel.sample_data.value_by_flat_index(0).to_f32();
        let wanted = mm_from_quanta(quanta, document.cell_mm) as f32;
        assert_eq!(got, wanted, "{name}");
    };
    assert_mm("vehicle", cell.vehicle);
    assert_mm("thickness", cell.volume());
    let mut seen = 0;
    for slot in 0..ROUND_TRIP_SLOTS {
        let Some(pigment) = document.slots[slot] else { continue };
        let name = &document.library[pigment].name;
        let first = document.slots.iter().position(|s| *s == Some(pigment)) == Some(slot);
        if first && !name.contains('.') {
            assert_mm(name, cell.pigments[slot]);
            seen += 1;
        }
    }
    assert!(seen > 2, "{seen} pigments compared");
}

fn image(bytes: &[u8]) -> FlatImage {
    exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .unwrap()
}

/// Error of reading a valid file after `change`. Asserts that it names the file.
fn refused(change: impl FnOnce(&mut FlatImage)) -> PaintingFileError {
    let mut image = image(&write(&small()).unwrap());
    change(&mut image);
    let mut bytes = Vec::new();
    image.write().to_buffered(Cursor::new(&mut bytes)).unwrap();
    let error = read("a.exr", &bytes).unwrap_err();
    assert!(error.to_string().starts_with("a.exr: "), "{error}");
    error
}

fn edit_json(image: &mut FlatImage, change: impl FnOnce(&mut serde_json::Value)) {
    let value = image.layer_data[0].attributes.other.get_mut(&Text::from("impasto")).unwrap();
    let AttributeValue::Text(text) = value else { panic!("{value:?}") };
    let mut json: serde_json::Value =
        serde_json::from_str(&text.chars().collect::<String>()).unwrap();
    json["title"] = "in ASCII, as the test writes it back".into();
    change(&mut json);
    *text = json.to_string().as_str().into();
}

fn channel<'a>(
    image: &'a mut FlatImage,
    part: usize,
    name: &str,
) -> &'a mut AnyChannel<FlatSamples> {
    let list = &mut image.layer_data[part].channel_data.list;
    list.iter_mut().find(|channel| channel.name.eq(name)).unwrap()
}

fn set(image: &mut FlatImage, part: usize, name: &str, index: usize, value: f32) {
    let FlatSamples::F32(values) = &mut channel(image, part, name).sample_data else {
        panic!("32 bits")
    };
    values[index] = value;
}

#[test]
fn a_file_that_is_no_painting_is_refused() {
    for bytes in [&b""[..], b"\x76", b"hello, I am a text", &[0; 64]] {
        let error = read("a.exr", bytes).unwrap_err();
        assert!(matches!(error, PaintingFileError::Container { .. }), "{error}");
    }
    let error = refused(|image| drop(image.layer_data[0].attributes.other.drain()));
    assert_eq!(
        error.to_string(),
        "a.exr: not a painting of impasto: attribute `impasto` of part `base` is missing"
    );
}

#[test]
fn a_newer_version_is_told_so() {
    let error = refused(|image| edit_json(image, |json| json["version"] = 3.into()));
    let wanted = "a.exr: this program reads paintings up to version 2, found `3`";
    assert_eq!(error.to_string(), wanted);
    assert_eq!(
        error.hint().map(|hint| hint.to_string()).as_deref(),
        Some("a newer impasto may read it")
    );
    let error = refused(|image| edit_json(image, |json| json["format"] = "other".into()));
    assert!(matches!(error, PaintingFileError::Format { .. }), "{error}");
}

#[test]
fn a_header_that_contradicts_itself_is_refused() {
    type Change = fn(&mut serde_json::Value);
    let cases: [(Change, &str); 8] = [
        (|json| json["surprise"] = 1.into(), "unknown field `surprise`"),
        (|json| json["cell_mm"] = 0.into(), "cell_mm is 0.0001 to 100, found `0`"),
        (|json| json["layers"] = serde_json::json!([]), "no layers"),
        (|json| json["layers"][1]["part"] = "dry.007".into(), "layer 1 is `dry.000`"),
        (
            |json| json["layers"][0]["pigments"][0]["slot"] = 9.into(),
            "layer `wet`: slots are 0 to 7, found `9`",
        ),
        (
            |json| json["layers"][0]["pigments"][0]["name"] = "Octarine".into(),
            "names no pigment of the library: `Octarine`",
        ),
        (|json| drop(json["ground"]["reflectance"].as_array_mut().unwrap().pop()), "reflectances"),
        (|json| json["library"]["pigments"][2]["scattering"][3] = (-1).into(), "scattering at"),
    ];
    for (change, wanted) in cases {
        let error = refused(|image| edit_json(image, change)).to_string();
        assert!(error.contains(wanted), "{error} for {wanted}");
    }
}

#[test]
fn parts_that_lack_or_are_too_many_are_named() {
    let error = refused(|image| drop(image.layer_data.remove(2)));
    assert_eq!(error.to_string(), "a.exr: part `dry.000` is missing");
    let error = refused(|image| image.layer_data[2].attributes.layer_name = Some("glaze".into()));
    assert!(error.to_string().starts_with("a.exr: part `glaze` is none that"), "{error}");
    let error = refused(|image| edit_json(image, |json| json["width"] = 41.into()));
    assert!(error.to_string().contains("of another size than the canvas of 41 x 33"), "{error}");
    let error = refused(|image| image.layer_data[1].attributes.layer_position.0 += 1);
    assert!(error.to_string().contains("part `wet` leaves the canvas of 40 x 33"), "{error}");
}

#[test]
fn channels_that_are_not_the_layers_own_are_named() {
    let error = refused(|image| channel(image, 1, "vehicle").name = "water".into());
    let wanted = "a.exr: part `wet`, channel `water` names no pigment of this layer";
    assert_eq!(error.to_string(), wanted);
    let error = refused(|image| {
        image.layer_data[2].channel_data.list.retain(|channel| !channel.name.eq("thickness"));
    });
    assert_eq!(error.to_string(), "a.exr: part `dry.000`, channel `thickness` is missing");
    let error = refused(|image| {
        let vehicle = channel(image, 3, "vehicle");
        let halves = vehicle.sample_data.values_as_f32().map(exr::prelude::f16::from_f32);
        vehicle.sample_data = FlatSamples::F16(halves.collect());
    });
    assert!(error.to_string().contains("channel `vehicle` must hold 32-bit floats"), "{error}");
    assert!(error.hint().is_some(), "a way out");
}

#[test]
fn values_that_are_no_amounts_are_told_with_their_place() {
    for (value, found) in [(f32::NAN, "NaN"), (-0.25, "-0.25"), (f32::INFINITY, "inf"), (9e9, "9")]
    {
        let mut place = (0, 0);
        let error = refused(|image| {
            let position = image.layer_data[1].attributes.layer_position;
            let width = image.layer_data[1].size.width();
            place = (position.x() + 1, position.y() + 1);
            set(image, 1, "vehicle", width + 1, value);
        });
        let (x, y) = place;
        let wanted = format!(
            "a.exr: part `wet`, channel `vehicle`, x {x}, y {y}: an amount is 0 to 512 cell \
             widths, found `{found}"
        );
        assert!(error.to_string().starts_with(&wanted), "{error}");
    }
    let error = refused(|image| set(image, 0, "height", 42, f32::NAN));
    assert!(error.to_string().contains("channel `height`, x 2, y 1: a height"), "{error}");
}

#[test]
fn cells_that_overflow_are_told_with_their_place() {
    let mut document = painting(5, (40, 33), 0, 0);
    document.slots = [Some(PigmentId(0)); 8];
    let bytes = write(&document).unwrap();
    let mut image = image(&bytes);
    let high = (document.cell_mm * 450.0) as f32;
    let name = document.library.pigments[0].name.clone();
    set(&mut image, 1, &name, 0, high);
    set(&mut image, 1, &format!("{name} 2"), 0, high);
    let mut bytes = Vec::new();
    image.write().to_buffered(Cursor::new(&mut bytes)).unwrap();
    let error = read("a.exr", &bytes).unwrap_err().to_string();
    assert!(error.contains("channel `thickness`, x 0, y 0: a cell holds 512"), "{error}");
}

#[test]
fn a_painting_beyond_the_memory_limit_is_refused_before_it_is_read() {
    let bytes = write(&small()).unwrap();
    let needed = 40 * 33 * (4 + 3 * 36);
    assert!(read_within("a.exr", &bytes, needed).is_ok(), "{needed}");
    let error = read_within("a.exr", &bytes, needed - 1).unwrap_err();
    let wanted =
        PaintingFileError::TooLarge { file: "a.exr".into(), bytes: needed, limit: needed - 1 };
    assert_eq!(error, wanted);
}

/// A header may state a huge size: no memory is allocated before the file is long enough for it.
#[test]
fn a_short_file_cannot_promise_a_huge_canvas() {
    let mut bytes = write(&painting(5, (40, 33), 0, 0)).unwrap();
    // Change the canvas size in both parts, then data window and chunk count of the first part,
    // `base`.
    let mut patch = |key: &[u8], skip: usize, value: i32, times: usize| {
        let places: Vec<_> =
            (0..bytes.len() - key.len()).filter(|&at| bytes[at..].starts_with(key)).collect();
        for at in places.into_iter().take(times) {
            bytes[at + key.len() + skip..][..4].copy_from_slice(&value.to_le_bytes());
        }
    };
    for (window, times) in [(&b"displayWindow\0box2i\0"[..], 2), (b"dataWindow\0box2i\0", 1)] {
        patch(window, 4 + 8, 39_999, times);
        patch(window, 4 + 12, 32_999, times);
    }
    patch(b"chunkCount\0int\0", 4, 33_000 / 32 + 1, 1);
    fn at(bytes: &[u8], key: &[u8]) -> usize {
        bytes.windows(key.len()).position(|w| w == key).unwrap()
    }
    let json = at(&bytes, b"\"width\":40,\"height\":33");
    bytes.splice(json..json + 22, *b"\"width\":40000,\"height\":33000");
    let size = at(&bytes, b"impasto\0string\0") + 15;
    let length = i32::from_le_bytes(bytes[size..][..4].try_into().unwrap()) + 6;
    bytes[size..][..4].copy_from_slice(&length.to_le_bytes());
    let error = read_within("a.exr", &bytes, u64::MAX).unwrap_err().to_string();
    assert!(error.contains("cannot hold the"), "{error}");
    let error = read("a.exr", &bytes).unwrap_err();
    assert!(matches!(error, PaintingFileError::TooLarge { .. }), "{error}");
}

#[test]
fn every_truncation_is_an_error() {
    let bytes = write(&painting(3, (20, 18), 1, 1000)).unwrap();
    let step = (bytes.len() / 700).max(1);
    for length in (0..bytes.len()).step_by(step).chain([bytes.len() - 1]) {
        let error = read("a.exr", &bytes[..length]).unwrap_err();
        assert!(error.to_string().starts_with("a.exr: "), "{length}: {error}");
    }
}

fn fuzz() -> ProptestConfig {
    ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() }
}

proptest! {
    #![proptest_config(fuzz())]

    /// If you read a damaged file, you get an error or another painting, but never a panic.
    #[test]
    fn damage_never_panics(
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        early in any::<bool>(),
    ) {
        let mut bytes = sound().to_vec();
        for (index, byte) in flips {
            // Half of the cases damage only the first bytes, where the headers are.
            let at = if early { index.index(1200) } else { index.index(bytes.len()) };
            bytes[at] = byte;
        }
        let _ = read_within("a.exr", &bytes, 1 << 30);
    }

    #[test]
    fn noise_never_panics(noise in prop::collection::vec(any::<u8>(), 0..400)) {
        let mut bytes = vec![0x76, 0x2f, 0x31, 0x01, 2, 16, 0, 0];
        bytes.extend(&noise);
        let _ = read_within("a.exr", &bytes, 1 << 30);
    }
}

/// A valid file, made once. Its library has only two pigments. A whole library would be far longer
/// than the rest of the file, so damage would rarely hit anything else.
fn sound() -> &'static [u8] {
    static BYTES: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    BYTES.get_or_init(|| {
        let mut document = painting(3, (48, 40), 1, 1 << 24);
        let all = document.library.pigments.len();
        document.library.evidence = None;
        document.library.reference = None;
        document.library.pigments.truncate(2);
        let layers = document.dry.iter_mut().map(|layer| &mut layer.slots);
        for slot in layers.chain([&mut document.slots]).flatten().flatten() {
            *slot = PigmentId(slot.index() * 2 / all);
        }
        let bytes = write(&document).unwrap();
        // The file must contain compressed blocks, so that damage hits them too.
        let image = image(&bytes);
        let layers = image.layer_data.iter();
        let raw: usize = layers.map(|l| l.size.area() * 4 * l.channel_data.list.len()).sum();
        assert!(bytes.len() < raw, "{} bytes of {raw}", bytes.len());
        bytes
    })
}
