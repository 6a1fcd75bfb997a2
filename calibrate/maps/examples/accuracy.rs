//! How far you can believe pigment maps: `cargo run --release -p impasto-maps --example accuracy`.
//!
//! Prints precision, recall and share error (half the sum of absolute errors) of
//!
//! 1. the measured binary mixtures of the Van Gogh oils, each unmixed as one pixel with a library that was
//!    fitted without it, beside linear methods in common use,
//! 2. simulated paintings of 8 of 18 pigments (a palette without black, then any), with noise 0.003 and
//!    real K and S that are off by smooth errors of 10 %. They have 60 recipes of one to three pigments
//!    with shares of at least 10 %. Also paintings with pigments fitted on one half of the readings,
//!    mapped with a library fitted on the other half,
//! 3. the probabilities and standard deviations of the maps,
//! 4. the same paintings if you know the palette, or K and S, or both, and how much the spectra speak
//!    for the true pigments where the map found wrong ones,
//! 5. pixels with a pigment that the library lacks,
//! 6. paintings of up to five pigments, under a surface that reflects unevenly. The library comes from
//!    the other half of the readings, and each paint is 15 % stronger or weaker than there. The last
//!    figure of a line says how much the truth surprises the map: the mean of -ln p, where p is the
//!    probability that the map gives to what is true. We chose by it how far stated errors count.
//! 7. paintings with a pigment that the library knows as a masstone only, for each oil in turn: the map
//!    leaves it out, takes it with an assumed S, or knows K and S. Last comes the chi-square of its
//!    masstone if the other pigments explain it.
//!
//! We have no scan of a painting, so these are swatches and simulations only.

#![expect(clippy::print_stdout, reason = "an example prints its result")]

use calibrate::Readings;
use documents::Task;
use maps::accuracy::{
    Baseline, NamedGroups, Painting, PaintingPlan, Scores, SwatchTrials, Told, Trial,
    choose_penalty, coverage, light_palette, missing_pigment, oil_groups, painting_trials,
    prepared_oils, reliability, residuals_of, swatch_trials,
};
use maps::{MapSettings, Mapper, ModelError, USUAL_MODEL_ERROR};
use pigment::PigmentLibrary;
use spectra::Viewing;

const SEEDS: std::ops::Range<u64> = 1001..1021;
/// Noise of an almost noiseless sensor, in reflectance.
const QUIET: f64 = 0.0005;
/// From this difference of chi-square on, a spectrum decides between two sets.
const DECISIVE: f64 = 4.0;
const RANGES: [f64; 6] = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../measurements/van-gogh-oils.csv");
    let prepared = prepared_oils(&Readings::open(path)?)?;
    swatches(&prepared)?;
    let oils = PigmentLibrary::van_gogh_oils();
    let stated = MapSettings {
        groups: oil_groups(),
        group_alike: false,
        model_error: Some(ModelError::Stated(0.1)),
        ..MapSettings::default()
    };
    let plan = PaintingPlan { pixels: 200, ..PaintingPlan::default() };
    let light = PaintingPlan { palette: light_palette(), ..plan.clone() };
    paintings("eight light pigments, K and S off by 10 %", (&oils, &oils), &light, &stated)?;
    paintings("any eight, K and S off by 10 %", (&oils, &oils), &plan, &stated)?;
    let halves = [prepared.half(0), prepared.half(1)];
    let real = halves[0].fit(&Task::default())?.library;
    let known = halves[1].fit(&Task::default())?.library;
    let model_error =
        residuals_of(&halves[1].left_out(&Task::default())?).map(ModelError::Residuals);
    let usual = MapSettings { model_error, ..stated.clone() };
    let exact = PaintingPlan { error: 0.0, ..plan.clone() };
    paintings("library from the other half", (&real, &known), &exact, &usual)?;

    limits(&oils, &plan, &stated)?;

    println!("\n5. A pigment that the library lacks, in 10 paintings");
    let found = missing_pigment(&oils, &plan, 1..11, &stated)?;
    println!("  median chi-square without it {:.2}, with it {:.2}", found.chi2[0], found.chi2[1]);
    println!("  noticed by chi-square in {:.0} % of the pixels with it", 100.0 * found.noticed);
    let [without, with] = found.false_presences;
    println!("  false presences in a pixel without it {without:.2}, with it {with:.2}");

    println!(
        "\n6. Up to five pigments, other half, strengths off by 15 %: dark, middle, light, -ln p a pixel"
    );
    let plan = PaintingPlan {
        at_most: 5,
        least_share: 0.03,
        strength: 0.15,
        gloss: 0.006,
        ..exact.clone()
    };
    for (real, known) in [(&real, &known), (&known, &real)] {
        let trials = painting_trials((real, known), &plan, 1..13, (&stated, Told::Nothing))?;
        let [dark, middle, light] = [0, 1, 2].map(|tone| Scores::of(trials.of_tone(tone)));
        println!("  {dark} | {middle} | {light} {:.2}", surprise(&trials.mapped));
        print_reliability(&trials.mapped);
    }

    masstones(&oils, &stated)?;

    println!("\nPigments that look alike in 31 bands from 400 to 700 nm, told from K and S alone");
    let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
    let mapper = Mapper::new(&oils, &nm, &MapSettings::default())?;
    for column in mapper.columns().iter().filter(|column| column.pigments.len() > 1) {
        println!("  {}", column.pigments.join(", "));
    }
    Ok(())
}

