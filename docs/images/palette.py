"""Draws docs/images/palette.svg: every pigment of a library, tinted with its reference white.

    cargo run --release -- demo
    python3 docs/images/palette.py out/van-gogh-oils.pigments.json docs/images/palette.svg

The colour of each patch is the prediction of `impasto mix`.
"""

import json
import subprocess
import sys

SHARES = [100, 75, 50, 25, 10, 3, 1]
PATCH, GAP, NAME, TOP, ROW = 84, 4, 190, 64, 34


def impasto(*arguments):
    command = ["target/release/impasto", *arguments, "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def text(x, y, words, size, fill="#333", anchor="start"):
    words = words.replace("&", "&amp;").replace("<", "&lt;")
    return (
        f'<text x="{x}" y="{y}" font-family="sans-serif" font-size="{size}" '
        f'fill="{fill}" text-anchor="{anchor}">{words}</text>'
    )


def main():
    library, picture = sys.argv[1:3]
    white = json.load(open(library, encoding="utf-8"))["reference"]
    pigments = [p for p in impasto("library", "list", library) if p["identified"]]
    pigments = [p["name"] for p in pigments if p["name"] != white]
    width = NAME + len(SHARES) * (PATCH + GAP) + 16
    height = TOP + len(pigments) * ROW + 34
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        f'width="{width}" height="{height}">',
        f'<rect width="{width}" height="{height}" fill="#cfccc6"/>',
        text(16, 26, "Van Gogh's oils, calibrated: each pigment in " + white.lower(), 17, "#222"),
    ]
    for column, share in enumerate(SHARES):
        middle = NAME + column * (PATCH + GAP) + PATCH / 2
        out.append(text(middle, TOP - 10, f"{share} %", 12, "#444", "middle"))
    for row, name in enumerate(pigments):
        y = TOP + row * ROW
        out.append(text(16, y + 20, name, 13))
        for column, share in enumerate(SHARES):
            recipe = [f"{name}={share}"] + ([f"{white}={100 - share}"] if share < 100 else [])
            colour = impasto("mix", library, *recipe)["hex"]
            x = NAME + column * (PATCH + GAP)
            out.append(
                f'<rect x="{x}" y="{y}" width="{PATCH}" height="{ROW - GAP}" fill="{colour}"/>'
            )
    note = "predicted from K and S under D65; made by docs/images/palette.py"
    out.append(text(width - 16, height - 12, note, 11, "#555", "end"))
    out.append("</svg>\n")
    with open(picture, "w", encoding="utf-8") as file:
        file.write("\n".join(out))


main()
