//! The program `impasto`.

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

use impasto::Screen;

fn main() -> ExitCode {
    let colors =
        stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let mut out = std::io::BufWriter::new(stdout().lock());
    let screen = Screen { colors, progress: stderr().is_terminal() };
    let code = impasto::run(std::env::args_os(), &mut out, &mut stderr(), screen);
    // A reader that closed the pipe has seen enough; a full disk has not.
    match out.flush() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let _ = writeln!(stderr(), "error: the results cannot be written: {error}");
            ExitCode::from(2)
        }
        _ => ExitCode::from(code),
    }
}
