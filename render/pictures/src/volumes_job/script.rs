//! The script that is played. It is read from a file or made for a subject, and then changed as the
//! request says. An error names the line of the file, or the key of the request that has the value.

use std::path::Path;
use std::sync::Arc;

use calibrate::{Backing, backing_from_text, library::PigmentLibrary};
use documents::{
    counted,
    hint::{Explain, Fault},
    text::{KeyPath, KeyStep, ValueFault, is_toml, read_text},
};
use paint::{
    document::Lighting,
    ground::{GroundKind, GroundSpec, MeasuredPrimer, Primer, PrimerSpectrum},
};
use spectra::Viewing;
use volumes::painter::{VolumePainter, VolumePigments};
use volumes::performance::PerformanceError;
use volumes::script::{PourTable, Row, Script, ScriptError};
use volumes::settings::{Inside, Preset, Settings};

use crate::error::{PictureError, SettingError};
use crate::exports::{Listener, Note};
use crate::request::{PictureRequest, PigmentRequest, VolumesRequest};
use crate::style::{
    StyleRequest, canvas_of, listed, name_in_recipe, pigment_names, toml_of_change,
};

/// Paint in mm3 of a pour if you give no amount. This is a film of 0.02 mm on a disc 60 mm wide.
const AMOUNT_MM3: f64 = 60.0;
/// Longest time over which we pour this paint, in seconds.
const FLOW_S: f64 = 3.0;
/// Duration in seconds, if there is no script and no key `seconds`.
const SECONDS: f64 = 4.0;

/// A script with the file that it was read from, if any.
#[derive(Debug)]
pub(super) struct OpenScript {
    pub(super) script: Script,
    /// Name of the file and its text.
    file: Option<(String, String)>,
    /// Number of pours in the script itself. The request adds the pours after these.
    own_pours: usize,
    /// Whether the request gives the duration.
    seconds_given: bool,
    /// Whether the request gives the camera.
    pub(super) camera_given: bool,
}

/// A part of the script that comes from the request.
enum RequestPart {
    Seconds,
    /// A pour, with its number among the pours of the request.
    Pour(usize),
    Camera,
    Palette,
}

impl OpenScript {
    /// Reads the script of a request, or makes one for its subject, and changes it as the request says.
    /// `library` is the library of the request, if it names one.
    pub(super) fn open(
        request: &PictureRequest,
        own: &VolumesRequest,
        library: Option<&PigmentLibrary>,
        listener: &mut Listener<'_>,
    ) -> Result<Self, PictureError> {
        let mut open = Self::of(&request.subject, own.seconds)?;
        let usual = (library.is_some() && !open.is_file()).then_some(Preset::Grisaille);
        open.apply_style(&request.style, usual)?;
        open.apply_pours(own, &request.pigments.palette, library)?;
        open.apply_ground(own, listener)?;
        // We play the rounded values, because a script that we write holds these.
        open.script = open.script.rounded();
        open.script.check().map_err(|fault| open.located(fault))?;
        if open.script.events().is_empty() {
            let message = format!("{}: nothing is poured", request.subject.display());
            let hint = "add [pour=0.5,0.5], or a script with [[pour]]";
            return Err(SettingError::whole(message, hint).into());
        }
        Ok(open)
    }

    /// Reads the script `subject`. If `subject` is a model or photograph, makes a script for it in which
    /// nothing happens yet.
    fn of(subject: &Path, seconds: Option<f64>) -> Result<Self, PictureError> {
        let seconds_given = seconds.is_some();
        if !is_toml(subject) {
            let script = Script::new(&subject.to_string_lossy(), seconds.unwrap_or(SECONDS));
            return Ok(Self {
                script,
                file: None,
                own_pours: 0,
                seconds_given,
                camera_given: false,
            });
        }
        let name = subject.display().to_string();
        let text = read_text(subject)?;
        let script = Script::open_own(subject)?;
        let own_pours = script.pours.len();
        Ok(Self { script, file: Some((name, text)), own_pours, seconds_given, camera_given: false })
    }