/// Maps paintings with each oil, of which the library knows the masstone alone.
fn masstones(
    oils: &PigmentLibrary,
    stated: &MapSettings,
) -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "\n7. A pigment known as a masstone: left out, S assumed, K and S known; chi-square of it"
    );
    let nm: Vec<f64> = oils.grid.wavelengths_nm().collect();
    let measured = oils.pigments.iter().filter(|pigment| pigment.identified);
    let names: Vec<String> = measured.map(|pigment| pigment.name.clone()).collect();
    let mut all = [const { Vec::new() }; 3];
    for name in &names {
        let masstone = oils.color([(name.as_str(), 1.0)], &Viewing::default())?;
        let mut known = oils.clone();
        let place = known.find(name)?;
        let pigment = &mut known.pigments[place.0];
        // As the fit does: the root of Y, if the reference white has S = 1.
        let assumed = (masstone.xyz.y / 100.0).sqrt();
        for (k, s) in pigment.absorption.iter_mut().zip(&mut pigment.scattering) {
            (*k, *s) = (assumed * *k / *s, assumed);
        }
        pigment.identified = false;
        let others = names.iter().filter(|other| *other != name).cloned().collect();
        let mapper = |library: &PigmentLibrary, palette: Vec<String>| {
            Mapper::new(library, &nm, &MapSettings { palette, ..stated.clone() })
        };
        let mappers =
            [mapper(&known, others)?, mapper(&known, names.clone())?, mapper(oils, names.clone())?];
        let mut trials = [const { Vec::new() }; 3];
        let plans = (1..).map(|seed| PaintingPlan { seed, pixels: 150, ..PaintingPlan::default() });
        let paintings = plans.map(|plan| Painting::simulate(oils, oils, &plan));
        for painting in paintings.filter(|painting| painting.pigments.contains(name)).take(4) {
            for (trials, mapper) in trials.iter_mut().zip(&mappers) {
                let book = mapper.survey(&painting.spectra, &Task::default())?;
                let maps = mapper.map_block(&book, &painting.spectra)?;
                trials.extend(painting.trials(mapper, &maps));
            }
        }
        let narrow: Vec<f32> =
            masstone.reflectance.values().iter().map(|value| *value as f32).collect();
        let chi2 = mappers[0].search(&narrow)?.chi2[0];
        let [without, assumed, measured] = trials.each_ref().map(Scores::of);
        println!("  {name:24} {without} | {assumed} | {measured} {chi2:6.2}");
        all.iter_mut().zip(trials).for_each(|(all, trials)| all.extend(trials));
    }
    let [without, assumed, measured] = all.each_ref().map(Scores::of);
    println!("  {:24} {without} | {assumed} | {measured}", "all");
    Ok(())
}

fn swatches(prepared: &calibrate::PreparedFit) -> Result<(), Box<dyn std::error::Error>> {
    let samples = prepared.left_out(&Task::default())?;
    let groups = oil_groups();
    let named = NamedGroups::of(&samples, &groups);
    println!("1. {} measured mixtures, each left out of its library", samples.len());
    println!("  {:44} {:17} groups", "precision, recall, share error of", "pigments");
    for baseline in Baseline::ALL {
        row(baseline.name(), &SwatchTrials::baseline(&samples, &named, baseline, 0.1));
    }
    let stated = MapSettings {
        model_error: Some(ModelError::Stated(USUAL_MODEL_ERROR)),
        at_most: 3,
        ..MapSettings::default()
    };
    let trials = swatch_trials(&samples, &stated, &groups)?;
    row("two constants, K and S off by 10 %", &trials);
    println!("  with the errors of the other mixtures:");
    let mut of_penalty = Vec::new();
    for penalty in [0.0, 1.0, 2.0, 4.0] {
        let settings = MapSettings { penalty, at_most: 3, ..MapSettings::default() };
        let trials = swatch_trials(&samples, &settings, &groups)?;
        row(&format!("two constants, penalty {penalty}"), &trials);
        of_penalty.push((penalty, trials));
    }
    let choice = choose_penalty(&of_penalty, 5);
    row(&format!("penalty chosen on other folds {:?}", choice.penalties), &choice.trials);
    print_reliability(&choice.trials.groups);
    Ok(())
}

