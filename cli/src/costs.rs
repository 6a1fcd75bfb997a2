//! What each pigment costs.

use std::path::Path;

use anyhow::Context;
use calibrate::library::PigmentLibrary;

use crate::failure::Refusal;

/// The price of one gram of each pigment of `library`, from texts NAME=PRICE and
/// paths of CSV files with the columns `pigment` and `price`; nothing from no
/// text. Each of `needed` must have one.
pub(crate) fn costs(
    texts: &[String],
    library: &PigmentLibrary,
    needed: &[usize],
) -> anyhow::Result<Vec<f64>> {
    if texts.is_empty() {
        return Ok(Vec::new());
    }
    let mut found: Vec<Option<f64>> = vec![None; library.pigments.len()];
    for text in texts {
        if Path::new(text).is_file() {
            read(text, library, &mut found)?;
            continue;
        }
        let (name, price) = text.rsplit_once('=').ok_or_else(|| {
            Refusal::usage(
                format!("--cost takes NAME=PRICE or a CSV file that exists, found `{text}`"),
                "try --cost \"Cobalt Blue=0.9\" or --cost prices.csv",
            )
        })?;
        found[library.find(name)?] = Some(price_of(price, text)?);
    }
    let lacking: Vec<&str> = needed
        .iter()
        .filter(|index| found[**index].is_none())
        .map(|index| library.pigments[*index].name.as_str())
        .collect();
    if !lacking.is_empty() {
        return Err(Refusal::data(
            format!("no price for {}", lacking.join(", ")),
            "price every pigment that may take part, or leave some out with --without or --only",
        ));
    }
    Ok(found.into_iter().map(|price| price.unwrap_or(0.0)).collect())
}

fn price_of(text: &str, place: &str) -> anyhow::Result<f64> {
    let price = text.trim().parse().ok().filter(|price: &f64| price.is_finite() && *price >= 0.0);
    price.ok_or_else(|| {
        Refusal::data(
            format!("{place}: a price of 0 or more is wanted, found `{}`", text.trim()),
            "numbers take a decimal point, without a currency",
        )
    })
}

fn read(file: &str, library: &PigmentLibrary, found: &mut [Option<f64>]) -> anyhow::Result<()> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(file)
        .with_context(|| format!("{file}: cannot be read"))?;
    let headers = reader.headers().with_context(|| format!("{file}: no table of prices"))?.clone();
    let column = |name: &str| {
        headers.iter().position(|header| header.eq_ignore_ascii_case(name)).ok_or_else(|| {
            Refusal::data(
                format!("{file}, row 1: no column `{name}`"),
                "the first row is `pigment,price`; commas part the columns",
            )
        })
    };
    let (pigment, price) = (column("pigment")?, column("price")?);
    for record in reader.records() {
        let record = record.with_context(|| format!("{file}: no table of prices"))?;
        let row = record.position().map_or(0, csv::Position::line);
        let place = format!("{file}, row {row}");
        let name = record.get(pigment).unwrap_or_default();
        let known = library.find(name).with_context(|| format!("{place}, column `pigment`"));
        found[known?] = Some(price_of(record.get(price).unwrap_or_default(), &place)?);
    }
    Ok(())
}
