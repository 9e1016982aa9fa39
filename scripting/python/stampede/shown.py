"""What notebooks show of objects: small tables of HTML."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence

from stampede._core import EpisodeArrays, Session


def table(header: Sequence[object], rows: Iterable[Sequence[object]], below: str = "") -> str:
    """With all texts as they are. header: empty for none."""
    lines = [_row(header, "th")] if header else []
    lines += [_row(row, "td") for row in rows]
    return f"<table>{''.join(lines)}</table>" + (f"<p>{html.escape(below)}</p>" if below else "")


def about(facts: Mapping[str, object]) -> str:
    """A table of what something is, a row a fact."""
    rows = (f"<tr>{_cell(name, 'th')}{_cell(fact, 'td')}</tr>" for name, fact in facts.items())
    return f"<table>{''.join(rows)}</table>"


def _row(cells: Sequence[object], kind: str) -> str:
    return "<tr>" + "".join(_cell(cell, kind) for cell in cells) + "</tr>"


def _cell(cell: object, kind: str) -> str:
    return f"<{kind}>{html.escape(str(cell))}</{kind}>"


def _arrays(arrays: EpisodeArrays) -> str:
    columns = [arrays.column(name) for name in arrays.keys()]
    rows = [(one.name, " x ".join(map(str, one.values.shape)), one.unit, one.frame) for one in columns]
    return table(("column", "shape", "unit", "frame"), rows, repr(arrays))


def _session(session: Session) -> str:
    return about({"session": repr(session), "tasks": len(session.tasks())})


def register() -> None:
    """For those classes of the engine's that notebooks show."""
    EpisodeArrays._repr_html_ = _arrays
    Session._repr_html_ = _session
