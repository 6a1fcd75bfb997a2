//! The derive macro of `Explain`: every form of its attributes.

use documents::hint::{Explain, Fault, Hint};

/// The hint and the fault of an error.
fn hint_and_fault(error: &dyn Explain) -> (Option<String>, Fault) {
    (error.hint().map(|hint| hint.to_string()), error.fault())
}

fn hint(text: &str) -> Option<String> {
    Some(text.to_owned())
}

#[derive(Debug, thiserror::Error, Explain)]
enum Plain {
    #[error("a")]
    #[hint("set [backend=cpu]")]
    Text,
    #[error("b {text}")]
    #[hint(verbatim, "spectra: {text}, [white]")]
    Verbatim { text: String },
    #[error("c {0} {1}")]
    #[hint("{1:.2} is more than {0}; braces {{}} stay")]
    Tuple(u8, f64),
    #[error("d {names:?}")]
    #[hint("{}, or {0:?}", names.join(" or "))]
    Arguments { names: Vec<String> },
    #[error("e {count}")]
    #[hint(if *count == 0, "add one")]
    #[hint(if *count > 9, "leave out {}", count - 9)]
    Conditions { count: usize },
    #[error("f {place}")]
    #[hint(if *place == "x", "along x")]
    #[hint("somewhere else")]
    #[fault(Environment)]
    Otherwise { place: &'static str },
    #[error("g")]
    #[hint(with = Self::by_function)]
    #[fault(with = Self::fault_by_function)]
    Function,
    #[error("h")]
    #[hint(with = advice.clone())]
    #[fault(with = if advice.is_some() { Fault::Setting } else { Fault::Environment })]
    Expression { advice: Option<Hint> },
    #[error("i")]
    Nothing,
}

impl Plain {
    fn by_function(&self) -> Option<Hint> {
        Some(Hint::new(format!("function of {self}")))
    }

