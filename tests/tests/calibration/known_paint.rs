//! Fits of synthetic mixtures with known K and S, calibration with absolute amounts on one backing
//! (from ladders and mixtures of synthetic watercolours), and swatches read from the rows of a
//! measurement file.

use std::sync::{Arc, Mutex};

use calibrate::absolute::{calibrate_absolute, chosen_film, films};
use calibrate::evaluate::Viewing;
use calibrate::fit::{
    FitError, FitSettings, Problem, Refined, Refinement, Smoothness, condition, fit_qp,
    fit_refined, fit_weighted,
};
use calibrate::library::PigmentLibrary;
use calibrate::measurement::{MeasurementError, MeasurementTable, Scale, ScaleChoice};
use calibrate::observation::{BelowSurface, Hiding, Observation, observations};
use calibrate::swatch::SwatchSet;
use calibrate::synthetic::SyntheticMixtures;
use calibrate::validation::{ValidationPlan, leave_out_films};
use calibrate::{Curves, LeaveOut, PigmentId};
use documents::Task;
use spectra::optics::{Layer, Surface, UnevenFilm, infinite_film};
use suite::watercolors::Watercolors;

fn problem(made: &SyntheticMixtures) -> Problem {
    Problem::new(made.grid, made.surface, &made.observations, PigmentId(0)).unwrap()
}

fn refined(made: &SyntheticMixtures, smoothness: Smoothness) -> Refined {
    let weights = Viewing::default().weights(made.grid).unwrap();
    fit_refined(&problem(made), &weights, Refinement::whole(smoothness), &Task::default()).unwrap()
}

/// Largest error of the logarithm of `curve` (K or S) where the true value exceeds 0.01.
fn largest_log_error(found: &[Curves], truth: &[Curves], curve: fn(&Curves) -> &[f64]) -> f64 {
    let pairs = found.iter().flat_map(curve).zip(truth.iter().flat_map(curve));
    pairs.filter(|(_, t)| **t > 1e-2).map(|(f, t)| (f / t).ln().abs()).fold(0.0, f64::max)
}

#[test]
fn every_method_recovers_known_k_and_s_from_readings_without_noise() {
    let made = SyntheticMixtures::paper_size(3, 0.0);
    let problem = problem(&made);
    let refined = refined(&made, Smoothness::None);
    let fits = [
        ("qp", fit_qp(&problem, &Task::default()).unwrap(), 0.05),
        ("weighted", fit_weighted(&problem, &Task::default()).unwrap(), 0.05),
        ("refined", refined.curves, 0.05),
    ];
    for (name, curves, bound) in fits {
        let k = largest_log_error(&curves, &made.curves, |c| &c.absorption);
        let s = largest_log_error(&curves, &made.curves, |c| &c.scattering);
        assert!(k < bound && s < bound, "{name}: log K off by {k}, log S by {s}");
    }
}

#[test]
fn at_the_papers_size_the_fit_is_nearer_to_the_truth_than_its_readings() {
    for seed in [11, 12] {
        let made = SyntheticMixtures::paper_size(seed, 0.002);
        // Noise of 0.002 in 71 mixtures with 21 unknowns leaves 0.002 sqrt(21 / 71) = 0.00109
        // without smoothing.
        let rough = made.rms_to_truth(&refined(&made, Smoothness::None).curves);
        assert!(rough < 0.00115, "seed {seed}: {rough}");
        let smooth = made.rms_to_truth(&refined(&made, Smoothness::Auto).curves);
        assert!(smooth < 0.0007, "seed {seed}: {smooth}");
    }
}

#[test]
fn standard_deviations_are_of_the_size_of_the_errors() {
    let made = SyntheticMixtures::paper_size(21, 0.002);
    let fit = refined(&made, Smoothness::None);
    let deviations = fit.deviations.as_ref().expect("a whole fit has deviations");
    let mut pulls = Vec::new();
    let pigments = fit.curves.iter().zip(&made.curves).zip(deviations).skip(1);
    for ((fitted, given), deviation) in pigments {
        for at in 0..made.grid.count() {
            let error = fitted.scattering[at] - given.scattering[at];
            pulls.push((error / deviation.scattering[at]).powi(2));
        }
    }
    pulls.sort_by(f64::total_cmp);
    // The median of a squared normal deviate is 0.455.
    let median = pulls[pulls.len() / 2];
    assert!((0.2..1.0).contains(&median), "median squared error in deviations: {median}");
    assert!(deviations[0].scattering.iter().all(|sd| *sd == 0.0), "the reference's S is given");
}

