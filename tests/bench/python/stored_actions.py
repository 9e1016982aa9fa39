"""How many demos do their task again by the actions stored with them: stored_actions.py [TASK…] [--demos N] [--seed N] [--stops] [--measured]

Makes demos of each task, goes back to the start of each and gives an environment what is stored of each frame, joint
positions and opening of the hand, as a policy would that knows the data by heart; the last of them up to two seconds on.
Prints one line a demo that fails or is late, the share, and how hard the arm pressed on anything.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import stampede
from stampede import _core

WAIT = 40  # frames of 50 ms
FORCE = """
SELECT coalesce(max(peak_force), 0) AS force FROM contacts
WHERE (object_a = 'panda' OR object_b = 'panda') AND object_a <> object_b
"""


def replay(env: stampede.Env, episode: _core.Episode, measured: bool) -> tuple[str, int]:
    """Why it does not reach its goal, empty: it does; and how many frames later than the demo."""
    stored = env.session.arrays(episode, ["action/joint_position", "action/gripper", "joint_positions"])
    actions = np.column_stack([stored["action/joint_position"], stored["action/gripper"]])[:-1]  # the last frame has none
    if measured:
        actions[:, :-1] = stored["joint_positions"][1:, : actions.shape[1] - 1]
    env.reset(options={"variation": episode.variation, "seed": episode.seed})
    for number, action in enumerate([*actions, *[actions[-1]] * WAIT], 1):
        _, _, ended, cut, info = env.step(action.astype(env.action_space.dtype))
        if "refusal" in info:
            return f"action {number} of {len(actions)}: {info['refusal']}".split("\n")[0], 0
        if info["success"]:
            return "", max(0, number - len(actions))
        if ended or cut:
            return f"ends after action {number} of {len(actions)}: {info['reason']}", 0
    return f"not done after {len(actions)} actions and {WAIT} frames", 0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*", help="default: all")
    parser.add_argument("--demos", type=int, default=3, help="of each task")
    parser.add_argument("--seed", type=int, default=0, help="of the first")
    parser.add_argument("--stops", action="store_true", help="demos that stand at their via-points")
    parser.add_argument("--measured", action="store_true", help="where the arm was a frame later, not where it was sent")
    options = parser.parse_args()
    wanted = ["motion.stop_at_vias=1"] if options.stops else []
    total = done = waited = 0
    hardest = 0.0
    folder = tempfile.TemporaryDirectory()
    for name in options.tasks or _core.Session().tasks():
        made = Path(folder.name) / f"{name}.db"
        env = stampede.Env(name, action="joint_position", hidden=True, record=True, catalogue=made)
        variations = env.session.variations(name)
        for number in range(options.demos):
            seed = options.seed + number
            episode = env.session.run(name, variation=variations[number % len(variations)], seed=seed, set=wanted)
            if not episode.success:
                print(f"{name} {seed}: no demo: {episode.reason} {episode.detail}".split("\n")[0], flush=True)
                continue
            why, late = replay(env, episode, options.measured)
            total, done, waited = total + 1, done + (not why), waited + (late > 0)
            if why or late:
                print(f"{name} {seed}: {why or f'{late} frames late'}", flush=True)
        env.close()
        force = float(stampede.Catalogue(made).query(FORCE)["force"][0])
        if force > hardest:
            print(f"{name}: up to {force:.1f} N", flush=True)
            hardest = force
    print(f"{done} of {total} do their task again, {waited} of them late; at most {hardest:.1f} N")


main()
