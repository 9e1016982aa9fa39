"""VAMP's part of tests/bench/peers; each mode prints one JSON object.

vamp_side.py plan FILE ROUNDS   MotionBenchMaker's problems: RRT-Connect, then its simplification
vamp_side.py checks SECONDS     configurations looked at a second; standard input: what `peers_bench posts` prints
"""

import json
import math
import sys
import time
from collections.abc import Callable

import numpy as np
import vamp


def angles(quaternion_xyzw: list[float]) -> list[float]:
    """Roll, pitch and yaw about fixed axes."""
    x, y, z, w = quaternion_xyzw
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))
    return [roll, pitch, math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))]


def environment(problem: dict) -> vamp.Environment:
    """As VAMP's own evaluation makes it: cylinders are capsules, but in the set `box` they are boxes."""
    made = vamp.Environment()
    for thing in problem["obstacles"]:
        at, turned, size = thing["position"], angles(thing["quaternion_xyzw"]), thing["dimensions"]
        if thing["type"] == "box":
            made.add_cuboid(vamp.Cuboid(at, turned, [s / 2 for s in size]))
        elif problem["set"] == "box":
            made.add_cuboid(vamp.Cuboid(at, turned, [size[1], size[1], size[0] / 2]))
        else:
            made.add_capsule(vamp.Cylinder(at, turned, size[1], size[0]))
    return made


def plan(path: str, rounds: int) -> dict:
    with open(path, encoding="utf-8") as file:
        problems = json.load(file)["problems"]
    robot, search, settings, simplification = vamp.configure_robot_and_planner_with_kwargs("panda", "rrtc")
    sampler = robot.halton()
    answers = []
    for problem in problems:
        around = environment(problem)
        start, goal = (np.array(problem[end], np.float32) for end in ("start", "goal"))
        answer = {"set": problem["set"], "id": problem["id"], "solved": False}
        answer["ends_free"] = all(robot.validate(end, around) for end in (start, goal))
        answers.append(answer)
        if not answer["ends_free"]:
            continue
        times = []
        for _ in range(rounds):
            sampler.reset()
            found = search(start, goal, around, settings, sampler)
            if not found.solved:
                break
            short = robot.simplify(found.path, around, simplification, sampler)
            times.append((found.nanoseconds + short.nanoseconds) / 1e6)
            answer.update(solved=True, length=float(short.path.cost()), iterations=found.iterations)
        if times:
            answer["ms"] = sorted(times)[len(times) // 2]
    return {"problems": answers}


def rate_of(seconds: float, things: int, round_of: Callable[[], None]) -> float:
    round_of()
    done, begin = 0, time.perf_counter()
    while (passed := time.perf_counter() - begin) < seconds:
        round_of()
        done += things
    return done / passed


def checks(seconds: float) -> dict:
    given = json.load(sys.stdin)
    robot, around = vamp.panda, vamp.Environment()
    for x, y, z, *size in given["boxes"]:
        around.add_cuboid(vamp.Cuboid([x, y, z], [0, 0, 0], [s / 2 for s in size]))
    rows = [q for q in np.array(given["configurations"], np.float32) if robot.validate(q, around)]
    validate, validate_motion = robot.validate, robot.validate_motion

    def one_by_one() -> None:
        for q in rows:
            validate(q, around)

    # Short motions that are free to their end: of each, a known number of configurations is looked at.
    random = np.random.default_rng(0)
    motions, looked = [], 0
    for q in rows:
        step = random.normal(size=7)
        other = (q + 2.0 * step / np.linalg.norm(step)).astype(np.float32)
        inside = np.all(other > robot.lower_bounds()) and np.all(other < robot.upper_bounds())
        if inside and validate_motion(q, other, around):
            motions.append((q, other))
            blocks = max(1, math.ceil(float(np.linalg.norm(other - q)) / 8 * robot.resolution()))
            looked += 8 * blocks

    def along_motions() -> None:
        for a, b in motions:
            validate_motion(a, b, around)

    return {
        "one_per_s": rate_of(seconds, len(rows), one_by_one),
        "many_per_s": rate_of(seconds, looked, along_motions),
        "free_for_both": len(rows),
        "of": len(given["configurations"]),
        "motions": len(motions),
    }


if __name__ == "__main__":
    if sys.argv[1:2] == ["plan"] and len(sys.argv) == 4:
        print(json.dumps(plan(sys.argv[2], int(sys.argv[3]))))
    elif sys.argv[1:2] == ["checks"] and len(sys.argv) == 3:
        print(json.dumps(checks(float(sys.argv[2]))))
    else:
        raise SystemExit(__doc__)
