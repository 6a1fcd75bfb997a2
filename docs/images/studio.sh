#!/bin/sh
# Writes the screenshots of the studio (studio*.jpg) into docs/images/.
# Needs cargo, a graphics adapter (a software one such as lavapipe is enough), and Python
# with Pillow (PYTHON=its path).
# Run it from the root of the repository: sh docs/images/studio.sh
set -eu

scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

cargo run --quiet -p impasto-studio --example screenshots -- "$scratch"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image

scratch = Path(sys.argv[1])
names = ["studio", "studio-lights", "studio-colour", "studio-layers", "studio-marks", "studio-guides"]
for name in [*names, "studio-volumes"]:
    picture = Image.open(scratch / f"{name}.png").convert("RGB")
    kept = Path(f"docs/images/{name}.jpg")
    # The highest quality that stays below 200 kB.
    for quality in range(90, 60, -2):
        picture.save(kept, quality=quality, optimize=True, progressive=True)
        if kept.stat().st_size <= 200_000:
            break
    print(f"{kept}: {kept.stat().st_size // 1000} kB, quality {quality}")
END
