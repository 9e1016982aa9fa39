"""The card of a catalogue: what is in it, how it was made, what is weak."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from stampede.catalogue import Catalogue, StoredEpisode
from stampede.publish import card
from stampede.publish.tables import Table
from stampede.publish.words import code, plain

FILE, LOCK = "demos.db", "demos.lock"
_MOST_OPTIONS = 8  # sets of options that a card tells of
_MOST_SENTENCES = 4
_VIEWS = {
    "episodes": "good and bad; `demos` are those that succeeded",
    "segments": "subgoals, skills and motions, with arguments, first and last frames, outcome",
    "facts": "what was true, from when to when",
    "steps": "joints, tip, commands, the skill that runs: a row a frame (rad, m, s)",
    "poses": "where each thing was at each frame (m, quaternions xyzw)",
    "instructions": "sentences, by level",
    "problems, plans": "PDDL, and the plan that was to be executed",
    "images, cameras": "stored pictures, and lenses",
    "tries, failures": "what was undone, and why it failed",
}
_TASKS = """SELECT task, count(*) AS n, sum(outcome = 'success') AS good, sum(outcome != 'success') AS bad,
sum(split = 'train') AS train, sum(split = 'test') AS test, sum(duration_s) / 3600.0 AS hours
FROM episodes GROUP BY task ORDER BY task"""
_SKILLS = """SELECT skill, count(*) AS n, sum(outcome = 'success') AS good, avg(duration_s) AS seconds
FROM segments WHERE kind = 'skill' GROUP BY skill ORDER BY skill"""
_SCRIPTS = """SELECT count(DISTINCT hash) AS n FROM definitions
WHERE episode IN (SELECT min(episode) FROM episodes GROUP BY task)"""
_WEAK = """SELECT count(*) AS n, sum(source = 'real') AS real, sum(outcome != 'success') AS bad, sum(undone) AS undone,
sum(split = 'test') AS test, (SELECT count(*) FROM images) AS pictures,
(SELECT count(DISTINCT episode) FROM agent_actions) AS acted,
(SELECT count(*) FROM instructions WHERE source != 'template') AS said FROM episodes"""


@dataclass(frozen=True)
class Made:
    """What is in the folder."""

    demos: Catalogue
    tables: Sequence[Table]
    content: str  # hash of all but host times
    unlocked: str  # why there is no lock; empty: there is one
    shown: StoredEpisode | None  # in film and contact sheet
    film: bool


def card_of(made: Made, options: argparse.Namespace) -> list[str]:
    tags = ["robotics", *(["LeRobot"] if options.lerobot else []), "simulation", "stampede"]
    shards = {"lerobot": "lerobot/data/*/*.parquet"} if options.lerobot else {}
    files = {"episodes": "episodes.csv", "segments": "segments.csv", **shards}
    return [
        *card.front_matter(options, len(made.demos), tags, files),
        "",
        f"# {plain(options.name)}",
        "",
        "Labelled demonstrations of robot tasks: what the robot did, frame by frame, with skills, facts, plans and",
        f"sentences. All is in one SQLite file, `{FILE}`.",
        *_picture(made, options),
        *_files(made, options),
        *_counts(made),
        "",
        "## Fields",
        "",
        "SI units, radians, quaternions xyzw; seconds count from the episode's start; spans are half-open. Views of",
        f"`{FILE}`; `stampede query --views` says what each column means, its unit and frame of reference:",
        "",
        *card.grid(["view", "what"], ([f"`{names}`", what] for names, what in _VIEWS.items())),
        *card.fields(made.tables),
        *_sentences(made),
        *_how(made, options),
        *_weaknesses(made),
        *card.ending(options),
    ]


def _picture(made: Made, options: argparse.Namespace) -> list[str]:
    if made.shown is None:
        return ["", "No episode succeeded, so none is shown."]
    lines = ["", f"Episode {made.shown.id}: {code(made.shown.task)} {code(made.shown.variation)}", ""]
    page = card.page_of(options)
    if made.film and page:
        lines += [f'<video controls src="{page}/resolve/main/film.mp4"></video>', ""]
    picture = "![Its start, a picture amid each skill, its end](sheet.png)"
    return [*lines, f"[{picture}](film.mp4)" if made.film else picture]


def _files(made: Made, options: argparse.Namespace) -> list[str]:
    files = {
        FILE: "the catalogue",
        **({} if made.unlocked else {LOCK: "what it is made of: the same data come out of it again"}),
        "episodes.csv, segments.csv": "two of its views as tables",
        **({"lerobot/": "the successful episodes as LeRobotDataset v3.0"} if options.lerobot else {}),
        "croissant.json": "what files and rows are, for programs",
        "SHA256SUMS": "hashes of all other files",
    }
    how = ["", 'LeRobot reads a folder: download this one, then `LeRobotDataset("local", root="lerobot")`.']
    rows = card.grid(["file", "what"], ([f"`{name}`", what] for name, what in files.items()))
    return ["", "## Files", "", *rows, *(how if options.lerobot else [])]


def _counts(made: Made) -> list[str]:
    tasks, skills = made.demos.query(_TASKS), made.demos.query(_SKILLS)
    total = {name: sum(row[name] for row in tasks) for name in tasks.columns if name != "task"}

    def numbers(row: dict[str, Any]) -> list[object]:
        return [*(row[name] for name in ("n", "good", "bad", "train", "test")), f"{row['hours']:.4f}"]

    rows = [*([code(row["task"]), *numbers(row)] for row in tasks), ["**all**", *numbers(total)]]
    of_skills = ([code(row["skill"]), row["n"], row["good"], f"{row['seconds']:.2f}"] for row in skills)
    return [
        "",
        "## Counts",
        "",
        *card.grid(["task", "episodes", "success", "failure", "train", "test", "hours"], rows),
        "",
        "Splits: the seeds of `test` (1,000,000 and above) are never those of `train`; column `split` says which.",
        "",
        *card.grid(["skill", "segments", "success", "mean s"], of_skills),
    ]


def _sentences(made: Made) -> list[str]:
    shown = made.shown or made.demos.episodes("episode = (SELECT min(episode) FROM episodes)")[0]
    said = {
        "task": shown.instructions("task"),
        "world": shown.instructions("world"),
        "skill": shown.instructions("skill"),
    }
    rows = ([level, "<br>".join(map(plain, texts[:_MOST_SENTENCES])) or "–"] for level, texts in said.items())
    head = ["", "## Sentences", "", f"At three levels; the first ones of episode {shown.id}:", ""]
    return [*head, *card.grid(["level", "text"], rows)]


def _how(made: Made, options: argparse.Namespace) -> list[str]:
    makers = made.demos.query("SELECT DISTINCT engine_version AS release, numerics FROM episodes ORDER BY 1, 2")
    asked = made.demos.query("SELECT DISTINCT options FROM episodes ORDER BY 1").values("options")
    (scripts,) = made.demos.query(_SCRIPTS)
    more = len(asked) - _MOST_OPTIONS
    lines = [
        "",
        "## How it was made, and how to make it again",
        "",
        *(f"- Release {code(row['release'])} of Stampede, numerics {code(row['numerics'])}" for row in makers),
        f"- {scripts['n']} scripts; their texts are in view `definitions`"
        + ("" if made.unlocked else " and in the lock"),
        *(f"- Options of its runs: {code(str(one))}" for one in asked[:_MOST_OPTIONS]),
        *([f"- and {more} more sets of options"] if more > 0 else []),
        f"- Content hash: `{made.content}` (`stampede query {FILE} --hash`)",
        f"- This folder: `{card.command(options)}`",
        "",
    ]
    if made.unlocked:
        lines += [f"There is no lock, and it cannot be made again from scripts: {plain(made.unlocked)}.", ""]
    again = [] if made.unlocked else [f"stampede make {LOCK} --out again.db", f"stampede verify {LOCK} again.db"]
    ask = '"SELECT skill, count(*), avg(duration_s) FROM segments GROUP BY skill"'
    return [*lines, "```sh", *again, f"stampede query {FILE} success_by_task", f"stampede query {FILE} {ask}", "```"]


def _weaknesses(made: Made) -> list[str]:
    (n,) = made.demos.query(_WEAK)
    bits = "Out of the lock the same data come on the same release and class of processor only."
    found = [
        (n["real"] < n["n"], card.SIMULATED),
        (n["real"], f"{n['real']} episodes were recorded of a real robot: what was not recorded is NULL."),
        (n["acted"], f"{n['acted']} episodes were acted by a program, and are as good as it was."),
        (n["bad"], f"{n['bad']} of {n['n']} episodes failed, and are in it: view `demos` leaves them out."),
        (n["undone"], f"{n['undone']} tries of skills were undone: demonstrations look surer than they were."),
        (not n["test"], "No episode is of the test split."),
        (not n["pictures"], card.UNDRAWN),
        (not n["said"], "All sentences come from templates."),
        (not made.unlocked, bits),
    ]
    return ["", "## Known weaknesses", "", *(f"- {text}" for is_so, text in found if is_so)]
