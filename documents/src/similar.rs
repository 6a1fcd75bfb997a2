//! Names that are spelt like another.

/// Most names that a suggestion holds.
const MOST: usize = 3;

/// Up to three of `known` that are spelt like `name`, the most similar first.
///
/// ```
/// use documents::similar_names;
/// assert_eq!(similar_names("viridan", ["Viridian", "Zinc White"]), ["Viridian"]);
/// ```
#[must_use]
pub fn similar_names<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let name: Vec<char> = name.to_lowercase().chars().take(100).collect();
    let mut ranked: Vec<_> = known
        .into_iter()
        .map(|other| {
            let letters: Vec<char> = other.to_lowercase().chars().collect();
            (edit_distance(&name, &letters), other)
        })
        .filter(|(edits, other)| *edits <= (name.len().max(other.len()) / 3).max(1))
        .collect();
    ranked.sort_unstable();
    ranked.into_iter().take(MOST).map(|(_, other)| other).collect()
}

/// The question "did you mean A or B?" with the names of `known` that are spelt like `name`;
/// `None` if there are none.
///
/// ```
/// use documents::did_you_mean;
/// let question = did_you_mean("Zink White", ["Viridian", "Zinc White"]);
/// assert_eq!(question.as_deref(), Some("did you mean Zinc White?"));
/// ```
#[must_use]
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let similar = similar_names(name, known);
    (!similar.is_empty()).then(|| format!("did you mean {}?", similar.join(" or ")))
}

/// Edit distance between `a` and `b` (Levenshtein 1966): insertions, deletions and
/// substitutions of letters.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, left) in a.iter().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, right) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(left != right);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_pigment_finds_its_name() {
        let known = ["Zinc White", "Prussian Blue", "Viridian", "Cobalt Blue"];
        assert_eq!(similar_names("prusian blue", known), ["Prussian Blue"]);
        assert_eq!(similar_names("Viridan", known), ["Viridian"]);
        assert!(similar_names("Octarine", known).is_empty(), "no similar name");
        let series = ["FL3.1", "FL3.2", "FL3.3", "FL3.4", "FL3"];
        assert_eq!(similar_names("fl3.4", series), ["FL3.4", "FL3.1", "FL3.2"], "three at most");
        assert_eq!(edit_distance(&['a', 'b'], &['b', 'a', 'c']), 2);
    }
}
