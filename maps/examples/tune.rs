use calibrate::{FitOptions, PreparedFit, Readings};
use maps::accuracy::*;
use maps::left_out::left_out;
use maps::{MapSettings, PigmentGroup};
fn main() {
    let group = |name: &str, list: &[&str]| PigmentGroup {
        name: name.into(),
        pigments: list.iter().map(|s| s.to_string()).collect(),
    };
    let groups = vec![
        group("whites", &["Zinc White", "Lead White", "Barium Sulphate", "Calcium Carbonate"]),
        group(
            "red lakes",
            &["Eosin Lake (wax)", "Eosin Lake", "Eosin Lake (lead, wax)", "Cochineal Lake"],
        ),
        group("chrome yellows", &["Chrome Yellow", "Chrome Yellow (Otero)"]),
    ];

    if std::env::args().nth(1).as_deref() == Some("sim") {
        let oils = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let steps = vec![("same", oils.clone(), oils.clone())];
        for (label, real, known) in steps {
            for seed in [1, 2] {
                let plan = PaintingPlan { seed, pixels: 3000, ..PaintingPlan::default() };
                let painting = Painting::simulate(&real, &known, &plan);
                for penalty in [4.0, 6.0] {
                    let settings = MapSettings {
                        penalty,
                        model_error: Some(maps::ModelError::Stated(0.1)),
                        groups: groups.clone(),
                        group_alike: false,
                        ..MapSettings::default()
                    };
                    let mapper = maps::Mapper::new(&known, &nm, &settings).unwrap();
                    let t = std::time::Instant::now();
                    let maps = mapper.search(&painting.spectra).unwrap();
                    let ts = t.elapsed();
                    let trials = painting.trials(&mapper, &maps);
                    println!(
                        "{label} seed {seed} pen {penalty} search {} in {:?}; worse {:.3} chi2 {:.2}",
                        Scores::of(&trials),
                        ts,
                        painting.search_worse_than_truth(&mapper).unwrap(),
                        trials.iter().map(|t| t.chi2).sum::<f64>() / 3000.0
                    );
                    let t = std::time::Instant::now();
                    let book = mapper.survey(&painting.spectra, &|| ()).unwrap();
                    let tb = t.elapsed();
                    let t = std::time::Instant::now();
                    let maps = mapper.map_block(&book, &painting.spectra).unwrap();
                    let trials = painting.trials(&mapper, &maps);
                    println!(
                        "   survey {tb:?} map {} in {:?} usual {}",
                        Scores::of(&trials),
                        t.elapsed(),
                        book.usual_chi2
                    );
                    for r in reliability(&trials, &[0.0, 0.1, 0.3, 0.5, 0.7, 0.9]) {
                        print!(
                            " {:.1}: n {} told {:.2} true {:.2};",
                            r.from, r.count, r.told, r.true_part
                        );
                    }
                    println!(" cover {:?}", coverage(&trials));
                }
            }
        }
        return;
    }
    let t = std::time::Instant::now();
    let readings = Readings::open("measurements/van-gogh-oils.csv").unwrap();
    let options = FitOptions {
        below_surface: Some(calibrate::observation::BelowSurface::Floor),
        ..FitOptions::default()
    };
    let prepared = PreparedFit::new(&readings, &options, &|| ()).unwrap();
    let samples = left_out(&prepared, &|| ()).unwrap();
    println!("{} samples {:?}", samples.len(), t.elapsed());
    let rms = (samples
        .iter()
        .flat_map(|s| s.reflectance.iter().zip(&s.predicted))
        .map(|(a, b)| (a - b) * (a - b))
        .sum::<f64>()
        / (31 * samples.len()) as f64)
        .sqrt();
    println!("rms {rms}");
    let j: Vec<_> = samples.iter().map(|s| serde_json::json!({"sample": s.sample, "shares": s.shares, "reflectance": s.reflectance, "predicted": s.predicted, "pigments": s.library.pigments.iter().filter(|p| p.identified).map(|p| serde_json::json!({"name": p.name, "K": p.absorption, "S": p.scattering, "sk": p.absorption_sd, "ss": p.scattering_sd})).collect::<Vec<_>>()})).collect();
    std::fs::write("/tmp/p3/left.json", serde_json::to_string(&j).unwrap()).unwrap();
    let named = NamedGroups::of(&samples, &groups);
    for b in Baseline::ALL {
        let t = SwatchTrials::baseline(&samples, &named, b, 0.05);
        println!("{:28} {} | {}", b.name(), Scores::of(&t.pigments), Scores::of(&t.groups));
    }
    let mut all = Vec::new();
    for penalty in [4.0, 6.0, 8.0] {
        let t = std::time::Instant::now();
        let settings = MapSettings { penalty, ..MapSettings::default() };
        let trials = swatch_trials(&samples, &settings, &groups).unwrap();
        println!(
            "pen {penalty} {} | {}  {:?}",
            Scores::of(&trials.pigments),
            Scores::of(&trials.groups),
            t.elapsed()
        );
        for (label, list) in [("pigments", &trials.pigments), ("groups", &trials.groups)] {
            let map: Vec<Trial> = list
                .iter()
                .map(|t| Trial { present: t.told.iter().map(|s| *s > 0.0).collect(), ..t.clone() })
                .collect();
            println!("    best set {label} {}", Scores::of(&map));
        }
        for r in reliability(&trials.groups, &[0.0, 0.1, 0.3, 0.6, 0.9]) {
            print!(" {:.1}: n {} told {:.2} true {:.2};", r.from, r.count, r.told, r.true_part);
        }
        println!(" cover {:?}", coverage(&trials.groups));
        all.push((penalty, trials));
    }
    let choice = choose_penalty(&all, 5);
    println!(
        "chosen {:?} {} | {}",
        choice.penalties,
        Scores::of(&choice.trials.pigments),
        Scores::of(&choice.trials.groups)
    );
}