#[test]
fn the_program_ends_at_its_optimum() {
    // At the minimum of a convex program over nonnegative unknowns, the gradient is 0 for each
    // positive unknown and at least 0 for each unknown at 0.
    let made = SyntheticMixtures::paper_size(5, 0.002);
    let curves = fit_qp(&problem(&made), &Task::default()).unwrap();
    let pigments = curves.len();
    for at in (0..made.grid.count()).step_by(10) {
        let mut gradient = vec![0.0; 2 * pigments];
        let mut size = vec![1e-300f64; 2 * pigments];
        for observation in &made.observations {
            let q = observation.ratio[at];
            let row: Vec<f64> = observation
                .shares
                .iter()
                .copied()
                .chain(observation.shares.iter().map(|c| -q * c))
                .collect();
            let values = (0..pigments)
                .map(|p| curves[p].absorption[at])
                .chain((0..pigments).map(|p| curves[p].scattering[at]));
            let residual: f64 = row.iter().zip(values.clone()).map(|(r, v)| r * v).sum();
            let scale: f64 = row.iter().zip(values).map(|(r, v)| (r * v).abs()).sum();
            for (place, r) in row.iter().enumerate() {
                gradient[place] += r * residual;
                size[place] += (r * scale).abs();
            }
        }
        for place in (0..2 * pigments).filter(|&p| p != pigments) {
            let slope = gradient[place] / size[place];
            let value = if place < pigments {
                curves[place].absorption[at]
            } else {
                curves[place - pigments].scattering[at]
            };
            assert!(slope > -1e-5, "the cost still falls along unknown {place} at {at}: {slope}");
            assert!(value < 1e-6 || slope < 1e-5, "unknown {place} = {value} at {at}: {slope}");
        }
    }
}

#[test]
fn any_number_of_wavelengths_will_do() {
    let made = SyntheticMixtures::paper_size(4, 0.001);
    for count in [1, 2, 3, 7] {
        let grid = spectra::Grid::from_nm(500.0, 3.0, count).unwrap();
        let cut = made.observations.iter().map(|o| Observation {
            ratio: o.ratio[..count].to_vec(),
            reflectance: o.reflectance[..count].to_vec(),
            ..o.clone()
        });
        let observations: Vec<Observation> = cut.collect();
        let problem = Problem::new(grid, made.surface, &observations, PigmentId(0)).unwrap();
        let weights = Viewing::default().weights(grid).unwrap();
        let how = Refinement::whole(Smoothness::Auto);
        let fit = fit_refined(&problem, &weights, how, &Task::default()).unwrap();
        let all = fit.curves.iter().flat_map(|curves| &curves.absorption);
        assert!(all.into_iter().all(|v| v.is_finite() && *v >= 0.0), "{count}");
    }
}

#[test]
fn wrong_shapes_are_refused() {
    let made = SyntheticMixtures::paper_size(1, 0.0);
    let mut observations = made.observations.clone();
    observations[3].ratio.pop();
    let error = Problem::new(made.grid, made.surface, &observations, PigmentId(0)).unwrap_err();
    assert!(matches!(&error, FitError::Shape { sample, .. } if sample == "S03"), "{error}");
    let none = Problem::new(made.grid, made.surface, &[], PigmentId(0)).unwrap_err();
    assert_eq!(none, FitError::Empty);
    let only_black: Vec<Observation> =
        made.observations.iter().filter(|o| o.shares[0] == 0.0).cloned().collect();
    let lost = Problem::new(made.grid, made.surface, &only_black, PigmentId(0)).unwrap_err();
    assert_eq!(lost, FitError::Reference);
}