    /// Whether the script was read from a file.
    pub(super) fn is_file(&self) -> bool {
        self.file.is_some()
    }

    /// Changes the settings. `usual` is the preset if neither the request nor the script names one.
    fn apply_style(
        &mut self,
        style: &StyleRequest,
        usual: Option<Preset>,
    ) -> Result<(), PictureError> {
        let script = &mut self.script;
        script.preset = style.preset::<VolumePainter>()?.or(script.preset).or(usual);
        if let Some(path) = &style.settings {
            script.change_settings(&path.display().to_string(), &read_text(path)?)?;
        }
        for change in &style.set {
            let toml = toml_of_change::<VolumePainter>(change)?;
            script.change_settings(change, &toml).map_err(|error| {
                // If the message does not begin with this change, the fault lies in earlier settings.
                match error.to_string().starts_with(change.as_str()) {
                    true => SettingError::as_of("set", &error),
                    false => SettingError::as_whole(&error),
                }
            })?;
        }
        Ok(())
    }

    /// Adds the pours of the request. `palette` lists pigments of the library. Without a library, it must be
    /// empty.
    fn apply_pours(
        &mut self,
        own: &VolumesRequest,
        palette: &[String],
        library: Option<&PigmentLibrary>,
    ) -> Result<(), SettingError> {
        check_counts(own)?;
        let script = &mut self.script;
        if let Some(seconds) = own.seconds {
            script.seconds = seconds;
        }
        let (names, paints) = match library {
            Some(library) => {
                let paints = own.paint.iter().map(|text| recipe_of(text, library));
                (pigment_names(palette, library), paints.collect::<Result<Vec<_>, _>>()?)
            }
            None => {
                let keys = [("palette", palette), ("paint", &own.paint[..])];
                match keys.iter().find(|(_, texts)| !texts.is_empty()) {
                    Some((key, _)) => return Err(needs_pigments(key)),
                    None => (Vec::new(), Vec::new()),
                }
            }
        };
        for name in &names {
            palette_key(script, name);
        }
        let in_turn: Vec<String> = match names.is_empty() {
            true => script.palette.values().cloned().collect(),
            false => names,
        };
        for (index, text) in own.pour.iter().enumerate() {
            let recipe = match &paints[..] {
                [] => in_turn.iter().cycle().nth(index).map(|name| vec![(name.clone(), 1.0)]),
                [one] => Some(one.clone()),
                each => Some(each[index].clone()),
            };
            let (picked, amount_mm3) = pour_of(text)?;
            let mut pour = PourTable {
                picked: Some(Row(picked)),
                for_s: script.seconds.min(FLOW_S),
                amount_mm3: Some(amount_mm3),
                ..PourTable::default()
            };
            for (name, part) in recipe.into_iter().flatten() {
                *pour.recipe.entry(palette_key(script, &name)).or_default() += part;
            }
            script.pours.push(pour);
        }
        Ok(())
    }

    /// Gives the script the ground of the request.
    fn apply_ground(
        &mut self,
        own: &VolumesRequest,
        listener: &mut Listener<'_>,
    ) -> Result<(), PictureError> {
        let script = &mut self.script;
        if let Some(name) = &own.ground {
            let kind = canvas_of(name)?;
            let reflectance = script.ground.take().and_then(|own| own.reflectance);
            script.ground = Some(GroundSpec { reflectance, ..kind.spec(1) });
        }
        let Some(text) = &own.over else { return Ok(()) };
        let mut remarks = Vec::new();
        let backing = backing_from_text(text, &mut remarks);
        remarks.into_iter().for_each(|remark| listener(Note::Remark(remark)));
        let primer = match backing? {
            Backing::Even(reflectance) => Primer::Grey(reflectance),
            Backing::Measured(spectrum) => {
                let grid = spectrum.grid();
                let values = spectrum.values().to_vec();
                Primer::Measured(MeasuredPrimer { spectrum: PrimerSpectrum { grid, values } })
            }
        };
        let before = script.ground.take().unwrap_or_else(|| GroundKind::Panel.spec(1));
        script.ground = Some(GroundSpec { reflectance: Some(primer), ..before });
        Ok(())
    }

