//! Volumes as films of measured pigments.

use suite::program::{impasto, repository};

use super::{POUR, SMALL, done, files, folder, path, pixels, stencil};

fn library() -> String {
    repository("measurements/van-gogh-oils.pigments.json")
}

#[test]
fn a_painting_of_volumes_is_relit_and_repainted() {
    let folder = folder();
    let library = library();
    let [model, painting, picture] = ["box.obj", "o.exr", "p.png"].map(|name| path(&folder, name));
    let [spectral, maps, shown] = ["s.exr", "maps", "r.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let paint = ["--palette", "Ultramarine,Chrome Yellow", "--paint", "Ultramarine=1"];
    let under = ["--ground", "paper", "--over", "white", "--illuminant", "D65"];
    let exports = ["--output", &painting, "--picture", &picture, "--pigment-maps", &maps];
    let bands = ["--spectral", &spectral, "--bands", "nodes", "--bits", "16"];
    done(&[&scene[..], &paint, &under, &exports, &bands].concat());
    let bits = image::open(&picture).unwrap();
    assert!(bits.as_rgb16().is_some() || bits.as_rgba16().is_some(), "{:?}", bits.color());
    let relit = |options: &[&str]| {
        let run = impasto(&[&["relight", &painting, "--picture", &shown], options].concat());
        assert_eq!(run.status, 0, "{options:?}: {}", run.err);
        pixels(&shown)
    };
    let own = pixels(&picture);
    let same = relit(&[]);
    let off = own.pixels().zip(same.pixels());
    let off = off.map(|(a, b)| (0..3).map(|i| a.0[i].abs_diff(b.0[i])).max().unwrap());
    assert!(off.max() <= Some(1), "the picture as it was saved");
    // Where ultramarine was poured the picture turns from blue to red, and nowhere else.
    let swapped = relit(&["--swap", "all:Ultramarine=Vermilion"]);
    let redness = |pixel: &image::Rgb<u8>| i32::from(pixel.0[0]) - i32::from(pixel.0[2]);
    let turned = same.pixels().zip(swapped.pixels()).filter(|(a, b)| a != b);
    let turned: Vec<i32> = turned.map(|(a, b)| redness(b) - redness(a)).collect();
    assert!((20..1500).contains(&turned.len()), "{} pixels changed", turned.len());
    assert!(turned.iter().all(|&more| more >= 0), "{turned:?}");
    assert!(turned.iter().filter(|&&more| more > 40).count() > 20, "{turned:?}");
    assert!(relit(&["--illuminant", "A", "--adaptation", "0"]) != same);
    let names = files(&maps, ".png");
    assert!(names.iter().any(|name| name.to_lowercase().contains("ultramarine")), "{names:?}");
    assert!(std::fs::metadata(&spectral).unwrap().len() > 1000);
}

#[test]
fn pours_take_the_palette_in_turn_and_recipes_mix() {
    let folder = folder();
    let library = library();
    let [model, picture, script] = ["box.obj", "p.png", "s.toml"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let written = ["--picture", &picture, "--script-out", &script];
    let text = |options: &[&str]| {
        done(&[&scene[..], &written, options].concat());
        let text = std::fs::read_to_string(&script).unwrap();
        (text, pixels(&picture))
    };
    let palette = ["--palette", "Ultramarine,Chrome Yellow", "--pour", "0.6,0.4"];
    let (in_turn, picture_of_two) = text(&palette);
    for words in ["preset = \"grisaille\"", "P1 = 1.0", "P2 = 1.0", "P1 = \"Ultramarine\""] {
        assert!(in_turn.contains(words), "{words}: {in_turn}");
    }
    let recipe = ["--paint", "Eosin Lake (lead, wax)=1, Ultramarine=2, Ultramarine"];
    let (mixed, other) = text(&recipe);
    for words in ["P1 = 1.0", "P2 = 3.0", "P1 = \"Eosin Lake (lead, wax)\""] {
        assert!(mixed.contains(words), "{words}: {mixed}");
    }
    assert!(picture_of_two != other);
    let own = ["--palette", "Eosin Lake (lead, wax),Ultramarine", "--pour", "0.6,0.4"];
    let (commas, _) = text(&own);
    for words in ["P1 = \"Eosin Lake (lead, wax)\"", "P2 = \"Ultramarine\"", "P2 = 1.0"] {
        assert!(commas.contains(words), "{words}: {commas}");
    }
    // Parts of a painting are shown too, but not written as one.
    done(&[&scene[..], &palette, &["--show", "mask", "--picture", &picture]].concat());
    assert!(pixels(&picture).pixels().all(|pixel| [0, 255].contains(&pixel.0[1])));
    let output = path(&folder, "o.exr");
    let run = stencil(&[&scene[..], &palette, &["--show", "mask", "--output", &output]].concat());
    assert!(run.status == 2 && run.err.contains("--output is of the painting"), "{}", run.err);
}

#[test]
fn a_written_script_knows_its_pigments_and_guards_them() {
    let folder = folder();
    std::fs::copy(library(), path(&folder, "own.toml")).unwrap();
    let [model, pigments] = ["box.obj", "own.toml"].map(|name| path(&folder, name));
    let [script, one, other] = ["s.toml", "1.png", "2.png"].map(|name| path(&folder, name));
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &pigments]].concat();
    let paint = ["--palette", "Viridian", "--illuminant", "A"];
    done(&[&scene[..], &paint, &["--picture", &one, "--script-out", &script]].concat());
    let text = std::fs::read_to_string(&script).unwrap();
    assert!(
        text.contains("library = \"own.toml\"") && text.contains("illuminant = \"A\""),
        "{text}"
    );
    done(&[&script, "--width", "64", "--picture", &other]);
    assert_eq!(pixels(&one), pixels(&other), "the script alone makes the same picture");
    done(&[&script, "--width", "64", "--picture", &other, "--illuminant", "D65"]);
    assert_ne!(pixels(&one), pixels(&other), "another light");
    let before = std::fs::read(&pigments).unwrap();
    let refused = stencil(&[&script, "--width", "64", "--script-out", &pigments]);
    assert_eq!(refused.status, 2, "{}", refused.err);
    assert!(refused.err.contains("own.toml") && std::fs::read(&pigments).unwrap() == before);
    let alone =
        [&[&model[..]], &SMALL[..], &POUR, &["--picture", &one, "--illuminant", "A"]].concat();
    let refused = stencil(&alone);
    assert!(
        refused.status == 2 && refused.err.contains("--illuminant needs pigments"),
        "{}",
        refused.err
    );
}

