
use maps::accuracy::*; use maps::*; use pigment::PigmentLibrary;
#[test] fn z() {
    let oils = PigmentLibrary::van_gogh_oils();
    let s = MapSettings { groups: oil_groups(), group_alike: false, model_error: Some(ModelError::Stated(0.1)), ..MapSettings::default() };
    for (name, palette) in [("random", Vec::new()), ("light", light_palette())] {
    for penalty in [0.0, 2.0] {
    let plan = PaintingPlan { pixels: 100, palette: palette.clone(), ..PaintingPlan::default() };
    let t = painting_trials((&oils, &oils), &plan, 101..121, &MapSettings { penalty, ..s.clone() }).unwrap();
    for (l, list) in [("searched", &t.searched), ("mapped", &t.mapped)] {
        let mut z: Vec<f64> = list.iter().filter(|t| t.present.iter().filter(|p| **p).count() > 1).flat_map(|t| (0..t.sd.len()).filter(|&i| t.present[i]).map(|i| (t.truth[i] - t.told[i]).abs() / t.sd[i].max(1e-6)).collect::<Vec<_>>()).collect();
        z.sort_by(f64::total_cmp);
        println!("{name} pen {penalty} {l} {} worse {:.3} z50 {:.2} z68 {:.2} z90 {:.2} cover {:?}", Scores::of(list), t.worse, z[z.len()/2], z[z.len()*68/100], z[z.len()*9/10], coverage(list).within);
        for r in reliability(list, &[0.0, 0.1, 0.3, 0.5, 0.7, 0.9]) { print!(" {:.2}/{:.2} ({})", r.told, r.true_part, r.count); }
        println!();
    }
    }}
}