    fn fault_by_function(&self) -> Fault {
        Fault::Setting
    }
}

#[test]
fn texts_have_fields_arguments_and_conditions() {
    let text = "b [c]".to_owned();
    let input = Fault::Input;
    for (error, wanted) in [
        (Plain::Text, (hint("set `backend = cpu`"), input)),
        (Plain::Verbatim { text }, (hint("spectra: b [c], [white]"), input)),
        (Plain::Tuple(1, 2.555), (hint("2.56 is more than 1; braces {} stay"), input)),
        (Plain::Conditions { count: 0 }, (hint("add one"), input)),
        (Plain::Conditions { count: 5 }, (None, input)),
        (Plain::Conditions { count: 12 }, (hint("leave out 3"), input)),
        (Plain::Otherwise { place: "x" }, (hint("along x"), Fault::Environment)),
        (Plain::Otherwise { place: "y" }, (hint("somewhere else"), Fault::Environment)),
        (Plain::Function, (hint("function of g"), Fault::Setting)),
        (Plain::Expression { advice: None }, (None, Fault::Environment)),
        (Plain::Expression { advice: Some(Hint::new("[a]")) }, (hint("`a`"), Fault::Setting)),
        (Plain::Nothing, (None, input)),
    ] {
        assert_eq!(hint_and_fault(&error), wanted, "{error}");
    }
    let names = Plain::Arguments { names: vec!["a".to_owned(), "b".to_owned()] };
    assert_eq!(names.hint(), Some(Hint::new("a or b, or \"a or b\"")));
}

#[derive(Debug, thiserror::Error, Explain)]
#[fault(Setting)]
#[hint("look at {self}")]
enum WithDefaults {
    #[error("a {0}")]
    ByDefault(u8),
    #[error("b")]
    #[hint("its own")]
    #[fault(Input)]
    Own,
    #[error("c")]
    #[hint(none)]
    None,
    #[error(transparent)]
    Transparent(#[from] Plain),
    #[error(transparent)]
    #[hint("its own")]
    TransparentWithHint(std::io::Error),
    #[error("inner {1}")]
    #[hint(inner)]
    Marked(usize, #[source] Plain),
    #[error("inner {1}")]
    #[hint(inner = 1)]
    Indexed(usize, Plain),
    #[error("inner {error}")]
    #[hint(inner)]
    #[fault(Environment)]
    Named { file: String, error: Box<Plain> },
    #[error("inner {reason} of {file}")]
    #[hint(if file.is_empty(), "name it")]
    #[hint(inner = reason)]
    Chosen { file: String, reason: Plain },
    #[error("d {0}")]
    #[fault(inner)]
    InnerFault(std::io::Error),
}

#[test]
fn an_enum_has_defaults_and_a_wrapped_error_its_own() {
    let io = || std::io::Error::from(std::io::ErrorKind::StorageFull);
    let expression = || Plain::Expression { advice: None };
    for (error, wanted) in [
        (WithDefaults::ByDefault(3), (hint("look at a 3"), Fault::Setting)),
        (WithDefaults::Own, (hint("its own"), Fault::Input)),
        (WithDefaults::None, (None, Fault::Setting)),
        (Plain::Nothing.into(), (None, Fault::Input)),
        (expression().into(), (None, Fault::Environment)),
        (WithDefaults::TransparentWithHint(io()), (hint("its own"), Fault::Environment)),
        (WithDefaults::Marked(1, Plain::Text), (hint("set `backend = cpu`"), Fault::Input)),
        (WithDefaults::Indexed(1, Plain::Text), (hint("set `backend = cpu`"), Fault::Input)),
        (
            WithDefaults::Named { file: "a.csv".to_owned(), error: Box::new(Plain::Function) },
            (hint("function of g"), Fault::Environment),
        ),
        (
            WithDefaults::Chosen { file: "a.csv".to_owned(), reason: expression() },
            (None, Fault::Environment),
        ),
        (
            WithDefaults::Chosen { file: String::new(), reason: expression() },
            (hint("name it"), Fault::Environment),
        ),
        (WithDefaults::InnerFault(io()), (hint("look at d no storage space"), Fault::Environment)),
    ] {
        assert_eq!(hint_and_fault(&error), wanted, "{error}");
    }
}

#[derive(Debug, thiserror::Error, Explain)]
#[error("there is no shape `{0}`")]
#[hint("shapes are {NAMES}, not {0}")]
#[fault(Setting)]
struct UnknownShape(String);

const NAMES: &str = "round and flat";

#[derive(Debug, thiserror::Error, Explain)]
#[error("cut off")]
struct Unit;

#[derive(Debug, thiserror::Error, Explain)]
#[error("{path}: {reason}")]
#[hint(inner = reason)]
struct Named {
    path: String,
    reason: std::io::Error,
}

#[derive(Debug, thiserror::Error, Explain)]
enum Generic<E: std::error::Error + 'static> {
    #[error(transparent)]
    Inner(E),
    #[error("in a box")]
    #[hint(inner)]
    Boxed(#[source] Box<E>),
    #[error(transparent)]
    Unit(#[from] Unit),
}

#[test]
fn structs_and_generic_enums_explain_too() {
    let unknown = UnknownShape("fan".to_owned());
    assert_eq!(
        hint_and_fault(&unknown),
        (hint("shapes are round and flat, not fan"), Fault::Setting)
    );
    assert_eq!(hint_and_fault(&Unit), (None, Fault::Input));
    let reason = std::io::Error::from(std::io::ErrorKind::StorageFull);
    let full = "free space on the disk, or choose another";
    let named = Named { path: "a".to_owned(), reason };
    assert_eq!(hint_and_fault(&named), (hint(full), Fault::Environment));
    let wanted = (hint("shapes are round and flat, not fan"), Fault::Setting);
    let boxed = Generic::Boxed(Box::new(UnknownShape("fan".to_owned())));
    assert_eq!(
        [hint_and_fault(&Generic::Inner(unknown)), hint_and_fault(&boxed)],
        [wanted.clone(), wanted]
    );
    assert_eq!(hint_and_fault(&Generic::<UnknownShape>::Unit(Unit)), (None, Fault::Input));
}
