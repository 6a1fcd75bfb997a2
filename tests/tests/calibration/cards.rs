//! Films on two cards: simulated films of known K and S come back within their deviations, and the verb
//! `film` tells their contrast ratio and hiding power.

use calibrate::film::{FilmError, FilmOnCards};
use calibrate::{FilmRequest, Readings, film};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use spectra::Viewing;
use spectra::optics::{Layer, Specular, Surface};
use suite::program::impasto;

const WAVELENGTHS: usize = 31;

fn nm(at: usize) -> f64 {
    400.0 + 10.0 * at as f64
}

/// A paint with one absorption band.
#[derive(Clone, Copy)]
struct Paint {
    /// K by mm outside the band and at its centre.
    absorption: [f64; 2],
    centre_nm: f64,
    /// S by mm.
    scattering: f64,
}

impl Paint {
    fn at(&self, nm: f64) -> [f64; 2] {
        let [floor, peak] = self.absorption;
        let band = (-((nm - self.centre_nm) / 60.0).powi(2)).exp();
        [floor + peak * band, self.scattering]
    }
}

const CARDS: [(&str, f64); 2] = [("white", 0.82), ("black", 0.03)];

/// A measurement file of films of `thicknesses_mm`, read twice each with noise of standard deviation `sd`.
fn file(paint: Paint, thicknesses_mm: &[f64], surface: Surface, sd: f64, seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let head: Vec<String> = (0..WAVELENGTHS).map(|at| nm(at).to_string()).collect();
    let mut text = format!("sample,film,backing,thickness_mm,{}\n", head.join(","));
    let mut add = |name: &str, reflectance: &dyn Fn(usize) -> f64| {
        for _ in 0..2 {
            let values = (0..WAVELENGTHS).map(|at| {
                let error: f64 = StandardNormal.sample(&mut random);
                let read = surface.measured_from_internal(reflectance(at)) + sd * error;
                format!("{:.6}", read.max(0.0))
            });
            text += &format!("{name},{}\n", values.collect::<Vec<_>>().join(","));
        }
    };
    for (card, g) in CARDS {
        add(&format!("card,none,{card},"), &|_| g);
        for mm in thicknesses_mm {
            let name = format!("paint,paint,{card},{mm}");
            add(&name, &|at| {
                let [k, s] = paint.at(nm(at));
                Layer::new(k, s, *mm).over(g)
            });
        }
    }
    text
}

fn read(text: &str, request: &FilmRequest) -> Vec<FilmOnCards> {
    let readings = Readings::from_csv("cards.csv", text.as_bytes()).unwrap();
    film(&readings, request).unwrap().films
}

/// Contrast ratio of a film of `paint`.
fn contrast(paint: Paint, mm: f64, surface: Surface) -> f64 {
    let grid = spectra::Grid::from_nm(400.0, 10.0, WAVELENGTHS).unwrap();
    let weights = Viewing::default().weights(grid).unwrap();
    let [light, dark] = CARDS.map(|(_, g)| {
        let values = (0..WAVELENGTHS).map(|at| {
            let [k, s] = paint.at(nm(at));
            surface.measured_from_internal(Layer::new(k, s, mm).over(g))
        });
        weights.xyz(&values.collect::<Vec<f64>>()).y
    });
    dark / light
}

const WHITE: Paint = Paint { absorption: [0.05, 0.1], centre_nm: 420.0, scattering: 60.0 };
const OCHRE: Paint = Paint { absorption: [2.0, 25.0], centre_nm: 440.0, scattering: 40.0 };
const GLAZE: Paint = Paint { absorption: [0.5, 20.0], centre_nm: 520.0, scattering: 0.0 };
const BLUE: Paint = Paint { absorption: [3.0, 60.0], centre_nm: 600.0, scattering: 12.0 };

