//! Compares results of `spectra` with the golden files: chromatic adaptation by Bradford and CAT16,
//! colour differences, conversions between colour spaces, metamerism indices, sRGB and Display P3,
//! CIE whiteness.

mod lights;

use std::collections::BTreeMap;

use serde::Deserialize;
use spectra::color::{
    Adaptation, Cie94, Cmc, Lab, Lch, Luv, Rgb, RgbSpace, Whiteness, WhitenessError, Xyz, adapt,
    corrected_to_match, delta_e_cie76, delta_e_cie94, delta_e_ciede2000, delta_e_cmc,
    metamerism_index,
};
use spectra::{Grid, Illuminant, Interpolation, Observer, TristimulusWeights};
use suite::golden::{Golden, assert_near, read};

/// A spectrum at a constant step, as in the golden files.
#[derive(Deserialize)]
struct Regular {
    start_nm: f64,
    step_nm: f64,
    values: Vec<f64>,
}

impl Regular {
    fn grid(&self) -> Grid {
        Grid::from_nm(self.start_nm, self.step_nm, self.values.len()).unwrap()
    }
}

fn observer(stem: &str) -> Observer {
    Observer::named(stem.strip_prefix("cie-").unwrap()).unwrap()
}

fn interpolation(name: &str) -> Interpolation {
    [Interpolation::Linear, Interpolation::Sprague]
        .into_iter()
        .find(|method| method.name() == name)
        .unwrap_or_else(|| panic!("no interpolation is called {name}"))
}

#[derive(Deserialize)]
struct Change {
    transform: String,
    from: String,
    to: String,
    from_white: [f64; 3],
    to_white: [f64; 3],
    matrix: [[f64; 3]; 3],
    samples: Vec<Adapted>,
}

#[derive(Deserialize)]
struct Adapted {
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    adapted: [f64; 3],
}

pub(crate) fn transform(name: &str) -> Adaptation {
    match name {
        "Bradford" => Adaptation::Bradford,
        "CAT16" => Adaptation::Cat16,
        _ => panic!("no adaptation is called {name}"),
    }
}

fn white_of(light: &str) -> [f64; 3] {
    let light = Illuminant::named(light).unwrap();
    let observer = Observer::Cie1931Deg2;
    let interpolation = Interpolation::Linear;
    let weights = TristimulusWeights::new(Grid::cie(), &light, observer, interpolation).unwrap();
    weights.white().to_array()
}

#[test]
fn matrices_and_colors_from_white_to_white() {
    let golden: Golden<Vec<Change>> = read("adaptation");
    for case in &golden.cases {
        let label = format!("{} from {} to {}", case.transform, case.from, case.to);
        for (light, wanted) in [(&case.from, case.from_white), (&case.to, case.to_white)] {
            assert_near(format!("white of {light}"), &white_of(light), &wanted, golden.tolerance);
        }
        let adaptation = transform(&case.transform);
        let (from, to) = (Xyz::from(case.from_white), Xyz::from(case.to_white));
        let matrix = adaptation.matrix(from, to).0;
        assert_near(&label, matrix.as_flattened(), case.matrix.as_flattened(), golden.tolerance);
        for sample in &case.samples {
            let got = adapt(sample.xyz.into(), from, to, adaptation).to_array();
            assert_near(&label, &got, &sample.adapted, golden.tolerance);
        }
    }
}

#[derive(Deserialize)]
struct Pair {
    reference: [f64; 3],
    sample: [f64; 3],
    ciede2000: f64,
    cie1976: f64,
    cie94: f64,
    cie94_textiles: f64,
    cmc_2_1: f64,
    cmc_1_1: f64,
}

#[test]
fn differences_in_every_formula() {
    let golden: Golden<Vec<Pair>> = read("difference");
    for pair in &golden.cases {
        let reference = Lab::from(pair.reference);
        let sample = Lab::from(pair.sample);
        let formulas = [
            ("CIEDE2000", delta_e_ciede2000(reference, sample), pair.ciede2000),
            ("CIE 1976", delta_e_cie76(reference, sample), pair.cie1976),
            ("CIE94", delta_e_cie94(reference, sample, Cie94::GraphicArts), pair.cie94),
            (
                "CIE94, textiles",
                delta_e_cie94(reference, sample, Cie94::Textiles),
                pair.cie94_textiles,
            ),
            ("CMC(2:1)", delta_e_cmc(reference, sample, Cmc::ACCEPTABILITY), pair.cmc_2_1),
            ("CMC(1:1)", delta_e_cmc(reference, sample, Cmc::PERCEPTIBILITY), pair.cmc_1_1),
        ];
        for (formula, got, wanted) in formulas {
            let label = format!("{formula} of {:?} and {:?}", pair.reference, pair.sample);
            assert_near(label, &[got], &[wanted], golden.tolerance);
        }
    }
}