#[test]
fn pigments_always_mixed_alike_lower_the_rank() {
    let made = SyntheticMixtures::paper_size(6, 0.0);
    let tied: Vec<Observation> = made
        .observations
        .iter()
        .map(|o| {
            let mut shares = o.shares.clone();
            let both = shares[1] + shares[2];
            (shares[1], shares[2]) = (both / 2.0, both / 2.0);
            Observation { shares, ..o.clone() }
        })
        .collect();
    let ranks = [&made.observations, &tied].map(|observations| {
        let problem = Problem::new(made.grid, made.surface, observations, PigmentId(0)).unwrap();
        condition(&problem, &made.curves).rank
    });
    // The mixtures determine only the sum of the two K and of the two S, so there are two unknowns
    // fewer.
    assert_eq!(ranks, [21, 19]);
}

#[test]
fn a_fit_is_the_same_to_the_bit_on_any_number_of_threads_and_tells_its_stages() {
    // This is wide enough that the solver shares out panels of the factor to threads.
    let grid = spectra::Grid::from_nm(400.0, 20.0, 16).unwrap();
    let made = SyntheticMixtures::of_size(7, 0.002, grid, 30, 120);
    let weights = Viewing::default().weights(grid).unwrap();
    let fit = |threads: usize| {
        let stages = Arc::new(Mutex::new(Vec::new()));
        let heard = Arc::clone(&stages);
        let task = Task::observed(move |progress| {
            heard.lock().unwrap().push(progress.stage.to_string());
        });
        let how = Refinement::whole(Smoothness::Auto);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let refined = pool.install(|| fit_refined(&problem(&made), &weights, how, &task).unwrap());
        let stages = stages.lock().unwrap().clone();
        (refined, stages)
    };
    let (one, stages) = fit(1);
    let three = fit(3).0;
    assert!(one == three, "a result depends on the number of threads");
    assert_eq!(stages[0], "quadratic programs, round 1 of 6");
    let place = |wanted: &str| stages.iter().position(|stage| stage == wanted).unwrap();
    let spectra = place("refinement by spectra, estimate 1, round 1");
    let colors = place("refinement by colours");
    let deviations = place("standard deviations, sample 0 of 120");
    assert!(spectra == 6 && spectra < colors && colors < deviations, "{stages:?}");
}

const EVEN: UnevenFilm = UnevenFilm { surface: Surface::NONE, unevenness: 0.0 };

#[test]
fn ladders_and_mixtures_without_error_give_back_k_and_s() {
    let made = Watercolors::exact();
    let library = calibrate_absolute(
        &made.swatches(),
        EVEN,
        &FitSettings::default(),
        &Viewing::default(),
        &Task::default(),
    )
    .unwrap()
    .library;
    let error = library.evidence.as_ref().unwrap().delta_e;
    assert!(error.max < 0.1, "{error:?}");
    let again = PigmentLibrary::from_json("library", &library.to_json()).unwrap();
    for (index, pigment) in library.pigments.iter().enumerate() {
        let swatches = made.swatches().swatches;
        let amounts = swatches.iter().map(|s| s.amounts[index]).filter(|amount| *amount > 0.0);
        let measured = amounts.fold([f64::INFINITY, 0.0], |range: [f64; 2], amount| {
            [range[0].min(amount), range[1].max(amount)]
        });
        assert_eq!(pigment.measured_amounts, Some(measured), "{}", pigment.name);
        assert_eq!(again.pigments[index].measured_amounts, Some(measured), "{}", pigment.name);
        for at in 0..library.grid.count() {
            let found = pigment.absorption[at];
            let truth = made.absorption[index][at];
            // K below 1 per mL is about a hundredth of the peaks and hardly changes these films.
            if truth > 1.0 {
                assert!(
                    (found / truth).ln().abs() < 0.05,
                    "{}: K {found} for {truth}",
                    pigment.name
                );
            }
        }
    }
}