#[test]
fn known_films_come_back_within_their_deviations() {
    let [gloss, matte] = [Surface::of_most_paints(Specular::Included), Surface::NONE];
    let excluded = Surface::of_most_paints(Specular::Excluded);
    for (name, paint, mm, surface) in [
        ("white", WHITE, 0.04, gloss),
        ("white, matte", WHITE, 0.03, matte),
        ("ochre", OCHRE, 0.03, gloss),
        ("ochre, 45:0", OCHRE, 0.05, excluded),
        ("glaze", GLAZE, 0.05, gloss),
        ("blue", BLUE, 0.02, gloss),
        ("blue, thin", BLUE, 0.005, gloss),
    ] {
        let mut squares = Vec::new();
        for seed in 0..8 {
            let text = file(paint, &[mm], surface, 0.001, seed);
            let request = FilmRequest { surface: Some(surface), ..FilmRequest::default() };
            let found = read(&text, &FilmRequest { noise: Some(0.001), ..request }).remove(0);
            for power in &found.powers {
                let [k, s] = paint.at(power.nm).map(|value| value * mm);
                for (truth, found) in [(k, power.absorption), (s, power.scattering)] {
                    if let Some(found) = found {
                        squares.push(((found.value - truth) / found.deviation).powi(2));
                    }
                }
            }
        }
        assert!(squares.len() > 8 * WAVELENGTHS, "{name}: {}", squares.len());
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        // Errors at a bound, such as S of a glaze, are smaller than the deviation.
        assert!((0.3..1.4).contains(&mean), "{name}: mean squared error in deviations {mean}");
    }
}

#[test]
fn hiding_power_is_the_thickness_at_which_the_contrast_ratio_reaches_the_limit() {
    let surface = Surface::of_most_paints(Specular::Included);
    for (name, paint, mm, limit) in [
        ("white", WHITE, 0.04, 0.98),
        ("white, thick", WHITE, 0.12, 0.98),
        ("ochre", OCHRE, 0.03, 0.98),
        ("ochre, 0.95", OCHRE, 0.03, 0.95),
        ("blue", BLUE, 0.02, 0.98),
    ] {
        let exact = file(paint, &[mm], surface, 0.0, 1);
        let request =
            FilmRequest { surface: Some(surface), contrast: limit, ..FilmRequest::default() };
        let found = read(&exact, &request).remove(0);
        let truth = contrast(paint, mm, surface);
        assert!((found.contrast.value - truth).abs() < 1e-4, "{name}: {:?}", found.contrast);
        let hiding = found.hiding.unwrap();
        let hidden_mm = hiding.thickness_mm.unwrap().value;
        let reached = contrast(paint, hidden_mm, surface);
        assert!((reached - limit).abs() < 5e-4, "{name}: {reached} at {hidden_mm} mm");
        assert!((hiding.spreading_rate.unwrap().value * hidden_mm - 1.0).abs() < 1e-9);
        // The deviation covers the errors of noisy readings.
        let noisy = (0..8).map(|seed| {
            let text = file(paint, &[mm], surface, 0.001, seed);
            let request = FilmRequest { noise: Some(0.001), ..request.clone() };
            let found = read(&text, &request).remove(0);
            let factor = found.hiding.unwrap().thickness_mm.unwrap();
            (((factor.value - hidden_mm) / factor.deviation).powi(2), found)
        });
        let squares: Vec<f64> = noisy.map(|(square, _)| square).collect();
        assert!(squares.iter().sum::<f64>() / 8.0 < 1.5, "{name}: {squares:?}");
    }
}