/// Tolerance of the computed `ciede2000` of Sharma's pairs. `published` has only four decimals.
const FULL: f64 = 1e-9;

#[derive(Deserialize)]
struct Published {
    pair: usize,
    reference: [f64; 3],
    sample: [f64; 3],
    published: f64,
    ciede2000: f64,
    branch: bool,
}

fn published() -> Golden<Vec<Published>> {
    read("sharma")
}

fn assert_as_published(case: &Published, tolerance: f64) {
    let got = delta_e_ciede2000(case.reference.into(), case.sample.into());
    assert_near(format!("pair {}, printed", case.pair), &[got], &[case.published], tolerance);
    assert_near(format!("pair {}, in full", case.pair), &[got], &[case.ciede2000], FULL);
}

#[test]
fn ciede2000_of_the_published_pairs() {
    let golden = published();
    let numbers: Vec<usize> = golden.cases.iter().map(|case| case.pair).collect();
    assert_eq!(numbers, (1..=34).collect::<Vec<_>>(), "the pairs of Sharma, Wu and Dalal");
    for case in golden.cases.iter().filter(|case| !case.branch) {
        assert_as_published(case, golden.tolerance);
    }
}

/// In pairs 10 and 14 the hues differ by 180 degrees up to rounding, so both ways round the hue
/// circle are equally short. The rounding of one `atan2` then decides between two mean hues. The
/// published values assume a difference of at most 180 degrees.
#[test]
fn ciede2000_where_hues_are_half_a_turn_apart() {
    let golden = published();
    let pairs: Vec<_> = golden.cases.iter().filter(|case| case.branch).collect();
    assert_eq!(pairs.len(), 2, "pairs on the branch");
    for case in pairs {
        let [reference, sample] = [case.reference, case.sample].map(|[_, a, b]| [a, b]);
        assert_eq!(reference, sample.map(|v| -v), "pair {} is symmetric about grey", case.pair);
        assert_as_published(case, golden.tolerance);
    }
}

/// Below this chroma we do not compare hues, because rounding determines them.
const GREY: f64 = 0.01;

#[derive(Deserialize)]
#[serde(rename_all = "PascalCase")]
struct Color {
    #[serde(rename = "white")]
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "xyY", default)]
    xyy: Option<[f64; 3]>,
    lab: [f64; 3],
    #[serde(rename = "LCh")]
    lch: [f64; 3],
}

#[derive(Deserialize)]
struct Colors {
    from_xyz: Vec<Color>,
    from_lab: Vec<Color>,
}

fn colors() -> Golden<Colors> {
    read("lab")
}

#[test]
fn lab_from_xyz_and_back() {
    let golden = colors();
    for case in &golden.cases.from_xyz {
        let white = Xyz::from(case.white);
        let lab = Lab::from_xyz(case.xyz.into(), white);
        let label = format!("XYZ {:?}", case.xyz);
        assert_near(&label, &lab.to_array(), &case.lab, golden.tolerance);
        let back = Lab::from(case.lab).to_xyz(white);
        assert_near(format!("back to {label}"), &back.to_array(), &case.xyz, golden.tolerance);
    }
}

#[test]
fn xyz_from_lab() {
    let golden = colors();
    for case in &golden.cases.from_lab {
        let xyz = Lab::from(case.lab).to_xyz(case.white.into());
        assert_near(format!("{:?}", case.lab), &xyz.to_array(), &case.xyz, golden.tolerance);
    }
}

#[test]
fn lch_from_lab_and_back() {
    let golden = colors();
    for case in golden.cases.from_xyz.iter().chain(&golden.cases.from_lab) {
        let Lch { lightness, chroma, hue_degrees } = Lab::from(case.lab).to_lch();
        let label = format!("Lab {:?}", case.lab);
        assert_near(&label, &[lightness, chroma], &case.lch[..2], golden.tolerance);
        if chroma >= GREY {
            // The golden Lab is rounded. This turns the hue more if the chroma is smaller.
            let turn = golden.tolerance * (1.0 + 1f64.to_degrees() / chroma);
            assert_near(&label, &[hue_degrees], &case.lch[2..], turn);
        }
        let back = Lab::from(Lch { lightness, chroma, hue_degrees });
        assert_near(format!("back to {label}"), &back.to_array(), &case.lab, golden.tolerance);
    }
}

