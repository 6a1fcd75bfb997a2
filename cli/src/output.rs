//! Files that are written whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use tempfile::NamedTempFile;

use crate::failure::Refusal;

/// A file to be, known to be writable.
pub(crate) struct Output {
    /// Where the user wants it.
    path: PathBuf,
    /// The same with links followed: a link keeps pointing where it does.
    target: PathBuf,
}

impl Output {
    /// Checks, before the slow part, that `path` can be written and is none of
    /// `inputs`.
    pub(crate) fn open(path: &Path, inputs: &[PathBuf]) -> anyhow::Result<Self> {
        let target = path.canonicalize().or_else(|_| std::path::absolute(path));
        let target = target.with_context(|| format!("{}: cannot be written", path.display()))?;
        if target.exists() && !target.is_file() {
            return Err(Refusal::usage(
                format!("{}: an ordinary file is wanted", path.display()),
                "leave out --output and redirect what --json prints",
            ));
        }
        let same = |input: &PathBuf| input.canonicalize().is_ok_and(|input| input == target);
        if inputs.iter().any(same) {
            return Err(Refusal::usage(
                format!("{}: is an input, which is never written over", path.display()),
                "give the output a name of its own",
            ));
        }
        let output = Self { path: path.to_owned(), target };
        output.beside()?;
        Ok(output)
    }

    /// Where the user wants it.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Whether both would be the same file.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        self.target == other.target
    }

    /// Writes `content` to a temporary file and gives that the wanted name.
    pub(crate) fn write(self, content: impl AsRef<[u8]>) -> anyhow::Result<()> {
        let mut file = self.beside()?;
        let cannot = || self.unwritable();
        file.write_all(content.as_ref()).with_context(cannot)?;
        file.as_file().sync_all().with_context(cannot)?;
        if let Ok(before) = std::fs::metadata(&self.target) {
            file.as_file().set_permissions(before.permissions()).with_context(cannot)?;
        }
        file.persist(&self.target).with_context(cannot)?;
        Ok(())
    }

    /// A temporary file in the same folder; gone when dropped.
    fn beside(&self) -> anyhow::Result<NamedTempFile> {
        let folder = match self.target.parent() {
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
        builder.tempfile_in(folder).with_context(|| self.unwritable())
    }

    fn unwritable(&self) -> String {
        format!("{}: cannot be written", self.path.display())
    }
}
