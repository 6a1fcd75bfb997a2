//! How far you can believe the maps of simulated scans of paintings, beside least squares on K/S:
//! `paintings SCAN.hdr TRUTH.zarr [LIBRARY.json]`.
//!
//! `impasto simulate-scan` writes scan and truth. Without a library this maps with the Van Gogh oils
//! that ship. It prints, for hiding paint by its tone, precision, recall and share error of the maps and
//! of nonnegative least squares on K/S with masstones (Kubelka-Munk theory with one constant) and on
//! K - Q S (with two), then from which probability on the maps are as precise as the former, then the
//! probabilities of the maps beside the truth, and each pigment. Whites count as one pigment and chrome
//! yellows too, as in the guide.

#![expect(clippy::print_stdout, reason = "an example prints its result")]

use std::time::Instant;

use documents::Task;
use maps::accuracy::{Baseline, ScoreSums, Trial, oil_groups, reliability, tone};
use maps::bands::Bands;
use maps::pixel_maps::Mask;
use maps::truth::{PaintClass, Truth};
use maps::{Cube, MapSettings, Paints, SurveyedScan};
use pigment::PigmentLibrary;

/// We map about this many pixels of a scan, evenly spread.
const MAPPED: usize = 60_000;
/// Least squares see every such pixel.
const EACH: usize = 10;
/// Least true share of a pigment that counts as present, and least share that least squares report.
const LEAST: f64 = 0.05;
const RANGES: [f64; 6] = [0.0, 0.1, 0.3, 0.5, 0.7, 0.9];
const TONES: [&str; 3] = ["dark", "middle", "light"];

/// Results for the pixels of one tone.
#[derive(Default)]
struct Trials {
    /// The map in each pixel.
    maps: Vec<Trial>,
    /// The map in the pixels that least squares unmix too.
    compared: Vec<Trial>,
    seen: ScoreSums,
    /// Least squares on K/S in these pixels.
    least_squares: ScoreSums,
    /// Least squares on K - Q S in these pixels.
    two_constants: ScoreSums,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [scan, truth, library @ ..] = &arguments[..] else {
        return Err("name a scan and its truth".into());
    };
    let library = match library {
        [path, ..] => PigmentLibrary::open(path)?,
        [] => PigmentLibrary::van_gogh_oils(),
    };
    // Red lakes are joined only if the bands cannot tell them apart.
    let groups = oil_groups().into_iter().filter(|group| group.name != "red lakes").collect();
    let settings = MapSettings { groups, ..MapSettings::default() };
    let cube = Cube::open(scan)?;
    let bands = Bands::new(cube.wavelengths_nm(), library.grid)?;
    let paints = Paints::new(&library, &[], &bands)?;
    let pixels = cube.spread(0..cube.lines(), 0..cube.samples(), MAPPED)?;
    let surveyed = SurveyedScan::survey(cube, &library, &settings, None, &Task::default())?;
    let columns = surveyed.mapper().columns();
    let start = Instant::now();
    let maps = surveyed.map_pixels(&pixels.values)?;
    let seconds = start.elapsed().as_secs_f64();
    println!("{} pixels at {:.0} pixels/s", maps.pixels(), maps.pixels() as f64 / seconds);

    let truth = Truth::open(truth)?;
    let column_of = |name: &String| columns.iter().position(|c| c.pigments.contains(name));
    let of_truth: Vec<Option<usize>> = truth.pigments().iter().map(column_of).collect();
    let of_paint: Vec<Option<usize>> = paints.names.iter().map(column_of).collect();
    let scan_bands = pixels.values.len() / pixels.places.len().max(1);
    let mut tones: [Trials; 3] = std::array::from_fn(|_| Trials::default());
    let mut index = 0;
    for (rows, place) in truth.blocks().zip(0..) {
        let known = truth.block(place)?;
        while let Some(&(row, column)) = pixels.places.get(index).filter(|at| at.0 < rows.end) {
            let pixel = index;
            index += 1;
            let at = (row - rows.start) * truth.samples() + column;
            if known.class[at] != PaintClass::Hiding || maps.mask[pixel] != Mask::Mapped {
                continue;
            }
            let own = &known.share[at * known.pigments..][..known.pigments];
            let shares =
                by_column(own.iter().map(|share| f64::from(*share)), &of_truth, columns.len());
            let trial = Trial { least: LEAST, ..Trial::of_map(&maps, pixel, &shares) };
            let trials = &mut tones[tone(known.mean_reflectance[at])];
            if pixel % EACH == 0 {
                let values = &pixels.values[pixel * scan_bands..][..scan_bands];
                let values: Vec<f64> = values.iter().map(|value| f64::from(*value)).collect();
                let values = bands.fold_scan(&values);
                let methods = [
                    (Baseline::Ratio, &mut trials.least_squares),
                    (Baseline::TwoConstants, &mut trials.two_constants),
                ];
                for (method, sums) in methods {
                    let unmixed = method.unmix(&paints, &values).shares;
                    let told = by_column(unmixed, &of_paint, columns.len());
                    let present = told.iter().map(|share| *share > LEAST).collect();
                    sums.add(&Trial { told, present, ..trial.clone() });
                }
                trials.seen.add(&trial);
                trials.compared.push(trial.clone());
            }
            trials.maps.push(trial);
        }
    }
    print(&tones, columns.iter().map(|column| column.name.as_str()));
    Ok(())
}

