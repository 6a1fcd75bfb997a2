//! Swatch files (ASE, ACO, GPL): a round trip of random palettes, and errors of faulty files.

use proptest::prelude::*;
use spectra::color::{Lab, Rgb};
use spectra::swatch_file::{
    SwatchColor, SwatchEntry, SwatchFile, read_aco, read_ase, read_gpl, write_aco, write_ase,
    write_gpl,
};

/// Colours whose components are exact in 8 bits, in 16 bits and in 32-bit floats.
fn color() -> impl Strategy<Value = SwatchColor> {
    let step = || (0..=1u8).prop_map(f64::from);
    let quarter = |from: i32, to: i32| (from * 4..=to * 4).prop_map(|q| f64::from(q) / 4.0);
    prop_oneof![
        [step(), step(), step()].prop_map(|rgb| SwatchColor::Rgb(Rgb(rgb))),
        (step(), quarter(-128, 127), quarter(-128, 127))
            .prop_map(|(l, a, b)| SwatchColor::Lab(Lab { lightness: 100.0 * l, a, b })),
        [step(), step(), step(), step()].prop_map(SwatchColor::Cmyk),
        step().prop_map(SwatchColor::Grey),
    ]
}

fn palette(groups: &'static str) -> impl Strategy<Value = SwatchFile> {
    let swatch = ("[^\u{0}]{0,9}", groups, color());
    let swatch = swatch.prop_map(|(name, group, color)| SwatchEntry { name, group, color });
    prop::collection::vec(swatch, 0..9)
        .prop_map(|swatches| SwatchFile { name: String::new(), swatches })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn ase_is_read_as_written(palette in palette("[ab]{0,1}")) {
        let bytes = write_ase(&palette).unwrap();
        prop_assert_eq!(read_ase("p.ase", &bytes).unwrap(), palette);
    }

    #[test]
    fn aco_is_read_as_written(palette in palette("")) {
        let bytes = write_aco(&palette).unwrap();
        prop_assert_eq!(read_aco("p.aco", &bytes).unwrap(), palette);
    }

    #[test]
    fn gpl_is_read_as_written(rgbs in prop::collection::vec(any::<[u8; 3]>(), 0..9)) {
        let swatches = rgbs.iter().map(|rgb: &[u8; 3]| SwatchEntry {
            name: format!("Rot {rgb:?} \u{fc}"),
            group: String::new(),
            color: SwatchColor::Rgb(Rgb(rgb.map(|v| f64::from(v) / 255.0))),
        }).collect();
        let palette = SwatchFile { name: "Name: of # all".into(), swatches };
        let text = write_gpl(&palette).unwrap();
        prop_assert_eq!(read_gpl("p.gpl", text.as_bytes()).unwrap(), palette);
    }

    #[test]
    fn no_bytes_make_a_reader_panic_and_every_refusal_has_a_place(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        all_say_where(&bytes)?;
    }

    #[test]
    fn nor_do_files_with_a_byte_changed_or_cut_short(
        palette in palette("[ab]{0,1}"),
        at in any::<prop::sample::Index>(),
        byte in any::<u8>(),
        cut in any::<prop::sample::Index>(),
    ) {
        let files = [write_ase(&palette).unwrap(), write_aco(&palette).unwrap()];
        for mut bytes in files {
            let place = at.index(bytes.len());
            bytes[place] = byte;
            all_say_where(&bytes)?;
            bytes.truncate(cut.index(bytes.len()));
            all_say_where(&bytes)?;
            let text = ["GIMP Palette\n".as_bytes(), &bytes].concat();
            all_say_where(&text)?;
        }
    }
}

fn all_say_where(bytes: &[u8]) -> Result<(), TestCaseError> {
    for read in [read_ase, read_aco, read_gpl] {
        if let Err(error) = read("the file", bytes) {
            let said = error.to_string();
            prop_assert!(
                said.starts_with("the file, byte ") || said.starts_with("the file, line ")
            );
        }
    }
    Ok(())
}

#[test]
fn a_small_ase_is_byte_for_byte_as_other_programs_write_it() {
    let swatch = SwatchEntry {
        name: "Red".into(),
        group: String::new(),
        color: SwatchColor::Rgb(Rgb([1.0, 0.0, 0.0])),
    };
    let palette = SwatchFile { name: String::new(), swatches: vec![swatch] };
    let mut wanted = b"ASEF\x00\x01\x00\x00\x00\x00\x00\x01".to_vec();
    wanted.extend(b"\x00\x01\x00\x00\x00\x1c\x00\x04\x00R\x00e\x00d\x00\x00RGB ");
    wanted.extend(b"\x3f\x80\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02");
    assert_eq!(write_ase(&palette).unwrap(), wanted);
    let mut wanted = b"\x00\x01\x00\x01\x00\x00\xff\xff\x00\x00\x00\x00\x00\x00".to_vec();
    wanted.extend(b"\x00\x02\x00\x01\x00\x00\xff\xff\x00\x00\x00\x00\x00\x00");
    wanted.extend(b"\x00\x00\x00\x04\x00R\x00e\x00d\x00\x00");
    assert_eq!(write_aco(&palette).unwrap(), wanted);
}

#[test]
fn errors_name_file_and_byte_or_line() {
    let error = |result: Result<SwatchFile, spectra::swatch_file::SwatchFileError>| {
        result.unwrap_err().to_string()
    };
    assert_eq!(
        error(read_ase("a.ase", b"ASEX\x00\x01\x00\x00")),
        "a.ase, byte 0: expected `ASEF`, found `ASEX`"
    );
    let wrong = b"ASEF\x00\x01\x00\x00\x00\x00\x00\x01\x00\x01\x00\x00\x00\x08\x00\x01\x00\x00HSV ";
    assert_eq!(
        error(read_ase("a.ase", wrong)),
        "a.ase, byte 22: expected RGB, LAB, CMYK or Gray, found `HSV `"
    );
    assert_eq!(
        error(read_aco("a.aco", b"\x00\x01\x00\x01\x00\x03\x00\x00\x00\x00\x00\x00\x00\x00")),
        "a.aco, byte 4: expected RGB, HSB, CMYK, Lab or grey, found `3`"
    );
    let lines = b"GIMP Palette\nName: x\n#\n 10 20 300\tred\n";
    let said = error(read_gpl("a.gpl", lines));
    assert!(said.starts_with("a.gpl, line 4:") && said.contains("10 20 300"), "{said}");
    assert!(error(read_gpl("a.gpl", b"RIFF")).starts_with("a.gpl, line 1:"));
    assert!(error(read_gpl("a.gpl", b"GIMP Palette\n\xff")).contains("byte 13"));
}

#[test]
fn hue_saturation_and_brightness_are_read_as_rgb() {
    // A hue of 120 degrees with full saturation and brightness is green.
    let bytes = b"\x00\x01\x00\x01\x00\x01\x55\x55\xff\xff\xff\xff\x00\x00";
    let SwatchColor::Rgb(rgb) = read_aco("a.aco", bytes).unwrap().swatches[0].color else {
        panic!("RGB")
    };
    assert_eq!(rgb.to_hex(), "#00ff00");
}
