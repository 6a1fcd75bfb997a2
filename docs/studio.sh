#!/bin/sh
# Makes the pictures of the window that the README shows.
# Needs cargo, a graphics adapter (a software one will do, such as lavapipe), and Python
# with Pillow (PYTHON names it).
# Run it in the root of the repository: sh docs/studio.sh
set -eu

scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

cargo run --quiet -p impasto-studio --example screenshots -- "$scratch"

"${PYTHON:-python3}" - "$scratch" <<'END'
import sys
from pathlib import Path
from PIL import Image

scratch = Path(sys.argv[1])
for name in ["studio", "studio-lights", "studio-colour", "studio-layers"]:
    picture = Image.open(scratch / f"{name}.png").convert("RGB")
    kept = Path(f"docs/{name}.jpg")
    # As good as fits: letters want it sharp, the README small.
    for quality in range(90, 60, -2):
        picture.save(kept, quality=quality, optimize=True, progressive=True)
        if kept.stat().st_size <= 200_000:
            break
    print(f"{kept}: {kept.stat().st_size // 1000} kB, quality {quality}")
END
