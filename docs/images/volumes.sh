#!/bin/sh
# Writes the pictures of paint that spreads over drawings into docs/images/: volumes*.jpg and
# volumes.gif. Needs `impasto` on the path (or IMPASTO=its path) and Python with Pillow (PYTHON=its
# path). Run it from the root of the repository: sh docs/images/volumes.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

pour() { # NAME SUBJECT OPTIONS..
    name=$1
    shift
    "$impasto" stencil "$@" --picture "$scratch/$name.png" > "$scratch/$name.txt"
}

# A village that wakes up, in six moments and as an animation.
cat > "$scratch/village.toml" <<'SCRIPT'
format = "paint-volumes"
version = 1
title = "A village wakes up"
subject = "shape:village"
seconds = 6.0
preset = "washed"

[camera]
azimuth_deg = 30.0
elevation_deg = 22.0

[[pour]]
picked = [0.5, 0.5]
from_s = 0.3
for_s = 3.5
amount_mm3 = 330

[[pour]]
picked = [0.24, 0.6]
from_s = 1.5
for_s = 3.0
amount_mm3 = 260

[[pour]]
picked = [0.75, 0.62]
from_s = 2.5
for_s = 2.5
amount_mm3 = 300
SCRIPT
for moment in 0.8 1.7 2.6 3.5 4.5 6.0; do
    pour "wake-$moment" "$scratch/village.toml" --width 720 --at "$moment"
done
"$impasto" stencil "$scratch/village.toml" --width 480 --rate 12 --animation "$scratch/volumes.gif" \
    > "$scratch/gif.txt"

# The volumes, and the result.
pour seed-volumes shape:still-life --pour 0.42,0.55,110 --pour 0.66,0.66,60 --show volumes
pour seed-result shape:still-life --pour 0.42,0.55,110 --pour 0.66,0.66,60

# The five presets.
oils=measurements/van-gogh-oils.pigments.json
for preset in sketch washed tinted bleed; do
    pour "preset-$preset" shape:still-life --preset "$preset" --pour 0.42,0.6,160
done
blue="--pour 0.36,0.5,18 --paint Ultramarine=1"
red="--pour 0.66,0.66,12 --paint Cochineal\ Lake=1"
yellow="--pour 0.45,0.8,18 --paint Chrome\ Yellow=1"
eval "pour preset-grisaille shape:still-life --preset grisaille $oils $blue $red $yellow \
    --output '$scratch/glazes.exr'"

# The glazes by day and by lamp.
"$impasto" relight "$scratch/glazes.exr" --illuminant A --adaptation 0.4 \
    --picture "$scratch/lamp.png" > "$scratch/lamp.txt"

# Colour spreads over a photograph.
pour photograph docs/images/coffee.jpg --preset washed --pour 0.45,0.5,260 --seconds 5 --width 900

# The same paint in one shell, in two and in four.
shells() { # NAME SIZES
    pour "$1" docs/images/coffee.jpg --pour 0.52,0.46,290 --seconds 5 --width 700 \
        --set grid.cell=0.12 --set "drawing.shells=$2"
}
shells shells-1 "[1.0]"
shells shells-2 "[1.0, 0.75]"
shells shells-4 "[1.0, 0.85, 0.7, 0.55]"

"${PYTHON:-python3}" - "$scratch" <<'PYTHON'
import sys
from pathlib import Path

from PIL import Image

scratch, images = Path(sys.argv[1]), Path("docs/images")


def sheet(name, columns, *names):
    pictures = [Image.open(scratch / f"{own}.png").convert("RGB") for own in names]
    width, height = pictures[0].size
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (width * columns, height * rows), "white")
    for index, picture in enumerate(pictures):
        whole.paste(picture, (index % columns * width, index // columns * height))
    whole.thumbnail((1600, 1600), Image.LANCZOS)
    whole.save(images / f"{name}.jpg", quality=88, optimize=True)


sheet("volumes", 3, *[f"wake-{at}" for at in ("0.8", "1.7", "2.6", "3.5", "4.5", "6.0")])
sheet("volumes-inside", 2, "seed-volumes", "seed-result")
sheet("volumes-presets", 3, *[f"preset-{own}" for own in ("sketch", "washed", "tinted", "bleed", "grisaille")], "lamp")
sheet("volumes-photograph", 1, "photograph")
sheet("volumes-shells", 3, "shells-1", "shells-2", "shells-4")
(images / "volumes.gif").write_bytes((scratch / "volumes.gif").read_bytes())
PYTHON
