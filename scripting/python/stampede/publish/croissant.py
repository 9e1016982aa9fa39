"""Croissant 1.0 (mlcommons.org/croissant): what the files are and what rows are in them, for programs."""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from stampede.publish.card import AUTHORS, bibtex, licence_page, page_of
from stampede.publish.folder import File, files_in
from stampede.publish.tables import Column, Table

Json = dict[str, Any]

# Croissant's own words; the rest are schema.org's.
_OURS = """citeAs column equivalentProperty extract field fileProperty fileObject fileSet format includes isLiveDataset
jsonPath key md5 parentField path recordSet references regex repeated replace samplingRate separator source subField
transform""".split()
_CONTEXT: Json = {
    "@language": "en",
    "@vocab": "https://schema.org/",
    "sc": "https://schema.org/",
    "cr": "http://mlcommons.org/croissant/",
    "rai": "http://mlcommons.org/croissant/RAI/",
    "dct": "http://purl.org/dc/terms/",
    "conformsTo": "dct:conformsTo",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
    "examples": {"@id": "cr:examples", "@type": "@json"},
    **{word: f"cr:{word}" for word in _OURS},
}
_FORMS = {
    ".csv": "text/csv",
    ".db": "application/vnd.sqlite3",
    ".json": "application/json",
    ".lock": "application/json",
    ".md": "text/markdown",
    ".mp4": "video/mp4",
    ".parquet": "application/vnd.apache.parquet",
    ".png": "image/png",
}
_MANY = "lerobot"  # a folder with files by the thousand: SHA256SUMS has their hashes


def _form(ending: str) -> str:
    return _FORMS.get(ending, "application/octet-stream")


def digest_of(hashes: Iterable[str]) -> str:
    """One hash of many."""
    return hashlib.sha256("".join(hashes).encode()).hexdigest()


def write(folder: Path, options: argparse.Namespace, what: str, content: str, tables: Sequence[Table]) -> None:
    """croissant.json of what is in the folder by now, but the card. content: hash of all that was published."""
    files, page = files_in(folder), page_of(options)
    named = [file for file in files if not file.name.startswith(f"{_MANY}/")]
    about: Json = {
        "@context": _CONTEXT,
        "@type": "sc:Dataset",
        "name": options.name,
        "description": what,
        "conformsTo": "http://mlcommons.org/croissant/1.0",
        "license": licence_page(options),
        "creator": {"@type": "sc:Organization", "name": AUTHORS},
        "version": f"1.0.0+{content[:12]}",
        "citeAs": bibtex(),
        "keywords": ["robotics", "demonstrations", "simulation"],
        **({"url": page} if page else {}),
        **({"datePublished": options.date} if options.date else {}),
        "distribution": [_object(file) for file in named] + _sets(files),
        "recordSet": [_records(table) for table in tables],
    }
    text = json.dumps(about, indent=1)
    for letter in "<>&":  # some put it into a page, between <script> and </script>
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    (folder / "croissant.json").write_text(text + "\n")


def _object(file: File) -> Json:
    return {
        "@type": "cr:FileObject",
        "@id": file.name,
        "name": file.name,
        "contentUrl": file.name,
        "contentSize": f"{file.size} B",
        "encodingFormat": _form(Path(file.name).suffix),
        "sha256": file.sha256,
    }


def _sets(files: Sequence[File]) -> list[Json]:
    endings = sorted({Path(file.name).suffix for file in files if file.name.startswith(f"{_MANY}/")})
    return [
        {
            "@type": "cr:FileSet",
            "@id": f"{_MANY}{ending}",
            "name": f"{_MANY}{ending}",
            "description": "Of the LeRobotDataset in lerobot/",
            "includes": f"{_MANY}/**/*{ending}",
            "encodingFormat": _form(ending),
        }
        for ending in endings
    ]


def _records(table: Table) -> Json:
    return {
        "@type": "cr:RecordSet",
        "@id": table.name,
        "name": table.name,
        "description": table.meaning,
        "key": [{"@id": f"{table.name}/{name}"} for name in table.key],
        "field": [_field(table, column) for column in table.columns],
    }


def _field(table: Table, column: Column) -> Json:
    # No `references` from segments to episodes: mlcroissant 1.1 then gives their rows once only, and none after that.
    return {
        "@type": "cr:Field",
        "@id": f"{table.name}/{column.name}",
        "name": column.name,
        "description": column.meaning + (f" ({column.unit})" if column.unit else ""),
        "dataType": f"sc:{column.kind}",
        "source": {"fileObject": {"@id": f"{table.name}.csv"}, "extract": {"column": column.name}},
    }
