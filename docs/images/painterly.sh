#!/bin/sh
# Writes painterly.jpg into docs/images/: models in the brushwork of maps.
# Needs `impasto` on the path (or IMPASTO=its path) and Python with Pillow (PYTHON=its path).
# Run it from the root of the repository: sh docs/images/painterly.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

map() { # NAME STYLE HUE
    "$impasto" artmap paint --style "$2" --hue "$3" --output "$scratch/$1-samples.exr" > "$scratch/$1.txt"
    "$impasto" artmap build "$scratch/$1-samples.exr" --output "$scratch/$1.exr" >> "$scratch/$1.txt"
}

map oil oil-flat "#7d93b5"
map dabs dabs "#c9a227"
map lines hatching "#7d6f5c"
"$impasto" painterly shape:still-life --map "$scratch/oil.exr" --camera 25,12 --set colour.from=model \
    --picture "$scratch/1.png"
"$impasto" painterly shape:village --map "$scratch/dabs.exr" --camera 40,16 --set colour.from=model \
    --set strokes.width_px=8 --picture "$scratch/2.png"
# The pigments and the relief of the map, in raking light.
"$impasto" painterly shape:still-life --map "$scratch/oil.exr" --camera 25,12 \
    --output "$scratch/still-life.exr"
"$impasto" relight "$scratch/still-life.exr" --backend cpu --azimuth 90 --elevation 15 \
    --picture "$scratch/3.png"
"$impasto" painterly shape:torus-knot --map "$scratch/lines.exr" --preset hatching \
    --picture "$scratch/4.png"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image

pictures = [Image.open(Path(sys.argv[1]) / f"{n}.png").convert("RGB") for n in (1, 2, 3, 4)]
width, height = pictures[0].size
whole = Image.new("RGB", (2 * width, 2 * height), "white")
for place, picture in enumerate(pictures):
    whole.paste(picture, (place % 2 * width, place // 2 * height))
whole.save("docs/images/painterly.jpg", quality=85, optimize=True)
END
