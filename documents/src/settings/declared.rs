//! The macros that declare settings and presets.

/// Declares a table of settings, one row a setting. [The module](mod@crate::settings) has an example.
///
/// A row is
///
/// ```text
/// field as "key": type = default, Takes(limits), "unit", Scales => "Meaning", like "example";
/// ```
///
/// where
///
/// | part | holds |
/// | --- | --- |
/// | `as "key"` | the key in the file, where it is not the name of the field |
/// | `Takes(limits)` | a variant of [`Takes`](crate::settings::Takes) |
/// | `"unit"` | the unit of the numbers. Without it there is none |
/// | `Scales` | `Length` or `Area`, which change with the size of a picture. Without it the setting does not |
/// | `"Meaning"` | a sentence without its full stop: the doc comment of the field and the comment in the file |
/// | `like "example"` | only with the type `Option<String>`: a value for the file's comment where there is none |
///
/// After the rows come nested tables: `[field as "key"]: Type => "meaning";`.
///
/// `pub struct Name: File { .. }` is a whole file and has the functions `open`, `from_toml`, `changed`,
/// `valid` and `documented`. `File(path)` also checks by the function at `path` what belongs together:
/// it takes the settings and the [`KeyPath`](crate::text::KeyPath) of their table.
///
/// The crate that declares settings depends on `serde` with its derive macros.
#[macro_export]
macro_rules! settings {
    (
        $(#[doc = $doc:expr])*
        $visibility:vis struct $name:ident $(: $file:ident $(($check:path))?)? {
            $(
                $field:ident $(as $key:literal)? : $type:ty = $default:expr, $takes:ident $(($($limit:expr),* $(,)?))?
                    $(, $unit:literal $(, $scales:ident)?)? => $about:literal $(, like $example:literal)?;
            )*
            $(
                [$group:ident $(as $group_key:literal)?] : $table:ty => $group_about:literal;
            )*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, PartialEq, ::serde::Serialize, ::serde::Deserialize)]
        #[serde(deny_unknown_fields, default)]
        $visibility struct $name {
            $(
                #[doc = ::core::concat!($about, ".")]
                #[doc = ""]
                #[doc = $crate::settings!(@values $default, $takes $(($($limit),*))?; $($unit)?)]
                $(
                    #[doc = ::core::concat!("May be left out; such as `", $example, "`.")]
                    #[serde(skip_serializing_if = "::core::option::Option::is_none")]
                )?
                #[serde($(rename = $key)?)]
                pub $field: $type,
            )*
            $(
                #[doc = ::core::concat!("Table: ", $group_about, ".")]
                #[serde($(rename = $group_key)?)]
                pub $group: $table,
            )*
        }

        impl ::core::default::Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $default,)*
                    $($group: <$table as ::core::default::Default>::default(),)*
                }
            }
        }

        impl $crate::settings::Table for $name {
            const ROWS: &'static [$crate::settings::Row] = &[
                $($crate::settings::Row {
                    key: $crate::settings!(@key $field $($key)?),
                    takes: $crate::settings::Takes::$takes $(($($limit),*))?,
                    unit: $crate::settings!(@unit $($unit)?),
                    scales: $crate::settings!(@scales $($($scales)?)?),
                    about: $about,
                    example: $crate::settings!(@example $($example)?),
                },)*
                $($crate::settings::Row {
                    key: $crate::settings!(@key $group $($group_key)?),
                    takes: $crate::settings::Takes::Table(<$table as $crate::settings::Table>::ROWS),
                    unit: "",
                    scales: $crate::settings::Scales::No,
                    about: $group_about,
                    example: ::core::option::Option::None,
                },)*
            ];

            fn scale(&mut self, by: f32) {
                let _ = by;
                $($crate::settings!(@scale self.$field, by, $($($scales)?)?);)*
                $($crate::settings::Table::scale(&mut self.$group, by);)*
            }

            fn check_together(&self, base: &$crate::text::KeyPath) -> $crate::text::Checked {
                let _ = base;
                $($crate::settings::Table::check_together(
                    &self.$group,
                    &base.key($crate::settings!(@key $group $($group_key)?)),
                )?;)*
                $($($check(self, base)?;)?)?
                ::core::result::Result::Ok(())
            }
        }

        $($crate::settings!(@$file $name);)?
    };

    (@File $name:ident) => {
        impl $name {
            /// Reads a TOML file. Keys that it leaves out have the defaults.
            ///
            /// # Errors
            /// [`SettingsError`]($crate::settings::SettingsError) with file, line and key.
            pub fn open(path: &::std::path::Path) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::open(path)
            }

            /// Parses the text of a file of settings. Errors call it `name`.
            ///
            /// # Errors
            /// [`SettingsError`]($crate::settings::SettingsError) with line and key.
            pub fn from_toml(name: &str, text: &str) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::from_toml(name, text)
            }

            /// A copy of these settings in which the keys of `text` (TOML) are replaced. Errors call the text
            /// `name`.
            ///
            /// # Errors
            /// [`SettingsError`]($crate::settings::SettingsError) if the text is no TOML, a key is unknown, or a
            /// value is out of its range.
            pub fn changed(&self, name: &str, text: &str) -> ::core::result::Result<Self, $crate::settings::SettingsError> {
                $crate::settings::changed(self, name, text)
            }

            /// Checks settings that were made by code.
            ///
            /// # Errors
            /// [`SettingsError`]($crate::settings::SettingsError) for the first value that is out of its range.
            pub fn valid(&self) -> ::core::result::Result<(), $crate::settings::SettingsError> {
                let checked = $crate::settings::check(self, &$crate::text::KeyPath::default());
                ::core::result::Result::Ok(checked.map_err($crate::text::TextError::Invalid)?)
            }

            /// The text of a TOML file of these settings: `title` as a comment, then each key below its meaning,
            /// unit and range. Reading it gives the same settings to the bit.
            #[must_use]
            pub fn documented(&self, title: &str) -> ::std::string::String {
                $crate::settings::documented(self, title)
            }
        }
    };

    (@key $field:ident) => { ::core::stringify!($field) };
    (@key $field:ident $key:literal) => { $key };
    (@unit) => { "" };
    (@unit $unit:literal) => { $unit };
    (@scales) => { $crate::settings::Scales::No };
    (@scales $scales:ident) => { $crate::settings::Scales::$scales };
    (@example) => { ::core::option::Option::None };
    (@example $example:literal) => { ::core::option::Option::Some($example) };
    (@scale $value:expr, $by:expr,) => {};
    (@scale $value:expr, $by:expr, Length) => { $value *= $by };
    (@scale $value:expr, $by:expr, Area) => { $value *= $by * $by };

    (@values $default:expr, Number($least:expr, $most:expr); $($unit:literal)?) => {
        ::core::concat!(
            "From `", ::core::stringify!($least), "` to `", ::core::stringify!($most), "`", $(" ", $unit,)?
            "; `", ::core::stringify!($default), "` by default."
        )
    };
    (@values $default:expr, Whole($least:expr, $most:expr); $($unit:literal)?) => {
        $crate::settings!(@values $default, Number($least, $most); $($unit)?)
    };
    (@values $default:expr, Numbers($least:expr, $most:expr); $($unit:literal)?) => {
        $crate::settings!(@values $default, Number($least, $most); $($unit)?)
    };
    (@values $default:expr, Color; $($unit:literal)?) => {
        ::core::concat!("A colour written `#rrggbb`; `", ::core::stringify!($default), "` by default.")
    };
    (@values $default:expr, $takes:ident $(($($limit:expr),*))?; $($unit:literal)?) => {
        ::core::concat!("By default `", ::core::stringify!($default), "`.")
    };
}

