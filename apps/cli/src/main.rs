//! The program `impasto`.

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

use impasto::Screen;

fn main() -> ExitCode {
    documents::file::end_cleanly_on_signals();
    let colors =
        stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let mut out = std::io::BufWriter::new(stdout().lock());
    let screen = Screen { colors, progress: stderr().is_terminal(), owns_errors: true };
    let code = impasto::run(std::env::args_os(), &mut out, &mut stderr(), screen);
    // A closed pipe is no error: the reader wants no more output.
    match out.flush() {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            let _ = writeln!(stderr(), "error: cannot write the results: {error}");
            ExitCode::from(2)
        }
        _ => ExitCode::from(code),
    }
}
