"""TensorFlow Datasets and RLDS on an exported folder: `rlds_client.py FOLDER/NAME/1.0.0 CATALOGUE`.

Without the package: what is expected is read from the catalogue with SQL. Its episodes have pictures of camera `front`,
actions are joint positions.
"""

import json
import re
import sqlite3
import sys
from unittest.mock import MagicMock

import numpy as np
import tensorflow as tf
import tensorflow_datasets as tfds

try:
    import reverb  # noqa: F401
except ImportError:  # it has no build for the latest TensorFlow, and only rlds.transformations.pattern needs it
    sys.modules["reverb"] = MagicMock()
import rlds  # noqa: E402

catalogue = sqlite3.connect(sys.argv[2])
catalogue.row_factory = sqlite3.Row
builder = tfds.builder_from_directory(sys.argv[1])
seen = {}
for split, info in builder.info.splits.items():
    episodes = builder.as_dataset(split=split)
    assert len(episodes) == info.num_examples and all(tf.io.gfile.exists(str(path)) for path in info.filepaths)
    for episode in episodes:
        about = {name: value.numpy() for name, value in episode["episode_metadata"].items()}
        assert about["split"].decode() == ("test" if split == "test" else "train")
        number = int(about["episode"])
        seen[number] = split
        rows = catalogue.execute("SELECT * FROM steps WHERE episode = ? ORDER BY frame", (number,)).fetchall()
        steps = list(episode["steps"].as_numpy_iterator())
        assert len(steps) == len(rows)
        pictures = catalogue.execute(
            "SELECT data FROM images WHERE episode = ? AND camera = 'front' AND kind = 'rgb' ORDER BY frame", (number,)
        )
        for step, row, (picture,) in zip(steps, rows, pictures, strict=True):
            joints = [*(row[f"j{k}"] for k in range(1, 8)), row["gripper"]]
            assert np.allclose(step["observation"]["state"], joints, atol=1e-6)
            assert np.array_equal(step["observation"]["image"], tf.io.decode_png(picture))
            for name, column in {"skill": "skill", "skill_label": "label", "motion": "motion"}.items():
                assert step[name].decode() == (row[column] or ""), name
            assert step["skill_arguments"].decode().split() == json.loads(row["arguments"] or "[]")
            if not step["is_last"]:
                action = [*(row[f"action_j{k}"] for k in range(1, 8)), row["action_gripper"]]
                assert np.allclose(step["action"], action, atol=1e-6)
            facts = catalogue.execute(
                "SELECT fact FROM facts WHERE episode = ?1 AND first_frame <= ?2 AND ?2 < end_frame",
                (number, row["frame"]),
            )
            assert sorted(fact for (fact,) in facts) == sorted(re.findall(r"\(.*?\)", step["facts"].decode()))
        assert [step["is_first"] for step in steps] == [True] + [False] * (len(steps) - 1)
        assert [step["is_last"] for step in steps] == [False] * (len(steps) - 1) + [True]
        assert steps[-1]["is_terminal"] and steps[-2]["reward"] == 1 and steps[-2]["discount"] == 0

        batches = list(rlds.transformations.batch(episode["steps"], size=4, shift=1, drop_remainder=True))
        assert len(batches) == len(steps) - 3 and batches[0]["action"].shape == (4, 8)
        assert rlds.transformations.episode_length(episode["steps"]) == len(steps)
    # Policies of vision and language read whole episodes at once, without decoding.
    whole = builder.as_dataset(split=split, decoders={"steps": tfds.decode.SkipDecoding()})
    for episode in whole:
        assert episode["steps"]["action"].shape[0] == episode["steps"]["observation"]["image"].shape[0]
stored = [number for (number,) in catalogue.execute("SELECT episode FROM episodes WHERE outcome = 'success'")]
assert sorted(seen) == sorted(stored)


def numbers(step):
    """The state, where it counts."""
    return {"state": step["observation"]["state"]}, {"state": True}


mean, _ = rlds.transformations.mean_and_std(builder.as_dataset(split="train"), numbers)
assert mean["state"].shape == (8,)
print(f"tfds {tfds.__version__} reads {len(seen)} episodes in {sorted(set(seen.values()))} of {sys.argv[1]}")
