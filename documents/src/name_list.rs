//! Lists of names in messages.

/// The first `most` of `names`, and how many more there are: `a, b and 3 more`.
///
/// ```
/// use documents::name_list;
///
/// assert_eq!(name_list(&["a", "b", "c"], 2, ", "), "a, b and 1 more");
/// assert_eq!(name_list(&["a", "b"], 2, " or "), "a or b");
/// ```
#[must_use]
pub fn name_list<S: AsRef<str>>(names: &[S], most: usize, separator: &str) -> String {
    let shown: Vec<&str> = names.iter().take(most).map(AsRef::as_ref).collect();
    let shown = shown.join(separator);
    match names.len().saturating_sub(most) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
