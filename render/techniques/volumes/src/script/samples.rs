//! Scripts for tests.

/// A script with every table and nearly every key.
pub(super) const WHOLE: &str = r##"format = "paint-volumes"
version = 1
title = "A jug wakes up"
subject = "shape:still-life"
unit_mm = 100.0
seconds = 6.0
preset = "washed"
library = "oils/mine.pigments.json"
illuminant = "5600K"

[palette]
B = "Ultramarine"
Y = "Chrome Yellow"

[ground]
kind = "linen"
seed = 3
threads_per_cm = 12.5
relief_mm = 0.1

[ground.reflectance.spectrum]
values = [0.7, 0.8, 0.85]

[ground.reflectance.spectrum.grid]
start_nm = 400.0
step_nm = 150.0
count = 3

[grid]
cell = 0.083

[settings.motion]
kick = 0.5

[settings.drawing]
tint = []

[camera]
closed = true

[[camera.keyframe]]
eye = [4.0, 2.0, 6.0]
target = [0.0, 1.0, 0.0]

[[camera.keyframe]]
eye = [6.0, 3.0, 2.0]
target = [0.0, 1.0, 0.0]
up = [0.0, 1.0, 0.0]
field_of_view_deg = 30.0

[[region]]
name = "sky"

[[region]]
name = "glow"
inside = "own-colours"
shells = [1.0, 0.93, 0.86]
tint = [0.0, 0.35, 0.7, 1.0]
stain = "#e8d8b8"

[[keep]]
box = [[-1.0, -1.0, -1.0], [1.0, 2.0, 1.0]]

[[keep]]
sphere = [[0.0, 0.5, 0.0], 2.0]

[[keep]]
above = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]

[[volume]]
centre = [0.1, 0.6, 0.3]
radius = 0.2
detail = 4
recipe = { B = 1.0 }

[[pour]]
path = [[0.0, 0.1, 0.6, 0.3], [2.0, 0.5, 0.6, 0.2]]
from_s = 0.5
for_s = 2.0
rate_mm3_s = 40.0
region = "glow"
recipe = { B = 2.0, Y = 1.0 }

[[pour]]
picked = [0.42, 0.55]
from_s = 0.25
amount_mm3 = 5.0
recipe = { Y = 1.0 }

[[push]]
at = [0.1, 0.6, 0.3]
towards = [1.0, 0.0, 0.0]
radius = 0.2
strength = 10.0
from_s = 3.0
for_s = 0.5

[[lift]]
at = [0.1, 0.6, 0.3]
radius = 0.1
from_s = 4.0
for_s = 0.5
rate = 0.75

[[split]]
at_s = 4.5
volume = 1

[[dry]]
at_s = 5.0

[[dry]]
at_s = 5.5
at = [0.1, 0.6, 0.3]
radius = 0.25
"##;

/// The shortest script.
pub(super) const SHORT: &str =
    "format = \"paint-volumes\"\nversion = 1\nsubject = \"shape:sphere\"\nseconds = 1\n";

/// The example of the format's description, to the letter.
pub(super) const DESCRIBED: &str = r#"format = "paint-volumes"
version = 1
title = "A jug wakes up"
subject = "shape:still-life"      # or a model, or a photograph, beside this file
unit_mm = 100.0
seconds = 6.0
[palette]                         # with pigments; without it colours are the subject's own
B = "Ultramarine"
Y = "Chrome Yellow"
[grid]
cell = 0.083                      # of the longest side; 0 is single volumes only
[[pour]]                          # `at` a place of the model
at = [0.1, 0.6, 0.3]
from_s = 0.5
for_s = 2.0
rate_mm3_s = 40.0
recipe = { B = 2, Y = 1 }
path = [[0.0, 0.1, 0.6, 0.3], [2.0, 0.5, 0.6, 0.2]]   # seconds, then place: a moving source
"#;
