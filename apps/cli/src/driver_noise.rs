//! Lines that graphics drivers and their libraries print to standard error by themselves, such as
//! "XDG_RUNTIME_DIR is invalid or not set in the environment".

use crate::console::Console;
use crate::failure::Result;

/// Calls `call`, and keeps what it prints to standard error from the terminal: with `--verbose` it is
/// told afterwards, line by line.
pub(crate) fn without_noise<T>(console: &mut Console<'_>, call: impl FnOnce() -> T) -> Result<T> {
    if !console.screen.owns_errors {
        return Ok(call());
    }
    let (result, noise) = caught::caught(call);
    for line in noise.lines().map(str::trim).filter(|line| !line.is_empty()) {
        console.detail(format!("graphics driver: {line}"))?;
    }
    Ok(result)
}

#[cfg(unix)]
mod caught {
    use std::fs::File;
    use std::io::{self, Read, Seek};
    use std::os::fd::OwnedFd;

    /// Standard error as it was, put back when dropped.
    struct PutBack(OwnedFd);

    impl Drop for PutBack {
        fn drop(&mut self) {
            let _ = rustix::stdio::dup2_stderr(&self.0);
        }
    }

    /// The result of `call`, and what was printed to standard error meanwhile.
    pub(super) fn caught<T>(call: impl FnOnce() -> T) -> (T, String) {
        let Ok((before, mut file)) = redirected() else { return (call(), String::new()) };
        let result = call();
        drop(before);
        let mut noise = Vec::new();
        let read = file.rewind().and_then(|()| file.read_to_end(&mut noise));
        let noise = read.map_or_else(|_| String::new(), |_| String::from_utf8_lossy(&noise).into());
        (result, noise)
    }

    fn redirected() -> io::Result<(PutBack, File)> {
        let file = tempfile::tempfile()?;
        let before = PutBack(rustix::io::dup(io::stderr())?);
        rustix::stdio::dup2_stderr(&file)?;
        Ok((before, file))
    }
}

#[cfg(not(unix))]
mod caught {
    /// The result of `call`.
    pub(super) fn caught<T>(call: impl FnOnce() -> T) -> (T, String) {
        (call(), String::new())
    }
}
