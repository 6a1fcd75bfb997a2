//! Styles that ship, as text.

/// Names and TOML files of the styles, in the order in which programs list them.
pub(super) const SHIPPED: [(&str, &str); 6] = [
    ("oil-flat", include_str!("styles/oil-flat.toml")),
    ("oil-long", include_str!("styles/oil-long.toml")),
    ("dabs", include_str!("styles/dabs.toml")),
    ("knife", include_str!("styles/knife.toml")),
    ("hatching", include_str!("styles/hatching.toml")),
    ("dry-brush", include_str!("styles/dry-brush.toml")),
];

/// Names of the styles.
pub(super) const NAMES: [&str; SHIPPED.len()] = {
    let mut names = [""; SHIPPED.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = SHIPPED[at].0;
        at += 1;
    }
    names
};
