//! Headings of colour coordinates in tables of instruments.

/// Coordinates of colour that are known by standing together, as tables of instruments write them.
const COORDINATES: [&[&str]; 6] = [
    &["L", "a", "b"],
    &["L", "C", "h"],
    &["L", "u", "v"],
    &["X", "Y", "Z"],
    &["x", "y", "Y"],
    &["R", "G", "B"],
];

/// Whether the heading at `index` is a coordinate of a colour, of which another stands beside it.
pub(super) fn is_coordinate(headings: &[String], index: usize) -> bool {
    let has = |name: &str| headings.iter().any(|heading| heading.trim() == name);
    let own = headings[index].trim();
    COORDINATES.iter().any(|set| {
        set.contains(&own) && has(set[0]) && set.iter().filter(|name| has(name)).count() > 1
    })
}
