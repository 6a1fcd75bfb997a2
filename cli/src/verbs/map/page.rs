//! Pictures of maps, and a page that shows them.

use calibrate::library::PigmentLibrary;
use maps::SurveyedScan;
use maps::pictures::{Overview, Ramp, picture_png};
use spectra::Viewing;

use crate::failure::Result;
use crate::output::OutputFolder;

/// Darkest lightness of the ink of a pigment's picture, so that pale pigments are seen.
const DARKEST: u8 = 150;

/// Writes a picture of the presence and the share of each pigment, of chi-square and of the residual, and the
/// page `maps.html`.
pub(super) fn write(
    folder: &OutputFolder,
    scan: &SurveyedScan,
    overview: &Overview,
    library: &PigmentLibrary,
) -> Result<()> {
    let size = (overview.width, overview.height);
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    let mut cells = String::new();
    let mut order: Vec<usize> = (0..overview.pigments.len()).collect();
    order.sort_by(|&a, &b| overview.present[b].total_cmp(&overview.present[a]));
    for place in order {
        let name = &overview.pigments[place];
        let file = |kind: &str| format!("{kind}-{}.png", file_name(name));
        let ink = ink(library, scan, name);
        for (kind, values) in [("presence", &overview.presence), ("share", &overview.share)] {
            files.push((file(kind), picture_png(&values[place], size, &Ramp::of_ink(ink))?));
        }
        cells += &format!(
            "<tr><td>{}</td><td>{:.1} %</td><td>{:.1} %</td><td><img src=\"{}\" alt=\"\"></td>\
             <td><img src=\"{}\" alt=\"\"></td></tr>\n",
            escaped(name),
            100.0 * overview.present[place],
            100.0 * overview.mean_share[place],
            file("presence"),
            file("share"),
        );
    }
    let chi2 = Ramp { from: (0.0, [255; 3]), to: (4.0, [150, 20, 20]) };
    let rms = Ramp { from: (0.0, [255; 3]), to: (0.05, [20, 20, 150]) };
    files.push(("chi2.png".to_owned(), picture_png(&overview.chi2, size, &chi2)?));
    files.push(("residual.png".to_owned(), picture_png(&overview.rms, size, &rms)?));
    files.push(("maps.html".to_owned(), page(scan, overview, &cells).into_bytes()));
    let names = files.iter().map(|(name, _)| name.clone());
    let outputs = folder.outputs(names)?;
    outputs.into_iter().zip(files).try_for_each(|(output, (_, content))| output.put(content))
}

/// The colour of a pigment's masstone, made dark enough to be seen on white.
fn ink(library: &PigmentLibrary, scan: &SurveyedScan, column: &str) -> [u8; 3] {
    let columns = scan.mapper().columns();
    let first = columns.iter().find(|c| c.name == column).and_then(|c| c.pigments.first());
    let color = first.and_then(|name| library.color([(name, 1.0)], &Viewing::default()).ok());
    let rgb = color.map_or([0; 3], |color| color.srgb.0.map(|v| (255.0 * v.clamp(0.0, 1.0)) as u8));
    let brightest = rgb.iter().copied().max().unwrap_or(0).max(1);
    match brightest > DARKEST && rgb.iter().copied().min().unwrap_or(0) > DARKEST {
        true => rgb.map(|v| (f64::from(v) * f64::from(DARKEST) / f64::from(brightest)) as u8),
        false => rgb,
    }
}

/// A name with letters and digits alone, for a file.
fn file_name(name: &str) -> String {
    let kept =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    let text: String = kept.collect();
    text.split('-').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("-")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

fn page(scan: &SurveyedScan, overview: &Overview, cells: &str) -> String {
    let about = scan.about();
    let grouped = scan.mapper().columns().iter().filter(|column| column.pigments.len() > 1);
    let groups: String = grouped
        .map(|column| format!("<li>{}</li>", escaped(&column.pigments.join(", "))))
        .collect();
    let groups = match groups.is_empty() {
        true => "<p>The bands of the scan can tell all of these pigments apart.</p>".to_owned(),
        false => format!(
            "<p>Mapped as one, since the bands cannot tell them apart:</p><ul>{groups}</ul>"
        ),
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
         <title>Pigment maps</title><style>{STYLE}</style></head><body>\n\
         <h1>Pigment maps</h1>\n\
         <p>{} x {} pixels, of which {} were mapped; one square of the pictures is {} x {step} pixels. \
         Presence is the probability that a pigment is there; the columns tell the part of the pixels where it is \
         more likely than not, and its mean share. Transparent squares were not mapped.</p>\n{groups}\n\
         <table><tr><th>pigment</th><th>present</th><th>share</th><th>presence</th><th>share</th></tr>\n\
         {cells}</table>\n\
         <h2>How well the spectra are explained</h2>\n\
         <p>Left: chi-square per degree of freedom, white for 0, red for 4 and more; where it is high, the \
         library may lack a pigment, or the film does not hide. Right: residual, white for 0, blue for 0.05 and \
         more of reflectance.</p>\n\
         <p><img src=\"chi2.png\" alt=\"chi-square\"> <img src=\"residual.png\" alt=\"residual\"></p>\n\
         <p class=\"small\">library {}<br>survey {}<br>scan {}</p>\n</body></html>\n",
        about.rows.len(),
        about.columns.len(),
        overview.pixels.of(maps::pixel_maps::Mask::Mapped),
        overview.step,
        about.library_sha256,
        about.book_sha256,
        about.scan,
        step = overview.step,
    )
}

/// Style of the page: readable in light and dark, and on narrow screens.
const STYLE: &str = "body{font:16px/1.5 sans-serif;margin:1rem auto;max-width:75rem;padding:0 1rem}\
    img{max-width:100%;min-width:8rem;background:repeating-conic-gradient(#ccc 0 25%,#eee 0 50%) 0 0/16px 16px}\
    table{border-collapse:collapse;display:block;overflow-x:auto}td,th{padding:.3rem .6rem;text-align:left;\
    vertical-align:top}.small{font-size:.75rem;overflow-wrap:anywhere}\
    @media(prefers-color-scheme:dark){body{background:#222;color:#eee}}";
