"""Texts of catalogues in cards and tables: whatever they are, they stay text.

Who reads a catalogue of somebody else publishes words that somebody else chose: names of tasks, variations, sentences.
"""

from __future__ import annotations

import re
import unicodedata

_HIDDEN = {"Cc", "Cf", "Cs", "Zl", "Zp"}  # what ends lines, what turns or hides text
_SHOWN = 200  # letters of one text in a card


def one_line(text: str) -> str:
    """Without what is no letter."""
    return "".join(" " if unicodedata.category(letter) in _HIDDEN else letter for letter in text)


def _short(text: str) -> str:
    line = one_line(text).strip()
    return line if len(line) <= _SHOWN else line[:_SHOWN] + " …"


def plain(text: str) -> str:
    """For a sentence of Markdown: no mark in it is one, no address becomes a link, no tag a tag."""
    marked = re.sub(r"[!-%(-+./:;=?@\[-`{-~]", r"\\\g<0>", _short(text))
    return marked.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def code(text: str) -> str:
    """For a name of Markdown, in a table too: it is shown letter by letter."""
    shown = _short(text).replace("`", "'").replace("|", "\\|")
    return f"`{shown}`" if shown else "–"


def cell(value: object) -> object:
    """For a table (CSV): a spreadsheet takes no text for a formula. Such a text has ' before it."""
    if not isinstance(value, str):
        return value
    line = one_line(value)
    first = unicodedata.normalize("NFKC", line.lstrip()[:1])
    return f"'{line}" if first and first in "=+-@" else line
