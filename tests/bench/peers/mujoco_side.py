"""MuJoCo's part of tests/bench/peers; each mode prints one JSON object.

mujoco_side.py physics CUBES SECONDS [asleep]   steps a second, the arm waving
mujoco_side.py pick CUBES EPISODES [pictures]   scripted pick-and-lift, wall seconds per simulated second
mujoco_side.py pictures SECONDS [shadows]       frames of five cameras a second
mujoco_side.py look FOLDER                      what the cameras see during a pick-and-lift, as PNG files
"""

import json
import os
import sys
import time
from collections.abc import Callable

os.environ["MUJOCO_GL"] = "osmesa"
os.environ["LP_NUM_THREADS"] = "0"  # the drawing thread alone, as in the engine

import mujoco
import numpy as np
import scene

SIZE = 128
OPEN, CLOSED = 0.04, 0.0


def model_of(cubes: list[tuple[float, float, float]], **looks: bool) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(scene.mjcf(cubes, **looks))
    data = mujoco.MjData(model)
    reset(model, data)
    return model, data


def reset(model: mujoco.MjModel, data: mujoco.MjData, cubes: list[tuple[float, float, float]] | None = None) -> None:
    mujoco.mj_resetData(model, data)
    data.qpos[addresses(model)] = scene.HOME
    for name in ("left_finger_joint", "right_finger_joint"):
        data.qpos[model.joint(name).qposadr[0]] = OPEN
    for i, at in enumerate(cubes or []):
        begin = model.body(f"cube{i}").jntadr[0]
        data.qpos[model.jnt_qposadr[begin] :][:3] = at
    data.ctrl[:7] = scene.HOME
    data.ctrl[7] = OPEN
    mujoco.mj_forward(model, data)


def addresses(model: mujoco.MjModel) -> np.ndarray:
    return np.array([model.joint(name).qposadr[0] for name in scene.ARM])


