"""PyBullet's part of tests/bench/peers: `pybullet_side.py physics CUBES SECONDS` prints one JSON object.

The engine's URDF, 20 iterations of the solver as in the engine, nothing asleep.
"""

import json
import sys
import time

import numpy as np
import pybullet
import scene

ITERATIONS = 20


def box(size: list[float], at: tuple[float, float, float], mass: float) -> int:
    shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=[s / 2 for s in size])
    return pybullet.createMultiBody(mass, shape, basePosition=at)


def physics(cubes: int, seconds: float) -> dict:
    pybullet.connect(pybullet.DIRECT)
    pybullet.setTimeStep(1 / scene.HZ)
    pybullet.setGravity(0, 0, -9.81)
    pybullet.setPhysicsEngineParameter(numSolverIterations=ITERATIONS)
    robot = pybullet.loadURDF(str(scene.URDF), useFixedBase=True)
    box([0.8, 1.2, 0.05], (0.55, 0, -0.025), 0)
    places = scene.resting_cubes(cubes)
    bodies = [box([scene.CUBE] * 3, at, 0.1) for at in places]
    joints = {pybullet.getJointInfo(robot, i)[1].decode(): i for i in range(pybullet.getNumJoints(robot))}
    arm = [joints[name] for name in scene.ARM]
    fingers = [joints["left_finger_joint"], joints["right_finger_joint"]]
    for joint, at in zip(arm + fingers, [*scene.HOME, 0.04, 0.04], strict=True):
        pybullet.resetJointState(robot, joint, at)
    forces = [*scene.TORQUE, 20, 20]
    path = scene.waving(990)
    lag, frames, begin = 0.0, -20, 0.0
    while True:
        if frames == 0:  # warm
            begin = time.perf_counter()
        target = path[(frames + 20) % len(path)]
        pybullet.setJointMotorControlArray(
            robot,
            arm + fingers,
            pybullet.POSITION_CONTROL,
            targetPositions=[*target, 0.04, 0.04],
            forces=forces,
        )
        for _ in range(scene.FRAME):
            pybullet.stepSimulation()
        frames += 1
        if frames > 0 and frames % 20 == 0:
            passed = time.perf_counter() - begin
            now = np.array([state[0] for state in pybullet.getJointStates(robot, arm)])
            lag = max(lag, float(np.abs(now - target).max()))
            if passed > seconds:
                break
    ends = np.array([pybullet.getBasePositionAndOrientation(body)[0] for body in bodies])
    moved = float(np.linalg.norm(ends - places, axis=1).max())
    if moved > 1e-2 or lag > 0.3:  # cubes creep by about 10 um a simulated second
        raise SystemExit(f"the scene is set up badly: cubes moved {moved} m, the arm lags by {lag} rad")
    return {"steps_per_s": frames * scene.FRAME / passed, "cubes_moved_mm": 1e3 * moved, "arm_lag_rad": lag}


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] != "physics":
        raise SystemExit(__doc__)
    print(json.dumps(physics(int(sys.argv[2]), float(sys.argv[3]))))
