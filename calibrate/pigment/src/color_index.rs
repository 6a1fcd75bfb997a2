//! The pigments that a name, a Colour Index name such as `PB29` or the word of a hue fits, with the traditional names
//! of Colour Index names.
//!
//! The Colour Index (Society of Dyers and Colourists, American Association of Textile Chemists and Colorists) gives
//! each pigment a generic name: `P` or, for natural ones, `N`, then the hue, then a number. The traditional names here
//! are those that makers of artists' paints print beside it, which say the same of a paint without a Colour Index name.

/// The hues of Colour Index names, and the words that name them.
const HUES: [(&str, &[&str]); 10] = [
    ("BK", &["black"]),
    ("BR", &["brown"]),
    ("B", &["blue"]),
    ("G", &["green"]),
    ("M", &["metal"]),
    ("O", &["orange"]),
    ("R", &["red"]),
    ("V", &["violet", "purple"]),
    ("W", &["white"]),
    ("Y", &["yellow"]),
];

/// Colour Index names and the traditional names of their pigments, in lower case. Each word of a name must begin a word
/// of a paint's name.
const KNOWN: [(&str, &[&str]); 62] = [
    ("PW1", &["lead white", "flake white", "cremnitz"]),
    ("PW4", &["zinc white", "chinese white"]),
    ("PW5", &["lithopone"]),
    ("PW6", &["titanium white", "titan white"]),
    ("PW18", &["calcium carbonate", "chalk", "whiting"]),
    ("PW20", &["mica"]),
    ("PW21", &["barium sulphate", "barium sulfate", "blanc fixe"]),
    ("PW22", &["baryte", "barite"]),
    ("PBk6", &["lamp black"]),
    ("PBk7", &["carbon black"]),
    ("PBk8", &["vine black", "charcoal black"]),
    ("PBk9", &["bone black", "ivory black"]),
    ("PBk11", &["mars black"]),
    ("PB15", &["phthalo blue", "phthalocyanine blue"]),
    ("PB27", &["prussian blue", "milori blue"]),
    ("PB28", &["cobalt blue"]),
    ("PB29", &["ultramarine"]),
    ("PB30", &["azurite"]),
    ("PB31", &["egyptian blue"]),
    ("PB32", &["smalt"]),
    ("PB33", &["manganese blue"]),
    ("PB35", &["cerulean"]),
    ("PB60", &["indanthrone"]),
    ("NB1", &["indigo"]),
    ("PG7", &["phthalo green", "phthalocyanine green"]),
    ("PG17", &["chromium oxide", "chrome oxide"]),
    ("PG18", &["viridian"]),
    ("PG19", &["cobalt green"]),
    ("PG20", &["verdigris"]),
    ("PG21", &["emerald green"]),
    ("PG22", &["scheele"]),
    ("PG23", &["green earth", "terre verte"]),
    ("PG39", &["malachite"]),
    ("PY1", &["hansa yellow"]),
    ("PY3", &["hansa yellow light"]),
    ("PY31", &["barium yellow", "lemon yellow"]),
    ("PY32", &["strontium yellow"]),
    ("PY34", &["chrome yellow"]),
    ("PY35", &["cadmium yellow", "cadmium lemon"]),
    ("PY36", &["zinc yellow"]),
    ("PY39", &["orpiment", "realgar"]),
    ("PY40", &["aureolin", "cobalt yellow"]),
    ("PY41", &["naples yellow"]),
    ("PY42", &["mars yellow"]),
    ("PY43", &["yellow ochre", "yellow ocher"]),
    ("NY24", &["gamboge"]),
    ("PO20", &["cadmium orange"]),
    ("PO21", &["chrome orange"]),
    ("PR83", &["alizarin"]),
    ("PR101", &["mars red", "venetian red", "indian red", "english red"]),
    ("PR102", &["red ochre", "red ocher", "hematite", "haematite"]),
    ("PR103", &["chrome red"]),
    ("PR105", &["minium", "red lead"]),
    ("PR106", &["vermilion", "cinnabar"]),
    ("PR108", &["cadmium red"]),
    ("NR4", &["cochineal", "carmine"]),
    ("NR9", &["madder"]),
    ("PV14", &["cobalt violet"]),
    ("PV16", &["manganese violet"]),
    ("PBr7", &["umber", "sienna"]),
    ("PBr8", &["manganese brown"]),
    ("NBr8", &["van dyke brown", "vandyke brown", "cassel earth"]),
];

