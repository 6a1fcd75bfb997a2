#!/bin/sh
# Writes the watercolor pictures (watercolor-*.jpg, turning.gif) into docs/images/.
# Needs `impasto` on the path (or IMPASTO=its path) and Python with Pillow (PYTHON=its path).
# Run it from the root of the repository: sh docs/images/watercolor.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
watercolor() { "$impasto" watercolor --backend cpu "$@"; }

watercolor shape:still-life --preset portrait --camera 25,12 -o "$scratch/still-life.png"
watercolor shape:village --preset landscape --camera 40,16 -o "$scratch/village.png"
for preset in portrait landscape sketch; do
    watercolor docs/images/coffee.jpg --preset "$preset" -o "$scratch/coffee-$preset.png"
done

# Every stage, with settings that make wobble and dry brush visible.
watercolor shape:still-life --camera 25,12 --set dry_brush.amount=0.15 --set wobble.amount_px=2 \
    --stages "$scratch/stages"

# Five calibrated pigments, and the same painting with viridian in place of ultramarine.
"$impasto" demo -o "$scratch/demo" > "$scratch/demo.txt"
watercolor shape:still-life --preset portrait --camera 25,12 --width 750 \
    "$scratch/demo/van-gogh-oils.pigments.json" \
    --palette "Ultramarine,Eosin Lake,Chrome Yellow,Vermilion,Bone Black" \
    -o "$scratch/day.png" -o "$scratch/glazes.exr"
"$impasto" relight "$scratch/glazes.exr" --backend cpu \
    --swap "all:Ultramarine=Viridian" -o "$scratch/swapped.png"

watercolor shape:village --preset portrait --camera 0,22 --width 320 --turntable 30 --rate 12 \
    --animation docs/images/turning.gif --frames "$scratch/turning"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image, ImageDraw, ImageFont

scratch = Path(sys.argv[1])
font = ImageFont.load_default(size=18)


def opened(name):
    return Image.open(name).convert("RGB")


def keep(picture, name):
    picture.save(f"docs/images/{name}.jpg", quality=88, optimize=True)


def grid(pictures, columns, gap=8, names=None):
    width, height = pictures[0].size
    rows = -(-len(pictures) // columns)
    line = 26 if names else 0
    size = (columns * (width + gap) - gap, rows * (height + gap + line) - gap)
    whole = Image.new("RGB", size, "white")
    draw = ImageDraw.Draw(whole)
    for place, picture in enumerate(pictures):
        x, y = place % columns * (width + gap), place // columns * (height + gap + line)
        whole.paste(picture, (x, y + line))
        if names:
            draw.text((x + 2, y + 1), names[place], fill="#333333", font=font)
    return whole


keep(opened(scratch / "still-life.png"), "watercolor-still-life")
keep(opened(scratch / "village.png").crop((0, 60, 1000, 660)), "watercolor-village")

photographs = [opened("docs/images/coffee.jpg")]
photographs += [opened(scratch / f"coffee-{p}.png") for p in ("portrait", "landscape", "sketch")]
names = ["photograph", "portrait", "landscape", "sketch"]
keep(grid(photographs, 2, names=names), "watercolor-photograph")

stages = sorted((scratch / "stages").glob("*.png"))
names = [path.stem[3:].replace("-", " ") for path in stages]
# Crop to the foot of the jug and two pieces of fruit.
parts = [opened(path).crop((240, 180, 580, 460)) for path in stages]
keep(grid(parts, 3, names=names), "watercolor-effects")

keep(grid([opened(scratch / f"{name}.png") for name in ("day", "swapped")], 2), "watercolor-glazes")
END
