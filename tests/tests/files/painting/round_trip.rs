//! A painting that is written and read back is the same to the quantum.

use std::io::Cursor;

use exr::prelude::{ReadChannels, ReadLayers};
use paint::amount::{MAX_COLUMN, mm_from_quanta};
use paint::file::{read, write};
use paint::layer::SLOTS;
use proptest::prelude::*;

use super::made_up::{painting, small};

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
        let cell = paint::layer::Cell::default();
        document.wet.set_cell(7, cell);
        document.wet.pigments.values_mut()[7][slot] = amount;
        let bytes = write(&document).unwrap();
        assert_eq!(read("a.exr", &bytes).unwrap().wet, document.wet, "{amount}");
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
    let value = |name: &str| {
        let list = &wet.channel_data.list;
        let channel = list.iter().find(|channel| channel.name.eq(name));
        channel.unwrap_or_else(|| panic!("no `{name}`")).sample_data.value_by_flat_index(0).to_f32()
    };
    let assert_mm = |name: &str, quanta: u32| {
        let got = value(name);
        let wanted = mm_from_quanta(quanta, document.cell_mm) as f32;
        assert_eq!(got, wanted, "{name}");
    };
    assert_mm("vehicle", cell.vehicle);
    assert_mm("thickness", cell.volume());
    let mut seen = 0;
    for slot in 0..SLOTS {
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