/// Sums of the shares of each column of the maps. A pigment without a column is left out.
fn by_column(
    shares: impl IntoIterator<Item = f64>,
    column_of: &[Option<usize>],
    columns: usize,
) -> Vec<f64> {
    let mut sums = vec![0.0; columns];
    for (share, column) in shares.into_iter().zip(column_of) {
        if let Some(column) = column {
            sums[*column] += share;
        }
    }
    sums
}

/// The least probability from which pigments of the maps are present with the precision `wanted`, with this
/// precision and the recall. `None` if even the surest are not.
fn as_precise(trials: &[Trial], wanted: f64) -> Option<(f64, f64, f64)> {
    let cases = trials.iter().flat_map(|trial| {
        let probabilities = trial.probability.iter().enumerate();
        probabilities.filter_map(|(at, probability)| Some((*probability, trial.is_there(at)?)))
    });
    let mut cases: Vec<(f64, bool)> = cases.collect();
    cases.sort_by(|a, b| b.0.total_cmp(&a.0));
    let there = cases.iter().filter(|(_, is_there)| *is_there).count().max(1) as f64;
    let mut right = 0.0;
    let mut found = None;
    for (told, (probability, is_there)) in (1..).zip(&cases) {
        right += f64::from(u8::from(*is_there));
        let precision = right / f64::from(told);
        if precision >= wanted && *probability > 0.0 {
            found = Some((*probability, precision, right / there));
        }
    }
    found
}

fn print<'a>(tones: &[Trials; 3], names: impl Iterator<Item = &'a str>) {
    println!(
        "hiding paint: pixels; precision, recall, share error of the maps; of the maps, of least squares on K/S and on K - Q S in the same pixels"
    );
    for (trials, tone) in tones.iter().zip(TONES) {
        let mut all = ScoreSums::default();
        trials.maps.iter().for_each(|trial| all.add(trial));
        let Trials { maps, seen, least_squares, two_constants, .. } = trials;
        let [all, seen, one, two] =
            [&all, seen, least_squares, two_constants].map(|sums| sums.scores());
        println!("  {tone:6} {:6}  {all} | {seen} | {one} | {two}", maps.len());
    }
    println!(
        "probability from which the maps are as precise as least squares on K/S, their precision and recall there, in the same pixels"
    );
    for (trials, tone) in tones.iter().zip(TONES) {
        let wanted = trials.least_squares.scores().precision;
        match as_precise(&trials.compared, wanted) {
            Some((probability, precision, recall)) => {
                println!("  {tone:6} {probability:.2} {precision:.3} {recall:.3}");
            }
            None => println!("  {tone:6} nowhere"),
        }
    }
    println!("presence told, true, times");
    let every: Vec<&Trial> = tones.iter().flat_map(|trials| &trials.maps).collect();
    for range in reliability(every.iter().copied(), &RANGES) {
        let off = range.told - range.true_part;
        println!("  {:.2} {:.2} {:8} {off:+.2}", range.told, range.true_part, range.count);
    }
    println!("pigment: true, told, rightly told (% of the pixels) by tone");
    for (column, name) in names.enumerate() {
        let rows = tones.each_ref().map(|trials| {
            let mut counts = [0usize; 3];
            for trial in &trials.maps {
                let Some(is_there) = trial.is_there(column) else { continue };
                let told = trial.present[column];
                let found = [is_there, told, is_there && told];
                counts.iter_mut().zip(found).for_each(|(count, is)| *count += usize::from(is));
            }
            let all = trials.maps.len().max(1) as f64;
            counts.map(|count| 100.0 * count as f64 / all)
        });
        if rows.iter().flatten().any(|part| *part >= 1.0) {
            let rows =
                rows.map(|[there, told, right]| format!("{there:3.0} {told:3.0} {right:3.0}"));
            println!("  {name:34} {}", rows.join(" | "));
        }
    }
}
