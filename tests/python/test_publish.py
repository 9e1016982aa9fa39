"""Folders for a data set hub: the same bytes again, counts as SQL has them, texts stay texts, nothing sent unasked."""

from __future__ import annotations

import csv
import hashlib
import json
import re
import sqlite3
import subprocess
import sys
import types
from pathlib import Path
from typing import Any

import pytest

import stampede
from stampede import _core
from stampede.publish import card, publish
from stampede.publish.words import cell, code, plain

PROGRAM = Path(_core.__file__).parent / "engine" / "bin" / "stampede"
EVIL = {
    "task": "=cmd|'/C calc'!A0",
    "variation": "@SUM(1)|<script>alert(1)</script>\n# Owned [x](javascript:1) `rm`",
    "sentence": "+1\n\n---\nlicense: mit <img src=x onerror=alert(1)> https://evil.example www.evil.example\u202e| *b*",
}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("publish") / "made.db"
    assert stampede.Session(catalogue=file).run_all(["reach_target"], episodes=2).succeeded == 2
    return file


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where pictures matter to nobody: a film takes longer than all the rest."""
    monkeypatch.setattr("stampede.publish.demos._draw", lambda folder, episode, tell: False)


@pytest.fixture(scope="module")
def folder(made: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run(made, tmp_path_factory.mktemp("out") / "set", "--repository", "me/reach", "--dry-run")


def run(file: Path, folder: Path, *more: str) -> Path:
    words = [str(file), "--out", str(folder), "--name", "Reach it", "--date", "2026-01-31", *more]
    return publish(words, tell=lambda line: None)


def files_of(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(newline="") as opened:
        return list(csv.DictReader(opened))


def program(*words: str | Path) -> str:
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


def refused(tmp_path: Path, *words: str) -> str:
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(stampede.Error) as error:
        publish([*words], tell=lambda line: None)
    assert sorted(tmp_path.rglob("*")) == before, "something half made was left"
    assert error.value.hint
    return str(error.value)


def front_matter(folder: Path) -> dict[str, Any]:
    yaml = pytest.importorskip("yaml")
    text = (folder / "README.md").read_text()
    assert text.startswith("---\n")
    loaded: dict[str, Any] = yaml.safe_load(text.split("---\n")[1])
    return loaded


def test_all_that_a_hub_wants_is_there_and_hashed(folder: Path) -> None:
    files = files_of(folder)
    expected = {"README.md", "SHA256SUMS", "croissant.json", "demos.db", "demos.lock", "episodes.csv", "segments.csv"}
    assert set(files) - {"film.mp4"} == expected | {"sheet.png"}  # a film needs libraries that may be missing
    lines = (folder / "SHA256SUMS").read_text().splitlines()[1:]
    sums = {name: digest for digest, name in (line.split("  ") for line in lines)}
    assert sums == {name: hashlib.sha256(files[name]).hexdigest() for name in files if name != "SHA256SUMS"}
    assert not list(folder.parent.glob(".*"))


def test_the_same_catalogue_gives_the_same_files_and_replaces_them(made: Path, folder: Path) -> None:
    before = files_of(folder)
    run(made, folder, "--repository", "me/reach", "--dry-run")
    assert files_of(folder) == before


def test_the_lock_makes_the_same_catalogue_again(folder: Path, tmp_path: Path) -> None:
    program("make", folder / "demos.lock", "--out", tmp_path / "again.db")
    program("verify", folder / "demos.lock", folder / "demos.db")
    (again,) = json.loads(program("query", tmp_path / "again.db", "--hash", "--json"))
    assert json.loads((folder / "demos.lock").read_text())["hash"] == again["content_hash"]
    assert again["content_hash"] in (folder / "README.md").read_text()


def test_the_card_says_what_the_catalogue_holds(made: Path, folder: Path) -> None:
    head, text = front_matter(folder), (folder / "README.md").read_text()
    assert head["license"] == "cc-by-4.0" and head["task_categories"] == ["robotics"]
    assert head["size_categories"] == ["n<1K"] and "LeRobot" not in head["tags"]
    for config in head["configs"]:
        assert all((folder / one["path"]).is_file() for one in config["data_files"])
    assert "| `reach_target` | 2 | 2 | 0 | 2 | 0 |" in text
    ((count, seconds),) = sqlite3.connect(made).execute(
        "SELECT count(*), avg((end_step - start_step) / 240.0) FROM segment WHERE kind = 'skill' AND NOT undone"
    )
    assert f"| `reach` | {count} | {count} | {seconds:.2f} |" in text
    assert set(re.findall(r"\]\(([^):]+)\)", text)) <= set(files_of(folder)), "links lead to files"
    assert f"title = {{{card.TITLE}}}, author = {{{{{card.AUTHORS}}}}}, version = {{{stampede.__version__}}}" in text


def test_what_is_cited_is_what_the_sources_say() -> None:
    said = (Path(__file__).parents[2] / "CITATION.cff").read_text()
    assert f'title: "{card.TITLE}"' in said and f'name: "{card.AUTHORS}"' in said


def test_tables_have_the_rows_of_the_views(made: Path, folder: Path) -> None:
    demos = stampede.Catalogue(made)
    for name, order in (("episodes", "episode"), ("segments", "episode, segment")):
        rows = rows_of(folder / f"{name}.csv")
        expected = list(demos.query(f"SELECT * FROM {name} ORDER BY {order}"))
        assert len(rows) == len(expected) > 1
        for row, truth in zip(rows, expected, strict=True):
            sentence = row.pop("sentence", None)
            assert row == {column: "" if truth[column] is None else str(truth[column]) for column in row}
            assert sentence in (None, *demos[truth["episode"]].instructions()[:1])


def test_croissant_reads_the_tables(folder: Path, tmp_path: Path) -> None:
    croissant = pytest.importorskip("mlcroissant")
    data = croissant.Dataset(folder / "croissant.json")
    issues = data.metadata.ctx.issues
    assert not issues.errors and not issues.warnings
    assert [row["episodes/seed"] for row in data.records("episodes")] == [1, 0]
    for _ in range(2):  # a second time too
        assert len(list(data.records("segments"))) == len(rows_of(folder / "segments.csv"))


def test_croissant_names_files_as_they_are(folder: Path) -> None:
    about, files = json.loads((folder / "croissant.json").read_text()), files_of(folder)
    objects = {one["contentUrl"]: one for one in about["distribution"]}
    assert set(objects) == set(files) - {"README.md", "SHA256SUMS", "croissant.json"}
    for name, one in objects.items():
        assert one["contentSize"] == f"{len(files[name])} B"
        assert one["sha256"] == hashlib.sha256(files[name]).hexdigest()
    for records in about["recordSet"]:
        assert [one["name"] for one in records["field"]] == list(rows_of(folder / f"{records['name']}.csv")[0])


@pytest.mark.usefixtures("undrawn")
def test_lerobot_shards_come_with_it(made: Path, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    pytest.importorskip("av")
    folder, again = (run(made, tmp_path / name, "--lerobot") for name in ("one", "two"))
    assert files_of(folder) == files_of(again)
    assert json.loads((folder / "lerobot/meta/info.json").read_text())["total_episodes"] == 2
    head = front_matter(folder)
    assert "LeRobot" in head["tags"]
    patterns = {one["config_name"]: one["data_files"][0]["path"] for one in head["configs"]}
    assert list(folder.glob(patterns["lerobot"]))


def test_words_of_strangers_stay_words(made: Path, tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / "evil.db") as copy:
        sqlite3.connect(made).backup(copy)
        copy.execute("UPDATE episode SET task = ?, variation = ?", (EVIL["task"], EVIL["variation"]))
        copy.execute("DELETE FROM variation_axis")
        copy.execute("DELETE FROM variation")
        copy.execute("INSERT INTO variation VALUES (?, ?)", (EVIL["task"], EVIL["variation"]))
        copy.execute("UPDATE language SET text = ?", (EVIL["sentence"],))
        copy.execute("UPDATE segment SET skill = ? WHERE kind = 'skill'", (EVIL["task"],))
    copy.close()
    folder = run(tmp_path / "evil.db", tmp_path / "set")
    text = (folder / "README.md").read_text()
    assert front_matter(folder)["license"] == "cc-by-4.0" and text.count("\n---\n") == 1
    body = re.sub(r"`[^`\n]*`", "", text.split("\n---\n")[1])  # in code nothing is a mark
    assert "<script" not in body and "<img" not in body and "\n# Owned" not in text and "](javascript" not in body
    assert "https://evil" not in body and "www.evil" not in body and "\u202e" not in text
    assert "rm" not in re.findall(r"`([^`\n]*)`", text)
    for name in ("episodes", "segments"):
        for row in rows_of(folder / f"{name}.csv"):
            assert not any(value.lstrip()[:1] in set("=+-@") or "\n" in value for value in row.values() if value)
    assert rows_of(folder / "episodes.csv")[0]["task"] == f"'{EVIL['task']}"
    assert "There is no lock" in text and not (folder / "demos.lock").exists()
    assert not set("<>") & set((folder / "croissant.json").read_text())


def test_words_by_themselves() -> None:
    assert cell("=1") == "'=1" and cell(" \t+1") == "'  +1" and cell("＝1") == "'＝1" and cell(-1) == -1
    assert cell("colour=red") == "colour=red" and cell("") == "" and cell(None) is None
    assert plain("a | <b> & http://c") == r"a \| \&lt;b\&gt; &amp; http\:\/\/c".replace(r"\&", "&")
    assert code("a`b|c\n") == r"`a'b\|c`" and code("") == "–" and len(code("x" * 1000)) < 210


@pytest.mark.usefixtures("undrawn")
def test_what_cannot_be_locked_says_so(made: Path, tmp_path: Path) -> None:
    drawn = tmp_path / "drawn.db"
    drawn.write_bytes(made.read_bytes())
    program("render", drawn, "--into", drawn, "--frames", "keyframes", "--camera", "front", "--size", "16x16")
    folder = run(drawn, tmp_path / "set")
    text = (folder / "README.md").read_text()
    assert "its pictures were drawn later" in text and "demos.lock" not in text and "No pictures are stored" not in text
    assert not (folder / "demos.lock").exists()


@pytest.mark.usefixtures("undrawn")
def test_catalogues_become_one(made: Path, tmp_path: Path) -> None:
    stampede.Session(catalogue=tmp_path / "more.db").run_all(["push_buttons"], seed=1_000_000)
    folder = run(made, tmp_path / "set", str(tmp_path / "more.db"))
    assert len(stampede.Catalogue(folder / "demos.db")) == 3
    assert "| `push_buttons` | 1 |" in (folder / "README.md").read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "no catalogue is named"),
        (["{made}"], "--name: it is missing"),
        (["{made}", "--name", "a\nb: c"], "cannot be one"),
        (["{made}", "--name", "x", "--licence", "CC BY\nx: y"], "--licence"),
        (["{made}", "--name", "x", "--repository", "../x"], "--repository"),
        (["{made}", "--name", "x", "--date", "2026-02-30"], "--date"),
        (["{made}", "--name", "x", "--catalogues"], "--catalogues"),
        (["no.db", "--name", "x"], "there is no such file"),
        (["{none}", "--name", "x"], "none.db"),
        (["{empty}", "--name", "x"], "it has no episodes"),
        (["--shipped", "--lerobot"], "--lerobot"),
        (["--shipped", "--episodes", "0"], "--episodes"),
        (["--shipped", "reach_targt"], "did you mean 'reach_target'?"),
    ],
)
def test_what_cannot_be_is_refused(made: Path, tmp_path: Path, words: list[str], said: str) -> None:
    none, empty = tmp_path / "none.db", tmp_path / "empty.db"
    none.write_text("no catalogue")
    if "{empty}" in words:
        stampede.Session(catalogue=empty).run_all(["reach_target"], shard=(2, 2))
    words = [word.format(made=made, none=none, empty=empty) for word in words]
    assert said in refused(tmp_path, *words, "--out", str(tmp_path / "set"))


@pytest.mark.usefixtures("undrawn")
def test_a_folder_of_somebody_else_is_left_alone(made: Path, tmp_path: Path) -> None:
    folder = tmp_path / "set"
    words = [str(made), "--name", "x", "--out", str(folder)]
    folder.mkdir()
    (folder / "thesis.tex").write_text("all of it")
    assert "no data set that this made" in refused(tmp_path, *words)
    (folder / "thesis.tex").unlink()
    publish(words, tell=lambda line: None)  # an empty one is taken
    (folder / "notes.txt").write_text("mine")
    assert "notes.txt is in it" in refused(tmp_path, *words)
    (folder / "notes.txt").unlink()
    (folder / "README.md").write_text("better words")
    assert "README.md is not as this made it" in refused(tmp_path, *words)


@pytest.mark.usefixtures("undrawn")
def test_what_is_cut_off_leaves_nothing(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def cut_off(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("stampede.publish.croissant.write", cut_off)
    with pytest.raises(KeyboardInterrupt):
        run(made, tmp_path / "set")
    assert not list(tmp_path.iterdir())


class FakeHub(types.ModuleType):
    """huggingface_hub, that notes what it is asked for."""

    def __init__(self, token: str | None, fails: str = "") -> None:
        super().__init__("huggingface_hub")
        self.token, self.fails, self.calls = token, fails, []  # type: ignore[var-annotated]
        self.HfApi = lambda: self

    def get_token(self) -> str | None:
        return self.token

    def create_repo(self, *names: str, **more: Any) -> None:
        self.calls.append(("create_repo", *names, more["repo_type"]))

    def upload_folder(self, repo_id: str, folder_path: str, **more: Any) -> None:
        if self.fails:
            raise RuntimeError(self.fails)
        self.calls.append(("upload_folder", repo_id, more["repo_type"], sorted(files_of(Path(folder_path)))))


@pytest.mark.usefixtures("undrawn")
def test_it_is_uploaded_when_that_is_asked_for(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    hub = FakeHub("secret")
    monkeypatch.setitem(sys.modules, "huggingface_hub", hub)
    lines: list[str] = []
    words = [str(made), "--out", str(tmp_path / "set"), "--name", "x", "--repository", "me/x"]
    publish([*words, "--dry-run"], tell=lines.append)
    files = files_of(tmp_path / "set")
    assert hub.calls == [] and "nothing uploaded" in lines[-1]
    assert {tuple(line.split()) for line in lines if line.split()[-1] in files} == {
        (str(len(data)), name) for name, data in files.items()
    }
    publish(words, tell=lines.append)
    assert hub.calls == [("create_repo", "me/x", "dataset"), ("upload_folder", "me/x", "dataset", sorted(files))]
    assert "uploaded to me/x" in lines[-1] and not any("secret" in line for line in lines)


@pytest.mark.usefixtures("undrawn")
def test_what_an_upload_lacks_is_told_before_work(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = [str(made), "--out", str(tmp_path / "set"), "--name", "x", "--repository", "me/x"]
    monkeypatch.setitem(sys.modules, "huggingface_hub", None)
    with pytest.raises(ImportError, match=r"stampede-sim\[publish\]"):
        publish(words, tell=lambda line: None)
    monkeypatch.setitem(sys.modules, "huggingface_hub", FakeHub(None))
    assert "nobody is signed in" in refused(tmp_path, *words)
    monkeypatch.setitem(sys.modules, "huggingface_hub", FakeHub("secret", fails="503\nbusy"))
    with pytest.raises(stampede.Error, match="503 busy") as error:
        publish(words, tell=lambda line: None)
    assert "hf upload me/x" in error.value.hint and (tmp_path / "set/README.md").exists()


def test_our_own_tasks_as_locks(tmp_path: Path) -> None:
    words = ["--shipped", "reach_target", "push_buttons", "--episodes", "2", "--date", "2026-01-31", "--out"]
    folder = publish([*words, str(tmp_path / "locks")], tell=lambda line: None)
    kept = publish([*words, str(tmp_path / "kept"), "--catalogues"], tell=lambda line: None)
    locks = {"locks/push_buttons.lock", "locks/reach_target.lock"}
    assert set(files_of(folder)) == locks | {"README.md", "SHA256SUMS", "croissant.json", "tasks.csv"}
    assert all((kept / name).read_bytes() == (folder / name).read_bytes() for name in locks | {"tasks.csv"})
    rows, text = rows_of(folder / "tasks.csv"), (folder / "README.md").read_text()
    assert [(row["task"], row["episodes"]) for row in rows] == [("push_buttons", "2"), ("reach_target", "2")]
    for row in rows:
        assert json.loads((folder / row["lock"]).read_text())["hash"] == row["content_hash"] and row["lock"] in text
        program("verify", kept / row["lock"], kept / "catalogues" / f"{row['task']}.db")
    assert len(list((kept / "catalogues").iterdir())) == 2
