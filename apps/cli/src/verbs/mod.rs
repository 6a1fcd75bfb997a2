//! Verbs that calibrate and mix, one file each. Those that draw, paint or map are in [`crate::pictures`].
mod fit;
mod validate;
mod mix;
mod against;
mod color;
mod light;
mod quadrature;
mod recipe_search;
mod correct;
mod library;
mod plan;
mod film;
mod demo;

use clap::Subcommand;

use crate::console::Console;
use crate::failure::Result;

/// Says which verbs are left out, if the program was compiled without pictures.
pub(crate) const LACKING: Option<&str> = if cfg!(feature = "pictures") {
    None
} else {
    Some("`--no-default-features` left out the verbs that draw, paint or map: compile without it")
};

/// A verb with its options.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Fit(fit::Fit),
    Validate(validate::Validate),
    Mix(mix::Mix),
    #[command(alias = "colour")]
    Color(color::Color),
    Light(light::Light),
    Quadrature(quadrature::Quadrature),
    Match(recipe_search::Match),
    Correct(Box<correct::Correct>),
    Library(library::Library),
    Plan(plan::Plan),
    Film(Box<film::Film>),
    Demo(demo::Demo),
    #[cfg(feature = "pictures")]
    #[command(flatten)]
    Picture(crate::pictures::PictureVerb),
}

impl Verb {
    pub(crate) fn run(self, console: &mut Console<'_>) -> Result<()> {
        match self {
            Self::Fit(verb) => verb.run(console),
            Self::Validate(verb) => verb.run(console),
            Self::Mix(verb) => verb.run(console),
            Self::Color(verb) => verb.run(console),
            Self::Light(verb) => verb.run(console),
            Self::Quadrature(verb) => verb.run(console),
            Self::Match(verb) => verb.run(console),
            Self::Correct(verb) => verb.run(console),
            Self::Library(verb) => verb.run(console),
            Self::Plan(verb) => verb.run(console),
            Self::Film(verb) => verb.run(console),
            Self::Demo(verb) => verb.run(console),
            #[cfg(feature = "pictures")]
            Self::Picture(verb) => verb.run(console),
        }
    }
}
