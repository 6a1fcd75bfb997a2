//! Pictures of maps, and a page that shows them.

use calibrate::library::PigmentLibrary;
use maps::pictures::{MapPictures, Overview, PictureError, Ramp, scan_png};
use maps::{Spot, SurveyedScan};

use crate::failure::Result;
use crate::output::OutputFolder;

/// Writes a picture of the presence and the share of each pigment, of chi-square and of the residual, and the
/// page `maps.html`.
pub(super) fn write(
    folder: &OutputFolder,
    scan: &SurveyedScan,
    overview: &Overview,
    (library, spots): (&PigmentLibrary, &[Spot]),
) -> Result<()> {
    let pictures = MapPictures::of(scan, overview, library)?;
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    let seen = match scan_png(scan, overview) {
        Ok(picture) => {
            files.push((MapPictures::SCAN_FILE.to_owned(), picture));
            format!(
                "<h2>The scan</h2><p><img src=\"{}\" alt=\"the scan\"></p>\n",
                MapPictures::SCAN_FILE
            )
        }
        Err(PictureError::Unseen) => String::new(),
        Err(error) => return Err(error.into()),
    };
    let mut cells = String::new();
    for of in pictures.pigments {
        cells += &format!(
            "<tr><td>{}</td><td>{:.1} %</td><td>{:.1} %</td><td><img src=\"{}\" alt=\"\"></td>\
             <td><img src=\"{}\" alt=\"\"></td></tr>\n",
            escaped(&overview.pigments[of.place]),
            100.0 * overview.present[of.place],
            100.0 * overview.mean_share[of.place],
            of.presence_file,
            of.share_file,
        );
        files.extend([(of.presence_file, of.presence), (of.share_file, of.share)]);
    }
    files.push((MapPictures::CHI2_FILE.to_owned(), pictures.chi2));
    files.push((MapPictures::RESIDUAL_FILE.to_owned(), pictures.residual));
    files.push((
        "maps.html".to_owned(),
        page(scan, overview, (&seen, &cells, &figures(spots))).into_bytes(),
    ));
    let names = files.iter().map(|(name, _)| name.clone());
    let outputs = folder.outputs(names)?;
    outputs.into_iter().zip(files).try_for_each(|(output, (_, content))| output.put(content))
}

/// A chart of each spot: the measured spectrum as dots, that of the mapped mixture as a line.
fn figures(spots: &[Spot]) -> String {
    if spots.is_empty() {
        return String::new();
    }
    let width = 460.0;
    let height = 220.0;
    let mut all = "<h2>Spots</h2><p>Dots: measured. Line: the mapped mixture.</p>\n".to_owned();
    for spot in spots {
        let ends = [spot.mapped_nm.first(), spot.mapped_nm.last()];
        let [first, last] = ends.map(|nm| nm.copied().unwrap_or_default());
        let most = spot.measured.iter().chain(&spot.mapped).copied().fold(0.1, f64::max);
        let x = |nm: f64| 40.0 + (width - 50.0) * (nm - first) / (last - first).max(1.0);
        let y = |value: f64| height - 30.0 - (height - 45.0) * value / most;
        let line: Vec<String> = spot
            .mapped_nm
            .iter()
            .zip(&spot.mapped)
            .map(|(nm, value)| format!("{:.1},{:.1}", x(*nm), y(*value)))
            .collect();
        let dots: String = spot
            .measured_nm
            .iter()
            .zip(&spot.measured)
            .map(|(nm, value)| {
                format!("<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2.5\"/>", x(*nm), y(*value))
            })
            .collect();
        let pigments = spot.pigments.iter().map(|pigment| {
            let [share, sd] = [pigment.share, pigment.share_sd].map(|part| 100.0 * part);
            format!("{} {share:.0} &plusmn; {sd:.0} %", escaped(&pigment.name))
        });
        all += &format!(
            "<h3>{}</h3><p>{}; residual {:.4}, chi-square {:.2}</p>\
             <svg viewBox=\"0 0 {width} {height}\" style=\"max-width:{width}px;width:100%\" fill=\"currentColor\">\
             <polyline points=\"{}\" fill=\"none\" stroke=\"#d2691e\" stroke-width=\"2\"/>{dots}\
             <text x=\"40\" y=\"{:.0}\" font-size=\"12\">{first:.0} nm</text>\
             <text x=\"{:.0}\" y=\"{:.0}\" font-size=\"12\" text-anchor=\"end\">{last:.0} nm</text>\
             <text x=\"2\" y=\"{:.0}\" font-size=\"12\">{most:.2}</text>\
             <text x=\"2\" y=\"{:.0}\" font-size=\"12\">0</text></svg>\n",
            spot.place_words(),
            pigments.collect::<Vec<_>>().join(", "),
            spot.rms,
            spot.chi2,
            line.join(" "),
            height - 12.0,
            width - 8.0,
            height - 12.0,
            y(most) + 4.0,
            y(0.0) + 4.0,
        );
    }
    all
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}

/// A bar with the colours of a ramp and its ends in words.
fn legend(ramp: &Ramp, ends: [&str; 2]) -> String {
    let [from, to] = [ramp.from.1, ramp.to.1].map(|[r, g, b]| format!("rgb({r},{g},{b})"));
    let [first, last] = ends;
    format!(
        "<span class=\"key\">{first} <i style=\"background:linear-gradient(90deg,{from},{to})\"></i> {last}</span>"
    )
}

fn page(
    scan: &SurveyedScan,
    overview: &Overview,
    (seen, cells, spots): (&str, &str, &str),
) -> String {
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
         more likely than not, and its mean share. Presence: {presence}; share: white for none, the colour of the \
         pigment for all (a pale pigment is shown darker); striped in grey: not mapped.</p>\n{groups}\n{seen}\
         <table><tr><th>pigment</th><th>present</th><th>mean share</th><th>presence</th><th>share</th></tr>\n\
         {cells}</table>\n\
         <h2>How well the spectra are explained</h2>\n\
         <p>Left: chi-square per degree of freedom, {chi2}; where it is high, the \
         library may lack a pigment, or the film does not hide. Right: residual in reflectance, {residual}.</p>\n\
         <p><img src=\"chi2.png\" alt=\"chi-square\"> <img src=\"residual.png\" alt=\"residual\"></p>\n\
         {spots}<p class=\"small\">library {}<br>survey {}<br>scan {}</p>\n</body></html>\n",
        about.rows.len(),
        about.columns.len(),
        overview.pixels.of(maps::pixel_maps::Mask::Mapped),
        overview.step,
        about.library_sha256,
        about.book_sha256,
        about.scan,
        step = overview.step,
        presence = legend(&MapPictures::PRESENCE, ["0", "1"]),
        chi2 = legend(&MapPictures::CHI2, ["0", "4 and more"]),
        residual = legend(&MapPictures::RESIDUAL, ["0", "0.05 and more"]),
    )
}

/// Style of the page: readable in light and dark, and on narrow screens.
const STYLE: &str = "body{font:16px/1.5 sans-serif;margin:1rem auto;max-width:75rem;padding:0 1rem}\
    img{max-width:100%;min-width:8rem}.key i{display:inline-block;width:5rem;height:.8rem;border:1px solid #888}\
    table{border-collapse:collapse;display:block;overflow-x:auto}td,th{padding:.3rem .6rem;text-align:left;\
    vertical-align:top}td:nth-child(2),td:nth-child(3){white-space:nowrap}.small{font-size:.75rem;overflow-wrap:anywhere}\
    @media(prefers-color-scheme:dark){body{background:#222;color:#eee}}";