fn row(name: &str, trials: &SwatchTrials) {
    println!("  {name:44} {} {}", Scores::of(&trials.pigments), Scores::of(&trials.groups));
}

fn paintings(
    name: &str,
    libraries: (&PigmentLibrary, &PigmentLibrary),
    plan: &PaintingPlan,
    settings: &MapSettings,
) -> Result<(), Box<dyn std::error::Error>> {
    println!("\n2. 20 simulated paintings, {name}: groups");
    let trials = painting_trials(libraries, plan, SEEDS, (settings, Told::Nothing))?;
    println!("  whole search      {}", Scores::of(&trials.searched));
    println!("  survey and map    {}", Scores::of(&trials.mapped));
    println!("  search worse than the refined truth in {:.1} %", 100.0 * trials.worse());
    print_reliability(&trials.searched);
    println!("  after a survey:");
    print_reliability(&trials.mapped);
    Ok(())
}

/// Prints how well we map the same paintings if we know the palette, or K and S, exactly. It also
/// counts the dark pixels with a wrong set where chi-square clearly favours the true one.
fn limits(
    oils: &PigmentLibrary,
    plan: &PaintingPlan,
    settings: &MapSettings,
) -> Result<(), maps::MapError> {
    println!("\n4. What could be told of any eight: dark, middle, light paint");
    let sure = MapSettings { model_error: Some(ModelError::Stated(0.003)), ..settings.clone() };
    let quiet = MapSettings { sensor_noise: QUIET, ..sure.clone() };
    let exact = PaintingPlan { error: 0.0, ..plan.clone() };
    let noiseless = PaintingPlan { noise: QUIET, ..exact.clone() };
    for (name, plan, settings, told) in [
        ("as the maps are", plan, settings, Told::Nothing),
        ("palette known", plan, settings, Told::Palette),
        ("K and S known exactly", &exact, &sure, Told::Nothing),
        ("K, S and palette known", &exact, &sure, Told::Palette),
        ("the same, noise 0.0005", &noiseless, &quiet, Told::Palette),
    ] {
        let trials = painting_trials((oils, oils), plan, SEEDS, (settings, told))?;
        let [dark, middle, light] = [0, 1, 2].map(|tone| Scores::of(trials.of_tone(tone)));
        println!("  {name:24} {dark} | {middle} | {light}");
        let wrong = trials.beside.iter().zip(&trials.tones).filter(|(b, _)| !b.is_right);
        let dark = wrong.filter(|(_, tone)| **tone == 0);
        let told = dark.clone().filter(|(beside, _)| beside.chi2 > DECISIVE).count();
        let count = dark.count();
        let pixels = trials.of_tone(0).count();
        println!(
            "    whole search: {count} of {pixels} dark pixels with a wrong set, in {told} of them chi-square of the true one lower by {DECISIVE} or more"
        );
    }
    Ok(())
}

/// Mean over `trials` of -ln of the probabilities of what is there and what is not. None counts as
/// more certain than 0.5 %. We leave out pixels that are not mapped.
fn surprise(trials: &[Trial]) -> f64 {
    let mut sum = 0.0;
    let mapped = trials.iter().filter(|trial| trial.probability.iter().all(|p| p.is_finite()));
    for trial in mapped.clone() {
        for (index, probability) in trial.probability.iter().enumerate() {
            let probability = probability.clamp(0.005, 0.995);
            sum -= match trial.is_there(index) {
                Some(true) => probability.ln(),
                Some(false) => (1.0 - probability).ln(),
                None => 0.0,
            };
        }
    }
    sum / mapped.count().max(1) as f64
}

/// Prints how well the probabilities and standard deviations of `trials` agree with the truth.
fn print_reliability(trials: &[Trial]) {
    for range in reliability(trials, &RANGES) {
        println!(
            "    presence told {:.2}, true {:.2}, {} times",
            range.told, range.true_part, range.count
        );
    }
    let found = coverage(trials);
    println!("    {:.0} % of {} shares within one deviation", 100.0 * found.within, found.count);
}