#[test]
fn a_written_script_holds_its_ground_and_its_lamp() {
    let folder = folder();
    let library = library();
    let lamp = "nm,halogen,led\n380,0.1,0.02\n500,0.5,0.4\n600,0.9,0.7\n730,1.3,0.05\n";
    std::fs::write(path(&folder, "lamp.csv"), lamp).unwrap();
    std::fs::write(path(&folder, "paper.csv"), "nm,rag\n380,0.512345678\n730,0.8\n").unwrap();
    let [model, script, lamp, paper] =
        ["box.obj", "s.toml", "lamp.csv#led", "paper.csv"].map(|name| path(&folder, name));
    let files = ["1.png", "1.exr", "2.png", "2.exr"].map(|name| path(&folder, name));
    let [one, layers, other, again] = &files;
    let scene = [&[&model[..]], &SMALL[..], &POUR, &["--pigments", &library]].concat();
    let paint = ["--palette", "Viridian", "--ground", "linen", "--over", &paper];
    let paint = [&paint[..], &["--illuminant", &lamp]].concat();
    let exports = ["--picture", one, "--output", layers, "--script-out", &script];
    done(&[&scene[..], &paint, &exports].concat());
    std::fs::remove_file(&paper).unwrap();
    let replayed = |options: &[&str]| {
        let written = [&script, "--width", "64", "--picture", other, "--output", again];
        done(&[&written[..], options].concat());
        [other, again].map(|file| std::fs::read(file).unwrap())
    };
    let bytes = [one, layers].map(|file| std::fs::read(file).unwrap());
    assert!(replayed(&[]) == bytes, "the script alone makes the same picture and painting");
    for other in [["--over", "black"], ["--ground", "paper"], ["--illuminant", "A"]] {
        assert!(replayed(&other) != bytes, "{other:?} is another painting");
    }
    // Written again from there into another folder, the lamp is found still.
    let below = path(&folder, "below");
    std::fs::create_dir(&below).unwrap();
    let moved = format!("{below}/t.toml");
    done(&[&script, "--width", "64", "--script-out", &moved]);
    let options = ["--width", "64", "--picture", other, "--output", again];
    done(&[&[&moved[..]], &options[..]].concat());
    assert!([other, again].map(|file| std::fs::read(file).unwrap()) == bytes);
    let bare =
        [&[&model[..]], &SMALL[..], &POUR, &["--picture", one, "--ground", "linen"]].concat();
    let refused = stencil(&bare);
    assert!(
        refused.status == 2 && refused.err.contains("--ground needs pigments"),
        "{}",
        refused.err
    );
}

