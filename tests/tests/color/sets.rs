//! `color --against`: two sets of measurements compared sample by sample.

use suite::program::impasto;

/// Spectra of grey samples, as rows of a CSV.
fn grey(samples: &[(&str, f64)], step_nm: usize) -> String {
    let nm: Vec<usize> = (400..=700).step_by(step_nm).collect();
    let head: Vec<String> = nm.iter().map(ToString::to_string).collect();
    let rows = samples
        .iter()
        .map(|(name, value)| format!("{name},{}\n", vec![value.to_string(); nm.len()].join(",")));
    std::iter::once(format!("sample,{}\n", head.join(","))).chain(rows).collect()
}

/// CIE 1976 lightness of a grey.
fn lightness(reflectance: f64) -> f64 {
    116.0 * reflectance.cbrt() - 16.0
}

#[test]
fn sets_are_compared_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let standard = [("a", 0.20), ("b", 0.40), ("c", 0.60)];
    for (case, batch, step_nm, tolerance, status, failed, says) in [
        ("alike", vec![("c", 0.60), ("a", 0.20), ("b", 0.40)], 10, Some("0"), 0, 0, ""),
        (
            "other wavelengths",
            vec![("a", 0.20), ("b", 0.40), ("c", 0.60)],
            5,
            Some("0.01"),
            0,
            0,
            "",
        ),
        (
            "darker",
            vec![("a", 0.19), ("b", 0.38), ("c", 0.57)],
            10,
            Some("1"),
            1,
            3,
            "3 of 3 samples",
        ),
        ("one is off", vec![("a", 0.20), ("b", 0.40), ("c", 0.50)], 10, Some("1"), 1, 1, "1 of 3"),
        ("a wide tolerance", vec![("a", 0.20), ("b", 0.40), ("c", 0.50)], 10, Some("9"), 0, 0, ""),
        ("no tolerance", vec![("a", 0.20), ("b", 0.40), ("c", 0.50)], 10, None, 0, 0, ""),
        (
            "repeated",
            vec![("a", 0.19), ("a", 0.21), ("b", 0.40)],
            10,
            Some("0.2"),
            0,
            0,
            "second set: c",
        ),
        ("more", vec![("a", 0.20), ("x", 0.40)], 10, Some("1"), 0, 0, "first set: x"),
        (
            "nothing in common",
            vec![("x", 0.20)],
            10,
            Some("1"),
            1,
            0,
            "no sample has the same name",
        ),
        ("impossible", vec![("a", 0.20)], 10, Some("-1"), 2, 0, "found `-1`"),
    ] {
        std::fs::write(path("batch.csv"), grey(&batch, step_nm)).unwrap();
        std::fs::write(path("standard.csv"), grey(&standard, 10)).unwrap();
        let tolerance = tolerance.map(|value| format!("--tolerance={value}"));
        let mut arguments = vec!["color".to_owned(), path("batch.csv"), "--json".to_owned()];
        arguments.extend(["--against".to_owned(), path("standard.csv")]);
        arguments.extend(tolerance.clone());
        let run = impasto(&arguments.iter().map(String::as_str).collect::<Vec<_>>());
        assert_eq!(run.status, status, "{case}: {}", run.err);
        assert!(run.err.contains(says), "{case}: {}", run.err);
        if run.out.is_empty() {
            continue;
        }
        let found = &run.json()[0];
        let expected = tolerance.map_or(serde_json::Value::Null, |_| failed.into());
        assert_eq!(found["failed"], expected, "{case}");
        for sample in found["samples"].as_array().unwrap() {
            let name = sample["sample"].as_str().unwrap();
            let mean = |set: &[(&str, f64)]| {
                let own: Vec<f64> =
                    set.iter().filter(|(own, _)| *own == name).map(|(_, value)| *value).collect();
                own.iter().sum::<f64>() / own.len() as f64
            };
            let step = lightness(mean(&batch)) - lightness(mean(&standard));
            let found = sample["dl"].as_f64().unwrap();
            assert!((found - step).abs() < 0.01, "{case}, {name}: {found} for {step}");
        }
    }
}

#[test]
fn the_table_tells_each_sample_and_the_summary() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::write(path("batch.csv"), grey(&[("a", 0.2), ("b", 0.3)], 10)).unwrap();
    std::fs::write(path("standard.csv"), grey(&[("a", 0.2), ("b", 0.4)], 10)).unwrap();
    let files = ["color", &path("batch.csv"), "--against", &path("standard.csv")];
    let run = impasto(&[&files[..], &["--tolerance", "2", "--illuminant", "A"]].concat());
    assert_eq!(run.status, 1, "{}", run.err);
    for word in ["A, observer", "pass", "FAIL", "mean shift dL* -", "1 pass and 1 fail at 2"] {
        assert!(run.out.contains(word), "{word} in {}", run.out);
    }
    let csv =
        impasto(&[&files[..], &["--csv", "--illuminant", "A", "--illuminant", "D65"]].concat());
    assert_eq!(csv.out.lines().count(), 5, "{}", csv.out);
    let both = impasto(&[&files[..], &["--compare", "a"]].concat());
    assert_eq!(both.status, 2, "{}", both.err);
}
