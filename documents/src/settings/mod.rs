//! Settings that are declared once.
//!
//! A row of [`settings!`](crate::settings!) is one setting: its field, type, default, range, unit and
//! meaning. The macro makes the documented struct, its default, the list of rows, the check of ranges, the
//! TOML file with comments, and what changes with the size of a picture. Presets
//! ([`presets!`](crate::presets!)) are files that hold only what differs from the default.
//!
//! ```
//! use documents::hint::Explain;
//!
//! documents::settings! {
//!     /// Pigment at the rim of a wash.
//!     pub struct EdgeSettings {
//!         strength: f32 = 3.0, Number(0.0, 10.0) => "What density gains at the rim";
//!         width_px: f32 = 1.0, Number(0.0, 20.0), "px", Length => "Width of the rim";
//!         color as "colour": Option<String> = None, Color => "Only washes of this colour", like "#506a8c";
//!     }
//! }
//!
//! documents::settings! {
//!     /// A style of watercolour.
//!     pub struct Settings: File {
//!         seed: u64 = 1, Any => "The same seed, the same picture";
//!         [edges]: EdgeSettings => "the rim of a wash";
//!     }
//! }
//!
//! let settings = Settings::from_toml("mine.toml", "[edges]\nstrength = 5")?;
//! assert_eq!((settings.edges.strength, settings.seed), (5.0, 1));
//! assert_eq!(settings.changed("here", "seed = 2")?.edges, settings.edges);
//!
//! let error = Settings::from_toml("mine.toml", "[edges]\nstrength = 11").unwrap_err();
//! assert_eq!(error.to_string(), "mine.toml, line 2: edges.strength takes 0 to 10, found `11`");
//! assert_eq!(error.hint().map(|hint| hint.to_string()).as_deref(), Some("3 is usual"));
//!
//! let text = "\
//! ## Mine
//!
//! ## The same seed, the same picture.
//! seed = 1
//!
//! [edges] # the rim of a wash
//! ## What density gains at the rim (0 to 10).
//! strength = 5.0
//! ## Width of the rim (px, 0 to 20).
//! width_px = 1.0
//! ## Only washes of this colour (a colour written #rrggbb).
//! ## colour = \"#506a8c\"
//! ";
//! assert_eq!(settings.documented("Mine"), text);
//! # Ok::<(), documents::settings::SettingsError>(())
//! ```

mod declared;
mod read;
mod row;

pub use read::{
    SettingsError, changed, changed_by, check, differences, digest, documented, guide_table, open,
    read as from_toml, rows,
};
pub use row::{Row, Scales, Table, Takes, is_color, text_of};
