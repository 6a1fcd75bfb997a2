//! Fits, validation and quadrature: `cargo bench -p impasto-calibrate`.
//!
//! The problem of Baxter, Wendt and Lin 2004 has 11 pigments, 71 mixtures and 101 wavelengths.
//! Other solvers take on 2 cores: quadprog 3.5 ms, Clarabel (one program after another) 19 ms,
//! cvxpy 196 ms.

use calibrate::LeaveOut;
use calibrate::evaluate::Viewing;
use calibrate::fit::{
    FitSettings, Method, Problem, Refinement, Smoothness, fit_qp, fit_refined, fit_weighted,
};
use calibrate::library::PigmentLibrary;
use calibrate::measurement::{MeasurementTable, ScaleChoice};
use calibrate::observation::BelowSurface;
use calibrate::quadrature::Quadrature;
use calibrate::swatch::SwatchSet;
use calibrate::synthetic::SyntheticMixtures;
use calibrate::validation::{ValidationPlan, leave_out_samples};
use calibrate::{PigmentId, calibration::calibrate};
use divan::{Bencher, black_box};
use documents::Task;
use spectra::Grid;
use spectra::optics::{Specular, Surface};

fn main() {
    divan::main();
}

const OILS: &[u8] = include_bytes!("../../../measurements/van-gogh-oils.csv");
const SURFACE: Surface = Surface { k1: 0.03, k2: 0.6, specular: Specular::Included };

fn paper_size() -> (SyntheticMixtures, Problem) {
    let made = SyntheticMixtures::paper_size(1, 0.002);
    let problem =
        Problem::new(made.grid, made.surface, &made.observations, PigmentId(0)).expect("a problem");
    (made, problem)
}

fn oils() -> (SwatchSet, PigmentId) {
    let table = MeasurementTable::from_csv("oils", OILS, ScaleChoice::ByFile).expect("readings");
    let set = SwatchSet::from_table(&table).expect("swatches");
    let white = set.pigments.iter().position(|p| p == "Zinc White").expect("the white");
    (set, PigmentId(white))
}

fn settings(method: Method) -> FitSettings {
    FitSettings { method, below_surface: BelowSurface::Floor, ..FitSettings::default() }
}

fn oil_library() -> PigmentLibrary {
    let (set, white) = oils();
    let settings = settings(Method::Refined);
    calibrate(&set, white, SURFACE, &settings, &Viewing::default(), &Task::default())
        .expect("a fit")
        .library
}

#[divan::bench]
fn qp_at_the_papers_size(bencher: Bencher<'_, '_>) {
    let (_, problem) = paper_size();
    let task = Task::default();
    bencher.bench_local(|| fit_qp(black_box(&problem), &task));
}

#[divan::bench]
fn weighted_at_the_papers_size(bencher: Bencher<'_, '_>) {
    let (_, problem) = paper_size();
    let task = Task::default();
    bencher.bench_local(|| fit_weighted(black_box(&problem), &task));
}

#[divan::bench(args = ["none", "auto"], sample_count = 10)]
fn refined_at_the_papers_size(bencher: Bencher<'_, '_>, smoothness: &str) {
    let (made, problem) = paper_size();
    let weights = Viewing::default().weights(made.grid).expect("weights");
    let smoothness = if smoothness == "none" { Smoothness::None } else { Smoothness::Auto };
    let how = Refinement::whole(smoothness);
    let task = Task::default();
    bencher.bench_local(|| fit_refined(black_box(&problem), &weights, how, &task));
}

/// 60 pigments, 2000 mixtures and 401 wavelengths: more than you will ever measure in a workshop.
#[divan::bench(sample_count = 1, sample_size = 1)]
fn refined_of_a_large_set(bencher: Bencher<'_, '_>) {
    let grid = Grid::from_nm(380.0, 1.0, 401).expect("a grid");
    let made = SyntheticMixtures::of_size(1, 0.002, grid, 60, 2000);
    let problem =
        Problem::new(made.grid, made.surface, &made.observations, PigmentId(0)).expect("a problem");
    let weights = Viewing::default().weights(grid).expect("weights");
    let how = Refinement::whole(Smoothness::Auto);
    let task = Task::default();
    bencher.bench_local(|| fit_refined(black_box(&problem), &weights, how, &task));
}

#[divan::bench]
fn reading_the_oils() -> SwatchSet {
    oils().0
}

#[divan::bench(args = [Method::Qp, Method::Weighted, Method::Refined], sample_count = 20)]
fn fit_of_the_oils(bencher: Bencher<'_, '_>, method: &Method) {
    let (set, white) = oils();
    let settings = settings(*method);
    let viewing = Viewing::default();
    let task = Task::default();
    bencher.bench_local(|| calibrate(&set, white, SURFACE, black_box(&settings), &viewing, &task));
}

#[divan::bench(sample_count = 3)]
fn leave_one_out_of_the_oils(bencher: Bencher<'_, '_>) {
    let (set, white) = oils();
    let settings = settings(Method::Refined);
    let viewing = Viewing::default();
    let task = Task::default();
    let state = calibrate(&set, white, SURFACE, &settings, &viewing, &task).expect("a fit").state;
    let plan = ValidationPlan {
        settings: &settings,
        viewing: &viewing,
        state,
        leave_out: LeaveOut::Mixture,
        folds: None,
        task: &task,
    };
    bencher.bench_local(|| leave_out_samples(&set, white, SURFACE, black_box(&plan), |_| true));
}

#[divan::bench(args = [3, 8, 16], sample_count = 5)]
fn quadrature_of_the_oils(bencher: Bencher<'_, '_>, nodes: usize) {
    let library = oil_library();
    let viewing = Viewing::default();
    bencher.bench_local(|| Quadrature::library(&viewing, black_box(&library), nodes));
}
