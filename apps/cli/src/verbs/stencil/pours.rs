//! Options for what is poured, and for how long.

use calibrate::library::PigmentLibrary;
use clap::Args;
use documents::counted;
use volumes::script::{PourTable, Row, Script};

use crate::failure::{Failure, Result};
use crate::palette::{listed, name_in_recipe, pigment_names};

/// Paint of a pour whose amount is not given, in mm3: a film of 0.02 mm on a disc 60 mm wide.
const AMOUNT_MM3: f64 = 60.0;
/// Longest time over which such paint flows, in seconds.
const FLOW_S: f64 = 3.0;
/// Duration without a script and without `--seconds`.
const SECONDS: f64 = 4.0;

#[derive(Debug, Args)]
#[command(next_help_heading = "Paint")]
pub(super) struct PourOptions {
    /// Pour paint at a place of the first picture: shares of its width and height, and the amount in
    /// mm3 [default: 60], such as `0.5,0.6` or `0.5,0.6,200`; may be repeated
    #[arg(long = "pour", value_name = "X,Y[,MM3]", allow_hyphen_values = true)]
    pours: Vec<String>,
    /// Paint of the pours, as pigments with their parts, such as `Ultramarine=2,White=1`: one for all
    /// of them, or one for each [default: the pigments of --palette, or of the script, in turn]
    #[arg(long = "paint", value_name = "RECIPE", requires = "pigments")]
    paints: Vec<String>,
    /// How long paint spreads, in seconds [default: 4, or as the script says]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    seconds: Option<f64>,
}

impl PourOptions {
    /// Seconds of a scene without a script.
    pub(super) fn usual_seconds(&self) -> f64 {
        self.seconds.unwrap_or(SECONDS)
    }

    /// Whether the duration is given.
    pub(super) fn has_seconds(&self) -> bool {
        self.seconds.is_some()
    }

    /// Adds what is poured to a script. `palette` are lists of pigments of the library, if one is
    /// given.
    pub(super) fn apply(
        &self,
        script: &mut Script,
        palette: &[String],
        library: Option<&PigmentLibrary>,
    ) -> Result<()> {
        self.check_counts()?;
        if let Some(seconds) = self.seconds {
            script.seconds = seconds;
        }
        let names = library.map(|library| pigment_names(palette, library)).unwrap_or_default();
        for name in &names {
            letter(script, name);
        }
        let in_turn: Vec<String> = match names.is_empty() {
            true => script.palette.values().cloned().collect(),
            false => names,
        };
        let paints = self
            .paints
            .iter()
            .filter_map(|text: &String| library.map(|library| parts(text, library)))
            .collect::<Result<Vec<_>>>()?;
        for (index, text) in self.pours.iter().enumerate() {
            let recipe = match &paints[..] {
                [] => in_turn.iter().cycle().nth(index).map(|name| vec![(name.clone(), 1.0)]),
                [one] => Some(one.clone()),
                each => Some(each[index].clone()),
            };
            let (picked, amount_mm3) = place(text)?;
            let mut pour = PourTable {
                picked: Some(Row(picked)),
                for_s: script.seconds.min(FLOW_S),
                amount_mm3: Some(amount_mm3),
                ..PourTable::default()
            };
            for (name, part) in recipe.into_iter().flatten() {
                *pour.recipe.entry(letter(script, &name)).or_default() += part;
            }
            script.pours.push(pour);
        }
        Ok(())
    }

    /// Checks that there is paint for every pour, and a pour for every paint.
    fn check_counts(&self) -> Result<()> {
        match (self.paints.len(), self.pours.len()) {
            (0, _) | (1, 1..) => Ok(()),
            (paints, pours) if paints == pours => Ok(()),
            (_, 0) => Err(Failure::usage(
                "--paint is the paint of pours, but there is no --pour",
                "add --pour 0.5,0.5",
            )),
            (paints, pours) => Err(Failure::usage(
                format!("{} for {}", counted(paints, "recipe"), counted(pours, "pour")),
                "give one --paint for all pours, or one for each",
            )),
        }
    }
}

/// The key of a pigment in the palette of a script, which is added if it is new.
fn letter(script: &mut Script, pigment: &str) -> String {
    if let Some((key, _)) = script.palette.iter().find(|(_, name)| *name == pigment) {
        return key.clone();
    }
    let mut keys = (1..).map(|number| format!("P{number}"));
    let key = keys.find(|key| !script.palette.contains_key(key)).unwrap_or_default();
    script.palette.insert(key.clone(), pigment.to_owned());
    key
}

/// Reads `X,Y[,MM3]`.
fn place(text: &str) -> Result<([f64; 2], f64)> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    let (x, y, amount) = match numbers.as_deref() {
        Ok(&[x, y]) => (x, y, AMOUNT_MM3),
        Ok(&[x, y, amount]) => (x, y, amount),
        _ => (f64::NAN, f64::NAN, AMOUNT_MM3),
    };
    let inside = [x, y].iter().all(|share| (0.0..=1.0).contains(share));
    if inside && amount > 0.0 && amount.is_finite() {
        return Ok(([x, y], amount));
    }
    Err(Failure::usage(
        format!(
            "--pour takes X,Y or X,Y,MM3 with shares of 0 to 1 and more than 0 mm3, found `{text}`"
        ),
        "try --pour 0.5,0.6 or --pour 0.5,0.6,200",
    ))
}

/// Reads `NAME=PART,NAME=PART`; a name alone has one part.
fn parts(text: &str, library: &PigmentLibrary) -> Result<Vec<(String, f64)>> {
    let wrong = || {
        Failure::usage(
            format!("--paint takes pigments with their parts above 0, found `{text}`"),
            "try --paint \"Ultramarine=2,Titanium White=1\"",
        )
    };
    listed(text, library, name_in_recipe)
        .into_iter()
        .map(|part: &str| {
            let (name, share) = part.rsplit_once('=').unwrap_or((part, "1"));
            let share: f64 = share.trim().parse().map_err(|_| wrong())?;
            let name = name.trim();
            let fits = !name.is_empty() && share > 0.0 && share.is_finite();
            if fits { Ok((name.to_owned(), share)) } else { Err(wrong()) }
        })
        .collect()
}