def cube_places(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    return np.array([data.body(i).xpos for i in range(model.nbody) if model.body(i).name.startswith("cube")])


def physics(cubes: int, seconds: float, sleep: bool) -> dict:
    model, data = model_of(scene.resting_cubes(cubes), sleep=sleep)
    path = scene.waving(990)
    before, arm = cube_places(model, data).copy(), addresses(model)
    lag, frames, begin = 0.0, -20, 0.0
    while True:
        if frames == 0:  # warm, and what may sleep does
            begin = time.perf_counter()
        target = path[(frames + 20) % len(path)]
        data.ctrl[:7] = target
        mujoco.mj_step(model, data, scene.FRAME)
        frames += 1
        if frames > 0 and frames % 20 == 0:
            passed = time.perf_counter() - begin
            lag = max(lag, float(np.abs(data.qpos[arm] - target).max()))
            if passed > seconds:
                break
    moved = float(np.linalg.norm(cube_places(model, data) - before, axis=1).max())
    if moved > 2e-3 or lag > 0.2:
        raise SystemExit(f"the scene is set up badly: cubes moved {moved} m, the arm lags by {lag} rad")
    return {
        "steps_per_s": frames * scene.FRAME / passed,
        "cubes_moved_mm": 1e3 * moved,
        "arm_lag_rad": lag,
        "contacts": int(data.ncon),
        "awake": int(data.ntree_awake),
    }


def reach(model: mujoco.MjModel, data: mujoco.MjData, at: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Joint positions that bring the tip there, the hand pointing down: damped least squares."""
    arm = addresses(model)
    dofs = np.array([model.joint(name).dofadr[0] for name in scene.ARM])
    down = np.diag([1.0, -1.0, -1.0])
    q, moves, turns = start.copy(), np.zeros((3, model.nv)), np.zeros((3, model.nv))
    site = data.site("tip")
    for _ in range(200):
        data.qpos[arm] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        now = site.xmat.reshape(3, 3)
        turn = 0.5 * sum(np.cross(now[:, i], down[:, i]) for i in range(3))
        error = np.concatenate([at - site.xpos, turn])
        if np.abs(error).max() < 1e-5:
            return q
        mujoco.mj_jacSite(model, data, moves, turns, site.id)
        jacobian = np.vstack([moves[:, dofs], turns[:, dofs]])
        q = q + jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-6 * np.eye(6), error)
    raise SystemExit("no joint positions reach the cube")


def plan(model: mujoco.MjModel, data: mujoco.MjData, cube: tuple[float, float, float]) -> np.ndarray:
    """frames x 8: targets of the arm and the fingers, 20 a second."""
    at = np.array(cube)
    above = reach(model, data, at + [0, 0, 0.12], scene.HOME)
    grasp = reach(model, data, at, above)
    high = reach(model, data, at + [0, 0, 0.25], above)
    rows: list[np.ndarray] = []

    def go(a: np.ndarray, b: np.ndarray, frames: int, fingers: float) -> None:
        rows.extend(np.append(a + (b - a) * scene.smooth((i + 1) / frames), fingers) for i in range(frames))

    go(scene.HOME, above, 24, OPEN)
    go(above, grasp, 16, OPEN)
    go(grasp, grasp, 8, CLOSED)
    go(grasp, high, 18, CLOSED)
    go(high, high, 10, CLOSED)
    return np.array(rows)


def pick(cubes: int, episodes: int, pictures: bool) -> dict:
    model, data = model_of(scene.resting_cubes(cubes), looks=pictures, cameras=pictures)
    look = cameras_of(model, shadows=False) if pictures else None
    random = np.random.default_rng(0)
    spent, simulated, lifted = 0.0, 0.0, 0
    for _ in range(episodes):
        places = scene.random_cubes(random, cubes)
        reset(model, data, places)
        path = plan(model, data, places[0])  # not in the time
        begin = time.perf_counter()
        reset(model, data, places)
        states, stored = np.empty((len(path), model.nq + model.nv)), []
        for row, target in enumerate(path):
            data.ctrl[:] = target
            mujoco.mj_step(model, data, scene.FRAME)
            states[row, : model.nq] = data.qpos
            states[row, model.nq :] = data.qvel
            if look:
                stored.append(look(data))
        spent += time.perf_counter() - begin
        simulated += data.time
        end = cube_places(model, data)
        rest = np.linalg.norm(end[1:] - places[1:], axis=1).max() if cubes > 1 else 0
        lifted += int(0.2 < end[0, 2] < 0.3 and rest < 5e-3)
    if lifted < 0.9 * episodes:
        raise SystemExit(f"the scene is set up badly: {lifted} of {episodes} cubes were lifted")
    return {"wall_per_simulated_s": spent / simulated, "episodes": episodes, "lifted": lifted, "simulated_s": simulated}


def cameras_of(model: mujoco.MjModel, *, shadows: bool) -> Callable[[mujoco.MjData], list]:
    """A function that draws all cameras: rgb, depth in metres and the ids of bodies of each.

    Faster than mujoco.Renderer, which draws three times and looks through all geoms in Python: colour and depth are
    read of one drawing.
    """
    context_gl = mujoco.GLContext(SIZE, SIZE)
    context_gl.make_current()
    context = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
    mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, context)
    views = mujoco.MjvScene(model, maxgeom=500)
    option = mujoco.MjvOption()
    rectangle = mujoco.MjrRect(0, 0, SIZE, SIZE)
    near, far = model.vis.map.znear * model.stat.extent, model.vis.map.zfar * model.stat.extent
    flags = mujoco.mjtRndFlag
    for flag in (flags.mjRND_REFLECTION, flags.mjRND_SKYBOX, flags.mjRND_HAZE, flags.mjRND_FOG):
        views.flags[flag] = False
    views.flags[flags.mjRND_SHADOW] = shadows
    cameras = []
    for i in range(model.ncam):
        camera = mujoco.MjvCamera()
        camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, i
        cameras.append(camera)
    bodies = np.zeros(0, np.int16)

    def look(data: mujoco.MjData) -> list:
        nonlocal bodies
        pictures = []
        for camera in cameras:
            mujoco.mjv_updateScene(model, data, option, None, camera, mujoco.mjtCatBit.mjCAT_ALL.value, views)
            if len(bodies) != views.ngeom + 1:  # of geoms as they are numbered in the picture, which stays
                bodies = np.full(views.ngeom + 1, -1, np.int16)
                for geom in views.geoms[: views.ngeom]:
                    if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM and geom.segid >= 0:
                        bodies[geom.segid + 1] = model.geom_bodyid[geom.objid]
            rgb, depth = np.empty((SIZE, SIZE, 3), np.uint8), np.empty((SIZE, SIZE), np.float32)
            ids = np.empty((SIZE, SIZE, 3), np.uint8)
            mujoco.mjr_render(rectangle, views, context)
            mujoco.mjr_readPixels(rgb, depth, rectangle, context)
            views.flags[flags.mjRND_SEGMENT] = views.flags[flags.mjRND_IDCOLOR] = True
            mujoco.mjr_render(rectangle, views, context)
            mujoco.mjr_readPixels(ids, None, rectangle, context)
            views.flags[flags.mjRND_SEGMENT] = views.flags[flags.mjRND_IDCOLOR] = False
            np.divide(np.float32(near), 1 - depth * np.float32(1 - near / far), out=depth)
            pictures.append((rgb[::-1], depth[::-1], bodies[ids[::-1, :, 0]]))  # fewer than 256 geoms
        return pictures

    look.contexts = (context_gl, context)  # kept as long as the function
    return look


def pictures(seconds: float, shadows: bool) -> dict:
    model, data = model_of(scene.resting_cubes(10), collision=False, looks=True, cameras=True, shadows=shadows)
    look = cameras_of(model, shadows=shadows)
    joint, frames, begin = addresses(model)[1], -3, 0.0
    while True:
        if frames == 0:
            begin = time.perf_counter()
        data.qpos[joint] = 0.3 * np.sin(0.05 * frames)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_camlight(model, data)
        look(data)
        frames += 1
        if frames > 0 and time.perf_counter() - begin > seconds:
            return {"frames_per_s": frames / (time.perf_counter() - begin), "triangles": triangles(model)}


def triangles(model: mujoco.MjModel) -> int:
    """Of what is drawn: boxes have 12, cylinders and spheres as many as MuJoCo's quality settings say."""
    slices, stacks = model.vis.quality.numslices, model.vis.quality.numstacks
    kinds = mujoco.mjtGeom
    round_sides = 2 * slices * stacks
    each = {
        kinds.mjGEOM_BOX: 12,
        kinds.mjGEOM_CYLINDER: round_sides + 2 * slices,
        kinds.mjGEOM_SPHERE: round_sides,
    }
    drawn = zip(model.geom_type, model.geom_group, strict=True)
    return sum(each.get(mujoco.mjtGeom(kind), 0) for kind, group in drawn if group < 3)


def look_at(folder: str) -> dict:
    from PIL import Image

    os.makedirs(folder, exist_ok=True)
    model, data = model_of(scene.resting_cubes(10), looks=True, cameras=True, shadows=True)
    look = cameras_of(model, shadows=True)
    random = np.random.default_rng(1)
    places = scene.random_cubes(random, 10)
    reset(model, data, places)
    path = plan(model, data, places[0])
    reset(model, data, places)
    for row, target in enumerate(path):
        data.ctrl[:] = target
        mujoco.mj_step(model, data, scene.FRAME)
        if row in (0, 38, 48, len(path) - 1):
            strip = []
            for rgb, depth, ids in look(data):
                grey = np.clip(depth * 100, 0, 255).astype(np.uint8)[:, :, None].repeat(3, 2)
                labels = ((ids.astype(int)[:, :, None] + 1) * [37, 91, 53] % 256).astype(np.uint8)
                strip.append(np.vstack([rgb, grey, labels]))
            Image.fromarray(np.hstack(strip)).save(f"{folder}/frame{row:03}.png")
    return {"folder": folder}


def main(arguments: list[str]) -> dict:
    mode, *rest = arguments
    if mode == "physics":
        return physics(int(rest[0]), float(rest[1]), "asleep" in rest[2:])
    if mode == "pick":
        return pick(int(rest[0]), int(rest[1]), "pictures" in rest[2:])
    if mode == "pictures":
        return pictures(float(rest[0]), "shadows" in rest[1:])
    if mode == "look":
        return look_at(rest[0])
    raise SystemExit(__doc__)


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1:])), flush=True)
    os._exit(0)  # OSMesa's contexts complain when the interpreter takes them down
