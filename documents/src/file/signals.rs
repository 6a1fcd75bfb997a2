//! Signals that end the program: temporary files are removed first.

/// Watches for SIGINT (Ctrl-C), SIGTERM and SIGHUP on a thread of its own. The first of them
/// removes the temporary files of writes under way and ends the process by this signal, so that a
/// shell sees the exit status 128 + its number. If you started the process to ignore a signal, e.g.
/// SIGHUP with `nohup`, this still ignores it.
#[cfg(unix)]
pub fn end_cleanly_on_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

    let wanted = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal));
    let Ok(mut signals) = signal_hook::iterator::Signals::new(wanted) else { return };
    std::thread::spawn(move || {
        let Some(signal) = signals.forever().next() else { return };
        super::abandon_writes();
        let _ = signal_hook::low_level::emulate_default_handler(signal);
        std::process::exit(128 + signal);
    });
}

/// Does nothing, because this system has no such signals.
#[cfg(not(unix))]
pub fn end_cleanly_on_signals() {}

/// Whether the process was started to ignore a signal. Linux lists the signals as bits. If the
/// system does not list them, we leave SIGHUP alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let Ok(status) = std::fs::read_to_string("/proc/self/status") else {
        return signal == signal_hook::consts::SIGHUP;
    };
    let bits = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let bits = bits.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok()).unwrap_or(0);
    bits & (1 << (signal - 1)) != 0
}
