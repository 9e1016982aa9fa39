"""The examples run; what they reach after long training is in their README."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

for library in ("torch", "stable_baselines3", "sb3_contrib", "h5py", "scipy"):
    pytest.importorskip(library)

EXAMPLES = Path(__file__).parents[2] / "scripting/python/examples"


@pytest.fixture(scope="module")
def demos(tmp_path_factory):
    return tmp_path_factory.mktemp("examples")


@pytest.mark.parametrize(
    "command",
    [
        "reach_ppo.py --steps 1000 --episodes 2",
        "skills_ppo.py push_buttons --steps 300 --episodes 1",
        "clone.py --demos 3 --steps 20 --episodes 1 --horizon 2",
        "next_pose.py --demos 3 --steps 20 --episodes 1 --horizon 2",
        "next_pose.py --from keyframes --demos 3 --steps 20 --episodes 1 --horizon 2",
        "learned_skill.py --demos 3 --steps 20 --episodes 1",
    ],
)
def test_an_example_runs(command, demos):
    file, *options = command.split()
    options += [] if "ppo" in file else ["--out", str(demos)]
    done = subprocess.run([sys.executable, EXAMPLES / file, *options], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert re.search(r"(success|succeeds in) [01]\.\d\d \[[01]\.\d\d, [01]\.\d\d\]", done.stdout), done.stdout