#[test]
fn chromaticity_from_xyz_and_back() {
    let golden = colors();
    for case in &golden.cases.from_xyz {
        let white = Xyz::from(case.white);
        let xyz = Xyz::from(case.xyz);
        let xyy = xyz.to_xyy(white);
        let got = [xyy.x, xyy.y, xyy.luminance];
        // Black has no chromaticity, so it gets the chromaticity of the white.
        let [x, y, z] = case.white;
        let of_white = [x / (x + y + z), y / (x + y + z), 0.0];
        let label = format!("XYZ {:?}", case.xyz);
        assert_near(&label, &got, &case.xyy.unwrap_or(of_white), golden.tolerance);
        let back = Xyz::from(xyy).to_array();
        assert_near(format!("back to {label}"), &back, &case.xyz, golden.tolerance);
    }
}

#[derive(Deserialize)]
struct InLuv {
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "Luv")]
    luv: [f64; 3],
}

#[test]
fn luv_from_xyz() {
    let golden: Golden<Vec<InLuv>> = read("luv");
    for case in &golden.cases {
        let luv = Luv::from_xyz(case.xyz.into(), case.white.into()).to_array();
        assert_near(format!("XYZ {:?}", case.xyz), &luv, &case.luv, golden.tolerance);
    }
}

#[derive(Deserialize)]
struct Case {
    pair: String,
    observer: String,
    reference: String,
    test: String,
    reference_cie1976: f64,
    reference_ciede2000: f64,
    #[serde(rename = "corrected_XYZ")]
    corrected_xyz: [f64; 3],
    cie1976: f64,
    ciede2000: f64,
}

#[derive(Deserialize)]
struct Pairs {
    pairs: BTreeMap<String, LightPair>,
}

#[derive(Deserialize)]
struct LightPair {
    start_nm: f64,
    step_nm: f64,
    one: Vec<f64>,
    two: Vec<f64>,
}

#[test]
fn metamerism_of_pairs_from_light_to_light() {
    let golden: Golden<Vec<Case>, Pairs> = read("metamerism");
    for case in &golden.cases {
        let label = format!("{} from {} to {}", case.pair, case.reference, case.test);
        let pair = &golden.shared.pairs[&case.pair];
        let grid = Grid::from_nm(pair.start_nm, pair.step_nm, pair.one.len()).unwrap();
        let [reference, test] = [&case.reference, &case.test].map(|light| {
            let light = Illuminant::named(light).unwrap();
            let observer = observer(&case.observer);
            TristimulusWeights::new(grid, &light, observer, Interpolation::Sprague).unwrap()
        });
        let [one, two] = [&pair.one, &pair.two].map(|r| [reference.xyz(r), test.xyz(r)]);
        fn differences(first: Xyz, second: Xyz, white: Xyz) -> [f64; 2] {
            let [first, second] = [first, second].map(|xyz| Lab::from_xyz(xyz, white));
            [delta_e_cie76(first, second), delta_e_ciede2000(first, second)]
        }

        let apart = differences(one[0], two[0], reference.white());
        let wanted = [case.reference_cie1976, case.reference_ciede2000];
        assert_near(format!("{label}, reference"), &apart, &wanted, golden.tolerance);

        let corrected = corrected_to_match(two[1], one[0], two[0]).unwrap();
        let corrected_xyz = corrected.to_array();
        assert_near(
            format!("{label}, corrected"),
            &corrected_xyz,
            &case.corrected_xyz,
            golden.tolerance,
        );
        let apart = differences(one[1], corrected, test.white());
        assert_near(&label, &apart, &[case.cie1976, case.ciede2000], golden.tolerance);

        let index = metamerism_index(one, two, test.white()).unwrap();
        assert_near(format!("{label}, index"), &[index], &[case.ciede2000], golden.tolerance);
    }
}

#[derive(Deserialize)]
struct Cases {
    #[serde(rename = "colours")]
    colors: Vec<DisplayColor>,
    transfer: Vec<Transfer>,
}

#[derive(Deserialize)]
struct DisplayColor {
    transform: Option<String>,
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    srgb: Values,
    #[serde(rename = "display-p3")]
    display_p3: Values,
}

#[derive(Deserialize)]
struct Values {
    linear: [f64; 3],
    encoded: [f64; 3],
}

#[derive(Deserialize)]
struct Transfer {
    linear: f64,
    encoded: f64,
}

