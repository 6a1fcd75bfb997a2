//! Properties of quantities computed from readings: K/S, scattering power S d, and the reflectance
//! below a surface.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::{
    OverBacking, Specular, Surface, SurfaceError, absorption_over_scattering,
    film_over_two_backings, infinite_film, infinite_film_from_ratio, infinite_film_slope,
};

use super::{Film, ROUNDING, random_films};

fn over_two_backings(film: &Film, black: f64, white: f64) -> [OverBacking; 2] {
    [black, white].map(|backing| OverBacking { film: film.layer().over(backing), backing })
}

#[test]
fn two_backings_recover_the_ratio_of_any_film() {
    for film in random_films().filter(|film| film.absorption > 0.0 && film.scattering > 0.0) {
        let [black, white] = over_two_backings(&film, 0.05, 0.95);
        let found = film_over_two_backings(black, white).unwrap();
        let ratio = film.absorption / film.scattering;
        // A film of small S d reflects little by itself, so that a rounding error of the reading is
        // larger by 1 / `shown` in 1 + K/S.
        let power = film.scattering * film.thickness;
        let shown = (power / (1.0 + power)).min(1.0 / (1.0 + ratio));
        let tolerance = 64.0 * ROUNDING * (1.0 + ratio) / shown;
        assert!((found.ratio - ratio).abs() <= tolerance, "{found:?} for {ratio}: {film:?}");
        let hiding = infinite_film(film.absorption, film.scattering);
        if tolerance < 1e-6 * ratio {
            assert!((found.infinite_film() - hiding).abs() <= 1e-6, "{found:?}: {film:?}");
        }
    }
}

#[test]
fn two_backings_recover_the_scattering_power_while_the_backing_shows() {
    let mut recovered = 0;
    for film in random_films().filter(|film| film.scattering > 0.0) {
        let [black, white] = over_two_backings(&film, 0.0, 1.0);
        let found = film_over_two_backings(black, white).unwrap();
        let shown = white.film - black.film;
        assert!((found.transparency - shown).abs() <= ROUNDING, "{found:?}: {film:?}");
        let power = film.scattering * film.thickness;
        if shown > 1e-3 && power > 1e-3 && film.absorption < 100.0 * film.scattering {
            let got = found.scattering_power.unwrap();
            assert!((got / power - 1.0).abs() <= 1e-7, "{got} for {power}: {film:?}");
            recovered += 1;
        }
    }
    assert!(recovered > 400, "films that show their backing: {recovered}");
}

#[test]
fn a_film_that_hides_still_tells_its_ratio_from_two_backings() {
    for film in random_films().filter(|film| film.absorption > 0.0 && film.scattering > 0.0) {
        let ratio = film.absorption / film.scattering;
        let hiding = infinite_film(film.absorption, film.scattering);
        let [black, white] = [0.05, 0.95].map(|backing| OverBacking { film: hiding, backing });
        let found = film_over_two_backings(black, white).unwrap();
        // For small R, K/S is 1 / (2 R), so an absolute rounding error of R grows by (K/S)^2.
        let tolerance = ROUNDING * (1.0 + ratio).powi(2);
        assert!((found.ratio - ratio).abs() <= tolerance, "{found:?} for {ratio}: {film:?}");
        assert_eq!(found.transparency, 0.0, "{film:?}");
        assert_eq!(found.scattering_power, Some(f64::INFINITY), "{film:?}");
    }
}

#[test]
fn one_backing_twice_tells_nothing() {
    for film in random_films() {
        let [same, again] = over_two_backings(&film, film.backing, film.backing);
        assert_eq!(film_over_two_backings(same, again), None, "{film:?}");
    }
}

#[test]
fn the_ratio_of_a_film_that_hides_is_the_inverse_of_its_reflectance() {
    for film in random_films().filter(|film| film.scattering > 0.0) {
        let k = film.absorption;
        let s = film.scattering;
        let reflectance = infinite_film(k, s);
        let from_ratio = infinite_film_from_ratio(k / s);
        let relative = ROUNDING * reflectance;
        assert!((reflectance - from_ratio).abs() <= relative, "{from_ratio}: {film:?}");
        // A relative rounding error of R grows as K/S in dark films and as its square root near
        // white.
        let found = absorption_over_scattering(reflectance);
        let tolerance = ROUNDING * (k / s + (k / s).sqrt() + f64::EPSILON);
        assert!((found - k / s).abs() <= tolerance, "{found} for {}: {film:?}", k / s);
    }
}

