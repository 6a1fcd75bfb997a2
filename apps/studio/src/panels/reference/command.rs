//! The commands that go on with a drawing.

use std::path::Path;

/// Command that takes samples of `picture` by the marks in a file.
pub(super) fn sample_command(picture: &Path, marks: &Path) -> String {
    let samples = picture.with_extension("samples.exr");
    let sheet = picture.with_extension("samples.png");
    let [picture, marks, samples, sheet] = [picture, marks, &samples, &sheet].map(quoted);
    format!("impasto artmap sample {picture} --marks {marks} --output {samples} --sheet {sheet}")
}

/// Command that paints a picture along the guides in a file; with a camera a model, whose name is
/// left open.
pub(super) fn paint_command(picture: &Path, camera: Option<[f32; 3]>, guides: &Path) -> String {
    let painted = quoted(&picture.with_extension("painted.png"));
    let subject = match camera {
        Some([around, above, view]) => format!("MODEL --camera {around},{above},{view}"),
        None => quoted(picture),
    };
    let guides = quoted(guides);
    format!(
        "impasto painterly {subject} --style oil-flat --directions {guides} --picture {painted}"
    )
}

/// A path as a word of a shell.
fn quoted(path: &Path) -> String {
    let text = path.to_string_lossy();
    if !text.is_empty()
        && text.bytes().all(|byte: u8| byte.is_ascii_alphanumeric() || b"/._-".contains(&byte))
        && !text.starts_with('-')
    {
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

    #[test]
    fn guides_of_a_view_need_its_model_and_camera() {
        let command = |camera| paint_command(Path::new("a.png"), camera, Path::new("g.toml"));
        let rest = "--style oil-flat --directions g.toml --picture a.painted.png";
        assert_eq!(command(None), format!("impasto painterly a.png {rest}"));
        let model = "impasto painterly MODEL --camera 30,20.5,30";
        assert_eq!(command(Some([30.0, 20.5, 30.0])), format!("{model} {rest}"));
    }
}