#[derive(Deserialize)]
struct Spaces {
    white_xy: [f64; 2],
    spaces: BTreeMap<String, Space>,
}

#[derive(Deserialize)]
struct Space {
    to_xyz: [[f64; 3]; 3],
    from_xyz: [[f64; 3]; 3],
}

fn golden() -> Golden<Cases, Spaces> {
    read("rgb")
}

const SPACES: [(&str, RgbSpace); 2] =
    [("srgb", RgbSpace::Srgb), ("display-p3", RgbSpace::DisplayP3)];

#[test]
fn matrices_and_white_of_each_space() {
    let golden = golden();
    for (name, space) in SPACES {
        let white = space.white();
        let xyy = white.to_xyy(white);
        assert_near(name, &[xyy.x, xyy.y], &golden.shared.white_xy, golden.tolerance);
        // The golden white has Y = 1, the white of `spectra` has Y = 100.
        let to_xyz = space.xyz_from_linear();
        let from_xyz = to_xyz.inverse();
        let wanted = &golden.shared.spaces[name];
        let to_wanted = wanted.to_xyz.as_flattened();
        let from_wanted = wanted.from_xyz.as_flattened();
        for (matrix, scale, wanted) in
            [(to_xyz.0, 0.01, to_wanted), (from_xyz.0, 100.0, from_wanted)]
        {
            let scaled: Vec<f64> = matrix.as_flattened().iter().map(|v| v * scale).collect();
            assert_near(name, &scaled, wanted, golden.tolerance);
        }
    }
}

#[test]
fn display_colors_unclipped() {
    let golden = golden();
    for case in &golden.cases.colors {
        for ((name, space), wanted) in SPACES.into_iter().zip([&case.srgb, &case.display_p3]) {
            // Without a transform the space keeps its own white, so XYZ is not adapted.
            let (white, adaptation) = match &case.transform {
                Some(name) => (Xyz::from(case.white), transform(name)),
                None => (space.white(), Adaptation::Bradford),
            };
            let label = format!("{:?} in {name}, {:?}", case.xyz, case.transform);
            let linear = space.linear_from_xyz(case.xyz.into(), white, adaptation);
            assert_near(&label, &linear.0, &wanted.linear, golden.tolerance);
            let encoded = space.encoded_from_xyz(case.xyz.into(), white, adaptation);
            assert_near(&label, &encoded.0, &wanted.encoded, golden.tolerance);
        }
    }
}

#[test]
fn transfer_curve_and_back() {
    let golden = golden();
    for Transfer { linear, encoded } in golden.cases.transfer {
        let Rgb([got, ..]) = Rgb([linear; 3]).encoded();
        assert_near(format!("curve at {linear}"), &[got], &[encoded], golden.tolerance);
        let Rgb([back, ..]) = Rgb([got; 3]).linear();
        assert_near(format!("back to {linear}"), &[back], &[linear], golden.tolerance);
    }
}

#[derive(Deserialize)]
struct WhitenessCase {
    illuminant: String,
    observer: String,
    white: [f64; 3],
    #[serde(rename = "XYZ")]
    xyz: [f64; 3],
    #[serde(rename = "WT")]
    wanted: [f64; 2],
    white_enough: bool,
}

#[test]
fn whiteness_and_tint_within_the_limits_and_none_beyond() {
    let golden: Golden<Vec<WhitenessCase>> = read("whiteness");
    let enough = golden.cases.iter().filter(|case| case.white_enough).count();
    assert!(enough > 0 && enough < golden.cases.len(), "both sides of the limits are tested");
    for case in &golden.cases {
        let label = format!("{:?} under {} for {}", case.xyz, case.illuminant, case.observer);
        let light = Illuminant::named(&case.illuminant).unwrap();
        let observer = observer(&case.observer);
        let found = Whiteness::of(case.xyz.into(), case.white.into(), &light, observer);
        assert_eq!(found.is_ok(), case.white_enough, "{label}: {found:?}");
        match found {
            Ok(found) => {
                let found = [found.whiteness, found.tint];
                assert_near(&label, &found, &case.wanted, golden.tolerance);
            }
            Err(WhitenessError::NotWhite { whiteness, .. }) => {
                assert_near(&label, &[whiteness], &case.wanted[..1], golden.tolerance);
            }
            Err(WhitenessError::Tinted(tint)) => {
                assert_near(&label, &[tint], &case.wanted[1..], golden.tolerance);
            }
            Err(other) => panic!("{label}: {other}"),
        }
    }
}
