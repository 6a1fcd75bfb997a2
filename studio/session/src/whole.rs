//! Files that are written whole or not at all.

use std::fs::File;
use std::io::Write;
use std::path::Path;

use tempfile::NamedTempFile;

use super::failure::FileFailure;

/// Writes `bytes` to a temporary file beside `path`, and gives that its name when
/// all of it is on the disk. A link keeps pointing where it does, and a file keeps
/// its permissions.
///
/// # Errors
/// [`FileFailure`]; what stood at `path` stays.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileFailure> {
    let target = path.canonicalize().or_else(|_| std::path::absolute(path));
    let written = target.and_then(|target| {
        let folder = target.parent().unwrap_or(Path::new("."));
        let mut file = beside(folder)?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        if let Ok(before) = std::fs::metadata(&target) {
            if !before.is_file() {
                return Err(std::io::Error::other("this is no ordinary file"));
            }
            file.as_file().set_permissions(before.permissions())?;
        }
        file.persist(&target)?;
        sync_folder(folder);
        Ok(())
    });
    written.map_err(|error| FileFailure::io(path, "written", &error))
}

/// Makes what was renamed in `folder` last through a loss of power, where the
/// system can.
pub fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

fn beside(folder: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".impasto-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As for any new file; the user's mask takes its share.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_written_whole_and_leaves_nothing_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write(&path, b"one").unwrap();
        write(&path, b"two").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"two");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn what_cannot_be_written_tells_the_file_and_leaves_no_trace() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("missing").join("a.txt");
        let error = write(&inside, b"one").unwrap_err();
        assert!(error.what.contains("missing"), "{error}");
        std::fs::create_dir(folder.path().join("b.exr")).unwrap();
        write(&folder.path().join("b.exr"), b"one").unwrap_err();
        assert_eq!(names(folder.path()), ["b.exr"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_pointing_where_it_does() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.txt"), folder.path().join("link.txt"));
        write(&file, b"one").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"two").unwrap();
        assert_eq!(std::fs::read(&file).unwrap(), b"two");
        assert!(link.is_symlink(), "the link was written over");
    }
}
