//! Files for the commands of the guides: small copies of the files that ship, and files that a
//! reader brings.

use std::path::Path;

use calibrate::PigmentLibrary;
use image::imageops::FilterType;
use suite::program::{impasto, repository};

const LONGEST: u32 = 96;

/// File of a small style of brushwork. The file [`MAP`] is a small map that is painted in this
/// style.
pub(crate) const STYLE: &str = "small.toml";
pub(crate) const MAP: &str = "small.artmap.exr";

/// Puts the files for the commands of `page` into `folder`, where they run.
pub(crate) fn prepare(folder: &Path, page: &str) {
    for inside in ["measurements", "paintings", "docs/images"] {
        std::fs::create_dir_all(folder.join(inside)).unwrap();
    }
    let oils = "measurements/van-gogh-oils.pigments.json";
    for file in ["measurements/van-gogh-oils.csv", oils] {
        std::fs::copy(repository(file), folder.join(file)).unwrap();
    }
    for name in ["coffee.jpg", "photograph.png", "still-life.png"] {
        let file = format!("docs/images/{name}");
        let picture = image::open(repository(&file)).unwrap();
        picture.resize(LONGEST, LONGEST, FilterType::Triangle).save(folder.join(file)).unwrap();
    }
    // Passages of this picture must hold several strokes.
    let painted = "docs/images/coffee-painted.jpg";
    std::fs::copy(repository(painted), folder.join(painted)).unwrap();
    if page.contains("impasto painterly") {
        brushwork(folder);
    }
    coarse_scripts(folder);
    scan(folder);
    std::fs::copy(folder.join(oils), folder.join("batch2.json")).unwrap();
    std::fs::write(folder.join("path.toml"), CAMERA).unwrap();
    std::fs::write(folder.join("spectra.csv"), SPECTRA).unwrap();
    std::fs::write(folder.join("swatches.csv"), SPECTRA).unwrap();
    std::fs::write(folder.join("swatches.ti3"), TI3).unwrap();
    let book = "name,L,a,b\nRAL 5012,55.1,-15.3,-31.9\n";
    std::fs::write(folder.join("book.csv"), book).unwrap();
    let book = folder.join("book.ase").to_str().unwrap().to_owned();
    let oils = folder.join(oils).to_str().unwrap().to_owned();
    let run = impasto(&["library", "export", &oils, "--to", "ase", "--output", &book]);
    assert_eq!(run.status, 0, "{}", run.err);
    std::fs::write(folder.join("pot.csv"), format!("{WAVELENGTHS}{STANDARD}{BATCH}{CORRECTED}"))
        .unwrap();
    std::fs::write(folder.join("standard.csv"), format!("{WAVELENGTHS}{STANDARD}")).unwrap();
    std::fs::write(folder.join("batch.csv"), format!("{WAVELENGTHS}{BATCH}")).unwrap();
    std::fs::write(folder.join("recipes.csv"), RECIPES).unwrap();
}

/// The style `dabs` with few large cells. Returns any other text as it is.
pub(crate) fn small_style(text: &str) -> String {
    text.replace("side_cells = 300", "side_cells = 64").replace("cell_mm = 0.18", "cell_mm = 0.36")
}

/// A style of small dabs, and a map of three tones.
fn brushwork(folder: &Path) {
    fn run(arguments: &[&str]) -> String {
        let run = impasto(arguments);
        assert_eq!(run.status, 0, "{arguments:?}: {}", run.err);
        run.out
    }
    let shown = run(&["artmap", "paint", "--show-style", "dabs"]);
    let style = small_style(&shown);
    assert!(style != shown, "the style has another size: {shown}");
    std::fs::write(folder.join(STYLE), style).unwrap();
    run(&["artmap", "paint", "--style", STYLE, "--tones", "3", "-o", "small.exr"]);
    run(&["artmap", "build", "small.exr", "--size", "64", "-o", MAP]);
}

fn coarse_scripts(folder: &Path) {
    for file in ["paintings/landscape.json", "paintings/colour-study.json"] {
        let text = std::fs::read_to_string(repository(file)).unwrap();
        let mut script: serde_json::Value = serde_json::from_str(&text).unwrap();
        script["canvas"]["cell_mm"] = 1.0.into();
        std::fs::write(folder.join(file), script.to_string()).unwrap();
    }
}

fn scan(folder: &Path) {
    let oils = PigmentLibrary::van_gogh_oils();
    let recipe = oils.recipe([("Lead White", 4.0), ("Viridian", 1.0)]).unwrap();
    let green = oils.mix(recipe).unwrap().hiding(oils.saunderson);
    let pixel: Vec<u8> = green.iter().flat_map(|value| (*value as f32).to_le_bytes()).collect();
    std::fs::write(folder.join("scan.bip"), pixel.repeat(8)).unwrap();
    let nm: Vec<String> = oils.grid.wavelengths_nm().map(|nm| nm.to_string()).collect();
    let header = format!(
        "ENVI\nsamples = 4\nlines = 2\nbands = {}\ndata type = 4\ninterleave = bip\n\
         byte order = 0\nwavelength units = Nanometers\nwavelength = {{{}}}\n",
        nm.len(),
        nm.join(", ")
    );
    std::fs::write(folder.join("scan.hdr"), header).unwrap();
}

const CAMERA: &str = "\
frames = 2
[[keyframe]]
eye = [4.0, 2.0, 6.0]
target = [0.0, 0.5, 0.0]
[[keyframe]]
eye = [6.0, 3.0, 2.0]
target = [0.0, 0.5, 0.0]
";

const SPECTRA: &str = "\
sample,400,450,500,550,600,650,700
STANDARD,0.1,0.2,0.4,0.5,0.4,0.3,0.3
trial,0.1,0.22,0.38,0.5,0.42,0.3,0.3
";

const WAVELENGTHS: &str = "sample,400,450,500,550,600,650,700\n";

/// Reading of zinc white with cobalt blue. [`BATCH`] has less blue.
const STANDARD: &str = "standard,0.5,0.74,0.63,0.31,0.2,0.21,0.45\n";
const BATCH: &str = "batch,0.52,0.78,0.69,0.39,0.27,0.28,0.53\n";
/// Reading of [`BATCH`] after blue was added.
const CORRECTED: &str = "corrected,0.51,0.76,0.66,0.35,0.235,0.245,0.49\n";

const TI3: &str = "\
CTI3

DESCRIPTOR \"Swatches\"
SPECTRAL_BANDS \"7\"
SPECTRAL_START_NM \"400\"
SPECTRAL_END_NM \"700\"
SPECTRAL_NORM \"100\"
NUMBER_OF_FIELDS 8
BEGIN_DATA_FORMAT
SAMPLE_ID SPEC_400 SPEC_450 SPEC_500 SPEC_550 SPEC_600 SPEC_650 SPEC_700
END_DATA_FORMAT
NUMBER_OF_SETS 4
BEGIN_DATA
w 70 85 88 89 90 90 90
b 8 20 15 9 8 9 14
t1 20 45 38 25 21 24 36
t2 35 62 58 45 40 44 55
END_DATA
";

const RECIPES: &str = "\
sample,Zinc White,Cobalt Blue
w,1,0
b,0,1
t1,4,1
t2,9,1
";
