"""What every card begins and ends with: README.md of a data set on a hub."""

from __future__ import annotations

import argparse
import json
import shlex
from collections.abc import Iterable, Mapping, Sequence

from stampede._core import __version__
from stampede.publish.tables import Table
from stampede.publish.words import plain

AUTHORS, TITLE = "The Stampede authors", "Stampede: labelled robot demonstrations from task scripts"  # CITATION.cff

SIMULATED = "Contacts, friction and looks are a simulation's: what holds here need not hold of a real robot."
UNDRAWN = "No pictures are stored: `stampede render` draws them."

# The hub's own names of licences; others are `other`, with their name.
_LICENCES = set(
    "apache-2.0 bsd-2-clause bsd-3-clause cc-by-2.0 cc-by-3.0 cc-by-4.0 cc-by-nc-4.0 cc-by-nc-nd-4.0 cc-by-nc-sa-4.0"
    " cc-by-nd-4.0 cc-by-sa-3.0 cc-by-sa-4.0 cc0-1.0 cdla-permissive-1.0 cdla-permissive-2.0 mit odbl odc-by pddl"
    " unlicense".split()
)


def front_matter(
    options: argparse.Namespace, rows: int, tags: Iterable[str], data_files: Mapping[str, str]
) -> list[str]:
    """The hub's YAML. data_files: patterns of files that the hub shows as tables, by name."""
    name = options.licence.lower()
    other = [] if name in _LICENCES else [f"license_name: {json.dumps(name)}", f"license_link: {licence_page(options)}"]
    lines = [
        "---",
        f"pretty_name: {json.dumps(options.name)}",
        f"license: {'other' if other else name}",
        *other,
        "language:",
        "- en",
        "task_categories:",
        "- robotics",
        "tags:",
        *(f"- {tag}" for tag in tags),
        "size_categories:",
        f"- {_size(rows)}",
        "configs:",
    ]
    for name, files in data_files.items():
        lines += [f"- config_name: {name}", "  data_files:", "  - split: full", f"    path: {json.dumps(files)}"]
    return [*lines, "---"]


def licence_page(options: argparse.Namespace) -> str:
    return f"https://spdx.org/licenses/{options.licence}.html"


def page_of(options: argparse.Namespace) -> str | None:
    """Where the hub shows it."""
    return f"https://huggingface.co/datasets/{options.repository}" if options.repository else None


def _size(rows: int) -> str:
    steps = ["1K", "10K", "100K", "1M", "10M", "100M", "1B"]
    place = max(0, len(str(rows)) - 3)
    if place == 0:
        return "n<1K"
    return f"{steps[place - 1]}<n<{steps[place]}" if place < len(steps) else "n>1B"


def command(options: argparse.Namespace) -> str:
    """That makes the same files of the same catalogue, and uploads nothing."""
    words = ["--shipped", *options.what, f"--episodes {options.episodes}"] if options.shipped else ["demos.db"]
    words += ["--out FOLDER", f"--name {shlex.quote(options.name)}", f"--licence {options.licence}"]
    words += [f"--date {options.date}"] if options.date else []
    words += [f"--repository {options.repository} --dry-run"] if options.repository else []
    words += [f"--{flag}" for flag in ("lerobot", "catalogues") if getattr(options, flag)]
    return " ".join(["python -m stampede.publish", *words])


def grid(head: Sequence[str], rows: Iterable[Sequence[object]]) -> list[str]:
    """A table of Markdown. Its texts are escaped by who gives them."""
    lines = [head, ["---"] * len(head), *rows]
    return ["| " + " | ".join(str(one) for one in line) + " |" for line in lines]


def fields(tables: Iterable[Table]) -> list[str]:
    lines: list[str] = []
    for table in tables:
        meanings = [[f"`{one.name}`", one.meaning.replace("|", "\\|"), one.unit] for one in table.columns]
        lines += ["", f"`{table.name}.csv`: {table.meaning}", "", *grid(["column", "meaning", "unit"], meanings)]
    return [*lines, "", "A text in a table (CSV) that a spreadsheet would take for a formula has `'` before it."]


def bibtex() -> str:
    """What CITATION.cff says, which lies beside the sources and not in the package."""
    return f"@software{{stampede, title = {{{TITLE}}}, author = {{{{{AUTHORS}}}}}, version = {{{__version__}}}}}"


def ending(options: argparse.Namespace) -> list[str]:
    return [
        "",
        "## Licence",
        "",
        f"[{plain(options.licence)}]({licence_page(options)})",
        "",
        "## Citation",
        "",
        "Cite Stampede, and the lock or the hash of these data.",
        "",
        "```bibtex",
        bibtex(),
        "```",
    ]
