//! `impasto light`: lamps by name and by file, in every form of output.

use suite::program::impasto;

#[test]
fn lamps_are_described_by_name_and_by_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bulb.csv");
    // A black body of 2700 K, measured at steps of 10 nm.
    let power = |nm: f64| (560.0 / nm).powi(5) / (1.4388e7 / (nm * 2700.0)).exp_m1();
    let lines = (36..=83).map(|ten| format!("{},{:e}\n", ten * 10, power(f64::from(ten * 10))));
    std::fs::write(&path, "nm,power\n".to_owned() + &lines.collect::<String>()).unwrap();
    let bulb = path.to_str().unwrap();
    let run = impasto(&["light", "FL11", bulb, "FL2", "--json"]);
    assert_eq!(run.status, 0, "{}", run.err);
    let told = run.json();
    let number = |at: usize, key: &str| told[at][key].as_f64().unwrap();
    assert!(
        (number(0, "ra") - 82.9).abs() < 0.1 && (number(0, "rf") - 80.15).abs() < 0.1,
        "{told}"
    );
    assert!((number(1, "kelvin") - 2700.0).abs() < 1.0, "{}", told[1]);
    assert!(number(1, "ra") > 99.9 && number(1, "rf") > 99.9 && number(1, "rg") > 99.8);
    assert_eq!(told[1]["light"], bulb);
    assert_eq!(told[2]["special"].as_array().unwrap().len(), 14);
    assert_eq!(told[2]["samples"].as_array().unwrap().len(), 99);
    // R9 of the tube FL2 is below 0: reds look brown.
    assert!(told[2]["special"][8].as_f64().unwrap() < 0.0, "{}", told[2]["special"]);
}

#[test]
fn the_table_has_the_figures_of_a_lamp_and_all_samples_on_demand() {
    let table = impasto(&["light", "A", "FL11", "LED-B3"]).out;
    let line = table.lines().find(|line| line.starts_with("FL11")).unwrap();
    let cells: Vec<&str> = line.split_whitespace().collect();
    assert_eq!(cells[..4], ["FL11", "0.3805", "0.3771", "4001"], "{table}");
    for words in ["CCT, K", "Duv", "Ra", "R9", "Rf", "Rg"] {
        assert!(table.lines().next().unwrap().contains(words), "{words}: {table}");
    }
    assert!(!table.contains("R14") && table.lines().count() == 4, "{table}");
    let all = impasto(&["light", "FL11", "--samples"]).out;
    assert!(all.contains("R14") && all.contains("Rf, hue"), "{all}");
    assert!(all.lines().all(|line| line.chars().count() <= 100), "{all}");
    let csv = impasto(&["light", "FL11", "--csv"]).out;
    let heading = csv.lines().next().unwrap();
    assert!(heading.starts_with("light,kelvin,duv,x,y,ra,R1,R2,"), "{heading}");
    assert!(heading.contains(",R13,R14,distance_from_reference,"), "{heading}");
    assert!(heading.contains(",rf,rg,Rf_hue_1,Rf_hue_2,"), "{heading}");
    assert!(heading.ends_with("Rf_hue_16"), "{heading}");
}

#[test]
fn lights_without_colour_rendering_are_refused_or_marked() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("green.csv");
    std::fs::write(&path, "nm,power\n400,0\n500,0\n530,1\n560,0\n700,0\n").unwrap();
    let green = impasto(&["light", path.to_str().unwrap()]);
    assert!(green.status == 1 && green.out.is_empty(), "{}", green.out);
    assert!(green.err.contains("no white light") && green.err.contains("hint: "), "{}", green.err);
    let unknown = impasto(&["light", "F11"]);
    assert!(unknown.status == 2 && unknown.err.contains("did you mean FL11?"), "{}", unknown.err);
    let far = impasto(&["light", "FL3.3", "HP1", "LED-V1"]).out;
    let marked = |name: &str| far.lines().find(|l| l.starts_with(name)).unwrap().ends_with('*');
    assert!(marked("FL3.3") && !marked("HP1") && !marked("LED-V1"), "{far}");
    assert!(far.lines().last().unwrap().starts_with("* farther than 0.0054"), "{far}");
}
