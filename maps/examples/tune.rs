use calibrate::{FitOptions, PreparedFit, Readings};
use maps::accuracy::*;
use maps::left_out::left_out;
use maps::{MapSettings, PigmentGroup};
fn main() {
    let group = |name: &str, list: &[&str]| PigmentGroup { name: name.into(), pigments: list.iter().map(|s| s.to_string()).collect() };
    let groups = vec![
        group("whites", &["Zinc White", "Lead White", "Barium Sulphate", "Calcium Carbonate"]),
        group("red lakes", &["Eosin Lake (wax)", "Eosin Lake", "Eosin Lake (lead, wax)", "Cochineal Lake"]),
        group("chrome yellows", &["Chrome Yellow", "Chrome Yellow (Otero)"]),
    ];

    if std::env::args().nth(1).as_deref() == Some("sim") {
        let oils = pigment::PigmentLibrary::van_gogh_oils();
        let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
        let steps = vec![("same", oils.clone(), oils.clone())];
        for (label, real, known) in steps {
            for penalty in [0.0, 1.0, 2.0, 3.0] {
            let settings = MapSettings { penalty, model_error: Some(maps::ModelError::Stated(0.1)), groups: groups.clone(), group_alike: false, ..MapSettings::default() };
            let mapper = maps::Mapper::new(&known, &nm, &settings).unwrap();
            let (mut all, mut worse) = (Vec::new(), 0.0);
            for seed in 101..141 {
            let plan = PaintingPlan { seed, pixels: 150, ..PaintingPlan::default() };
            let painting = Painting::simulate(&real, &known, &plan);
            let maps = mapper.search(&painting.spectra).unwrap();
            all.extend(painting.trials(&mapper, &maps));
            worse += painting.search_worse_than_truth(&mapper).unwrap() / 40.0;
            }
            let trials = all;
            println!("{label} pen {penalty} search {}; worse {:.3} chi2 {:.2}", Scores::of(&trials), worse, trials.iter().map(|t| t.chi2).sum::<f64>() / trials.len() as f64);
            let map: Vec<Trial> = trials.iter().map(|t| Trial { present: t.told.iter().map(|s| *s > 0.0).collect(), ..t.clone() }).collect();
            println!("   best set {}", Scores::of(&map));
            for r in reliability(&trials, &[0.0, 0.1, 0.3, 0.5, 0.7, 0.9]) { print!(" {:.1}: n {} told {:.2} true {:.2};", r.from, r.count, r.told, r.true_part); }
            let right: Vec<Trial> = trials.iter().filter(|t| t.present.iter().zip(&t.truth).all(|(p, t)| *p == (*t > 0.0))).cloned().collect();
            println!(" cover {:?} right sets {:?}", coverage(&trials), coverage(&right));
            let mut z: Vec<f64> = right.iter().filter(|t| t.present.iter().filter(|p| **p).count() > 1).flat_map(|t| (0..t.sd.len()).filter(|&i| t.present[i]).map(|i| (t.truth[i] - t.told[i]).abs() / t.sd[i].max(1e-6)).collect::<Vec<_>>()).collect();
            z.sort_by(f64::total_cmp);
            println!("   |z| quantiles 50 {:.2} 68 {:.2} 90 {:.2}", z[z.len() / 2], z[z.len() * 68 / 100], z[z.len() * 9 / 10]);
            }
        }
        return;
    }
    let t = std::time::Instant::now();
    let readings = Readings::open("measurements/van-gogh-oils.csv").unwrap();
    let options = FitOptions { below_surface: Some(calibrate::observation::BelowSurface::Floor), ..FitOptions::default() };
    let prepared = PreparedFit::new(&readings, &options, &|| ()).unwrap();
    let samples = left_out(&prepared, &|| ()).unwrap();
    println!("{} samples {:?}", samples.len(), t.elapsed());
    let rms = (samples.iter().flat_map(|s| s.reflectance.iter().zip(&s.predicted)).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / (31 * samples.len()) as f64).sqrt();
    println!("rms {rms}");
    let j: Vec<_> = samples.iter().map(|s| serde_json::json!({"sample": s.sample, "shares": s.shares, "reflectance": s.reflectance, "predicted": s.predicted, "pigments": s.library.pigments.iter().filter(|p| p.identified).map(|p| serde_json::json!({"name": p.name, "K": p.absorption, "S": p.scattering, "sk": p.absorption_sd, "ss": p.scattering_sd})).collect::<Vec<_>>()})).collect();
    std::fs::write("/tmp/p3/left.json", serde_json::to_string(&j).unwrap()).unwrap();
    let named = NamedGroups::of(&samples, &groups);
    for b in Baseline::ALL {
        let t = SwatchTrials::baseline(&samples, &named, b, 0.05);
        println!("{:28} {} | {}", b.name(), Scores::of(&t.pigments), Scores::of(&t.groups));
    }
    let mut all = Vec::new();
    for penalty in [0.0, 1.0, 2.0, 3.0] {
        let t = std::time::Instant::now();
        let settings = MapSettings { penalty, ..MapSettings::default() };
        let trials = swatch_trials(&samples, &settings, &groups).unwrap();
        println!("pen {penalty} {} | {}  {:?}", Scores::of(&trials.pigments), Scores::of(&trials.groups), t.elapsed());
        for (label, list) in [("pigments", &trials.pigments), ("groups", &trials.groups)] {
            let map: Vec<Trial> = list.iter().map(|t| Trial { present: t.told.iter().map(|s| *s > 0.0).collect(), ..t.clone() }).collect();
            println!("    best set {label} {}", Scores::of(&map));
        }
        for r in reliability(&trials.groups, &[0.0, 0.1, 0.3, 0.6, 0.9]) { print!(" {:.1}: n {} told {:.2} true {:.2};", r.from, r.count, r.told, r.true_part); }
        println!(" cover {:?}", coverage(&trials.groups));
        all.push((penalty, trials));
    }
    let choice = choose_penalty(&all, 5);
    println!("chosen {:?} {} | {}", choice.penalties, Scores::of(&choice.trials.pigments), Scores::of(&choice.trials.groups));
}