#[test]
fn the_passes_hold_the_heights_of_each_pigment() {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let folder = folder();
    let library = library();
    let [photo, passes] = ["photo.png", "p.exr"].map(|name| path(&folder, name));
    image::RgbImage::from_pixel(60, 40, image::Rgb([180; 3])).save(&photo).unwrap();
    // A photograph is 200 mm wide and fills the picture: a pixel is 1 mm^2.
    let scene = [&photo, "--width", "200", "--set", "picture.samples=1", "--pigments", &library];
    let paint = ["--pour", "0.4,0.5,18", "--paint", "Ultramarine=3,Lead White=1"];
    let told = done(&[&scene[..], &paint, &["--passes", &passes, "--json"]].concat()).json();
    let image = read().no_deep_data().largest_resolution_level().all_channels();
    let image = image.all_layers().all_attributes().from_file(&passes).unwrap();
    let part = |wanted: &str| {
        let mut layers = image.layer_data.iter();
        layers
            .find(|own| {
                own.attributes
                    .layer_name
                    .as_ref()
                    .is_some_and(|name: &exr::prelude::Text| *name == *wanted)
            })
            .unwrap()
    };
    let values = |wanted: &str, channel: &str| -> Vec<f64> {
        let channels = &part(wanted).channel_data.list;
        let own = channels.iter().find(|own| own.name == *channel).unwrap();
        own.sample_data.values_as_f32().map(f64::from).collect()
    };
    assert_eq!(part("heights").channel_data.list.len(), 2);
    let [blue, white] = ["Ultramarine", "Lead White"].map(|name| values("heights", name));
    let laid: f64 = blue.iter().chain(&white).sum();
    let on_scene = told["paint_mm3"]["on_scene"].as_f64().unwrap();
    assert!((on_scene - 18.0).abs() < 1e-3, "{told}");
    assert!((laid / on_scene - 1.0).abs() < 0.02, "{laid} of {on_scene} mm3");
    let counts = values("count.1", "N");
    for ((blue, white), count) in blue.iter().zip(&white).zip(&counts) {
        assert_eq!(*blue > 0.0, *count > 0.0, "a film where volumes are");
        assert!((blue - 3.0 * white).abs() <= 2e-5, "{blue} {white}");
    }
    // The film of the preset grisaille, and somewhat more at its edge.
    let most = blue.iter().zip(&white).map(|(blue, white)| blue + white).fold(0.0, f64::max);
    assert!((0.003..0.012).contains(&most), "{most} mm");
    assert!(counts.iter().filter(|&&count| count > 0.0).count() > 4000);
}
