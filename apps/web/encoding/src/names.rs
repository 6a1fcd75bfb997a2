//! Every name of the WHATWG Encoding Standard.

use crate::characters::Kind;
use crate::encoding::Encoding;

/// Declares encodings, one in a row: `constant, place: name, kind`. `place` is a static value, and
/// `constant` is a reference to it.
macro_rules! encodings {
    ($($constant:ident, $place:ident: $name:literal, $kind:ident;)*) => {
        $(
            #[doc = concat!("The place of ", $name, ".")]
            pub static $place: Encoding = Encoding::new($name, Kind::$kind);
            #[doc = concat!("The encoding ", $name, ".")]
            pub static $constant: &Encoding = &$place;
        )*
        /// Every encoding above, in order.
        pub(crate) static LABELS: &[&Encoding] = &[$(&$place),*];
    };
}

encodings! {
    BIG5, BIG5_INIT: "Big5", Unknown;
    EUC_JP, EUC_JP_INIT: "EUC-JP", Unknown;
    EUC_KR, EUC_KR_INIT: "EUC-KR", Unknown;
    GB18030, GB18030_INIT: "gb18030", Unknown;
    GBK, GBK_INIT: "GBK", Unknown;
    IBM866, IBM866_INIT: "IBM866", Unknown;
    ISO_2022_JP, ISO_2022_JP_INIT: "ISO-2022-JP", Unknown;
    ISO_8859_2, ISO_8859_2_INIT: "ISO-8859-2", Unknown;
    ISO_8859_3, ISO_8859_3_INIT: "ISO-8859-3", Unknown;
    ISO_8859_4, ISO_8859_4_INIT: "ISO-8859-4", Unknown;
    ISO_8859_5, ISO_8859_5_INIT: "ISO-8859-5", Unknown;
    ISO_8859_6, ISO_8859_6_INIT: "ISO-8859-6", Unknown;
    ISO_8859_7, ISO_8859_7_INIT: "ISO-8859-7", Unknown;
    ISO_8859_8, ISO_8859_8_INIT: "ISO-8859-8", Unknown;
    ISO_8859_8_I, ISO_8859_8_I_INIT: "ISO-8859-8-I", Unknown;
    ISO_8859_10, ISO_8859_10_INIT: "ISO-8859-10", Unknown;
    ISO_8859_13, ISO_8859_13_INIT: "ISO-8859-13", Unknown;
    ISO_8859_14, ISO_8859_14_INIT: "ISO-8859-14", Unknown;
    ISO_8859_15, ISO_8859_15_INIT: "ISO-8859-15", Unknown;
    ISO_8859_16, ISO_8859_16_INIT: "ISO-8859-16", Unknown;
    KOI8_R, KOI8_R_INIT: "KOI8-R", Unknown;
    KOI8_U, KOI8_U_INIT: "KOI8-U", Unknown;
    MACINTOSH, MACINTOSH_INIT: "macintosh", Unknown;
    REPLACEMENT, REPLACEMENT_INIT: "replacement", Unknown;
    SHIFT_JIS, SHIFT_JIS_INIT: "Shift_JIS", Unknown;
    UTF_8, UTF_8_INIT: "UTF-8", Utf8;
    UTF_16BE, UTF_16BE_INIT: "UTF-16BE", Utf16Be;
    UTF_16LE, UTF_16LE_INIT: "UTF-16LE", Utf16Le;
    WINDOWS_874, WINDOWS_874_INIT: "windows-874", Unknown;
    WINDOWS_1250, WINDOWS_1250_INIT: "windows-1250", Unknown;
    WINDOWS_1251, WINDOWS_1251_INIT: "windows-1251", Unknown;
    WINDOWS_1252, WINDOWS_1252_INIT: "windows-1252", Windows1252;
    WINDOWS_1253, WINDOWS_1253_INIT: "windows-1253", Unknown;
    WINDOWS_1254, WINDOWS_1254_INIT: "windows-1254", Unknown;
    WINDOWS_1255, WINDOWS_1255_INIT: "windows-1255", Unknown;
    WINDOWS_1256, WINDOWS_1256_INIT: "windows-1256", Unknown;
    WINDOWS_1257, WINDOWS_1257_INIT: "windows-1257", Unknown;
    WINDOWS_1258, WINDOWS_1258_INIT: "windows-1258", Unknown;
    X_MAC_CYRILLIC, X_MAC_CYRILLIC_INIT: "x-mac-cyrillic", Unknown;
    X_USER_DEFINED, X_USER_DEFINED_INIT: "x-user-defined", Unknown;
}
