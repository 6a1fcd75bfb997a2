#!/bin/sh
# shellcheck disable=SC2086 # words of $model, $own and $small are arguments of their own
# Writes the pictures of models and photographs in the brushwork of maps into docs/images/:
# painterly*.jpg, painterly-turning.gif and painterly-flow.gif.
# Needs `impasto` on the path (or IMPASTO=its path) and Python with Pillow (PYTHON=its path).
# Run it from the root of the repository: sh docs/images/painterly.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

map() { # NAME STYLE HUE
    "$impasto" artmap paint --style "$2" --hue "$3" --output "$scratch/$1-samples.exr" \
        --sheet "$scratch/$1-samples.png" > "$scratch/$1.txt"
    "$impasto" artmap build "$scratch/$1-samples.exr" --output "$scratch/$1.exr" \
        --sheet "$scratch/$1-map.png" >> "$scratch/$1.txt"
}

paint() { # NAME SUBJECT OPTIONS..
    name=$1
    shift
    "$impasto" painterly "$@" --picture "$scratch/$name.png" > "$scratch/$name.txt"
}

map oil oil-flat "#7d93b5"
map dabs dabs "#c9a227"
map knife knife "#c9a227"
map lines hatching "#7d6f5c"
map long oil-long "#7d93b5"

# Two models in four styles.
own="--set colour.from=model"
for model in "still-life 25,12" "village 40,16"; do
    set -- $model
    paint "$1-oil" "shape:$1" --camera "$2" --map "$scratch/oil.exr" $own --set layers.count=2
    paint "$1-dabs" "shape:$1" --camera "$2" --map "$scratch/dabs.exr" $own --set strokes.width_px=9
    paint "$1-knife" "shape:$1" --camera "$2" --map "$scratch/knife.exr" $own --preset knife \
        --set strokes.width_px=20
    paint "$1-lines" "shape:$1" --camera "$2" --map "$scratch/lines.exr" --preset hatching
done

# A photograph in three.
photograph=docs/images/coffee.jpg
paint photograph-1 $photograph --map "$scratch/oil.exr" --set layers.count=3 --set strokes.width_px=20
paint photograph-2 $photograph --preset knife --map "$scratch/knife.exr"
paint photograph-3 $photograph --preset hatching --map "$scratch/lines.exr"

# One painting with pigments: in daylight, in raking light, with other pigments.
"$impasto" painterly shape:still-life --camera 25,12 --map "$scratch/oil.exr" $own \
    --output "$scratch/painting.exr" --picture "$scratch/light-1.png" > "$scratch/painting.txt"
"$impasto" relight "$scratch/painting.exr" --backend cpu --azimuth 90 --elevation 15 \
    --picture "$scratch/light-2.png"
"$impasto" relight "$scratch/painting.exr" --backend cpu --swap "all:Cobalt Blue=Vermilion" \
    --picture "$scratch/light-3.png"

# The published way beside ours.
paint blur-1 shape:torus-knot --map "$scratch/oil.exr" --preset paper --set silhouette.width_px=0
paint blur-2 shape:torus-knot --map "$scratch/oil.exr"

# A turn, and a loop of flow.
small="--width 240 --set strokes.width_px=24"
"$impasto" painterly shape:torus-knot --map "$scratch/oil.exr" $small --turntable 40 --rate 15 \
    --frames "$scratch/turning" --animation docs/images/painterly-turning.gif > "$scratch/turning.txt"
"$impasto" painterly docs/images/coffee.jpg --map "$scratch/long.exr" --preset night --width 240 \
    --set strokes.width_px=24 --loop 32 --rate 15 \
    --frames "$scratch/flow" --animation docs/images/painterly-flow.gif > "$scratch/flow.txt"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image, ImageChops

scratch = Path(sys.argv[1])


def picture(name):
    return Image.open(scratch / f"{name}.png").convert("RGB")


def without_margins(pictures):
    """Pictures of one size without the white rows that all have above and below."""
    white = Image.new("RGB", pictures[0].size, "white")
    boxes = [ImageChops.difference(one, white).getbbox() or (0, 0, *one.size) for one in pictures
             if one.size == white.size]
    top = max(min(box[1] for box in boxes) - 15, 0)
    bottom = min(max(box[3] for box in boxes) + 15, white.height)
    return [one.crop((0, top, one.width, bottom)) for one in pictures]


def sheet(file, rows, width):
    """Pictures in rows, each row as wide as the sheet."""
    drawn = []
    for row in rows:
        pictures = without_margins([picture(name) for name in row])
        scale = width / sum(one.width / one.height for one in pictures)
        line = Image.new("RGB", (width, round(scale)), "white")
        left = 0.0
        for one in pictures:
            across = scale * one.width / one.height
            size = (round(left + across) - round(left), round(scale))
            line.paste(one.resize(size, Image.LANCZOS), (round(left), 0))
            left += across
        drawn.append(line)
    whole = Image.new("RGB", (width, sum(line.height for line in drawn)), "white")
    top = 0
    for line in drawn:
        whole.paste(line, (0, top))
        top += line.height
    whole.save(f"docs/images/{file}.jpg", quality=85, optimize=True)


styles = ["oil", "dabs", "knife", "lines"]
sheet("painterly", [[f"{model}-{style}" for style in pair] for model in ["still-life", "village"]
                    for pair in [styles[:2], styles[2:]]], 1400)
sheet("painterly-photograph", [[f"photograph-{n}" for n in (1, 2, 3)]], 1500)
sheet("painterly-lights", [[f"light-{n}" for n in (1, 2, 3)]], 1500)
sheet("painterly-sharpness", [[f"blur-{n}" for n in (1, 2)]], 1400)
for name in ["samples", "map"]:
    part = picture(f"oil-{name}")
    part.save(scratch / f"part-{name}.png")
sheet("painterly-map", [["part-samples"], ["part-map"]], 1400)
END