/// A pigment's name, and the Colour Index name that its library states.
pub(crate) type NamedPigment<'a> = (&'a str, Option<&'a str>);

/// Places of the `pigments` that `name` fits, in the first way in which it fits any: as the name as it is written, the
/// name in any letter case, the start of a name, a Colour Index name, or words and hues.
pub(crate) fn fitting(pigments: &[NamedPigment<'_>], name: &str) -> Vec<usize> {
    if let Some(exact) = pigments.iter().position(|(own, _)| *own == name) {
        return vec![exact];
    }
    let lower = name.to_lowercase();
    if let Some(same) = pigments.iter().position(|(own, _)| own.to_lowercase() == lower) {
        return vec![same];
    }
    let wanted = plain_index_name(name);
    let starts = |(own, _): &NamedPigment<'_>| own.to_lowercase().starts_with(&lower);
    let is_indexed =
        |pigment: &NamedPigment<'_>| wanted.is_some() && index_name(*pigment) == wanted;
    let has_words = |pigment: &NamedPigment<'_>| {
        holds_words(pigment.0, name)
            || index_name(*pigment).is_some_and(|own| has_hue(&own, &lower))
    };
    let ways: [&dyn Fn(&NamedPigment<'_>) -> bool; 3] = [&starts, &is_indexed, &has_words];
    let found = ways.into_iter().map(|way| {
        let places = (0..pigments.len()).filter(|at| way(&pigments[*at]));
        places.collect::<Vec<usize>>()
    });
    match lower.is_empty() {
        true => Vec::new(),
        false => found.into_iter().find(|places| !places.is_empty()).unwrap_or_default(),
    }
}

/// Colour Index name that the library states, or that tradition gives a paint of this name.
fn index_name((name, stated): NamedPigment<'_>) -> Option<String> {
    match stated {
        Some(stated) => plain_index_name(stated),
        None => traditional_index_name(name),
    }
}

/// Names with commas and, before the last, `or`.
pub(crate) fn one_of(names: &[String]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
        _ => names.join(", "),
    }
}

/// A Colour Index name in its common form: `PB29` for `pb 29`, `P.B. 29`, `C.I. Pigment Blue 29` or `PB29:1`. `None` for
/// any other text.
fn plain_index_name(text: &str) -> Option<String> {
    let words =
        text.to_uppercase().replace("C.I.", " ").replace("PIGMENT", "P").replace("NATURAL", "N");
    let mut plain: String = words.chars().filter(|c| c.is_alphanumeric() || *c == ':').collect();
    for (letters, words) in HUES {
        for word in words {
            plain = plain.replace(&word.to_uppercase(), letters);
        }
    }
    let plain = plain.split(':').next().unwrap_or_default().to_owned();
    let kind = plain.strip_prefix(['P', 'N'])?;
    let at = kind.find(|c: char| c.is_ascii_digit())?;
    let (hue, number) = kind.split_at(at);
    let is_known = HUES.iter().any(|(letters, _)| *letters == hue);
    (is_known && number.len() <= 3 && number.bytes().all(|b| b.is_ascii_digit())).then_some(plain)
}

/// The Colour Index name, in the form of [`plain_index_name`], that tradition gives a paint called `name`.
fn traditional_index_name(name: &str) -> Option<String> {
    // Of several traditional names, the longest says most.
    let known = KNOWN.iter().flat_map(|(index, names)| names.iter().map(move |name| (index, name)));
    let fitting = known.filter(|(_, words)| holds_words(name, words));
    fitting.max_by_key(|(_, words)| words.len()).map(|(index, _)| index.to_uppercase())
}

/// The traditional names of a Colour Index name, for messages. Empty for other texts.
pub(crate) fn traditional_names(text: &str) -> &'static [&'static str] {
    let index = plain_index_name(text);
    let known = KNOWN.iter().find(|(known, _)| index.as_ref() == Some(&known.to_uppercase()));
    known.map_or(&[], |(_, names)| names)
}

/// Whether the Colour Index name `index`, in the form of [`plain_index_name`], has the hue that `word` names.
fn has_hue(index: &str, word: &str) -> bool {
    let hue = index[1..].trim_end_matches(|c: char| c.is_ascii_digit());
    HUES.iter().any(|(letters, words)| *letters == hue && words.contains(&word))
}

