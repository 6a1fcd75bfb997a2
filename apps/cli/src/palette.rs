//! Pigments of a library that you name in a list, and their prices (the option `--cost`).

use std::path::Path;

use calibrate::library::PigmentLibrary;
use calibrate::matching::{PriceList, parse_price};
use documents::file::is_there;
use paint::document::{Slots, palette_slots};

use crate::failure::{Failure, Result};

/// Finds the pigments that `--palette` names and puts them into the slots of a layer.
pub(crate) fn palette(lists: &[String], library: &PigmentLibrary) -> Result<Slots> {
    Ok(palette_slots(&pigment_names(lists, library), library)?)
}

/// Splits lists of pigment names at their commas, but not at a comma inside a name (see
/// [`listed`]).
pub(crate) fn pigment_names(lists: &[String], library: &PigmentLibrary) -> Vec<String> {
    let names = lists.iter().flat_map(|list| listed(list, library, |part| part));
    names.map(str::to_owned).collect()
}

/// Splits a list at its commas, but not inside a pigment's name. For example, `Madder (old, dry)`
/// is one part. We take the longest part in which `name_of` finds a pigment of the library. We do
/// not split inside brackets either.
pub(crate) fn listed<'t>(
    list: &'t str,
    library: &PigmentLibrary,
    name_of: fn(&str) -> &str,
) -> Vec<&'t str> {
    let is_name = |part: &str| {
        let name = name_of(part).trim().to_lowercase();
        library.pigments.iter().any(|pigment| pigment.name.to_lowercase() == name)
    };
    let closed = |part: &str| part.matches('(').count() <= part.matches(')').count();
    let commas = list.match_indices(',').map(|(at, _)| at);
    let ends: Vec<usize> = commas.chain([list.len()]).collect();
    let mut parts = Vec::new();
    let mut from = 0;
    while from <= list.len() {
        let ahead = || ends.iter().copied().filter(|end| *end >= from);
        let longest = ahead().rev().find(|end| is_name(&list[from..*end]));
        let end = longest
            .or_else(|| ahead().find(|end| closed(&list[from..*end])))
            .or_else(|| ahead().next())
            .unwrap_or(list.len());
        parts.push(list[from..end].trim());
        from = end + 1;
    }
    parts
}

/// The name in a part of a recipe, `NAME=SHARE` or a name alone.
pub(crate) fn name_in_recipe(part: &str) -> &str {
    match part.rsplit_once('=') {
        Some((name, share)) if !share.contains(',') => name,
        _ => part,
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_commas_are_whole() {
        let mut library = PigmentLibrary::van_gogh_oils();
        library.pigments[0].name = "Red, dark".to_owned();
        library.pigments[1].name = "Red".to_owned();
        library.pigments[2].name = "Eosin Lake (lead, wax)".to_owned();
        let names = |list: &str| pigment_names(&[list.to_owned()], &library).join("|");
        assert_eq!(names("Red, dark,Red , Viridian"), "Red, dark|Red|Viridian");
        assert_eq!(names("red,DARK,Red"), "red|DARK|Red");
        assert_eq!(names("Viridian,RED, DARK"), "Viridian|RED, DARK");
        assert_eq!(names("Eosin Lake (lead, wax),Red"), "Eosin Lake (lead, wax)|Red");
        // An unknown name is whole too, so that a message can tell it.
        assert_eq!(names("Red,Madder (old, dry),Mauve (a,b"), "Red|Madder (old, dry)|Mauve (a|b");
        assert_eq!([names(""), names("Red,")], ["", "Red|"]);
        let lists = ["Red".to_owned(), "Viridian,Red, dark".to_owned()];
        assert_eq!(pigment_names(&lists, &library), ["Red", "Viridian", "Red, dark"]);
        let parts = listed("Red, dark=2, Viridian=1,Red", &library, name_in_recipe);
        assert_eq!(parts, ["Red, dark=2", "Viridian=1", "Red"]);
    }
}