#[test]
fn unseen_mixtures_of_uneven_washes_are_predicted_within_two() {
    // The deviations are as large as reported for real watercolour. If you assume an even film
    // without a surface, the mean error of these mixtures is about 2.2.
    let set = Watercolors::hard(1).swatches();
    let problem = films(&set).unwrap();
    let film = chosen_film(&problem, Surface::NONE, &Task::default()).unwrap();
    assert!(film.unevenness > 0.0 || film.surface.k2 > 0.0, "{film:?}");
    let settings = FitSettings::default();
    let viewing = Viewing::default();
    let plan = ValidationPlan {
        settings: &settings,
        viewing: &viewing,
        state: None,
        leave_out: LeaveOut::Mixture,
        folds: Some(3),
        task: &Task::default(),
    };
    let chosen = leave_out_films(&set, film, &plan).unwrap();
    assert_eq!(chosen.per_sample.len(), 702, "three folds of 234 left-out mixtures");
    assert!(chosen.delta_e.mean < 2.0, "{:?}", chosen.delta_e);
    // The error of a sample is larger when the fit has not seen it.
    let fitted =
        calibrate_absolute(&set, film, &settings, &viewing, &Task::default()).unwrap().library;
    let fitted = fitted.evidence.unwrap().per_sample;
    let errors = chosen
        .per_sample
        .iter()
        .map(|sample| fitted.iter().find(|f| f.sample == sample.sample).unwrap().delta_e);
    let same_films = errors.sum::<f64>() / 702.0;
    let ratio = chosen.delta_e.mean / same_films;
    assert!(ratio > 1.02, "{ratio}");
    let plain = leave_out_films(&set, EVEN, &plan).unwrap();
    assert!(chosen.delta_e.mean < plain.delta_e.mean, "{:?}", plain.delta_e);
}

#[test]
fn amounts_in_another_unit_change_only_the_unit_of_k_and_s() {
    fn fit(set: &SwatchSet) -> PigmentLibrary {
        let settings = FitSettings::default();
        let viewing = Viewing::default();
        calibrate_absolute(set, EVEN, &settings, &viewing, &Task::default()).unwrap().library
    }
    let made = Watercolors::exact();
    let mut set = made.swatches();
    let millilitres = fit(&set);
    set.swatches.iter_mut().flat_map(|s| &mut s.amounts).for_each(|amount| *amount *= 1000.0);
    let microlitres = fit(&set);
    for (a, b) in millilitres.pigments.iter().zip(&microlitres.pigments) {
        for (a, b) in a.absorption.iter().zip(&b.absorption) {
            assert!((a / b / 1000.0 - 1.0).abs() < 1e-3, "{a} {b}");
        }
    }
}

#[test]
fn a_film_without_its_bare_backing_is_refused() {
    let mut set = Watercolors::exact().swatches();
    set.swatches[2].films[0].bare = None;
    let error = films(&set).unwrap_err();
    let MeasurementError::NoBareBacking { sample, .. } = &error else { panic!("{error}") };
    assert_eq!(*sample, set.swatches[2].sample);
}

#[test]
fn a_reading_below_the_surface_is_refused_or_named_also_of_the_bare_backing() {
    let mut set = Watercolors::exact().swatches();
    let film = UnevenFilm { surface: Surface { k1: 0.03, k2: 0.5, ..Surface::NONE }, ..EVEN };
    set.swatches.retain(|s| s.films[0].reflectance.iter().all(|r| *r > 0.03));
    let fit = |set: &SwatchSet, below| {
        let settings = FitSettings { below_surface: below, ..FitSettings::default() };
        calibrate_absolute(set, film, &settings, &Viewing::default(), &Task::default())
    };
    assert!(fit(&set, BelowSurface::Refuse).is_ok());
    set.swatches[0].films[0].bare.as_mut().unwrap()[3] = 0.01;
    let error = fit(&set, BelowSurface::Refuse).unwrap_err();
    assert!(error.to_string().contains("430 nm"), "{error}");
    let warnings = fit(&set, BelowSurface::Floor).unwrap().library.evidence.unwrap().warnings;
    assert!(warnings.iter().any(|w| w.contains("W000 (1)")), "{warnings:?}");
}

