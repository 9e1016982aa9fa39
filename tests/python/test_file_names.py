"""Names of files that are made from data: the rules of engine/base/file_name.h, in Python."""

import json

import pytest

import stampede
from stampede.calibrate.apply import write_whole
from stampede.file_names import FileNames, file_name


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("front", "front"),
        ("RealSense D435", "RealSense D435"),
        ("küche", "küche"),
        ("../../x", "%2E.%2F..%2Fx"),
        ("..", "%2E%2E"),
        ("", "%"),
        ("-rf", "%2Drf"),
        ("a ", "a%20"),
        ("a\0b", "a%00b"),
        ("a\x1b[31m\nb", "a%1B[31m%0Ab"),
        ("a\\b:c*", "a%5Cb%3Ac%2A"),
        ("a\u202eb", "a%E2%80%AEb"),
        ("nul", "%6Eul"),
        ("console", "console"),
    ],
)
def test_a_name_stays_or_is_escaped_as_the_engine_does(text, name):
    assert file_name(text) == name


def test_no_two_texts_have_one_name():
    long = "x" * 300
    texts = ["", "%", ".", "%2E", "a/b", "a%2Fb", "a%2fb", "A", "a", "nul", "%6Eul"]
    texts += [long, long + "a", "ä" * 200, "ä" * 201]
    names = [file_name(text) for text in texts]
    assert len(set(names)) == len(texts)
    assert all("/" not in name and len(name.encode()) <= 160 for name in names)


def test_in_one_folder_names_differ_where_a_disk_does_not_know_large_letters():
    names = FileNames("masks.csv")
    assert [names.take(text) for text in ("Front", "front", "Masks.csv", "wrist")] == [
        "Front",
        "front%~2",
        "Masks.csv%~2",
        "wrist",
    ]


def test_a_calibration_replaces_its_own_and_nothing_else(tmp_path):
    file = tmp_path / "cameras.json"
    write_whole(file, {"cameras": []})
    write_whole(file, {"cameras": [1]})
    assert json.loads(file.read_text()) == {"cameras": [1]}
    (tmp_path / "letter").write_text("a letter")
    (tmp_path / "other").write_text('{"joints": []}')
    (tmp_path / "link").symlink_to(file)
    for name in ("letter", "other", "link", "."):
        with pytest.raises(stampede.Error):
            write_whole(tmp_path / name, {"cameras": [2]})
    assert (tmp_path / "letter").read_text() == "a letter"
    assert json.loads(file.read_text()) == {"cameras": [1]}
    assert sorted(one.name for one in tmp_path.iterdir()) == ["cameras.json", "letter", "link", "other"]