    /// The light of the request, or else the light of the script. `folder` is the folder of the script.
    pub(super) fn light(&self, pigments: &PigmentRequest, folder: &Path) -> Option<String> {
        pigments.illuminant.clone().or_else(|| self.script.light(folder))
    }

    /// Pigments, ground and light for the palette of the script. `requested` is the library of the
    /// request. Without it, if the script shows films, we open the library that the script names, from
    /// `folder`.
    pub(super) fn materials(
        &self,
        settings: &Settings,
        (request, own): (&PigmentRequest, &VolumesRequest),
        (requested, folder): (Option<PigmentLibrary>, &Path),
    ) -> Result<Option<VolumePigments>, PictureError> {
        let script = &self.script;
        let styles = script.region_styles(settings);
        let shows_films = styles.iter().any(|style| style.inside != Inside::OwnColors);
        let library = match requested {
            Some(library) => Some(library),
            None if shows_films && !script.palette.is_empty() => script.open_library(folder)?,
            None => None,
        };
        let Some(library) = library else {
            let keys = [
                ("ground", own.ground.is_some()),
                ("over", own.over.is_some()),
                ("illuminant", request.illuminant.is_some()),
            ];
            return match keys.iter().find(|(_, is_there)| *is_there) {
                None => Ok(None),
                Some((key, _)) => Err(needs_pigments(key).into()),
            };
        };
        if script.palette.is_empty() {
            let path = request.library.as_deref().unwrap_or(folder);
            let message = format!("{}: no pigment of this library is chosen", path.display());
            let hint = "add [palette] with up to eight of its pigments, or [paint] for each pour";
            return Err(SettingError::whole(message, hint).into());
        }
        let slots = script.slots(&library).map_err(|fault| self.located(fault))?;
        let ground = script.ground_under(&library).map_err(|fault| self.located(fault))?;
        // Films are thinner than the relief of a ground, which would only hide the drawing.
        let usual = Lighting::default();
        let illuminant = self.light(request, folder).unwrap_or(usual.illuminant);
        let lighting = Lighting { illuminant, relief: 0.0, ..Lighting::default() };
        // An unknown light is refused before anything is painted.
        Viewing::named(&lighting.illuminant, &lighting.observer)?;
        let library = Arc::new(library);
        Ok(Some(VolumePigments { library, slots, own_colors: None, ground, lighting }))
    }

    /// The error for a fault of the script. It names file and line, or the key of the request.
    pub(super) fn located(&self, fault: Box<ValueFault>) -> PictureError {
        let Some(part) = self.part_of_request(&fault.key) else {
            return match &self.file {
                Some((name, text)) => ScriptError::located(name, text, fault).into(),
                None => ScriptError::from(fault).into(),
            };
        };
        let ValueFault { wanted, found, hint, .. } = *fault;
        let takes = format!("takes {wanted}, found `{found}`");
        let error = match part {
            RequestPart::Seconds => SettingError::of("seconds", takes, ""),
            RequestPart::Pour(number) => {
                SettingError::of("pour", format!("number {number} {takes}"), "")
            }
            RequestPart::Camera => SettingError::of("camera", takes, ""),
            // This is a fault of the input, because the names of pigments depend on the library.
            RequestPart::Palette => {
                SettingError::of("palette", takes, "").or_of("paint").with_fault(Fault::Input)
            }
        };
        error.verbatim(hint).into()
    }

