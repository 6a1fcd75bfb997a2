//! Paths that a script may save to: only below the folder chosen by its player.

/// `None` if a script may save to `path`, else a description of the paths allowed. A path
/// is relative, at most 255 bytes long, without `..`, hidden names, names of Windows
/// devices and characters that Windows forbids, and ends in `.exr` or `.png`.
pub(super) fn violation(path: &str) -> Option<&'static str> {
    if path.len() > 255 {
        return Some("a path of at most 255 bytes");
    }
    if path.contains(|letter: char| letter.is_control() || "\\:*?\"<>|".contains(letter)) {
        return Some("a path without control characters and \\ : * ? \" < > |");
    }
    for part in path.split('/') {
        if part.is_empty() || part.starts_with('.') || part.ends_with(['.', ' ']) {
            return Some("a path below the script's folder, without `..` and hidden names");
        }
        let stem = part.split('.').next().unwrap_or(part).trim_end().to_ascii_lowercase();
        let numbered = stem.strip_prefix("com").or_else(|| stem.strip_prefix("lpt"));
        let device = ["con", "prn", "aux", "nul"].contains(&stem.as_str())
            || numbered.is_some_and(|rest| rest.len() == 1 && rest != "0");
        if device {
            return Some("a file, not a device");
        }
    }
    let lower = path.to_ascii_lowercase();
    let known = [".exr", ".png"].iter().any(|ending| lower.ends_with(ending));
    (!known).then_some("a path that ends in .exr or .png")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_save_below_their_folder_only() {
        for path in ["a.exr", "out/a b.png", "sub/dir/x.EXR", "compass.png", "x.y.png"] {
            assert_eq!(violation(path), None, "{path}");
        }
        for path in [
            "",
            "/a.exr",
            "../a.exr",
            "a/../../b.exr",
            "a//b.exr",
            "./a.exr",
            ".bashrc",
            "a/.b.png",
            "C:\\a.exr",
            "C:a.exr",
            "\\\\host\\a.exr",
            "a.sh",
            "a",
            "a.exr/",
            "nul.exr",
            "COM1.png",
            "a\n.exr",
            "a\0.exr",
            "~",
            "a.exr.",
            "a.exr ",
            "a /b.exr",
        ] {
            assert!(violation(path).is_some(), "{path:?}");
        }
        assert!(violation(&format!("{}.exr", "a".repeat(300))).is_some(), "too long");
    }
}
