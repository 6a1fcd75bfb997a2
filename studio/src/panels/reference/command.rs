//! The command that goes on with a drawing.

use std::path::Path;

/// Command that takes samples of `picture` by the marks in a file.
pub(super) fn sample_command(picture: &Path, marks: &Path) -> String {
    let samples = picture.with_extension("samples.exr");
    let sheet = picture.with_extension("samples.png");
    let [picture, marks, samples, sheet] = [picture, marks, &samples, &sheet].map(quoted);
    format!("impasto artmap sample {picture} --marks {marks} --output {samples} --sheet {sheet}")
}

/// A path as a word of a shell.
fn quoted(path: &Path) -> String {
    let text = path.to_string_lossy();
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"/._-".contains(&byte);
    if !text.is_empty() && text.bytes().all(plain) && !text.starts_with('-') {
        return text.into_owned();
    }
    let dash = if text.starts_with('-') { "./" } else { "" };
    format!("'{dash}{}'", text.replace('\'', "'\\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_words_of_a_shell() {
        let command = sample_command(Path::new("a b/o'k.png"), Path::new("m.toml"));
        let wanted = "impasto artmap sample 'a b/o'\\''k.png' --marks m.toml --output \
                      'a b/o'\\''k.samples.exr' --sheet 'a b/o'\\''k.samples.png'";
        assert_eq!(command, wanted);
        assert_eq!(quoted(Path::new("-x.png")), "'./-x.png'");
    }
}
