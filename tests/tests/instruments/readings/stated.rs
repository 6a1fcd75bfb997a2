//! Files that leave out a quantity, a unit, wavelengths or the geometry, or state them wrongly. One row of a
//! table is one file that the program reads or refuses.

use suite::program::{Run, impasto};

/// A table of reflectance by wavelength: `nm` turned into text, and a value at each.
fn rows(of: impl Fn(f64) -> (String, f64)) -> String {
    let rows = (0..36).map(|at| of(380.0 + 10.0 * f64::from(at)));
    rows.map(|(nm, value)| format!("{nm}\t{value:.6}\n")).collect()
}

/// Reflectance of a red paint.
fn red(nm: f64) -> f64 {
    0.05 + 0.6 / (1.0 + (-(nm - 590.0) / 15.0).exp())
}

fn nm_text(nm: f64) -> String {
    format!("{nm}")
}

fn values(separator: &str, of: impl Fn(f64) -> f64) -> String {
    let values = (0..36).map(|at| format!("{:.6}", of(380.0 + 10.0 * f64::from(at))));
    values.collect::<Vec<String>>().join(separator)
}

fn run(verb: &str, name: &str, content: &str, options: &[&str]) -> Run {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    std::fs::write(&file, content).unwrap();
    let mut arguments = vec![verb, file.to_str().unwrap(), "--json"];
    arguments.extend(options);
    impasto(&arguments)
}

fn lab(run: &Run) -> [f64; 3] {
    [0, 1, 2].map(|axis| run.json()[0]["lab"][axis].as_f64().unwrap())
}

const RANGE: [&str; 2] = ["--wavelengths", "380..730:10"];

#[test]
fn every_way_to_write_a_red_gives_its_color() {
    let plain = rows(|nm| (nm_text(nm), red(nm)));
    let wanted = lab(&run("color", "plain.csv", &format!("nm\tR\n{plain}"), &[]));
    let micrometres = rows(|nm| (format!("{:.3}", nm / 1000.0), red(nm)));
    let percent = rows(|nm| (format!("{:.3}", nm / 1000.0), 100.0 * red(nm)));
    let absorbance = rows(|nm| (nm_text(nm), -red(nm).log10()));
    let ratio = rows(|nm| (nm_text(nm), (1.0 - red(nm)).powi(2) / (2.0 * red(nm))));
    let in_row = format!("\"Red Ochre\"\t{}\n", values("\t", red));
    let below_title = format!(" splib07a Record=1: Red Ochre AREF\n{}\n", values("\n", red));
    let aster = "Name: Red\nType: manmade\nX Units: Wavelength (micrometers)\n\
                 Y Units: Reflectance (percent)\n\n";
    for (name, content, options, remark) in [
        ("um.csv", format!("Wavelength_um\tRed\n{micrometres}"), &[][..], ""),
        ("um.csv", format!("Wavelength (um)\tRed\n{micrometres}"), &[], ""),
        ("um.csv", micrometres, &[], "taken for micrometres"),
        ("aster.txt", format!("{aster}{percent}"), &[], "in percent"),
        ("abundance.txt", format!("Red, 100% abundance\nnm\tR\n{plain}"), &[], "in fractions"),
        ("misled.csv", format!("nm\tCounts\n{plain}"), &["--values", "reflectance"], ""),
        ("a.csv", format!("nm\tAbs\n{absorbance}"), &["--values", "absorbance"], "10^-A"),
        ("ks.csv", format!("nm\tK/S\n{ratio}"), &["--values", "K/S"], "K/S is turned"),
        ("row.txt", in_row, &RANGE, ""),
        ("usgs.txt", below_title, &RANGE, ""),
    ] {
        let found = run("color", name, &content, options);
        assert_eq!(found.status, 0, "{name}: {}", found.err);
        assert!(found.err.contains(remark), "{name}: `{remark}` is missing: {}", found.err);
        for (found, wanted) in lab(&found).into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 0.01, "{name} {options:?}: {found} for {wanted}");
        }
    }
}

