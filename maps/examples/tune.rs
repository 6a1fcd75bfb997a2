use calibrate::{FitOptions, PreparedFit, Readings};
use maps::accuracy::*;
use maps::left_out::left_out;
use maps::{MapSettings, PigmentGroup};
fn main() {
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
    let group = |name: &str, list: &[&str]| PigmentGroup { name: name.into(), pigments: list.iter().map(|s| s.to_string()).collect() };
    let groups = vec![
        group("whites", &["Zinc White", "Lead White", "Barium Sulphate", "Calcium Carbonate"]),
        group("red lakes", &["Eosin Lake (wax)", "Eosin Lake", "Eosin Lake (lead, wax)", "Cochineal Lake"]),
        group("chrome yellows", &["Chrome Yellow", "Chrome Yellow (Otero)"]),
    ];
    let named = NamedGroups::of(&samples, &groups);
    for b in Baseline::ALL {
        let t = SwatchTrials::baseline(&samples, &named, b, 0.05);
        println!("{:28} {} | {}", b.name(), Scores::of(&t.pigments), Scores::of(&t.groups));
    }
    let mut all = Vec::new();
    for penalty in [4.0, 8.0] {
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
