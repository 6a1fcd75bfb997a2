#!/bin/sh
# Makes the pictures of the README from the scripts in paintings/.
# Needs `impasto` on the path (or in IMPASTO), and Python with Pillow (PYTHON names it).
# Run it in the root of the repository: sh docs/pictures.sh
set -eu

impasto=${IMPASTO:-impasto}
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

for script in landscape glaze colour-study; do
    "$impasto" paint "paintings/$script.json" --backend cpu \
        --picture "$scratch/$script.png" --output "$scratch/$script.exr"
done

# The same glaze under a lamp, and with the light from the right, lower.
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
    picture.save(f"docs/{name}.jpg", quality=88, optimize=True)


landscape = opened("landscape")
keep(landscape.resize((900, 630), Image.Resampling.LANCZOS), "landscape")

# Cells as they are, each shown as 3 x 3 pixels.
detail = landscape.crop((620, 330, 960, 530))
keep(detail.resize((1020, 600), Image.Resampling.NEAREST), "landscape-detail")

keep(opened("colour-study").resize((900, 600), Image.Resampling.LANCZOS), "colour-study")

thirds = Image.new("RGB", (1200, 266), "white")
for place, name in enumerate(["glaze", "lamp", "side"]):
    part = opened(name).crop((20, 10, 780, 526))
    thirds.paste(part.resize((392, 266), Image.Resampling.LANCZOS), (404 * place, 0))
keep(thirds, "glaze")
END
