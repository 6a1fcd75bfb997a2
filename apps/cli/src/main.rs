//! The program `impasto`.

use std::io::{ErrorKind, IsTerminal, Write, stderr, stdout};
use std::process::ExitCode;

use impasto::Screen;

fn main() -> ExitCode {
    documents::file::end_cleanly_on_signals();
    let is_dumb = std::env::var_os("TERM").is_some_and(|terminal| terminal == "dumb");
    let wants_colors = std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let colors = stdout().is_terminal() && wants_colors && !is_dumb;
    let mut out = std::io::BufWriter::new(stdout().lock());
    let screen = Screen { colors, progress: stderr().is_terminal() && !is_dumb, owns_errors: true };
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
