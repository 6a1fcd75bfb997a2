//! Properties of Kubelka-Munk films and surfaces with any paint: energy balance, monotonicity,
//! limits and derivatives, and quantities computed from readings: K/S, scattering power S d, and
//! the reflectance below a surface.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use spectra::optics::{
    Layer, OverBacking, Specular, Surface, SurfaceError, absorption_over_scattering,
    film_over_two_backings, infinite_film, infinite_film_from_ratio, infinite_film_slope,
};

/// A random paint film over a backing. A failed assertion prints it with its seed. Pass this seed
/// to [`Film::random`] to make it again.
#[derive(Debug, Clone, Copy)]
struct Film {
    #[expect(dead_code, reason = "read through Debug, when a law fails")]
    seed: u64,
    absorption: f64,
    scattering: f64,
    thickness: f64,
    backing: f64,
}

impl Film {
    /// A random film, from a glaze to a film that hides. In a tenth of the films K is 0, and in a
    /// tenth S. Otherwise they are 0.001 to 100 on a logarithmic scale.
    fn random(seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let [absorption, scattering] = [(); 2].map(|()| {
            if rng.random_bool(0.1) { 0.0 } else { 10f64.powf(rng.random_range(-3.0..2.0)) }
        });
        let thickness = 10f64.powf(rng.random_range(-2.0..1.0));
        Self { seed, absorption, scattering, thickness, backing: rng.random_range(0.0..=1.0) }
    }

    fn layer(&self) -> Layer {
        Layer::new(self.absorption, self.scattering, self.thickness)
    }

    /// Layer of the same paint with `share` times the thickness.
    fn share(&self, share: f64) -> Layer {
        Layer::new(self.absorption, self.scattering, self.thickness * share)
    }

    fn over_backing(&self) -> f64 {
        self.layer().over(self.backing)
    }
}

fn random_films() -> impl Iterator<Item = Film> {
    (0..2000).map(Film::random)
}

/// A few rounding errors of numbers of size 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

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
        // A forward difference of second order, because K and S may be 0.
        fn quotient(at: impl Fn(f64) -> f64, size: f64) -> f64 {
            let step = 1e-5 * (1.0 + size);
            (4.0 * at(step) - at(2.0 * step) - 3.0 * at(0.0)) / (2.0 * step)
        }
        let by_k = quotient(|h| Layer::new(k + h, s, 1.0).over(g), k);
        let by_s = quotient(|h| Layer::new(k, s + h, 1.0).over(g), s);
        let by_g = Layer::new(k, s, 1.0).over_slope(g);
        // Backwards, because no backing reflects more than 1.
        let wanted = -quotient(|h| Layer::new(k, s, 1.0).over(g - h), 0.0);
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

fn over_two_backings(film: &Film, black: f64, white: f64) -> [OverBacking; 2] {
    [black, white].map(|backing| OverBacking { film: film.layer().over(backing), backing })
}

#[test]
fn two_backings_recover_the_ratio_of_any_film() {
    for film in random_films().filter(|film| film.absorption > 0.0 && film.scattering > 0.0) {
        let [black, white] = over_two_backings(&film, 0.05, 0.95);
        let found = film_over_two_backings(black, white).unwrap();
        let ratio = film.absorption / film.scattering;
        // A film of small S d reflects little by itself. So a rounding error of the reading is
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
        // A rounding error of R grows as K/S in dark films, and as its square root near white.
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
