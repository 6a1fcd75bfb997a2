//! Ages and file sizes in words.

use web_time::{Duration, SystemTime};

use crate::language::{tr, tr_format};

/// The age of `then` at the time `now`, such as `3 minutes ago`.
#[must_use]
pub fn ago(then: SystemTime, now: SystemTime) -> String {
    let seconds = now.duration_since(then).unwrap_or(Duration::ZERO).as_secs();
    let (count, [one, many]) = match seconds {
        0..60 => return tr("just now").to_owned(),
        60..3600 => (seconds / 60, [tr("minute"), tr("minutes")]),
        3600..86_400 => (seconds / 3600, [tr("hour"), tr("hours")]),
        86_400..5_184_000 => (seconds / 86_400, [tr("day"), tr("days")]),
        5_184_000..63_072_000 => (seconds / 2_592_000, [tr("month"), tr("months")]),
        _ => (seconds / 31_536_000, [tr("year"), tr("years")]),
    };
    let unit = if count == 1 { one } else { many };
    tr_format!("{count} {unit} ago", count, unit)
}

/// A file size in decimal units, such as `12.3 MB`.
#[must_use]
pub fn size(bytes: u64) -> String {
    match bytes {
        0..1000 => format!("{bytes} B"),
        1000..1_000_000 => format!("{:.0} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_and_sizes_in_words() {
        let now = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000_000);
        for (seconds, words) in [
            (5, "just now"),
            (60, "1 minute ago"),
            (7300, "2 hours ago"),
            (90_000, "1 day ago"),
            (70_000_000, "2 years ago"),
        ] {
            assert_eq!(ago(now - Duration::from_secs(seconds), now), words);
        }
        assert_eq!(ago(now + Duration::from_secs(60), now), "just now", "a clock set back");
        for (bytes, words) in [(999, "999 B"), (12_400, "12 kB"), (12_340_000, "12.3 MB")] {
            assert_eq!(size(bytes), words);
        }
    }
}