/// Declares the presets of a file of settings: an enum, each variant with its name, the file that holds what
/// differs from the default, and a sentence.
///
/// ```text
/// documents::presets! {
///     /// A shipped style with a name.
///     pub enum Preset of Settings {
///         Portrait = "portrait", "presets/portrait.toml" => "Portrait: soft light and fine grain.";
///     }
/// }
/// ```
///
/// The enum has `ALL`, `name`, `about`, `settings`, `changes` (the text of the file), `text` (all settings with
/// comments) and `FromStr`.
#[macro_export]
macro_rules! presets {
    (
        $(#[doc = $doc:expr])*
        $visibility:vis enum $name:ident of $settings:ident {
            $($variant:ident = $word:literal, $file:literal => $about:literal;)*
        }
    ) => {
        $(#[doc = $doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, ::serde::Serialize, ::serde::Deserialize)]
        $visibility enum $name {
            $(
                #[doc = $about]
                #[serde(rename = $word)]
                $variant,
            )*
        }

        impl $name {
            /// All presets, in the order in which programs list them.
            pub const ALL: [Self; [$($word),*].len()] = [$(Self::$variant),*];

            /// Names of all presets.
            const NAMES: &'static [&'static str] = &[$($word),*];

            /// The name in lower case, which `parse` accepts.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$variant => $word,)* }
            }

            /// A sentence on the style.
            #[must_use]
            pub fn about(self) -> &'static str {
                match self { $(Self::$variant => $about,)* }
            }

            /// The TOML text of what differs from the default.
            #[must_use]
            pub fn changes(self) -> &'static str {
                match self { $(Self::$variant => ::core::include_str!($file),)* }
            }

            /// The settings of the preset.
            ///
            /// # Panics
            /// Never: a test reads all presets.
            #[must_use]
            pub fn settings(self) -> $settings {
                $settings::from_toml(self.name(), self.changes()).expect("a shipped preset is valid")
            }

            /// The text of a TOML file of all settings of the preset, with a comment above each key.
            #[must_use]
            pub fn text(self) -> ::std::string::String {
                self.settings().documented(self.about())
            }
        }

        impl ::core::str::FromStr for $name {
            type Err = $crate::settings::SettingsError;

            fn from_str(name: &str) -> ::core::result::Result<Self, Self::Err> {
                let found = Self::ALL.into_iter().find(|preset| preset.name() == name);
                found.ok_or_else(|| $crate::settings::SettingsError::Preset {
                    name: name.to_owned(),
                    known: Self::NAMES,
                })
            }
        }
    };
}
