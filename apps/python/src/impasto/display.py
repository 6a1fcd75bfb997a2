"""Tables and swatches for notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape


class Html(str):
    """Text that is HTML already."""


def swatch(code: str) -> Html:
    """A patch of a colour `#rrggbb`."""
    return Html(
        f'<span style="display:inline-block;width:3em;height:1.4em;background:{escape(code)};'
        'border:1px solid #8888"></span>'
    )


def table(headings: Sequence[str], rows: Iterable[Sequence[object]], title: str = "") -> str:
    """An HTML table; cells of class `Html` stay as they are."""
    left = ' style="text-align:left"'
    head = "".join(f"<th{left}>{escape(text)}</th>" for text in headings)
    body = "".join(
        "<tr>"
        + "".join(
            f"<td{left}>{cell if isinstance(cell, Html) else escape(str(cell))}</td>" for cell in row
        )
        + "</tr>"
        for row in rows
    )
    caption = f"<p><b>{escape(title)}</b></p>" if title else ""
    return caption + f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def listed(title: str, sentences: Sequence[str]) -> str:
    """Sentences as a list below a title, or nothing."""
    items = "".join(f"<li>{escape(sentence)}</li>" for sentence in sentences)
    return f"<p><b>{escape(title)}</b></p><ul>{items}</ul>" if sentences else ""
