//! Remarks of the libraries as JSON.

use calibrate::{Remark, RemarkKind};
use serde_json::{Value, json};

use crate::failure::hint_text;

/// For each remark: `warning`, `text` and `hint`.
pub(crate) fn remarks<'a>(remarks: impl IntoIterator<Item = &'a Remark>) -> Value {
    remarks
        .into_iter()
        .map(|remark: &Remark| {
            json!({
                "warning": remark.kind == RemarkKind::Warning,
                "text": remark.text,
                "hint": remark.hint.as_ref().map(hint_text),
            })
        })
        .collect()
}
