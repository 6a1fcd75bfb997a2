//! Files in one input, so that damage reaches all of them.

use std::path::Path;

/// Begins the line before each file but the first.
const MARK: &str = "\n@@ ";

/// Names and bytes of files.
pub(crate) type Files = Vec<(String, Vec<u8>)>;

/// One input of a main file, which may be empty, and of others with their paths.
pub(crate) fn joined<'f>(
    main: &[u8],
    others: impl IntoIterator<Item = (&'f str, &'f [u8])>,
) -> Vec<u8> {
    let mut bytes = main.to_vec();
    for (path, content) in others {
        bytes.extend_from_slice(MARK.as_bytes());
        bytes.extend_from_slice(path.as_bytes());
        bytes.push(b'\n');
        bytes.extend_from_slice(content);
    }
    bytes
}

/// One input of all files in a folder.
pub(crate) fn joined_folder(folder: &Path) -> Vec<u8> {
    let files = files_below(folder, folder.file_name().unwrap().to_str().unwrap());
    joined(&[], files.iter().map(|(path, content)| (path.as_str(), content.as_slice())))
}

fn files_below(folder: &Path, name: &str) -> Files {
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let named = paths.iter().map(|path| {
        let name = format!("{name}/{}", path.file_name().unwrap().to_str().unwrap());
        match path.is_dir() {
            true => files_below(path, &name),
            false => vec![(name, std::fs::read(path).unwrap())],
        }
    });
    named.flatten().collect()
}

/// The main file of an input, and the others. A damaged path may be any text.
pub(crate) fn parts(bytes: &[u8]) -> (&[u8], Files) {
    let starts: Vec<usize> = marks(bytes).map(|start| start + MARK.len()).collect();
    let main = starts.first().map_or(bytes, |start| &bytes[..start - MARK.len()]);
    let ends = starts.iter().skip(1).map(|start| start - MARK.len()).chain([bytes.len()]);
    let others = starts.iter().zip(ends).filter_map(|(start, end)| {
        let part = bytes.get(*start..end)?;
        let line = part.iter().position(|byte| *byte == b'\n')?;
        Some((String::from_utf8_lossy(&part[..line]).into_owned(), part[line + 1..].to_vec()))
    });
    (main, others.collect())
}

/// The places of all marks.
fn marks(bytes: &[u8]) -> impl Iterator<Item = usize> {
    let windows = bytes.windows(MARK.len()).enumerate();
    windows.filter(|(_, window)| *window == MARK.as_bytes()).map(|(start, _)| start)
}

/// Whether a path stays below the folder of the test.
fn is_inside(path: &str) -> bool {
    let is_name = |name: &str| {
        (1..=60).contains(&name.len())
            && !name.starts_with("..")
            && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte))
    };
    path.split('/').count() <= 8 && path.split('/').all(is_name)
}

/// Writes the files of an input and reads what they hold.
pub(crate) fn on_disk(
    name: &str,
    bytes: &[u8],
    read: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), String> {
    // Files in memory, where there is such a folder.
    let memory = Path::new("/dev/shm");
    let folder = match memory.is_dir() {
        true => tempfile::tempdir_in(memory).unwrap(),
        false => tempfile::tempdir().unwrap(),
    };
    let (main, others) = parts(bytes);
    let path = folder.path().join(name);
    if !main.is_empty() || others.is_empty() {
        std::fs::write(&path, main).unwrap();
    }
    for (other, content) in others.iter().filter(|(other, _)| is_inside(other)) {
        let other = folder.path().join(other);
        // A damaged path may name a folder, or lie below a file.
        if std::fs::create_dir_all(other.parent().unwrap()).is_ok() {
            std::fs::write(other, content).ok();
        }
    }
    read(&path)
}

#[test]
fn files_in_one_input_are_found_again_and_stay_in_their_folder() {
    let input = joined(b"main\n", [("a.bin", &b"1\n@ 2"[..]), ("b/c.txt", b"")]);
    let (main, others) = parts(&input);
    assert_eq!(main, b"main\n");
    let wanted = [("a.bin", &b"1\n@ 2"[..]), ("b/c.txt", b"")];
    assert_eq!(others, wanted.map(|(name, bytes)| (name.to_owned(), bytes.to_vec())));
    assert!(is_inside("b/c.txt") && is_inside(".lock"));
    for path in ["../a", "/etc/passwd", "a//b", "a/../../b", "", "a\0b", "a\u{e9}"] {
        assert!(!is_inside(path), "{path:?}");
    }
}
