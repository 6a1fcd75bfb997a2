//! `impasto simulate-scan`: a painting of this program as a spectral camera would scan it, with the truth.

use std::ops::Range;
use std::path::PathBuf;

use clap::Args;
use maps::camera::{Camera, CameraSettings, Scene};
use maps::cube::envi::{EnviAbout, EnviWriter, written_data};
use maps::truth::{PaintClass, TruthAbout, TruthParts, TruthWriter, truth_rows};
use paint::document::Document;
use paint::scene::SpectralDocument;
use serde_json::{Map, Value, json};

use crate::console::Console;
use crate::failure::{Failure, Result};
use crate::output::Output;
use crate::progress::{Progress, waited};

/// Simulate a spectral scan of a painting, and write the truth beside it
///
/// The exact spectra of the painting become an ENVI cube: blurred, with noise, with a white that drifts
/// along the scan and a surface that reflects unevenly. The truth is a Zarr group. For each pixel it
/// holds the shares of the pigments in the visible paint (a layer counts by how much it hides the layers
/// below), the visible part of the ground, both blurred as the light is, and the kind of the pixel:
/// hiding, glaze, thin, bare, or an edge. The same seed gives the same bytes. `impasto map --truth`
/// compares maps with the truth.
#[derive(Debug, Args)]
pub(crate) struct SimulateScan {
    /// The painting (.exr, as `impasto paint --output` writes it)
    painting: PathBuf,
    /// The header of the scan to write (.hdr); its data lie beside it (.bil)
    #[arg(short, long, value_name = "SCAN.hdr")]
    output: PathBuf,
    /// The folder of the truth [default: SCAN-truth.zarr]
    #[arg(long, value_name = "FOLDER")]
    truth: Option<PathBuf>,
    /// Number of bands, evenly from 400 to 1000 nm, or over the part of it that the painting's
    /// library covers
    #[arg(long, value_name = "N", default_value_t = CameraSettings::default().bands)]
    bands: usize,
    /// Standard deviation of the blur in pixels
    #[arg(long, value_name = "PX", default_value_t = CameraSettings::default().blur_px)]
    blur: f64,
    /// Standard deviation of the shot noise at a reflectance of 1
    #[arg(long, value_name = "SD", default_value_t = CameraSettings::default().shot_noise)]
    shot_noise: f64,
    /// Standard deviation of the readout noise, in reflectance
    #[arg(long, value_name = "SD", default_value_t = CameraSettings::default().read_noise)]
    read_noise: f64,
    /// Change of the white from the first to the last line, as a fraction
    #[arg(
        long,
        value_name = "PART",
        default_value_t = CameraSettings::default().drift,
        allow_hyphen_values = true
    )]
    drift: f64,
    /// Standard deviation of the surface reflection k1 over the painting, as a fraction of k1
    #[arg(long, value_name = "PART", default_value_t = CameraSettings::default().surface)]
    surface: f64,
    /// Seed of all random numbers
    #[arg(long, value_name = "N", default_value_t = CameraSettings::default().seed)]
    seed: u64,
    /// Print JSON: lines, samples, wavelengths_nm, pigments, settings, classes
    #[arg(long)]
    json: bool,
}

impl SimulateScan {
    pub(super) fn run(self, console: &mut Console<'_>) -> Result<()> {
        let inputs = [self.painting.clone()];
        let header = Output::with_ending(&self.output, &["hdr"], &inputs)?;
        if documents::file::is_stream(header.path()) {
            return Err(Failure::usage("a scan has two files", "name its header: -o scan.hdr"));
        }
        Output::open(&written_data(&self.output), &inputs)?;
        let document = waited("reading the painting", console, || Document::open(&self.painting))?;
        let settings = self.settings();
        let exact = SpectralDocument::full(&document);
        let scene = Scene {
            lines: document.wet.height(),
            samples: document.wet.width(),
            grid: document.library.grid,
            surface: document.library.saunderson,
        };
        let camera = Camera::new(scene, &settings)?;
        let painting = Painting::new(&document, &exact);
        if painting.pigments.is_empty() {
            return Err(Failure::data(
                format!("{}: the painting holds no paint", self.painting.display()),
                "name a painting with strokes",
            ));
        }
        let about = self.about();
        let mut truth = TruthWriter::create(
            &self.truth_path(),
            TruthAbout {
                lines: scene.lines,
                samples: scene.samples,
                pigments: painting.names(),
                settings: about.clone(),
            },
        )?;
        let nm = camera.wavelengths_nm();
        let mut scan = EnviWriter::create(
            &self.output,
            EnviAbout {
                lines: scene.lines,
                samples: scene.samples,
                wavelengths_nm: nm.to_vec(),
                description: format!("simulated scan of a painting: {}", words(&about)),
            },
        )?;
        let block = truth.block_rows();
        let blocks = scene.lines.div_ceil(block);
        let bar = Progress::new(blocks, "scanning", console.shows_progress());
        let mut classes = [0u64; PaintClass::ALL.len()];
        for at in 0..blocks {
            let rows = at * block..((at + 1) * block).min(scene.lines);
            painting.scan(&camera, rows, (&mut scan, &mut truth), &mut classes)?;
            bar.step();
        }
        bar.done();
        // The scan comes last: one with a header has its truth.
        truth.finish()?;
        scan.finish()?;
        console.wrote(&self.truth_path())?;
        console.wrote(&self.output)?;
        if self.json {
            let classes: Map<String, Value> = PaintClass::ALL
                .map(|c| (c.name().to_owned(), json!(classes[c as usize])))
                .into_iter()
                .collect();
            return console.json(&json!({
                "lines": scene.lines,
                "samples": scene.samples,
                "wavelengths_nm": nm,
                "pigments": painting.names(),
                "settings": about,
                "classes": classes,
            }));
        }
        let [first, last] = [nm.first(), nm.last()].map(|nm| nm.copied().unwrap_or_default());
        console.line(format!(
            "{} x {} pixels, {} from {first} to {last} nm; {}",
            scene.lines,
            scene.samples,
            documents::counted(nm.len(), "band"),
            words(&about)
        ))?;
        let all = classes.iter().sum::<u64>().max(1) as f64;
        let parts = PaintClass::ALL
            .iter()
            .zip(classes)
            .map(|(class, count)| format!("{} {:.0} %", class.name(), 100.0 * count as f64 / all));
        console.line(format!("paint: {}", parts.collect::<Vec<_>>().join(", ")))
    }

