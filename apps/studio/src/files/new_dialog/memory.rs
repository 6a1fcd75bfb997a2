//! Memory that the machine has free.

use std::path::Path;

/// Memory in bytes that programs can still take; `None` where the system does not tell.
#[must_use]
pub(super) fn free_bytes() -> Option<u64> {
    let text = std::fs::read_to_string(Path::new("/proc/meminfo")).ok()?;
    available(&text)
}

/// The line `MemAvailable` of Linux, in bytes.
fn available(meminfo: &str) -> Option<u64> {
    let line = meminfo.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kib.checked_mul(1024)
}

/// Bytes as MiB in words, such as `178 MiB`.
#[must_use]
pub(super) fn in_mib(bytes: u64) -> String {
    format!("{} MiB", bytes.div_ceil(1 << 20))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_free_memory_of_linux_is_read() {
        let text = "MemTotal:       16309468 kB\nMemFree:  1 kB\nMemAvailable:    2048 kB\n";
        assert_eq!(available(text), Some(2048 * 1024));
        assert_eq!(available("MemTotal: 5 kB\n"), None);
        assert_eq!(free_bytes().is_some(), cfg!(target_os = "linux"));
        assert_eq!(in_mib(186_624_000), "178 MiB");
    }
}
