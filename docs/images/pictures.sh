#!/bin/sh
# Paints the scripts in paintings/ and writes landscape.jpg, landscape-detail.jpg,
# colour-study.jpg, alla-prima.jpg and glaze.jpg into docs/images/.
# Needs `impasto` on the path (or IMPASTO=its path) and Python with Pillow (PYTHON=its path).
# Run it from the root of the repository: sh docs/images/pictures.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

for script in landscape glaze colour-study still-life; do
    "$impasto" paint "paintings/$script.json" --backend cpu \
        --picture "$scratch/$script.png" --output "$scratch/$script.exr"
done

# Three pixels along every cell.
"$impasto" relight "$scratch/landscape.exr" --backend cpu --supersample 3 \
    --picture "$scratch/landscape.png"

# The glaze painting again: under illuminant A, and under a low light from the right.
"$impasto" relight "$scratch/glaze.exr" --backend cpu --illuminant A --picture "$scratch/lamp.png"
"$impasto" relight "$scratch/glaze.exr" --backend cpu --azimuth 90 --elevation 15 \
    --picture "$scratch/side.png"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image

scratch = Path(sys.argv[1])


def opened(name):
    return Image.open(scratch / f"{name}.png").convert("RGB")


def keep(picture, name):
    picture.save(f"docs/images/{name}.jpg", quality=88, optimize=True)


landscape = opened("landscape")
keep(landscape.resize((900, 630), Image.Resampling.LANCZOS), "landscape")

# A detail, pixel by pixel.
keep(landscape.crop((1860, 990, 2880, 1590)), "landscape-detail")

keep(opened("colour-study").resize((900, 600), Image.Resampling.LANCZOS), "colour-study")
keep(opened("still-life").resize((900, 675), Image.Resampling.LANCZOS), "alla-prima")

thirds = Image.new("RGB", (1200, 266), "white")
for place, name in enumerate(["glaze", "lamp", "side"]):
    part = opened(name).crop((20, 10, 780, 526))
    thirds.paste(part.resize((392, 266), Image.Resampling.LANCZOS), (404 * place, 0))
keep(thirds, "glaze")
END
