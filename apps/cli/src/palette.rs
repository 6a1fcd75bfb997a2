//! Prices of pigments (the option `--cost`).

use std::path::Path;

use calibrate::matching::{PriceList, parse_price};
use documents::file::is_there;

use crate::failure::{Failure, Result};

/// Reads prices from texts `NAME=PRICE` and from CSV files with the columns `pigment` and `price`.
pub(crate) fn prices(texts: &[String]) -> Result<PriceList> {
    let mut prices = PriceList::default();
    for text in texts {
        if is_there(Path::new(text)) {
            prices.add_file(text)?;
            continue;
        }
        let (name, price) = text.rsplit_once('=').ok_or_else(|| {
            Failure::usage(
                format!("--cost takes NAME=PRICE or an existing CSV file, found `{text}`"),
                "try --cost \"Cobalt Blue=0.9\" or --cost prices.csv",
            )
        })?;
        prices.set(name, parse_price(price, text)?)?;
    }
    Ok(prices)
}
