//! Swatches from the rows of a measurement file: scale, grid, repeated readings, backings, faults.

use calibrate::measurement::{MeasurementError, MeasurementTable, Scale, ScaleChoice};
use calibrate::observation::{BelowSurface, Hiding, observations};
use calibrate::swatch::SwatchSet;
use spectra::optics::{Layer, Surface, infinite_film};

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
    assert_eq!((table.grid.start_nm(), table.grid.step_nm(), table.grid.count()), (410.0, 10.0, 3));
    for (value, wanted) in table.readings[0].reflectance.iter().zip([0.41, 0.42, 0.43]) {
        assert!((value - wanted).abs() < 1e-12, "{value} for {wanted}");
    }
}

#[test]
fn the_ratio_of_a_film_that_does_not_hide_comes_from_two_backings() {
    let k = 0.3;
    let s = 0.8;
    let d = 1.1;
    let over = |g: f64| Layer::new(k, s, d).over(g);
    let text = format!(
        "sample,film,backing,W,400\na,paint,white,1,{}\na,paint,black,1,{}\na,none,white,,0.9\na,none,black,,0.04\n",
        over(0.9),
        over(0.04)
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
    let difference = |index: usize| match observed[index].hiding {
        Hiding::Assumed(Some(difference)) => difference,
        other => panic!("{other:?}"),
    };
    assert!((difference(0) - 0.2).abs() < 1e-12 && (difference(1) - 0.01).abs() < 1e-12);
}

#[test]
fn thicknesses_that_a_gauge_cannot_tell_apart_are_one() {
    let text = |second: &str| {
        format!(
            "sample,film,backing,thickness_mm,W,400\na,paint,white,0.101,1,0.5\na,paint,black,{second},1,0.4\na,none,white,,,0.9\na,none,black,,,0.04\n"
        )
    };
    let hiding = |second: &str| {
        let set = SwatchSet::from_table(&table(&text(second))).unwrap();
        observations(&set, Surface::NONE, BelowSurface::Refuse).unwrap()[0].hiding
    };
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
