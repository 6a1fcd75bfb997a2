//! Folders of Specim cameras: capture/ with the counts and their readings, results/ with reflectance.

use std::path::{Path, PathBuf};

use super::error::CubeError;

/// Scan of a camera's folder.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct SpecimScan {
    /// Header of the scan.
    pub(crate) scan: PathBuf,
    /// Header of the white, for counts.
    pub(crate) white: Option<PathBuf>,
    /// Header of the dark of the scan, for counts.
    pub(crate) dark: Option<PathBuf>,
    /// Header of the dark of the white, where the camera took one.
    pub(crate) white_dark: Option<PathBuf>,
    /// Sentence about the choice.
    pub(crate) remark: String,
}

/// Beginnings of the names of readings.
const READINGS: [&str; 3] = ["WHITEDARKREF_", "WHITEREF_", "DARKREF_"];
/// Beginning of the name of a scan's reflectance.
const REFLECTANCE: &str = "REFLECTANCE_";

/// Whether `folder` is one of a camera.
pub(crate) fn is_specim(folder: &Path) -> bool {
    ["capture", "results"].iter().any(|name| folder.join(name).is_dir())
        || headers(folder).iter().any(|(name, _)| {
            READINGS.iter().any(|start| name.starts_with(start)) || name.starts_with(REFLECTANCE)
        })
}

/// Headers in a folder with their names in upper case, in the order of names.
fn headers(folder: &Path) -> Vec<(String, PathBuf)> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let paths = entries.filter_map(Result::ok).map(|entry| entry.path());
    let is_header = |path: &PathBuf| {
        path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("hdr")) && path.is_file()
    };
    let mut found: Vec<_> = paths
        .filter(is_header)
        .filter_map(|path: PathBuf| {
            let name = path.file_stem()?.to_str()?.to_uppercase();
            Some((name, path))
        })
        .collect();
    found.sort();
    found
}

/// Finds the scan of a camera's folder: its reflectance, else its counts with white and dark.
pub(crate) fn find(folder: &Path) -> Result<SpecimScan, CubeError> {
    let inside = |name: &str| {
        let inner = folder.join(name);
        headers(if inner.is_dir() { &inner } else { folder })
    };
    let results = inside("results");
    let computed: Vec<_> =
        results.iter().filter(|(name, _)| name.starts_with(REFLECTANCE)).collect();
    if let [(_, scan)] = computed[..] {
        let remark = format!("the camera's reflectance is read: {}", scan.display());
        let scan = scan.clone();
        return Ok(SpecimScan { scan, white: None, dark: None, white_dark: None, remark });
    }
    let captured = inside("capture");
    let is_scan = |name: &str| {
        !READINGS.iter().any(|start| name.starts_with(start)) && !name.starts_with(REFLECTANCE)
    };
    let scans: Vec<_> = captured.iter().filter(|(name, _)| is_scan(name)).collect();
    let [(name, scan)] = scans[..] else {
        let problem = match computed.len().max(scans.len()) {
            0 => "has no header of a scan in capture/ or results/".to_owned(),
            several => format!("has {several} scans"),
        };
        return Err(CubeError::format(folder, problem, "name the .hdr file of one scan"));
    };
    let [white_dark, white, dark] = READINGS.map(|start: &str| {
        let wanted = format!("{start}{name}");
        captured.iter().find(|(name, _)| *name == wanted).map(|(_, path)| path.clone())
    });
    let remark = format!("counts are read with the camera's white and dark: {}", scan.display());
    Ok(SpecimScan { scan: scan.clone(), white, dark, white_dark, remark })
}
