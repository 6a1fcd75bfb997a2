//! Remarks of the libraries as tuples, and values as JSON text.

use calibrate::{Remark, RemarkKind};

use crate::failure::hint_text;

/// Whether a remark is a warning, its sentence, and its hint.
pub(crate) type RemarkTuple = (bool, String, Option<String>);

pub(crate) fn remarks<'a>(remarks: impl IntoIterator<Item = &'a Remark>) -> Vec<RemarkTuple> {
    remarks
        .into_iter()
        .map(|remark: &Remark| {
            let hint = remark.hint.as_ref().map(hint_text);
            (remark.kind == RemarkKind::Warning, remark.text.clone(), hint)
        })
        .collect()
}