/// Whether every word of `words` begins a word of `name`, in any letter case.
fn holds_words(name: &str, words: &str) -> bool {
    let lower = name.to_lowercase();
    let own: Vec<&str> = split(&lower).collect();
    let wanted = words.to_lowercase();
    let mut wanted = split(&wanted).peekable();
    wanted.peek().is_some() && wanted.all(|word| own.iter().any(|own| own.starts_with(word)))
}

fn split(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colour_index_names_are_read_in_many_forms() {
        for (text, expected) in [
            ("PB29", Some("PB29")),
            ("pbk 9", Some("PBK9")),
            ("P.Br. 7", Some("PBR7")),
            ("C.I. Pigment Blue 15:3", Some("PB15")),
            ("Natural Red 4", Some("NR4")),
            ("Pigment White 6", Some("PW6")),
            ("PX1", None),
            ("P12", None),
            ("PB", None),
            ("Prussian Blue", None),
            ("Paint 12B", None),
        ] {
            assert_eq!(plain_index_name(text).as_deref(), expected, "{text}");
        }
    }

    #[test]
    fn paints_have_the_colour_index_name_of_their_tradition() {
        for (name, expected) in [
            ("Ultramarine", Some("PB29")),
            ("French Ultramarine deep", Some("PB29")),
            ("Chrome Yellow (Otero)", Some("PY34")),
            ("Titanium White 2", Some("PW6")),
            ("Raw Umber", Some("PBR7")),
            ("Eosin Lake", None),
            ("Sky", None),
        ] {
            assert_eq!(traditional_index_name(name).as_deref(), expected, "{name}");
        }
        for (index, names) in KNOWN {
            assert!(plain_index_name(index).is_some(), "{index}");
            let own = names.iter().map(|name| traditional_index_name(name));
            assert!(own.flatten().all(|found| found == index.to_uppercase()), "{index}");
        }
    }

    #[test]
    fn hues_have_words() {
        assert!(has_hue("PB29", "blue") && has_hue("PBK9", "black") && has_hue("NBR8", "brown"));
        assert!(!has_hue("PBK9", "blue") && !has_hue("PB29", "red"));
    }

    #[test]
    fn pigments_are_found_by_name_colour_index_and_words() {
        let paints = [
            ("Zinc White", None),
            ("Zinc White (linseed)", None),
            ("Eosin Lake (wax)", None),
            ("Eosin Lake", Some("PR90:1")),
            ("Bone Black", None),
            ("Cobalt Blue", None),
            ("Ultramarine", None),
            ("Prussian Blue", None),
            ("Chrome Yellow", None),
            ("Chrome Yellow (poppyseed)", None),
            ("Viridian", None),
            ("Emerald Green", None),
            ("Barium Sulphate", None),
            ("Phthalo Blue", Some("PB15:3")),
            ("viridian", None),
        ];
        for (text, expected) in [
            ("Zinc White", &["Zinc White"][..]),
            ("zinc white", &["Zinc White"]),
            ("Viridian", &["Viridian"]),
            ("viridian", &["viridian"]),
            ("cobalt", &["Cobalt Blue"]),
            ("PB29", &["Ultramarine"]),
            ("pb 29", &["Ultramarine"]),
            ("pb15", &["Phthalo Blue"]),
            ("Pigment Black 9", &["Bone Black"]),
            ("PR90", &["Eosin Lake"]),
            ("sulphate", &["Barium Sulphate"]),
            ("blue prussian", &["Prussian Blue"]),
            ("poppyseed", &["Chrome Yellow (poppyseed)"]),
            ("black", &["Bone Black"]),
            ("blue", &["Cobalt Blue", "Ultramarine", "Prussian Blue", "Phthalo Blue"]),
            ("PW4", &["Zinc White", "Zinc White (linseed)"]),
            ("zinc", &["Zinc White", "Zinc White (linseed)"]),
            ("PW6", &[]),
            ("", &[]),
            ("Octarine", &[]),
        ] {
            let found = fitting(&paints, text).into_iter().map(|at| paints[at].0);
            assert_eq!(found.collect::<Vec<_>>(), expected, "{text}");
        }
        assert_eq!(traditional_names("pw 6"), ["titanium white", "titan white"]);
        assert!(traditional_names("Octarine").is_empty());
    }
}
