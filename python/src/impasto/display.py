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
    head = "".join(f"<th>{escape(text)}</th>" for text in headings)
    body = "".join(
        "<tr>"
        + "".join(f"<td>{cell if isinstance(cell, Html) else escape(str(cell))}</td>" for cell in row)
        + "</tr>"
        for row in rows
    )
    caption = f"<caption>{escape(title)}</caption>" if title else ""
    return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def findings(warnings: Sequence[str]) -> str:
    """Warnings as a list, or nothing."""
    if not warnings:
        return ""
    return "<p><b>Warnings</b></p><ul>" + "".join(f"<li>{escape(w)}</li>" for w in warnings) + "</ul>"
