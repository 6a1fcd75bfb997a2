//! Pigments guessed from a colour: mixing gives the colour back, and the guess is marked.

use calibrate::PigmentId;
use calibrate::curation::{Body, guessed_pigment};
use calibrate::evaluate::Viewing;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::color::{Adaptation, Lab, Rgb, RgbSpace, delta_e_ciede2000};
use suite::program::impasto;

use crate::{Shelf, done, oils, read, refused};

#[test]
fn a_thousand_colors_come_back_from_mixing() {
    let shelf = Shelf::new();
    let start = shelf.path("white.json");
    done(&["from-rgb", "#f4f4f0", "--name", "White", "--output", &start]);
    let mut library = read(&start);
    let weights = Viewing::default().weights(library.grid).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let mut met = 0;
    let mut missed = 0;
    for number in 0..1000 {
        let rgb = Rgb(std::array::from_fn(|_| random.random_range(0.0..1.0)));
        let wanted = RgbSpace::Srgb.xyz_from_encoded(rgb, weights.white(), Adaptation::Bradford);
        let body = if number % 2 == 0 { Body::Hiding } else { Body::Glaze };
        let Ok(guess) = guessed_pigment(&library, ("x", "x"), wanted, body, false) else {
            let least = rgb.linear().0.into_iter().fold(1.0, f64::min);
            assert!(least < library.saunderson.k1, "{} was not met", rgb.to_hex());
            missed += 1;
            continue;
        };
        library.pigments.truncate(1);
        library.pigments.push(guess.pigment);
        let mixture = library.mix([(PigmentId(1), 1.0)]).unwrap();
        let film = match body {
            Body::Hiding => mixture.hiding(library.saunderson),
            Body::Glaze => mixture.film(1.0, &[1.0; 31], library.film()),
        };
        let lab = |xyz| Lab::from_xyz(xyz, weights.white());
        let off = delta_e_ciede2000(lab(wanted), lab(weights.xyz(&film)));
        assert!(
            off < 0.05 && film.iter().all(|r| *r > 0.03 && *r < 1.0),
            "{}: {off}",
            rgb.to_hex()
        );
        met += 1;
    }
    assert!(met > 850, "{met} met, {missed} below the surface's own reflection");
}

#[test]
fn a_guess_joins_a_library_and_is_marked_everywhere() {
    let shelf = Shelf::new();
    let with = shelf.path("with.json");
    let run = done(&["from-rgb", &oils(), "#2a5caa", "--name", "Sky", "--output", &with]);
    assert!(run.out.contains("#2a5caa, 0.000 CIEDE2000"), "{}", run.out);
    let library = read(&with);
    assert_eq!(library.pigments.len(), 21);
    assert_eq!(library.pigments[..20], read(&oils()).pigments);
    assert!(library.pigments[20].guessed && library.pigments[20].identified);
    let mix = impasto(&["mix", &with, "Sky=1"]);
    assert!(
        mix.out.contains("#2a5caa") && mix.err.contains("warning: Sky: guessed"),
        "{}",
        mix.err
    );
    let list = done(&["list", &with]).out;
    assert!(
        list.lines().any(|line| line.starts_with("Sky ") && line.ends_with("guessed")),
        "{list}"
    );
    assert_eq!(done(&["list", &with, "--json"]).json()[20]["guessed"], true);
    let show = done(&["show", &with, "Sky"]).out;
    assert!(show.contains("Sky (guessed)") && show.contains("guessed from #2a5caa"), "{show}");
    assert!(done(&["check", &with]).out.contains("Sky: guessed from a colour"));
    let taken = ["from-rgb", &with, "#2a5caa", "--name", "Viridian", "--output", &oils()];
    assert_eq!(crate::tried(&taken).status, 1);
}

#[test]
fn a_glaze_shows_its_color_over_white_and_its_ground_elsewhere() {
    let shelf = Shelf::new();
    let with = shelf.path("with.json");
    let glaze = ["from-rgb", &oils(), "lab(60, 40, 20)", "--name", "Rose", "--glaze"];
    done(&[&glaze[..], &["--output", &with]].concat());
    let lab = |over: &str| {
        let mix = impasto(&["mix", &with, "Rose=1", "--thickness", "1", "--over", over, "--json"]);
        mix.json()["lab"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let on_white: Vec<f64> = lab("white");
    suite::near::assert_near("over white", &on_white, &[60.0, 40.0, 20.0], 0.01);
    let on_black: Vec<f64> = lab("black");
    assert!(on_black[0] < 30.0, "{on_black:?}");
}

#[test]
fn a_color_out_of_reach_is_refused_with_the_nearest() {
    let shelf = Shelf::new();
    let new = shelf.path("new.json");
    let black = ["from-rgb", "#000000", "--name", "Black", "--output", &new];
    refused(&black, 1, &["k1 = 0.03", "the nearest is 12.", "`#313131`", "--nearest"]);
    assert!(!std::path::Path::new(&new).exists(), "nothing written");
    let run = done(&[&black[..], &["--nearest"]].concat());
    assert!(run.err.contains("warning: #000000 is out of reach"), "{}", run.err);
    done(&[&black[..], &["--saunderson", "none", "--nearest"]].concat());
    assert!(read(&new).saunderson.k1 == 0.0 && read(&new).reference.as_deref() == Some("Black"));
    for color in ["red", "#12345", "lab(1,2)", "lab(101,0,0)", "lab(nan,0,0)"] {
        refused(&["from-rgb", color, "--name", "X", "--output", &new], 2, &[color]);
    }
}

#[test]
fn options_may_stand_between_library_and_color() {
    let shelf = Shelf::new();
    let bare = shelf.path("bare.json");
    let between = shelf.path("between.json");
    done(&["from-rgb", &oils(), "40,5,-45", "--name", "Sky", "--output", &bare]);
    done(&["from-rgb", &oils(), "--name", "Sky", "lab(40, 5, -45)", "--output", &between]);
    let sky = |path: &str| read(path).pigments.pop().unwrap().absorption;
    assert_eq!(sky(&bare), sky(&between));
    let new = shelf.path("new.json");
    done(&["from-rgb", "--name", "White", "--output", &new, "#f4f4f0"]);
    let list = impasto(&["library", "list", &new]);
    assert!(list.out.contains("S = 1 for White"), "{}", list.out);
    let three = ["from-rgb", &oils(), "40,", "5", "--name", "X", "--output", &bare];
    refused(&three, 2, &["found `3` arguments"]);
}