    fn settings(&self) -> CameraSettings {
        let &Self { bands, blur: blur_px, shot_noise, read_noise, drift, surface, seed, .. } = self;
        CameraSettings { bands, blur_px, shot_noise, read_noise, drift, surface, seed }
    }

    /// Every setting by its name.
    fn about(&self) -> Map<String, Value> {
        let all = json!({
            "bands": self.bands,
            "blur": self.blur,
            "shot_noise": self.shot_noise,
            "read_noise": self.read_noise,
            "drift": self.drift,
            "surface": self.surface,
            "seed": self.seed,
        });
        all.as_object().cloned().unwrap_or_default()
    }

    fn truth_path(&self) -> PathBuf {
        self.truth.clone().unwrap_or_else(|| {
            let stem = self.output.file_stem().unwrap_or_default().to_string_lossy();
            self.output.with_file_name(format!("{stem}-truth.zarr"))
        })
    }
}

/// Settings in words, such as `seed 1, blur 1.5`.
fn words(about: &Map<String, Value>) -> String {
    let each = about.iter().map(|(name, value)| format!("{} {value}", name.replace('_', " ")));
    each.collect::<Vec<_>>().join(", ")
}

/// A painting with the pigments that are in it.
struct Painting<'d> {
    document: &'d Document,
    exact: &'d SpectralDocument<'d>,
    /// Indices of its pigments in the library.
    pigments: Vec<usize>,
    parts: TruthParts,
}

impl<'d> Painting<'d> {
    fn new(document: &'d Document, exact: &'d SpectralDocument<'d>) -> Self {
        let dry = document.dry.iter().map(|layer| (&layer.slots, &layer.paint));
        let mut pigments: Vec<usize> = Vec::new();
        for (slots, paint) in dry.chain([(&document.slots, &document.wet)]) {
            let used = slots.iter().zip(paint.totals()).filter(|(_, total)| *total > 0);
            pigments.extend(used.filter_map(|(pigment, _)| Some((*pigment)?.index())));
        }
        pigments.sort_unstable();
        pigments.dedup();
        let parts = TruthParts { pigments: pigments.len(), layers: document.dry.len() + 1 };
        Self { document, exact, pigments, parts }
    }

    fn names(&self) -> Vec<String> {
        self.pigments
            .iter()
            .map(|&place: &usize| self.document.library.pigments[place].name.clone())
            .collect()
    }

    /// Scans rows, and writes them with their truth.
    fn scan(
        &self,
        camera: &Camera,
        rows: Range<usize>,
        (scan, truth): (&mut EnviWriter, &mut TruthWriter),
        classes: &mut [u64],
    ) -> Result<()> {
        let columns = camera.scene().samples;
        let scanned = camera.rows(rows.clone(), &|line| {
            (0..columns).flat_map(|x| self.exact.measured_reflectance(x, line)).collect()
        });
        scan.add(&scanned.told)?;
        let found = truth_rows(camera, self.parts, rows, scanned.mean, &|line| {
            (0..columns).flat_map(|x| self.seen(x, line)).collect()
        });
        for class in &found.class {
            classes[usize::from(class.code())] += 1;
        }
        Ok(truth.add(&found)?)
    }

    /// Shares of the paint that you see at a cell: first of the pigments, then of the layers, then of the
    /// ground.
    fn seen(&self, x: usize, y: usize) -> Vec<f64> {
        let seen = self.exact.seen(x, y);
        let pigments = self.pigments.iter().map(|&place| seen.pigments[place]);
        pigments.chain(seen.layers.iter().copied()).chain([seen.ground]).collect()
    }
}