#[test]
fn the_program_tells_films_by_columns_and_by_names() {
    let folder = tempfile::tempdir().unwrap();
    let surface = Surface::of_most_paints(Specular::Included);
    let path = |name: &str| folder.path().join(name).display().to_string();
    let text = file(OCHRE, &[0.03, 0.06, 0.15, 0.3], surface, 0.0005, 3);
    std::fs::write(path("cards.csv"), &text).unwrap();
    let run = impasto(&["film", &path("cards.csv"), "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let json = run.json();
    assert_eq!(json["films"].as_array().unwrap().len(), 4);
    let rate = json["interpolated"][0]["spreading_rate"].as_f64().unwrap();
    let modelled = json["films"][1]["hiding"]["spreading_rate"]["value"].as_f64().unwrap();
    assert!((rate / modelled - 1.0).abs() < 0.3, "{rate} for {modelled}");
    assert!(run.err.contains("lay a thinner film"), "{}", run.err);
    let table = impasto(&["film", &path("cards.csv")]).out;
    for word in ["paint, 0.03 mm", "contrast ratio 0.", "hides (0.98) at", "m2/l", "S per mm"] {
        assert!(table.contains(word), "{word} in {table}");
    }

    // The same film, with the names of four spectra and no columns.
    let names = ["W0", "Wf", "B0", "Bf"];
    let kept = text.lines().filter(|line| !line.contains("0.06") || !line.contains(",paint,"));
    let kept = kept.filter(|line| !(line.contains(",0.15,") || line.contains(",0.3,")));
    let renamed = kept.enumerate().map(|(at, line)| {
        let values: Vec<&str> = line.split(',').skip(4).collect();
        let name = if at == 0 { "Name" } else { names[(at - 1) / 2] };
        format!("{name},{}\n", values.join(","))
    });
    std::fs::write(path("named.csv"), renamed.collect::<String>()).unwrap();
    let by_name = ["--over-white", "Wf", "--over-black", "Bf", "--white-card", "W0"];
    let options = ["--black-card", "B0", "--thickness-mm", "0.03", "--json"];
    let run = impasto(&[&["film", &path("named.csv")], &by_name[..], &options[..]].concat());
    assert_eq!(run.status, 0, "{}", run.err);
    assert_eq!(run.json()["films"][0]["powers"], json["films"][0]["powers"]);
}

#[test]
fn what_is_no_film_on_two_cards_is_refused_with_a_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cards.csv").display().to_string();
    let surface = Surface::of_most_paints(Specular::Included);
    let whole = file(OCHRE, &[0.03], surface, 0.0005, 3);
    std::fs::write(&path, &whole).unwrap();
    for (arguments, what, hint, status) in [
        (&["--sample", "x"][..], "of `x`", "the file has paint", 1),
        (&["--over-white", "paint"], "four names", "--black-card NAME", 2),
        (&["--noise", "0"], "found `0`", "--noise", 2),
        (&["--contrast", "1"], "found `1`", "--contrast", 2),
        (&["--thickness-mm", "-1"], "found `-1`", "--thickness-mm", 2),
        (&["--saunderson", "0.06,0.6"], "k1 = 0.06", "--specular excluded", 1),
    ] {
        let run = impasto(&[&["film", &path], arguments].concat());
        assert_eq!(run.status, status, "{arguments:?}: {}", run.err);
        assert!(run.err.contains(what), "{arguments:?}: {}", run.err);
        assert!(run.err.contains(hint), "{arguments:?}: {}", run.err);
    }
    let refused = |text: &str| {
        let readings = Readings::from_csv("cards.csv", text.as_bytes()).unwrap();
        film(&readings, &FilmRequest::default()).unwrap_err()
    };
    let exchanged = whole.replace("card,none,white", "card,none,x");
    let exchanged = exchanged.replace("card,none,black", "card,none,white");
    let exchanged = exchanged.replace("card,none,x", "card,none,black");
    assert!(matches!(refused(&exchanged), FilmError::Darker { .. }));
    let without = whole.lines().filter(|line| !line.starts_with("card,none,black"));
    let without = without.collect::<Vec<_>>().join("\n");
    assert!(matches!(refused(&without), FilmError::NoPair { .. }));
    // Both cards are white.
    let card = whole.lines().find(|line| line.starts_with("card,none,white")).unwrap();
    let card = card.replace("white", "black");
    let alike = whole.lines().map(|line| match line.starts_with("card,none,black") {
        true => card.as_str(),
        false => line,
    });
    let alike = alike.collect::<Vec<_>>().join("\n");
    assert!(matches!(refused(&alike), FilmError::NoPair { .. }));
}