    /// The part of the request that the value at `key` comes from. `None` if it comes from the script itself.
    fn part_of_request(&self, key: &KeyPath) -> Option<RequestPart> {
        let (first, index) = match &key.0[..] {
            [KeyStep::Key(first), KeyStep::Index(index), ..] => (first, Some(*index)),
            [KeyStep::Key(first), ..] => (first, None),
            _ => return None,
        };
        match (first.as_str(), index) {
            ("seconds", _) if self.seconds_given || self.file.is_none() => {
                Some(RequestPart::Seconds)
            }
            ("pour", Some(index)) if index >= self.own_pours => {
                Some(RequestPart::Pour(index + 1 - self.own_pours))
            }
            ("camera", _) if self.camera_given => Some(RequestPart::Camera),
            ("palette", _) if self.file.is_none() => Some(RequestPart::Palette),
            _ => None,
        }
    }

    /// The error for a script that cannot be played. It names file and line, or the key of the request.
    pub(super) fn located_event(&self, error: PerformanceError) -> PictureError {
        if let Some(RequestPart::Pour(number)) =
            error.table().and_then(|table| self.part_of_request(table))
        {
            let error = error.placed(format!("number {number}"));
            return SettingError::as_of("pour", &error).with_fault(error.fault()).into();
        }
        match &self.file {
            Some((name, text)) => error.located(name, text).into(),
            None => error.into(),
        }
    }
}

/// The error for a key that only pictures with pigments take.
pub(super) fn needs_pigments(key: &str) -> SettingError {
    let hint = "name a [library] after the subject, and give [palette]";
    SettingError::of(key, "needs pigments, but no library is given", hint)
}

/// Checks that there is paint for every pour, and a pour for every paint.
fn check_counts(own: &VolumesRequest) -> Result<(), SettingError> {
    match (own.paint.len(), own.pour.len()) {
        (0, _) | (1, 1..) => Ok(()),
        (paints, pours) if paints == pours => Ok(()),
        (_, 0) => Err(SettingError::of("paint", "", "add [pour=0.5,0.5]")
            .naming("is the paint of pours, but there is no [pour]")),
        (paints, pours) => Err(SettingError::whole(
            format!("{} for {}", counted(paints, "recipe"), counted(pours, "pour")),
            "give one [paint] for all pours, or one for each",
        )),
    }
}

/// The key of a pigment in the palette of a script, which is added if it is new.
fn palette_key(script: &mut Script, pigment: &str) -> String {
    if let Some((key, _)) = script.palette.iter().find(|(_, name)| *name == pigment) {
        return key.clone();
    }
    let mut keys = (1..).map(|number| format!("P{number}"));
    let key = keys.find(|key| !script.palette.contains_key(key)).unwrap_or_default();
    script.palette.insert(key.clone(), pigment.to_owned());
    key
}

/// Reads `X,Y[,MM3]`.
fn pour_of(text: &str) -> Result<([f64; 2], f64), SettingError> {
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
    let reason =
        format!("takes X,Y or X,Y,MM3 with shares of 0 to 1 and more than 0 mm3, found `{text}`");
    Err(SettingError::of("pour", reason, "try [pour=0.5,0.6] or [pour=0.5,0.6,200]"))
}

/// Reads `NAME=PART,NAME=PART`. A name alone has one part.
fn recipe_of(text: &str, library: &PigmentLibrary) -> Result<Vec<(String, f64)>, SettingError> {
    let read = listed(text, library, name_in_recipe).into_iter().map(|part: &str| {
        let (name, share) = part.rsplit_once('=').unwrap_or((part, "1"));
        let share: f64 = share.trim().parse().ok()?;
        let name = name.trim();
        let fits = !name.is_empty() && share > 0.0 && share.is_finite();
        fits.then(|| (name.to_owned(), share))
    });
    read.collect::<Option<_>>().ok_or_else(|| {
        let reason = format!("takes pigments with their parts above 0, found `{text}`");
        SettingError::of("paint", reason, "try [paint=\"Ultramarine=2,Titanium White=1\"]")
    })
}
