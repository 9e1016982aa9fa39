"""Calibration: of a laboratory that is drawn and recorded, and of corners that are computed."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import stampede

cv2 = pytest.importorskip("cv2")
pytest.importorskip("rosbags")
sys.path.insert(0, str(Path(__file__).parents[1] / "bench" / "python"))
import laboratory  # noqa: E402
import laboratory_scripts  # noqa: E402
from recordings_bench import BOARD, pose_errors  # noqa: E402

from stampede.calibrate import calibrate  # noqa: E402
from stampede.calibrate.boards import Board, Sighting  # noqa: E402
from stampede.calibrate.bundle import Bundle, pose_error  # noqa: E402
from stampede.calibrate.lens import Lens, find_lens, spread  # noqa: E402
from stampede.calibrate.poses import inverse, moved, robot_world, step_between, turned, vector_of  # noqa: E402
from stampede.calibrate.recorded import JointStates  # noqa: E402
from stampede.calibrate.problem import Camera, FixedBoard, Seen, start  # noqa: E402
from stampede.calibrate.solve import least_squares  # noqa: E402
from stampede.recordings import convert  # noqa: E402
from stampede.robots import robot_of  # noqa: E402

SECONDS = 14


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Any]:
    folder = tmp_path_factory.mktemp("lab") / "laboratory"
    truth = laboratory.record(folder, 5, SECONDS)
    at = " ".join(map(str, laboratory_scripts.BASE))
    convert(["mcap", str(folder / "bag"), "--out", str(folder / "recording"), "--base", at], tell=lambda line: None)
    return folder / "recording", truth


@pytest.fixture(scope="module")
def lens(lab: tuple[Path, Any]) -> dict[str, Any]:
    recording, _ = lab
    with pytest.raises(stampede.Error, match="nothing is known of its lens"):
        calibrate(["extrinsics", str(recording), "--board", BOARD])
    words, found = calibrate(["intrinsics", str(recording), "--board", BOARD, "--most", "100"])
    assert "reprojection error" in words
    return found


def test_what_was_hidden_is_found(lab: tuple[Path, Any], lens: dict[str, Any]) -> None:
    recording, truth = lab
    assert lens["rms_pixels"] < 0.5
    measured = (recording / "joints.csv").read_text()
    words, found = calibrate(["extrinsics", str(recording), "--board", BOARD, "--most", "150", "--apply-joints"])
    errors = pose_errors(truth, found, SECONDS)
    assert errors["offset ms"] < 5 and errors["pose mm"] < 2 and errors["joints deg"] < 0.1, errors
    assert errors["pose deg"] < 0.35, errors  # of a minute it is below 0.2
    assert (
        abs(truth.camera_offset_s) > 0.005 and np.degrees(np.abs(truth.joint_offsets[1:-1])).max() > 0.2
    )  # there was something
    assert found["joints"][0]["fixed"] and not found["joints"][1]["fixed"] and "taken as it is" in words
    # Applied: camera file, clock and joints, and once more the same.
    document = json.loads((recording / "recording.json").read_text())
    assert document["clocks"]["lab"] == found["cameras"][0]["clock"] and document["cameras"] == "cameras.json"
    camera = json.loads((recording / "cameras.json").read_text())["cameras"][0]
    assert camera["mount"] == "world" and camera["mount_from_camera"] == found["camera_file"][0]["mount_from_camera"]
    assert (recording / "joints_measured.csv").read_text() == measured
    old, new = (
        np.genfromtxt(recording / name, delimiter=",", names=True) for name in ("joints_measured.csv", "joints.csv")
    )
    assert np.allclose(new["joint4_position_rad"] - old["joint4_position_rad"], found["joints"][3]["offset_rad"])
    assert (new["joint4_velocity_rad_s"] == old["joint4_velocity_rad_s"]).all()
    _, again = calibrate(["extrinsics", str(recording), "--board", BOARD, "--most", "150", "--apply-joints"])
    assert again["joints"] == found["joints"]


def test_the_engine_reads_the_camera_file(lab: tuple[Path, Any], lens: dict[str, Any], tmp_path: Path) -> None:
    recording, _ = lab
    out = tmp_path / "cameras.json"
    calibrate(["extrinsics", str(recording), "--board", BOARD, "--most", "60", "--out", str(out)])
    (tmp_path / "worlds").mkdir()
    world = (Path(stampede.__file__).parent / "engine/share/stampede/worlds/tabletop.lua").read_text()
    (tmp_path / "worlds" / "tabletop.lua").write_text(
        world.replace("  sensors = {", '  calibration = "../cameras.json",\n  sensors = {')
    )
    session = stampede.Session(paths=[tmp_path])
    seen = session.picture(session.run("reach_target", seed=1), 0, "lab")
    assert seen["rgb"].shape == (480, 640, 3)
    assert np.allclose(seen["extrinsics"], json.loads(out.read_text())["cameras"][0]["mount_from_camera"], atol=1e-6)


def test_wrong_boards_are_told(lab: tuple[Path, Any], lens: dict[str, Any]) -> None:
    recording, _ = lab
    few = ["--most", "30"]
    small = BOARD.replace(":0.05:0.037:", ":0.04:0.0296:")
    with pytest.raises(stampede.Error, match="beside|do not say where"):
        calibrate(["extrinsics", str(recording), "--board", small, *few])
    with pytest.raises(stampede.Error, match="a board is seen in 0 pictures"):
        calibrate(["extrinsics", str(recording), "--board", "checkerboard:9x6:0.025", *few])
    with pytest.raises(stampede.Error, match="there is no link 'hnd'"):
        calibrate(["extrinsics", str(recording), "--board", BOARD + "@hnd", *few])
    with pytest.raises(stampede.Error, match="only boards that stand still to it"):
        calibrate(["extrinsics", str(recording), "--board", BOARD + "@world", *few])
    with pytest.raises(stampede.Error, match="there is no camera with colours 'lob'"):
        calibrate(["extrinsics", str(recording), "--board", BOARD, "--camera", "lob"])


@pytest.mark.parametrize(
    "text",
    [
        "charuco:5x4:0.05:0.06:4X4_50",
        "charuco:5x4:0.05",
        "chess:5x4:1",
        "checkerboard:9x7:0.02",
        "checkerboard:ax7:1",
        "aruco:1:0.1:9X9_50",
    ],
)
def test_boards_that_there_are_not(text: str) -> None:
    with pytest.raises(stampede.Error) as caught:
        Board(text)
    assert text in caught.value.where and caught.value.hint


def drawn_board(kind: str, view: np.ndarray) -> np.ndarray:
    """A picture of a board, warped by a homography from its millimetres."""
    if kind == "checkerboard":
        squares = np.indices((6, 9)).sum(axis=0) % 2 * 255
        flat = np.pad(np.kron(squares, np.ones((40, 40))).astype(np.uint8), 40, constant_values=255)
        scale = np.array([[0.04 / 40 * 1e3, 0, -40], [0, 0.04 / 40 * 1e3, -40], [0, 0, 1]])
    else:
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
        flat = np.pad(cv2.aruco.generateImageMarker(dictionary, 7, 240), 40, constant_values=255)
        scale = np.array([[1.0, 0, -40], [0, 1.0, -40], [0, 0, 1]])
    return cv2.warpPerspective(flat, view @ scale, (640, 480), borderValue=128)


@pytest.mark.parametrize("turn", [0.0, np.pi])
def test_checkerboards_and_markers_have_one_way_up(turn: float) -> None:
    """Upside down, the same corner of the board is the first."""
    c, s = np.cos(turn), np.sin(turn)
    view = np.array([[c, -s, 320 - 180 * c + 120 * s], [s, c, 240 - 180 * s - 120 * c], [1e-5, 2e-5, 1]])
    sight = Board("checkerboard:9x6:0.040").find(drawn_board("checkerboard", view))
    assert sight is not None and len(sight.points) == 40
    where = np.concatenate([sight.points[:, :2] * 1e3 + 39.5, np.ones((40, 1))], axis=1) @ view.T
    assert np.abs(where[:, :2] / where[:, 2:] - sight.pixels).max() < 1.0
    sight = Board("aruco:7:0.24:4X4_50").find(drawn_board("aruco", view))
    assert sight is not None
    where = np.concatenate([sight.points[:, :2] * 1e3 - 0.5, np.ones((4, 1))], axis=1) @ view.T
    assert np.abs(where[:, :2] / where[:, 2:] - sight.pixels).max() < 2.0
    assert Board("aruco:8:0.24:4X4_50").find(drawn_board("aruco", view)) is None


# Corners that are computed: the truth to the last digit.

LENS = Lens(640, 480, np.array([600.0, 602.0]), np.array([318.0, 242.0]), np.array([0.05, -0.02, 1e-3, -5e-4, 0.0]))
CORNERS = np.array([[x, y, 0.0] for y in range(4) for x in range(5)]) * 0.05


def scene(seed: int, standing: bool = False) -> dict[str, Any]:
    """A camera that stands, one on the hand, boards on the hand and standing, joints that read beside the truth."""
    rng = np.random.default_rng(seed)
    robot = robot_of("panda")
    times = np.arange(0, 30, 0.01)
    home = np.array([0, -0.78, 0, -2.35, 0, 1.57, 0.78])
    waves = rng.uniform(0.15, 0.6, 7)
    phases = rng.uniform(0, 6, 7)
    true = home + 0.35 * np.sin(np.outer(times, waves) * 2 + phases)
    speed = 0.35 * 2 * waves * np.cos(np.outer(times, waves) * 2 + phases)
    offsets = np.radians(rng.uniform(-0.6, 0.6, 7))
    joints = JointStates(times, true - offsets, speed, None)
    looking = laboratory._looking(np.array([1.25, 0.1, 0.6]), np.array([0.45, 0.0, 0.25]))
    in_hand = laboratory.draw_truth(seed).hand_from_board
    standing_board = moved(looking, np.array([0.02, -0.05, 0.9, 0.2, -0.3, 0.1]))  # in the robot's base
    stamps = np.arange(0.5, 29.5, 0.25) + rng.uniform(0, 0.01, 116)
    clock = 0.043  # what is added to stamps
    drift = 30e-6 * (stamps - stamps.mean())
    motion = JointStates(times, true, speed, None)
    hands = robot.poses(motion.at(stamps + clock + drift), ["hand"])["hand"]
    seen = []
    for number, board in enumerate([in_hand, standing_board] if standing else [in_hand]):
        for stamp, hand in zip(stamps, hands, strict=True):
            pose = inverse(looking) @ (hand @ board if number == 0 else board)
            inside = CORNERS @ pose[:3, :3].T + pose[:3, 3]
            pixels = LENS.project(inside)
            if (inside[:, 2] > 0.1).all() and (np.abs(pixels - [320, 240]) < [315, 235]).all():
                noisy = pixels + rng.normal(0, 0.1, pixels.shape)
                seen.append(Seen(0, number, float(stamp), Sighting(CORNERS, noisy), pose))
    return {
        "robot": robot,
        "joints": joints,
        "seen": seen,
        "offsets": offsets,
        "camera": looking,
        "boards": [in_hand, standing_board],
        "clock": clock,
    }


def test_poses_clocks_and_joints_are_found_within_their_deviations() -> None:
    off = []
    for seed in (1, 2, 3):
        s = scene(seed)
        cameras, boards = [Camera("c", "link0", LENS)], [FixedBoard("b", "hand")]
        start(s["robot"], s["joints"], cameras, boards, s["seen"], 0.3)
        result = Bundle(s["robot"], s["joints"], cameras, boards, s["seen"], refine_lens=False).solve()
        camera = result.cameras[0]
        assert abs(camera.offset_s - s["clock"]) < 1e-3 and abs(camera.drift_ppm - 30) < 60
        inner = (result.offsets - s["offsets"])[1:-1]
        assert np.degrees(np.abs(inner)).max() < 0.1 and result.rms < 0.2
        off += list(inner / result.offset_deviations[1:-1]) + [
            (camera.offset_s - s["clock"]) / camera.offset_deviation_s
        ]
    assert 0.3 < np.sqrt(np.mean(np.square(off))) < 2.0  # deviations say how far off it is


def test_a_standing_board_whose_place_is_known_gives_the_first_joint_and_one_in_the_hand_the_last() -> None:
    s = scene(4, standing=True)
    assert {one.board for one in s["seen"]} == {0, 1}
    cameras = [Camera("c", "link0", LENS)]
    boards = [
        FixedBoard("b", mount, pose.copy(), (2e-4, 2e-4))
        for mount, pose in zip(("hand", "link0"), s["boards"], strict=True)
    ]
    start(s["robot"], s["joints"], cameras, boards, s["seen"], 0.3)
    result = Bundle(s["robot"], s["joints"], cameras, boards, s["seen"]).solve()
    assert all(result.freed) and np.degrees(np.abs(result.offsets - s["offsets"])).max() < 0.1
    way, turn = pose_error(result.cameras[0].pose, s["camera"])
    assert way < 2e-3 and np.degrees(turn) < 0.2


def test_wrong_corners_do_little() -> None:
    s = scene(5)
    rng = np.random.default_rng(0)
    for one in s["seen"][::12]:
        one.sighting.pixels[rng.integers(20)] += 40
    cameras, boards = [Camera("c", "link0", LENS)], [FixedBoard("b", "hand")]
    start(s["robot"], s["joints"], cameras, boards, s["seen"], 0.3)
    result = Bundle(s["robot"], s["joints"], cameras, boards, s["seen"], refine_lens=False).solve()
    assert np.degrees(np.abs((result.offsets - s["offsets"])[1:-1])).max() < 0.1 and result.cameras[0].median < 0.3


def test_pictures_of_another_time_and_an_arm_that_stood_still() -> None:
    s = scene(6)
    cameras, boards = [Camera("c", "link0", LENS)], [FixedBoard("b", "hand")]
    late = [Seen(0, 0, one.time + 1000, one.sighting, one.camera_from_board) for one in s["seen"]]
    with pytest.raises(stampede.Error, match="from when the arm was recorded"):
        start(s["robot"], s["joints"], cameras, boards, late, 0.3)
    still = JointStates(s["joints"].times, np.repeat(s["joints"].positions[:1], 3000, axis=0), None, None)
    with pytest.raises(stampede.Error, match="the hand has turned by 0 degrees"):
        start(s["robot"], still, cameras, boards, s["seen"], 0.3)


def test_lenses_agree_with_opencv_and_bad_sets_are_refused() -> None:
    points = np.random.default_rng(1).uniform([-0.4, -0.3, 0.8], [0.4, 0.3, 1.2], (50, 3))
    ours = LENS.project(points)
    theirs, _ = cv2.projectPoints(points, np.zeros(3), np.zeros(3), LENS.matrix, LENS.distortion)
    assert np.allclose(ours, theirs[:, 0], atol=1e-9)
    with pytest.raises(stampede.Error, match="seen in 2 pictures"):
        find_lens([Sighting(CORNERS, CORNERS[:, :2] * 1000)] * 2, (640, 480), "x")
    flat = [Sighting(CORNERS, CORNERS[:, :2] * 1000 + [100 + k, 100]) for k in range(8)]
    with pytest.raises(stampede.Error, match="tilted by 0 degrees at most"):
        find_lens(flat, (640, 480), "x")
    assert len(spread(flat, 3)) == 3


def test_rigid_motions() -> None:
    rng = np.random.default_rng(2)
    pose = moved(np.eye(4), rng.normal(size=6))
    step = rng.normal(size=6) * 0.3
    assert np.allclose(step_between(pose, moved(pose, step)), step)
    assert np.allclose(vector_of(turned(np.array([0.1, -2.0, 0.3]))), [0.1, -2.0, 0.3])
    x, y = (moved(np.eye(4), rng.normal(size=6)) for _ in range(2))
    first = np.stack([moved(np.eye(4), rng.normal(size=6)) for _ in range(10)])
    second = inverse(y) @ first @ x
    found_x, found_y, off = robot_world(first, second)
    assert np.allclose(found_x, x, atol=1e-9) and np.allclose(found_y, y, atol=1e-9) and off < 1e-8


def test_least_squares_keeps_to_priors() -> None:
    points = np.linspace(0, 1, 40)
    rng = np.random.default_rng(3)
    wanted = np.stack([2 * points + 1 + rng.normal(0, 0.01, 40), rng.normal(0, 0.01, 40)], axis=1)

    def residuals(v: np.ndarray) -> np.ndarray:
        return np.stack([v[0] * points + v[1] + v[2] - wanted[:, 0], -wanted[:, 1]], axis=1).ravel()

    answer = least_squares(residuals, np.zeros(3), np.full(3, 1e-4), np.array([np.inf, np.inf, 0.1]), np.arange(40))
    assert abs(answer.values[0] - 2) < 0.05 and abs(answer.values[1] + answer.values[2] - 1) < 0.02
    assert abs(answer.values[2]) < 0.05 and 0.02 < answer.deviations[2] < 0.2  # nothing but its prior says what it is
    fixed = least_squares(residuals, np.zeros(3), np.full(3, 1e-4), np.array([np.inf, 0.0, 0.0]), np.arange(40))
    assert fixed.values[1] == 0 and fixed.deviations[1] == 0
