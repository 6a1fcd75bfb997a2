//! Files as instruments write them.

mod error;

mod record;

pub use error::InstrumentError;
pub use record::{MeasuredQuantity, Record, Unit};
