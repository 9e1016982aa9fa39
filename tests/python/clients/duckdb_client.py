"""DuckDB with its extension for SQLite on a catalogue: `duckdb_client.py CATALOGUE`.

What it attaches it does not ask SQLite for: it runs the text of a view in its own SQL. Views where that gives something
else are known here; `Catalogue.query` gives DuckDB all of them.
"""

import math
import sqlite3
import sys

import duckdb
from duckdb_extension_sqlite_scanner import __file__ as package

REFUSED = {"failures", "images", "objects"}
OTHER = {"transitions": "no fact is NULL, not []"}

path = sys.argv[1]
version = f"v{duckdb.__version__}"
duck = duckdb.connect()
duck.execute(f"LOAD '{package.removesuffix('__init__.py')}extensions/{version}/sqlite_scanner.duckdb_extension'")
duck.execute(f"ATTACH '{path}' AS demos (TYPE sqlite, READ_ONLY)")
lite = sqlite3.connect(path)


def rows(answer):
    return sorted(answer.fetchall(), key=repr)


def alike(one, other):
    if isinstance(one, float):
        return isinstance(other, float | int) and math.isclose(one, other, rel_tol=1e-12, abs_tol=1e-12)
    return one == other


refused, different = set(), set()
views = [name for (name,) in lite.execute("SELECT name FROM sqlite_master WHERE type = 'view' ORDER BY name")]
for view in views:
    try:
        answer = duck.execute(f"SELECT * FROM demos.{view}")
        kinds = {str(column[1]) for column in answer.description}
        theirs = rows(answer)
    except duckdb.Error:
        refused.add(view)
        duck = duck.cursor()  # an internal error ends the connection
        continue
    assert kinds <= {"BIGINT", "DOUBLE", "VARCHAR", "JSON", "BOOLEAN"}, (view, kinds)
    ours = rows(lite.execute(f"SELECT * FROM {view}"))
    if len(ours) != len(theirs) or not all(all(map(alike, a, b)) for a, b in zip(theirs, ours, strict=True)):
        different.add(view)
assert refused <= REFUSED and different <= set(OTHER), (refused, different)
print(f"DuckDB {version} attaches {path}: {len(views) - len(refused | different)} of {len(views)} views are the same")
