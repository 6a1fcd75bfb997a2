//! Memory and processor time of a running process, as Linux reports them.

use std::path::PathBuf;
use std::process::Child;
use std::time::Duration;

/// Ticks of the processor time in a second, as Linux reports it on all common machines.
const TICKS: f64 = 100.0;

/// A program is at rest if it takes a smaller share of a core than this. Even then it draws a frame
/// a second for its performance log.
const REST: f64 = 0.2;

/// We wait for rest at most this many seconds.
const LONGEST: usize = 120;

pub(crate) struct Usage {
    folder: PathBuf,
}

impl Usage {
    pub(crate) fn of(child: &Child) -> Self {
        Self { folder: PathBuf::from(format!("/proc/{}", child.id())) }
    }

    /// Waits until the process has been at rest for two seconds.
    pub(crate) fn settle(&self) {
        let mut still = 0;
        for _ in 0..LONGEST {
            let before = self.processor_seconds();
            std::thread::sleep(Duration::from_secs(1));
            let rests = self.processor_seconds() - before < REST;
            still = if rests { still + 1 } else { 0 };
            if still == 2 {
                return;
            }
        }
        println!("  still at work after {LONGEST} s");
    }

    /// Memory in use now and at most so far, as text.
    pub(crate) fn memory(&self) -> String {
        let status = std::fs::read_to_string(self.folder.join("status")).unwrap_or_default();
        let [now, most] = ["VmRSS:", "VmHWM:"].map(|name| {
            let line = status.lines().find_map(|line| line.strip_prefix(name));
            let number = line.and_then(|rest| rest.split_whitespace().next()?.parse().ok());
            number.map_or(f64::NAN, |kib: f64| kib * 1024.0 / 1e6)
        });
        format!("{now:.0} MB, at most {most:.0} MB")
    }

    /// Processor time so far.
    pub(crate) fn processor_seconds(&self) -> f64 {
        let stat = std::fs::read_to_string(self.folder.join("stat")).unwrap_or_default();
        // The name in brackets may contain spaces. User and system time are fields 14 and 15.
        let fields = stat.rsplit(')').next().unwrap_or_default();
        let ticks = fields.split_whitespace().skip(11).take(2);
        ticks.filter_map(|field| field.parse::<f64>().ok()).sum::<f64>() / TICKS
    }
}
