//! Problems that only a page has: the browser's storage, and files that do not fit into its memory.

use super::age::size;
use super::problem::Problem;
use crate::language::{tr, tr_format};

/// A problem of a page, whose autosaves lie in the browser's storage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PageProblem {
    /// The browser gives this page no storage.
    StorageDenied,
    /// The storage has no room for an autosave.
    StorageFull,
    /// The storage was emptied while the page was open; the page has written its files again.
    StorageCleared,
    /// A write failed for another reason, in the browser's words.
    StorageFailed(String),
    /// The file of this name has more bytes than a page takes.
    TooLarge {
        /// Name of the file.
        name: String,
        /// Bytes of the file.
        bytes: u64,
        /// Most bytes that a page takes.
        most: u64,
    },
    /// The browser cannot read the file of this name, for a reason in its words.
    Unreadable {
        /// Name of the file.
        name: String,
        /// The reason.
        reason: String,
    },
}

impl From<PageProblem> for Problem {
    fn from(problem: PageProblem) -> Self {
        let save = || tr("save the painting often: it is downloaded");
        match problem {
            PageProblem::StorageDenied => {
                let text = tr("no autosaves: this browser denies its storage to the page");
                Self::new(text, save())
            }
            PageProblem::StorageFull => {
                let text = tr("no autosaves: the browser's storage is full");
                let hint = tr(
                    "save the painting: it is downloaded; autosaves go on once there is room on the \
                     disk or other pages' data is removed",
                );
                Self::new(text, hint)
            }
            PageProblem::StorageCleared => {
                let text = tr("the browser's storage was emptied: the autosave is written anew");
                Self::new(text, save())
            }
            PageProblem::StorageFailed(reason) => {
                let text = tr_format!(
                    "no autosaves: the browser's storage cannot be written: {reason}",
                    reason
                );
                Self::new(text, save())
            }
            PageProblem::TooLarge { name, bytes, most } => {
                let bytes = size(bytes);
                let most = size(most);
                let text = tr_format!(
                    "{name}: has {bytes}; a page takes at most {most}",
                    name,
                    bytes,
                    most
                );
                Self::new(text, tr("open it in the program impasto-studio"))
            }
            PageProblem::Unreadable { name, reason } => {
                let text = tr_format!("{name}: the browser cannot read it: {reason}", name, reason);
                Self::new(text, tr("choose the file again; a folder cannot be opened"))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_problem_names_the_way_out() {
        let name = "big.exr".to_owned();
        let reason = "gone".to_owned();
        let large = PageProblem::TooLarge { name: name.clone(), bytes: 600 << 20, most: 512 << 20 };
        let problem = Problem::from(large);
        assert_eq!(problem.text, "big.exr: has 629.1 MB; a page takes at most 536.9 MB");
        let unreadable = PageProblem::Unreadable { name, reason: reason.clone() };
        assert!(Problem::from(unreadable).text.starts_with("big.exr: "));
        for problem in [
            PageProblem::StorageDenied,
            PageProblem::StorageFull,
            PageProblem::StorageCleared,
            PageProblem::StorageFailed(reason),
        ] {
            let shown = Problem::from(problem.clone());
            assert!(shown.text.contains("storage"), "{shown:?}");
            let hint = shown.hint.unwrap_or_default();
            assert!(hint.contains("save the painting"), "{problem:?}: {hint}");
        }
    }
}
