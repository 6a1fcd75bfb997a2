use std::io::{Read, Seek, SeekFrom, Write};

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::*;

fn kind<T>(result: io::Result<T>) -> Option<io::ErrorKind> {
    result.err().map(|error| error.kind())
}

/// We make all calls of a session once here and once on the disk, and expect the same answers.
#[test]
fn it_answers_like_the_disk() {
    macro_rules! answers {
        ($disk:path, $root:expr) => {{
            use $disk as disk;
            let root: PathBuf = $root;
            let at = |name: &str| root.join(name);
            let mut answers: Vec<String> = Vec::new();
            let mut tell = |what: &dyn std::fmt::Debug| answers.push(format!("{what:?}"));
            tell(&kind(disk::write(at("none/a"), "x")));
            tell(&kind(disk::create_dir(at("none/b"))));
            disk::create_dir_all(at("a/b")).unwrap();
            tell(&kind(disk::create_dir(at("a/b"))));
            disk::write(at("a/one"), "first").unwrap();
            tell(&kind(
                disk::create_dir_all(at("a/one/c")).map_err(|_| io::ErrorKind::Other.into()),
            ));
            tell(&kind(disk::read(at("a"))));
            disk::hard_link(at("a/one"), at("a/two")).unwrap();
            tell(&disk::copy(at("a/one"), at("a/b/three")).unwrap());
            let mut file = disk::File::options().write(true).open(at("a/b/three")).unwrap();
            file.set_len(3).unwrap();
            file.seek(SeekFrom::End(0)).unwrap();
            file.write_all(b"e and more").unwrap();
            file.sync_all().unwrap();
            tell(&disk::read_to_string(at("a/b/three")).unwrap());
            disk::rename(at("a/b"), at("a/c")).unwrap();
            tell(&kind(disk::metadata(at("a/b/three"))));
            let mut text = String::new();
            disk::File::open(at("a/c/three")).unwrap().take(4).read_to_string(&mut text).unwrap();
            tell(&text);
            tell(&kind(disk::remove_dir(at("a/c"))));
            disk::write(at("a/four"), "fourth").unwrap();
            disk::rename(at("a/four"), at("a/two")).unwrap();
            let mut names: Vec<_> =
                disk::read_dir(at("a")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
            names.sort();
            tell(&names);
            let found = disk::metadata(at("a/two")).unwrap();
            tell(&(found.is_file(), found.is_dir(), found.len()));
            disk::remove_dir_all(at("a")).unwrap();
            tell(&kind(disk::read_dir(at("a"))));
            tell(&kind(disk::remove_file(at("a/two"))));
            answers
        }};
    }
    let folder = tempfile::tempdir().unwrap();
    create_dir_all("/memory/tests").unwrap();
    let [here, there] = [
        answers!(super, PathBuf::from("/memory/tests")),
        answers!(std::fs, folder.path().to_owned()),
    ];
    assert_eq!(here, there);
}

#[test]
fn changes_are_told_once_with_what_is_there_in_the_end() {
    create_dir_all("/told/partial").unwrap();
    let own = || {
        let changes = take_changes().into_iter().filter(|(path, _)| path.starts_with("/told"));
        let texts = changes.map(|(path, bytes)| {
            let text = bytes.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
            (path.display().to_string(), text)
        });
        texts.collect::<Vec<_>>()
    };
    write("/told/partial/a", "1").unwrap();
    write("/told/partial/a", "2").unwrap();
    write("/told/b", "3").unwrap();
    assert_eq!(
        own(),
        [("/told/b".into(), Some("3".into())), ("/told/partial/a".into(), Some("2".into()))]
    );
    rename("/told/partial", "/told/whole").unwrap();
    let moved = [("/told/partial/a".into(), None), ("/told/whole/a".into(), Some("2".into()))];
    assert_eq!(own(), moved);
    assert_eq!(own(), []);
}

#[test]
fn a_lock_is_held_until_it_is_given_up() {
    create_dir_all("/locks").unwrap();
    let first = File::create("/locks/lock").unwrap();
    first.try_lock().unwrap();
    assert!(File::open("/locks/lock").unwrap().try_lock().is_err(), "it is held");
    drop(first);
    assert!(File::open("/locks/../locks/./lock").unwrap().try_lock().is_ok(), "it was given up");
}
