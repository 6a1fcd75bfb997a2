//! Releases: we build the programs as we ship them, and pack an archive. The same source and
//! compiler give the same archive, byte for byte.

use std::fs;
use std::path::{Path, PathBuf};

use xtask::files::{root, text};

use crate::notices::notices;
use crate::runs::{Outcome, Run, target};

/// File names under which shells look for completions.
const COMPLETIONS: [(&str, &str); 5] = [
    ("bash", "impasto.bash"),
    ("elvish", "impasto.elv"),
    ("fish", "impasto.fish"),
    ("powershell", "_impasto.ps1"),
    ("zsh", "_impasto"),
];

/// `release [FOLDER]`: builds both programs in the profile `dist` and packs them.
pub(crate) fn release(folder: Option<&str>) -> Outcome {
    Run::cargo("build --profile dist --locked -p impasto -p impasto-studio").go()?;
    package(None, folder)
}

/// `package [--programs FOLDER] [FOLDER]`: packs both programs with completions, manual pages,
/// measurements, licences and the notices of others into `FOLDER/impasto-VERSION-TARGET.tar.gz`. If you do not name a
/// folder of programs, it packs the ones of the profile `dist`.
pub(crate) fn package(programs: Option<&str>, folder: Option<&str>) -> Outcome {
    let programs = programs.map_or_else(|| target().join("dist"), PathBuf::from);
    let folder = root().join(folder.unwrap_or("target/release-archive"));
    let name = format!("impasto-{}-{}", version()?, host()?);
    let scratch = target().join("package");
    fs::remove_dir_all(&scratch).ok();
    let packed = scratch.join(&name);
    for inside in ["bin", "completions", "man/man1"] {
        create_folder(&packed.join(inside))?;
    }
    create_folder(&folder)?;
    fill(&packed, &programs)?;
    let archive = archive(&scratch, &name)?;
    let there = folder.join(format!("{name}.tar.gz"));
    Run::new("mv").args([&archive, &there]).go()?;
    let sum = Run::new("sha256sum").args([format!("{name}.tar.gz")]);
    let sum = sum.inside(&folder.to_string_lossy()).output()?;
    write(&folder.join(format!("{name}.tar.gz.sha256")), &format!("{sum}\n"))?;
    println!("{}", there.display());
    fs::remove_dir_all(&scratch).map_err(|error| error.to_string())
}

/// Copies everything that we ship to the folder `packed`.
fn fill(packed: &Path, programs: &Path) -> Outcome {
    let of = ["impasto", "impasto-studio"].map(|program| programs.join(program));
    Run::new("install").words("-m 755").args(of).args([packed.join("bin")]).go()?;
    let program = packed.join("bin/impasto");
    for (shell, file) in COMPLETIONS {
        let text = Run::new(&program).words("completions").args([shell]).output()?;
        write(&packed.join("completions").join(file), &format!("{text}\n"))?;
    }
    Run::new(&program).words("-q man").args([packed.join("man/man1")]).go()?;
    let pages = ["README.md", "CHANGELOG.md", "LICENSE-APACHE", "LICENSE-MIT"];
    write(&packed.join("THIRD-PARTY.txt"), &notices()?)?;
    Run::new("cp").words("-R measurements").args(pages).args([packed]).go()?;
    Run::new("chmod").words("-R u=rwX,go=rX").args([packed]).go()
}

/// Packs the folder `name` of `scratch`. The same files give the same archive: entries are in order
/// with one time and owner, and gzip gets no name and no time.
fn archive(scratch: &Path, name: &str) -> Outcome<PathBuf> {
    let time = match std::env::var("SOURCE_DATE_EPOCH") {
        Ok(time) => time,
        Err(_) => Run::new("git").words("log -1 --format=%ct").output()?,
    };
    let tar = scratch.join("archive.tar");
    let order = "--sort=name --owner=0 --group=0 --numeric-owner --format=ustar";
    let run = Run::new("tar").words(order).args([format!("--mtime=@{time}")]);
    run.words("-C").args([scratch]).words("-cf").args([&tar]).args([name]).go()?;
    Run::new("gzip").words("-9nf").args([&tar]).go()?;
    Ok(scratch.join("archive.tar.gz"))
}

fn version() -> Outcome<String> {
    let manifest = text("Cargo.toml");
    let package = manifest.split("[workspace.package]").nth(1).unwrap_or_default();
    let version = package.split("version = \"").nth(1).and_then(|rest| rest.split('"').next());
    version.map(str::to_owned).ok_or_else(|| "Cargo.toml has no version".to_owned())
}

/// The system that the compiler builds for.
fn host() -> Outcome<String> {
    let version = Run::new("rustc").words("-vV").output()?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc -vV names no host".to_owned())
}

fn create_folder(path: &Path) -> Outcome {
    fs::create_dir_all(path).map_err(|error| format!("{}: {error}", path.display()))
}

fn write(path: &Path, text: &str) -> Outcome {
    fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
