//! Prints the colour of every reflectance spectrum in an instrument's file:
//! `cargo run -p impasto-spectra --example color_of_a_file [FILE] [LIGHT]`.

#![expect(clippy::print_stdout, reason = "an example prints its result")]

use spectra::Viewing;
use spectra::color::delta_e_ciede2000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let shipped = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/paints.csv");
    let path = arguments.next().unwrap_or_else(|| shipped.to_owned());
    let light = arguments.next().unwrap_or_else(|| "D65".to_owned());

    let file = spectra::read_spectra(path)?;
    let viewing = Viewing::named(&light, "1931-2")?;
    let mut first = None;
    for measured in &file.spectra {
        let color = viewing.color(&measured.reflectance()?)?;
        let difference = delta_e_ciede2000(*first.get_or_insert(color.lab), color.lab);
        let [lightness, a, b] = color.lab.to_array();
        println!(
            "{:16} {}  Lab {lightness:5.1} {a:5.1} {b:5.1}, CIEDE2000 from the first {difference:.1}",
            measured.name,
            color.hex()
        );
    }
    Ok(())
}
