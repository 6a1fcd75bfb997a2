//! Properties of Kubelka-Munk layers: energy balance, monotonicity, limits and derivatives.

use spectra::optics::{Layer, infinite_film};

use super::{Film, ROUNDING, random_films};

#[test]
fn a_film_never_gives_back_more_than_it_gets() {
    for film in random_films() {
        let Layer { reflectance, transmittance } = film.layer();
        assert!((0.0..=1.0).contains(&reflectance), "R {reflectance}: {film:?}");
        assert!((0.0..=1.0).contains(&transmittance), "T {transmittance}: {film:?}");
        let sum = reflectance + transmittance;
        assert!(sum <= 1.0 + ROUNDING, "R + T {sum}: {film:?}");
        if film.absorption == 0.0 {
            assert!(sum >= 1.0 - ROUNDING, "nothing absorbs, yet R + T {sum}: {film:?}");
        }
        let over = film.over_backing();
        assert!((0.0..=1.0 + ROUNDING).contains(&over), "{over} over a backing: {film:?}");
    }
}

#[test]
fn reflectance_grows_with_scattering_over_any_backing() {
    for film in random_films() {
        let more = Film { scattering: film.scattering * 1.5 + 1e-3, ..film };
        let before = film.over_backing();
        let after = more.over_backing();
        // A reflectance near 1 cannot rise further, so rounding may lower it.
        let room = if before < 0.99 { 0.0 } else { -ROUNDING };
        assert!(after - before > room, "{before} to {after}: {film:?}");
    }
}

#[test]
fn reflectance_falls_with_absorption_over_any_backing() {
    for film in random_films() {
        let more = Film { absorption: film.absorption * 1.5 + 1e-3, ..film };
        let before = film.over_backing();
        let after = more.over_backing();
        // A reflectance of 0 cannot fall further.
        assert!(after < before || before < 1e-300, "{before} to {after}: {film:?}");
    }
}

#[test]
fn a_film_cut_in_two_is_the_same_film_over_every_backing() {
    for film in random_films() {
        for share in [0.0, 1e-6, 0.3, 0.5, 1.0] {
            for backing in [0.0, film.backing, 1.0] {
                let lower = film.share(1.0 - share).over(backing);
                let cut = film.share(share).over(lower);
                let whole = film.layer().over(backing);
                assert!((cut - whole).abs() <= ROUNDING, "{cut} for {whole}: {share}, {film:?}");
            }
        }
    }
}

#[test]
fn zero_thickness_is_the_backing() {
    for film in random_films() {
        let nothing = film.share(0.0);
        assert_eq!(nothing.over(film.backing), film.backing, "{film:?}");
    }
}

#[test]
fn great_thickness_forgets_the_backing() {
    for film in random_films().filter(|film| film.absorption > 0.0) {
        let k = film.absorption;
        let s = film.scattering;
        let extinction = (k * (k + 2.0 * s)).sqrt();
        // Light that crosses the film twice is attenuated by exp(-80), about 2e-35.
        let thick = Layer::new(k, s, 40.0 / extinction);
        let over = thick.over(film.backing);
        let hiding = infinite_film(k, s);
        let tolerance = ROUNDING * hiding + 1e-34;
        assert!((over - hiding).abs() <= tolerance, "{over} for {hiding}: {film:?}");
    }
}

#[test]
fn a_film_without_absorption_over_white_is_white() {
    for film in random_films() {
        let over = Film { absorption: 0.0, backing: 1.0, ..film }.over_backing();
        assert!((over - 1.0).abs() <= ROUNDING, "{over}: {film:?}");
    }
}

#[test]
fn a_film_without_scattering_lets_through_what_beer_and_lambert_say() {
    for film in random_films() {
        let glaze = Film { scattering: 0.0, ..film };
        let wanted = film.backing * (-2.0 * film.absorption * film.thickness).exp();
        let over = glaze.over_backing();
        // A rounding error of the exponent is a relative error of the result.
        let tolerance = ROUNDING * wanted * (1.0 + film.absorption * film.thickness);
        assert!((over - wanted).abs() <= tolerance, "{over} for {wanted}: {film:?}");
    }
}

#[test]
fn slopes_are_the_limit_of_difference_quotients() {
    for film in random_films() {
        let g = film.backing;
        let k = film.absorption * film.thickness;
        let s = film.scattering * film.thickness;
        let [value, over_k, over_s] = Layer::over_with_slopes(k, s, g);
        assert!((value - film.over_backing()).abs() <= ROUNDING, "{value}: {film:?}");
        // Forward difference, because K and S may be 0; of second order in the step.
        let quotient = |at: &dyn Fn(f64) -> f64, size: f64| {
            let step = 1e-5 * (1.0 + size);
            (4.0 * at(step) - at(2.0 * step) - 3.0 * at(0.0)) / (2.0 * step)
        };
        let by_k = quotient(&|h| Layer::new(k + h, s, 1.0).over(g), k);
        let by_s = quotient(&|h| Layer::new(k, s + h, 1.0).over(g), s);
        let by_g = Layer::new(k, s, 1.0).over_slope(g);
        // Backwards, because no backing reflects more than 1.
        let wanted = -quotient(&|h| Layer::new(k, s, 1.0).over(g - h), 0.0);
        assert!((by_g - wanted).abs() <= 1e-6 * (1.0 + wanted), "{by_g} for {wanted}: {film:?}");
        let size = 1.0 + s.powi(2);
        assert!((over_k - by_k).abs() <= 1e-6 * size, "dR/dK {over_k} for {by_k}: {film:?}");
        assert!((over_s - by_s).abs() <= 1e-6 * size, "dR/dS {over_s} for {by_s}: {film:?}");
        // Thickness scales K and S alike, so K dR/dK + S dR/dS is dR/dd of Kubelka's equation.
        let by_d = s - 2.0 * (k + s) * value + s * value * value;
        let by_ray = k * over_k + s * over_s;
        let tolerance = 64.0 * ROUNDING * (1.0 + k + s);
        assert!((by_ray - by_d).abs() <= tolerance, "dR/dd {by_ray} for {by_d}: {film:?}");
    }
}

#[test]
fn reflectance_is_finite_and_a_fraction_to_the_edges() {
    let edges = [0.0, 1e-300, 1e-12, 1e-3, 1.0, 50.0];
    for k in edges {
        for s in edges {
            for d in edges.into_iter().chain([100.0]) {
                let layer = Layer::new(k, s, d);
                for percent in 0..=100 {
                    let over = layer.over(f64::from(percent) / 100.0);
                    assert!(
                        (0.0..=1.0 + ROUNDING).contains(&over),
                        "K {k}, S {s}, d {d} over {percent} %: {over}"
                    );
                }
            }
        }
    }
}