#[test]
fn the_slope_over_the_ratio_is_the_limit_of_difference_quotients() {
    for film in random_films().filter(|film| film.absorption > 0.0 && film.scattering > 0.0) {
        let ratio = film.absorption / film.scattering;
        let step = 1e-5 * ratio;
        let [below, above] = [ratio - step, ratio + step].map(infinite_film_from_ratio);
        let quotient = (above - below) / (2.0 * step);
        let slope = infinite_film_slope(infinite_film_from_ratio(ratio));
        assert!((slope / quotient - 1.0).abs() < 1e-5, "{slope} for {quotient}: {film:?}");
    }
}

/// Random surfaces: seed, surface, and an internal reflectance of 0.01 to 0.99.
fn random_surfaces() -> impl Iterator<Item = (u64, Surface, f64)> {
    (0..2000).map(|seed| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let specular = if seed % 2 == 0 { Specular::Included } else { Specular::Excluded };
        let k1 = rng.random_range(0.0..0.2);
        let k2 = rng.random_range(0.0..0.9);
        let surface = Surface::new(k1, k2, specular).unwrap();
        (seed, surface, rng.random_range(0.01..=0.99))
    })
}

#[test]
fn below_the_surface_and_out_again_is_the_same_reading() {
    for (seed, surface, internal) in random_surfaces() {
        let measured = surface.measured_from_internal(internal);
        let back = surface.internal_from_measured(measured).unwrap();
        // Near black a rounding error of the reading is multiplied by 1 / (1 - k2).
        let tolerance = ROUNDING / (1.0 - surface.k2);
        assert!(
            (back - internal).abs() <= tolerance,
            "{back} for {internal}: seed {seed}, {surface:?}"
        );
    }
}

#[test]
fn white_below_a_surface_reads_white_with_the_mirror_reflection() {
    for (seed, surface, _) in random_surfaces() {
        let read = surface.measured_from_internal(1.0);
        let wanted = match surface.specular {
            Specular::Included => 1.0,
            Specular::Excluded => 1.0 - surface.k1,
        };
        assert!((read - wanted).abs() <= ROUNDING, "{read}: seed {seed}, {surface:?}");
    }
}

#[test]
fn the_slope_of_a_surface_is_the_limit_of_difference_quotients() {
    for (seed, surface, internal) in random_surfaces() {
        let step = 1e-6;
        let [below, above] =
            [internal - step, internal + step].map(|r| surface.measured_from_internal(r));
        let quotient = (above - below) / (2.0 * step);
        let slope = surface.measured_slope(internal);
        assert!(
            (slope / quotient - 1.0).abs() < 1e-6,
            "{slope} for {quotient}: seed {seed}, {surface:?}"
        );
    }
}

#[test]
fn a_reading_below_the_surface_is_refused() {
    for (seed, surface, _) in random_surfaces() {
        let floor = surface.floor();
        assert_eq!(surface.internal_from_measured(floor), Ok(0.0), "seed {seed}, {surface:?}");
        let measured = floor - 1e-9;
        assert_eq!(
            surface.internal_from_measured(measured),
            Err(SurfaceError::BelowFloor { measured, floor }),
            "seed {seed}, {surface:?}"
        );
    }
    let excluded = Surface::new(0.04, 0.6, Specular::Excluded).unwrap();
    assert_eq!(excluded.floor(), 0.0, "without the specular component the floor is 0");
}

#[test]
fn shares_outside_0_to_1_make_no_surface() {
    for share in [-1e-9, 1.0, 2.0, f64::NAN, f64::INFINITY] {
        for (k1, k2, wrong) in [(share, 0.6, "k1"), (0.04, share, "k2")] {
            let refused = Surface::new(k1, k2, Specular::Included);
            let Err(SurfaceError::Share { name, .. }) = refused else {
                panic!("{wrong} = {share}: {refused:?}")
            };
            assert_eq!(name, wrong, "which share is {share}");
        }
    }
    let file = r#"{"k1": 0.04, "k2": 1.6, "specular": "included"}"#;
    let refused = serde_json::from_str::<Surface>(file).unwrap_err().to_string();
    assert!(refused.contains("k2 is a fraction"), "{refused}");
}