#[test]
fn what_is_doubtful_is_refused_or_told_with_the_way_out() {
    let even = |first: u32, last: u32, step: usize| -> String {
        (first..=last).step_by(step).map(|nm| format!("{nm} 0.5\n")).collect()
    };
    let plain = rows(|nm| (nm_text(nm), red(nm)));
    let infrared: String = (0..73).map(|at| format!("{} 0.5\n", 4000 - 50 * at)).collect();
    for (name, content, options, status, words) in [
        ("ftir.txt", infrared, &[][..], 1, &["400 to `4000`", "`cm-1`"][..]),
        ("uv.csv", format!("nm R\n{}", even(250, 400, 10)), &[], 1, &["have no colour"]),
        ("nir.csv", format!("nm R\n{}", even(675, 2495, 10)), &[], 1, &["have no colour"]),
        ("a.csv", format!("nm\tAbs\n{plain}"), &[], 1, &["absorbance", "--values absorbance"]),
        ("ks.csv", format!("nm\tK/S\n{plain}"), &[], 1, &["K/S", "--values k/s"]),
        ("quanta.csv", format!("nm\tQNTM\n{plain}"), &[], 1, &["a number of photons"]),
        (
            "white.txt",
            format!("nm\tReflectance[%]\n{plain}"),
            &[],
            0,
            &["states percent", "--fraction"],
        ),
        ("row.txt", format!("Red\t{}\n", values("\t", red)), &[], 1, &["--wavelengths"]),
        (
            "row.txt",
            format!("Red\t{}\n", values("\t", red)),
            &["--wavelengths", "400..730:10"],
            1,
            &["line 1", "34 wavelengths, found `36`"],
        ),
        ("own.txt", format!("nm\tR\n{plain}"), &RANGE, 1, &["its own wavelengths"]),
        ("any.csv", plain, &["--wavelengths", "400..735:10"], 2, &["380..730:10"]),
    ] {
        let found = run("color", name, &content, options);
        assert_eq!(found.status, status, "{name} {options:?}: {}", found.err);
        for word in words {
            assert!(found.err.contains(word), "{name}: `{word}` is missing: {}", found.err);
        }
    }
}

#[test]
fn a_lamp_is_read_by_its_quantity_and_its_smoothness() {
    // A black body of 2856 K in numbers of photons.
    let body = |nm: f64| 1e17 * nm.powi(-4) / ((1.4388e7 / (nm * 2856.0)).exp() - 1.0);
    let photons = rows(|nm| (nm_text(nm), 1e-3 * body(nm)));
    let lined = rows(|nm| (nm_text(nm), if nm == 430.0 || nm == 540.0 { 5.0 } else { 1.0 }));
    let list = values(" ", |nm| 1e-3 * body(nm) / nm);
    for (name, content, options, kelvin, words) in [
        (
            "q.txt",
            format!("nm\tQNTM\n{photons}"),
            &[][..],
            Some(2856.0),
            &["divided by wavelength"][..],
        ),
        ("p.txt", photons, &["--values", "photons"], Some(2856.0), &["Sprague", "every 10 nm"]),
        (
            "list.txt",
            list,
            &["--wavelengths", "380..730:10", "--values", "power"],
            Some(2856.0),
            &[],
        ),
        ("tube.csv", format!("nm\tpower\n{lined}"), &[], None, &["linearly", "by 10 and more"]),
    ] {
        let found = run("light", name, &content, options);
        assert_eq!(found.status, 0, "{name}: {}", found.err);
        for word in words {
            assert!(found.err.contains(word), "{name}: `{word}` is missing: {}", found.err);
        }
        if let Some(kelvin) = kelvin {
            let found = found.json()[0]["kelvin"].as_f64().unwrap();
            assert!((found - kelvin).abs() < 3.0, "{name}: {found} K");
        }
    }
}

#[test]
fn raw_counts_are_told_as_counts_and_a_dark_tile_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let counts = rows(|nm| (nm_text(nm), 20000.0 * red(nm)));
    let white = rows(|nm| (nm_text(nm), 20000.0 - 0.1 * (nm - 560.0).abs()));
    let tile = rows(|nm| (nm_text(nm), 0.99 - 1e-6 * nm));
    std::fs::write(path("red.csv"), format!("nm\tCounts\n{counts}")).unwrap();
    std::fs::write(path("white.csv"), format!("nm\tCounts\n{white}")).unwrap();
    std::fs::write(path("tile.txt"), format!("nm\tReflectance[%]\n{tile}")).unwrap();
    let [red, white, tile] = ["red.csv", "white.csv", "tile.txt"].map(path);
    let with = ["color", &red, "--white-reading", &white, "--dark-reading", "0"];
    let found = impasto(&with);
    assert_eq!(found.status, 0, "{}", found.err);
    assert!(found.err.contains("in counts, divided by the white"), "{}", found.err);
    // The white reads 20,000 at most, so this detector is saturated and one count more is not.
    for (full_scale, is_read) in [("20000", false), ("20001", true)] {
        let found = impasto(&[&with[..], &["--full-scale", full_scale]].concat());
        assert_eq!(found.status == 0, is_read, "{full_scale}: {}", found.err);
        assert_eq!(found.err.contains("saturated"), !is_read, "{full_scale}: {}", found.err);
    }
    let found = impasto(&[&with[..], &["--tile", &tile]].concat());
    assert!(found.status != 0 && found.err.contains("stated in percent"), "{}", found.err);
}