#[test]
fn few_films_are_fitted_without_holding_any_back() {
    let mut set = Watercolors::exact().swatches();
    set.swatches.truncate(1);
    let set = set.retaining(|_| true);
    let problem = films(&set).unwrap();
    assert_eq!(chosen_film(&problem, Surface::NONE, &Task::default()).unwrap(), EVEN);
    assert!(
        calibrate_absolute(
            &set,
            EVEN,
            &FitSettings::default(),
            &Viewing::default(),
            &Task::default()
        )
        .is_ok()
    );
}

#[test]
fn thin_films_that_tell_little_of_scattering_are_told() {
    let set = Watercolors::hard(2).swatches();
    let white = set.pigments.iter().position(|p| p == "chinese white").unwrap();
    // Keeps chinese white only in its thinnest wash, where white paper shows nothing but noise.
    let ladders = set.retaining(|s| {
        let alone = s.amounts.iter().filter(|a| **a > 0.0).count() == 1;
        alone && (s.amounts[white] == 0.0 || s.amounts[white] < 0.015)
    });
    let settings = FitSettings::default();
    let library =
        calibrate_absolute(&ladders, EVEN, &settings, &Viewing::default(), &Task::default())
            .unwrap();
    let library = library.library;
    let warnings = &library.evidence.as_ref().unwrap().warnings;
    let told = ["chinese white", "cadmium red"].map(|name| {
        warnings.iter().any(|w| w.starts_with(&format!("{name}: these films tell little")))
    });
    assert_eq!(told, [true, false], "{warnings:?}");
    assert!(!library.pigments[white].notes.is_empty(), "the pigment carries the note");
}

fn table(text: &str) -> MeasurementTable {
    MeasurementTable::from_csv("t.csv", text.as_bytes(), ScaleChoice::ByFile).unwrap()
}

#[test]
fn columns_stand_in_any_order_and_empty_amounts_are_none() {
    let table = table("R400,Blue,sample,White,R500\n0.5,,a,2,0.25\n0.1,1,b,1,0.2\n");
    assert_eq!(table.pigments, ["Blue", "White"]);
    assert_eq!(table.scale, Scale::Fraction);
    assert_eq!((table.grid.start_nm(), table.grid.step_nm()), (400.0, 100.0));
    let set = SwatchSet::from_table(&table).unwrap();
    assert_eq!(set.swatches[0].shares, [0.0, 1.0]);
    assert_eq!(set.swatches[1].shares, [0.5, 0.5]);
}

#[test]
fn a_pigment_in_none_of_the_chosen_swatches_leaves_amounts_and_shares() {
    let table =
        table("sample,Blue,Red,White,400,410\na,1,,3,0.5,0.5\nb,,1,1,0.4,0.4\nc,,,1,0.9,0.9\n");
    let set = SwatchSet::from_table(&table).unwrap().retaining(|swatch| swatch.sample != "b");
    assert_eq!(set.pigments, ["Blue", "White"]);
    let shares: Vec<&[f64]> = set.swatches.iter().map(|swatch| &swatch.shares[..]).collect();
    assert_eq!(shares, [[0.25, 0.75], [0.0, 1.0]]);
    assert_eq!(set.swatches[0].amounts, [1.0, 3.0]);
}

#[test]
fn repeated_readings_are_averaged_and_their_spread_kept() {
    let table = table("sample,replicate,W,400,410\na,1,1,0.50,0.60\na,2,1,0.52,0.62\n");
    let film = &SwatchSet::from_table(&table).unwrap().swatches[0].films[0];
    for (mean, wanted) in film.reflectance.iter().zip([0.51, 0.61]) {
        assert!((mean - wanted).abs() < 1e-12, "{mean}");
    }
    // The standard deviation of two readings 0.02 apart is 0.01 sqrt(2).
    assert!((film.spread.unwrap() - 0.01 * 2f64.sqrt()).abs() < 1e-12, "{:?}", film.spread);
}

#[test]
fn percent_is_told_from_the_whole_file_and_can_be_forced() {
    assert_eq!(table("sample,W,400\na,1,50\nb,1,1.5\n").scale, Scale::Percent);
    let forced = ScaleChoice::Known(Scale::Percent);
    let dark = MeasurementTable::from_csv("t", b"sample,W,400\na,1,0.5\n", forced).unwrap();
    assert_eq!(*dark.readings[0].reflectance, [0.005]);
}

