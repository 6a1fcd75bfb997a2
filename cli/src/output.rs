//! Files that are written whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::NamedTempFile;

/// A file to be. Opened before the slow part, so that a path that cannot be
/// written is told at once; if dropped unwritten it leaves nothing behind.
pub(crate) struct Output {
    path: PathBuf,
    file: NamedTempFile,
}

impl Output {
    /// Opens a temporary file beside `path`.
    pub(crate) fn open(path: &Path) -> anyhow::Result<Self> {
        let cannot = || format!("{}: cannot be written", path.display());
        if path.is_dir() {
            anyhow::bail!("{}: is a folder, a file is wanted", path.display());
        }
        let folder = match path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".impasto-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As for any new file; the user's mask takes its share.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let file = builder.tempfile_in(folder).with_context(cannot)?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// Writes `text` and gives the file its name.
    pub(crate) fn write(mut self, text: &str) -> anyhow::Result<()> {
        let path = self.path;
        let cannot = || format!("{}: cannot be written", path.display());
        self.file.write_all(text.as_bytes()).with_context(cannot)?;
        self.file.as_file().sync_all().with_context(cannot)?;
        self.file.persist(&path).with_context(cannot)?;
        Ok(())
    }
}
