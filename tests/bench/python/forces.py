"""How hard an arm presses that nobody steers with sense: forces.py [TASK…] [--seeds N] [--frames N]

Random policies in each task and four action spaces, and `random_skills` and `random_applicable` in all of them. Prints the
greatest force between the arm and anything, the contacts above the limit, and the fastest joint and tool of the policies.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import stampede
from stampede.envs import Env

TASKS = (
    "block_pyramid close_box close_door close_drawer open_jar close_laptop_lid empty_dishwasher insert_onto_square_peg "
    "meat_off_grill open_drawer open_window pick_and_lift push_buttons put_books_on_bookshelf slide_block_to_target "
    "stack_blocks set_the_table take_toilet_roll_off_stand turn_tap turn_oven_on"
).split()
SPACES = ["joint_position", "joint_velocity", "joint_torque", "tool_velocity"]
LIMIT_N = 100
CONTACTS = """
SELECT task, seed, round(start_s, 2), object_a || '.' || part_a, object_b || '.' || part_b, round(peak_force, 1)
FROM contacts WHERE (object_a = 'panda' OR object_b = 'panda') AND object_a <> object_b ORDER BY peak_force DESC LIMIT 6
"""


def told(name: str, catalogue: Path) -> None:
    rows = [tuple(row.values()) for row in stampede.Catalogue(catalogue).query(CONTACTS)]
    print(f"{name}: at most {rows[0][-1] if len(rows) else 0} N")
    for row in rows:
        if row[-1] > LIMIT_N / 2:
            print("    ", *row)
    sys.stdout.flush()


def policies(tasks: list[str], seeds: int, frames: int, longest: int, folder: Path) -> None:
    for space in SPACES:
        catalogue = folder / f"{space}.db"
        joint, tool = 0.0, 0.0
        for task in tasks:
            world = Env(task, action=space, record=True, catalogue=catalogue, horizon_s=frames / 20, hidden=True)
            for seed in range(seeds):
                draw = np.random.default_rng([seed, frames])
                world.reset(seed=seed)
                over, before, held = False, None, 0
                while not over:
                    if held == 0:
                        action, held = world.action_space.low + draw.random(world.action_space.shape) * (
                            world.action_space.high - world.action_space.low
                        ), int(draw.integers(1, longest + 1))
                    held -= 1
                    seen, _, ended, cut, _ = world.step(action.astype(world.action_space.dtype))
                    over = ended or cut
                    joint = max(joint, float(np.abs(seen["joint_velocities"]).max()))
                    place = seen["gripper_pose"][:3]
                    tool = max(tool, 0.0 if before is None else float(np.linalg.norm(place - before)) * 20)
                    before = place
            world.close()
        told(f"{space}, {len(tasks) * seeds} episodes, joints {joint:.2f} rad/s, tool {tool:.2f} m/s", catalogue)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tasks", nargs="*", default=TASKS)
    parser.add_argument("--seeds", type=int, default=1, help="of each task and space")
    parser.add_argument("--frames", type=int, default=200, help="of an episode of a policy")
    parser.add_argument("--hold", type=int, default=19, help="frames that a policy keeps an action, at most; 1: a new one each")
    parser.add_argument("--skills", type=int, default=10, help="episodes of random skills a task; 0: none")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        policies(options.tasks, options.seeds, options.frames, options.hold, folder)
        for behaviour, episodes in (("random_skills", options.skills), ("random_applicable", options.skills * 2 // 5)):
            if episodes == 0:
                continue
            catalogue = folder / f"{behaviour}.db"
            made = [*options.tasks, "--behaviour", behaviour, "--episodes", str(episodes), "--out", str(catalogue)]
            subprocess.run([sys.executable, "-m", "stampede", "run", *made], capture_output=True, check=False)
            told(f"{behaviour}, {len(options.tasks) * episodes} episodes", catalogue)


main()