#[test]
fn five_irregular_wavelengths_are_brought_to_a_grid_by_straight_lines() {
    let table = table("sample,W,401,404,411,419,431\na,1,0.401,0.404,0.411,0.419,0.431\n");
    assert_eq!(table.resampled_from, Some(5));
    assert_eq!((table.grid.start_nm(), table.grid.step_nm(), table.grid.count()), (402.0, 2.0, 15));
    for (value, nm) in table.readings[0].reflectance.iter().zip(table.grid.wavelengths_nm()) {
        let wanted = nm / 1000.0;
        assert!((value - wanted).abs() < 1e-12, "{value} for {wanted}");
    }
}

#[test]
fn the_ratio_of_a_film_that_does_not_hide_comes_from_two_backings() {
    let k = 0.3;
    let s = 0.8;
    let d = 1.1;
    let [white, black] = [0.9, 0.04].map(|g| Layer::new(k, s, d).over(g));
    let text = format!(
        "sample,film,backing,W,400\na,paint,white,1,{white}\na,paint,black,1,{black}\na,none,white,,0.9\na,none,black,,0.04\n"
    );
    let set = SwatchSet::from_table(&table(&text)).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    assert!((observed[0].ratio[0] - k / s).abs() < 1e-9, "{:?}", observed[0]);
    assert!((observed[0].reflectance[0] - infinite_film(k, s)).abs() < 1e-9);
    assert_eq!(observed[0].hiding.hides(), Some(false));
}

#[test]
fn a_card_of_another_sample_serves_where_a_sample_has_none() {
    let text = "sample,film,backing,W,400\na,paint,white,1,0.5\na,paint,black,1,0.4\nx,none,white,,0.9\nx,none,black,,0.04\n";
    let set = SwatchSet::from_table(&table(text)).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    assert!(matches!(observed[0].hiding, Hiding::Difference(_)), "{:?}", observed[0].hiding);
}

#[test]
fn a_sample_prefers_its_own_card() {
    let text = "sample,film,backing,W,400\na,paint,white,1,0.5\na,paint,black,1,0.4\na,none,white,,0.8\nx,none,white,,0.9\nx,none,black,,0.04\n";
    let set = SwatchSet::from_table(&table(text)).unwrap();
    assert_eq!(set.swatches[0].films[0].bare, Some(vec![0.8]));
    assert_eq!(set.swatches[0].films[1].bare, Some(vec![0.04]));
}

#[test]
fn without_a_second_backing_a_film_is_taken_to_hide() {
    let set = SwatchSet::from_table(&table("sample,W,400\na,1,0.5\n")).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    assert_eq!(observed[0].hiding, Hiding::Assumed(None));
    assert!((observed[0].ratio[0] - 0.25).abs() < 1e-12, "(1 - 0.5)^2 / (2 x 0.5)");
}

#[test]
fn rows_of_one_sample_that_disagree_are_refused() {
    let table = table("sample,backing,W,B,400\na,white,1,2,0.5\na,black,1,3,0.5\n");
    let error = SwatchSet::from_table(&table).unwrap_err();
    let MeasurementError::Contradiction { place, first_row, .. } = &error else {
        panic!("{error}")
    };
    assert_eq!((place.row, place.column.as_str(), *first_row), (3, "B", 2));
}

#[test]
fn several_files_join_by_pigment_and_sample() {
    let first = table("sample,White,Red,400,410\na,1,,0.9,0.9\nb,1,1,0.5,0.6\n");
    let second = table("sample,Red,Blue,400,410\nb2,2,,0.3,0.4\nc,1,1,0.1,0.1\n");
    let all = MeasurementTable::joined(vec![first, second]).unwrap();
    assert_eq!(all.pigments, ["White", "Red", "Blue"]);
    assert_eq!(*all.readings[2].amounts, [0.0, 2.0, 0.0]);
    assert_eq!(*all.readings[0].amounts, [1.0, 0.0, 0.0]);
    let other = table("sample,White,400,420\na,1,0.9,0.9\n");
    let again = table("sample,White,400,410\na,1,0.9,0.9\n");
    let error = MeasurementTable::joined(vec![again, other]).unwrap_err();
    assert!(matches!(error, MeasurementError::Grid { .. }), "{error}");
}

#[test]
fn recipes_counted_in_parts_are_no_fault() {
    let parts = table("sample,W,B,400\na,3,1,0.5\nb,1,1,0.5\nc,9,1,0.5\n");
    assert!(SwatchSet::from_table(&parts).unwrap().uneven_recipes().is_empty());
    let percent = table("sample,W,B,400\na,75,25,0.5\nb,50,50,0.5\nc,90,9,0.5\n");
    let set = SwatchSet::from_table(&percent).unwrap();
    assert_eq!(set.uneven_recipes(), [("c", 99.0)]);
}

#[test]
fn films_whose_readings_deny_that_they_hide_are_told_apart() {
    let text =
        "sample,backing,W,400\na,white,1,0.5\na,black,1,0.3\nb,white,1,0.5\nb,black,1,0.49\n";
    let set = SwatchSet::from_table(&table(text)).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    for (observation, wanted) in observed.iter().zip([0.2, 0.01]) {
        match observation.hiding {
            Hiding::Assumed(Some(difference)) => assert!((difference - wanted).abs() < 1e-12),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn thicknesses_that_a_gauge_cannot_tell_apart_are_one() {
    fn hiding(second: &str) -> Hiding {
        let text = format!(
            "sample,film,backing,thickness_mm,W,400\na,paint,white,0.101,1,0.5\na,paint,black,{second},1,0.4\na,none,white,,,0.9\na,none,black,,,0.04\n"
        );
        let set = SwatchSet::from_table(&table(&text)).unwrap();
        observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap()[0].hiding
    }
    assert!(matches!(hiding("0.099"), Hiding::Difference(_)), "{:?}", hiding("0.099"));
    assert!(matches!(hiding("0.080"), Hiding::Assumed(Some(_))), "{:?}", hiding("0.080"));
}

#[test]
fn the_thickest_film_counts_where_one_is_taken_to_hide() {
    let text = "sample,thickness_mm,W,400\na,0.1,1,0.5\na,0.3,1,0.4\na,0.2,1,0.45\n";
    let set = SwatchSet::from_table(&table(text)).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    assert!((observed[0].reflectance[0] - 0.4).abs() < 1e-12, "{:?}", observed[0].reflectance);
}

#[test]
fn a_column_without_any_amount_is_no_pigment() {
    let set = SwatchSet::from_table(&table("sample,W,Unused,400\na,1,,0.5\nb,2,0,0.5\n")).unwrap();
    assert_eq!(set.pigments, ["W"]);
    assert_eq!(set.swatches[1].amounts, [2.0]);
}

#[test]
fn bare_cards_alone_are_no_swatches() {
    let error = SwatchSet::from_table(&table("sample,film,W,400\na,none,,0.9\n")).unwrap_err();
    assert_eq!(error, MeasurementError::NoFilms);
}

#[test]
fn readings_above_white_are_counted() {
    let set = SwatchSet::from_table(&table("sample,W,400,410\na,1,1.02,0.9\n")).unwrap();
    let observed = observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap();
    assert_eq!((observed[0].above_white, observed[0].ratio[0]), (1, 0.0));
    let far = SwatchSet::from_table(&table("sample,W,400\na,1,1.2\n")).unwrap();
    let error = observations(&far, Surface::NONE, BelowSurface::Refuse).unwrap_err();
    assert!(matches!(error, MeasurementError::AboveWhite { nm: 400.0, .. }), "{error}");
}

#[test]
fn masstones_counted_as_one_beside_mixtures_in_parts_are_no_fault() {
    let mixed = table("sample,W,B,400\na,1,,0.5\nb,,1,0.5\nc,1,,0.5\nd,3,2,0.5\ne,2,5,0.5\n");
    assert!(SwatchSet::from_table(&mixed).unwrap().uneven_recipes().is_empty());
}
