"""Rows of figures: Stampede beside its peers, in turn, round by round. tests/bench/peers/run calls it.

A ratio above 1 says that Stampede is faster; it is the median of the rounds' ratios, and in brackets their least and
greatest. Times are wall times unless a row says otherwise.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
CLASSICAL = ["elevator", "assembly", "travel", "satellite", "logistics", "storage"]
CAMERAS = 5


class Skipped(Exception):
    """Why a figure cannot be had."""


class Bench:
    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.results: list[dict] = []
        self.folder = Path(tempfile.mkdtemp(prefix="peers"))
        self.catalogues = 0

    # What is run.

    def call(self, command: list, **more: object) -> subprocess.CompletedProcess:
        environment = {**os.environ, "LC_ALL": "C"}
        return subprocess.run(
            [str(word) for word in command], capture_output=True, text=True, env=environment, cwd=self.folder, **more
        )

    def json_of(self, command: list, **more: object) -> dict:
        answer = self.call(command, **more)
        last = answer.stdout[answer.stdout.find("{") :]
        try:
            if answer.returncode == 0:
                return json.loads(last)
        except ValueError:
            pass
        said = (answer.stderr.strip() or answer.stdout.strip()).splitlines()
        raise Skipped(said[-1] if said else f"{Path(str(command[0])).name}: exit code {answer.returncode}")

    def peer(self, module: str, script: str, *arguments: object, **more: object) -> dict:
        if find_spec(module) is None:
            raise Skipped(f"{module} is not installed; see .build/peers-venv/why/{module}")
        return self.json_of([sys.executable, HERE / script, *arguments], **more)

    def mujoco(self, *arguments: object) -> dict:
        return self.peer("mujoco", "mujoco_side.py", *arguments)

    def built(self, name: str) -> Path:
        path = self.options.build / "tests/bench" / name
        if not path.exists():
            raise Skipped(f"{name} is not built")
        return path

    def google(self, name: str, only: str) -> dict[str, dict]:
        """Google Benchmark's answers by name."""
        words = [f"--benchmark_filter={only}", "--benchmark_format=json", f"--benchmark_min_time={self.seconds}"]
        answer = self.json_of([self.built(name), *words])
        if not answer["benchmarks"]:
            raise Skipped(f"{name} has no {only}")
        return {one["name"].split("/min_time")[0]: one for one in answer["benchmarks"]}

    def run_task(
        self,
        task: str,
        episodes: int,
        *words: str,
        program: Path | None = None,
        seed: int = 0,
        workers: int = 1,
    ) -> dict:
        """What `stampede run` says, and how long it took, its start included."""
        self.catalogues += 1
        out = self.folder / f"run{self.catalogues}.db"
        command = [program or self.options.stampede, "run", task, "--episodes", episodes, "--seed", seed]
        begin = time.perf_counter()
        answer = self.call([*command, "--workers", workers, "--out", out, "--json", *words])
        wall = time.perf_counter() - begin
        for path in self.folder.glob(out.name + "*"):
            path.unlink()
        if answer.returncode not in (0, 1) or not answer.stdout.startswith("{"):
            said = answer.stderr.strip().splitlines()
            raise Skipped(f"stampede run {task}: {said[-1] if said else answer.returncode}")
        return {"wall": wall, **json.loads(answer.stdout)["tasks"][0]}

    # How long.

    @property
    def seconds(self) -> float:
        return 0.3 if self.options.quick else 1.5

    def episodes(self, usual: int) -> int:
        return max(2, usual // 4) if self.options.quick else usual

    # What is said.

    def say(self, text: str) -> None:
        print(text, flush=True)

    def row(
        self,
        number: int,
        name: str,
        unit: str,
        sides: dict[str, Callable[[], float]],
        *,
        faster_is: str = "more",
        rounds: int | None = None,
        note: str = "",
    ) -> None:
        """Asks the sides in turn, round by round, for a figure each, and prints medians and ratios."""
        values: dict[str, list[float]] = {side: [] for side in sides}
        skipped: dict[str, str] = {}
        for _ in range(rounds or self.options.rounds):
            for side, ask in sides.items():
                if side in skipped:
                    continue
                try:
                    values[side].append(ask())
                except Skipped as why:
                    skipped[side] = str(why)
        figures = {side: statistics.median(v) for side, v in values.items() if v and side not in skipped}
        ours = next(iter(sides))
        ratios = {}
        for side in figures:
            if side == ours or ours not in figures:
                continue
            pairs = zip(values[ours], values[side], strict=True)
            ratios[side] = spread([a / b if faster_is == "more" else b / a for a, b in pairs])
        self.keep(number, name, unit, values, ratios, skipped, note)
        parts = [f"{side} {shown(figure)}" for side, figure in figures.items()]
        if len(sides) == 1 and figures:
            parts[0] += f" ({min(values[ours]):.4g} .. {max(values[ours]):.4g})"
        line = f"{number:>2}  {name}, {unit}: " + "; ".join(parts)
        for side, ratio in ratios.items():
            line += f"; {ours}/{side} {ratio['median']:.3g} ({ratio['min']:.3g} .. {ratio['max']:.3g})"
        for side, why in skipped.items():
            line += f"; {side} skipped: {why}"
        self.say(line + (f"  [{note}]" if note else ""))

    def keep(
        self, number: int, name: str, unit: str, values: dict, ratios: dict, skipped: dict, note: str = ""
    ) -> None:
        self.results.append(
            {
                "row": number,
                "name": name,
                "unit": unit,
                "values": values,
                "ratios": ratios,
                "skipped": skipped,
                "note": note,
            }
        )


def spread(values: list[float]) -> dict[str, float]:
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def shown(value: float) -> str:
    return f"{value:,.0f}" if value >= 1000 else f"{value:.4g}"


def percentile(values: list[float], part: float) -> float:
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def physics(bench: Bench) -> None:
    for cubes in (3, 10, 30):
        sides = {
            "ours": lambda n=cubes: bench.json_of([bench.built("peers_bench"), "physics", n, bench.seconds]),
            "MuJoCo": lambda n=cubes: bench.mujoco("physics", n, bench.seconds),
            "PyBullet": lambda n=cubes: bench.peer("pybullet", "pybullet_side.py", "physics", n, bench.seconds),
        }
        rates = {side: (lambda ask=ask: ask()["steps_per_s"]) for side, ask in sides.items()}
        bench.row(1, f"physics, Panda and {cubes} cubes", "steps/s", rates)
    for cubes in (3, 10, 30):
        sides = {
            "ours": lambda n=cubes: bench.json_of([bench.built("peers_bench"), "physics", n, bench.seconds, "asleep"]),
            "MuJoCo": lambda n=cubes: bench.mujoco("physics", n, bench.seconds, "asleep"),
        }
        rates = {side: (lambda ask=ask: ask()["steps_per_s"]) for side, ask in sides.items()}
        bench.row(1, f"physics, Panda and {cubes} cubes that may sleep", "steps/s", rates)


def bare(bench: Bench) -> None:
    name = "engine_against_bare/joint_position"

    def ask() -> float:
        one = next(iter(bench.google("sim_step_bench", name).values()))
        return one["speed_ratio"]

    bench.row(2, "the engine's step beside a bare Bullet loop", "times as fast", {"ours": ask})


def pick(bench: Bench) -> None:
    for objects, words in ((3, ["pick_and_lift"]), (10, ["pick_and_lift_10", "--path", HERE])):
        picking(bench, 3, objects, words, "state only", bench.episodes(40), [])


def pick_pictures(bench: Bench) -> None:
    pictures = ["--images", "all", "--size", "128x128"]
    for objects, words in ((3, ["pick_and_lift"]), (10, ["pick_and_lift_10", "--path", HERE])):
        picking(bench, 4, objects, [*words, *pictures], "five cameras", bench.episodes(8), ["pictures"])


def picking(
    bench: Bench, number: int, objects: int, words: list, what: str, episodes: int, peer_words: list[str]
) -> None:
    note = ""

    def ours(workers: int) -> float:
        nonlocal note
        answer = bench.run_task(words[0], episodes, *words[1:], workers=workers)
        note = f"ours: {answer['succeeded']} of {answer['episodes']} succeeded"
        return answer["wall"] / answer["simulated_s"]

    def mujoco() -> float:
        return bench.mujoco("pick", objects, episodes, *peer_words)["wall_per_simulated_s"]

    name = f"pick-and-lift, {objects} objects, {what}"
    sides = {"ours": lambda: ours(1), "MuJoCo": mujoco, "ours with two workers": lambda: ours(2)}
    bench.row(number, name, "wall s per simulated s", sides, faster_is="less")
    bench.say(f"    {note}")
    bench.results[-1]["note"] = note


def pictures(bench: Bench) -> None:
    for bench_name, name, words in (
        ("all_kinds", "without shadows", []),
        ("all_kinds_shadows", "with shadows", ["shadows"]),
    ):

        def ours(wanted: str = bench_name) -> float:
            return bench.google("render_bench", f"^{wanted}$")[wanted]["items_per_second"]

        def mujoco(more: list[str] = words) -> float:
            return bench.mujoco("pictures", bench.seconds, *more)["frames_per_s"]

        bench.row(5, f"pictures, {CAMERAS} cameras of 128 x 128, {name}", "frames/s", {"ours": ours, "MuJoCo": mujoco})


def motions(bench: Bench) -> None:
    path = bench.options.problems.resolve()
    if not path.exists():
        bench.say(f" 6  motion planning skipped: there is no {bench.options.problems}")
        bench.keep(6, "motion planning", "", {}, {}, {"ours": f"no {bench.options.problems}"})
        return
    answers: dict[str, list[dict]] = {"ours": [], "VAMP": []}
    skipped: dict[str, str] = {}

    def ours() -> list[dict]:
        out = bench.folder / "mbm.json"
        answer = bench.call([bench.built("mbm_bench"), path, "--json", out])
        if not out.exists():
            raise Skipped(f"mbm_bench: {(answer.stderr.strip().splitlines() or [answer.returncode])[-1]}")
        return json.loads(out.read_text())["problems"]

    def vamp() -> list[dict]:
        return bench.peer("vamp", "vamp_side.py", "plan", path, 3)["problems"]

    for _ in range(min(3, bench.options.rounds)):
        for side, ask in (("ours", ours), ("VAMP", vamp)):
            if side in skipped:
                continue
            try:
                answers[side].append({(one["set"], one["id"]): one for one in ask()})
            except Skipped as why:
                skipped[side] = str(why)
    for side, why in skipped.items():
        bench.say(f" 6  motion planning: {side} skipped: {why}")
    sets = sorted({key[0] for rounds in answers.values() for one in rounds for key in one})
    if (HERE.parents[2] / ".build/peers-venv/why/vamp.stand-ins").exists() and answers["VAMP"]:
        bench.say("    VAMP was built with a stand-in for its nearest neighbours")
    for chosen in [*sets, "all"]:
        motion_line(bench, chosen, answers, skipped)


def motion_line(bench: Bench, chosen: str, answers: dict[str, list[dict]], skipped: dict[str, str]) -> None:
    def wanted(key: tuple) -> bool:
        return chosen in ("all", key[0])

    parts, values, merged = [], {}, {}
    for side, rounds in answers.items():
        if not rounds:
            continue
        merged[side] = {
            key: {**one, "ms": statistics.median(r[key]["ms"] for r in rounds)}
            for key, one in rounds[0].items()
            if wanted(key) and all(r[key]["solved"] for r in rounds)
        }
        problems = [one for key, one in rounds[0].items() if wanted(key)]
        solved = list(merged[side].values())
        if not solved:
            continue
        times = [one["ms"] for one in solved]
        values[side] = {
            "problems": len(problems),
            "ends_free": sum(one["ends_free"] for one in problems),
            "solved": len(solved),
            "median_ms": statistics.median(times),
            "p95_ms": percentile(times, 0.95),
            "median_length_rad": statistics.median(one["length"] for one in solved),
        }
        v = values[side]
        parts.append(
            f"{side} solved {v['solved']} of {v['ends_free']}, {v['median_ms']:.3g} ms, 95 % {v['p95_ms']:.3g} ms, "
            f"{v['median_length_rad']:.2f} rad"
        )
    line, ratios = f" 6  motion planning, {chosen}: " + "; ".join(parts), {}
    both = sorted(set(merged.get("ours", {})) & set(merged.get("VAMP", {})))
    if both:
        mine, theirs = merged["ours"], merged["VAMP"]
        each = [theirs[key]["ms"] / mine[key]["ms"] for key in both]
        longer = [mine[key]["length"] / theirs[key]["length"] for key in both]
        ratios = {
            "time": spread(each),
            "p95": values["VAMP"]["p95_ms"] / values["ours"]["p95_ms"],
            "length": statistics.median(longer),
        }
        line += (
            f"; ours/VAMP {ratios['time']['median']:.3g} ({min(each):.2g} .. {max(each):.2g}), "
            f"of the 95 % {ratios['p95']:.3g}; our paths {ratios['length']:.3g} times as long"
        )
    bench.say(line)
    bench.keep(6, f"motion planning, {chosen}", "ms", values, ratios, skipped)


def checks(bench: Bench) -> None:
    try:
        posts = bench.call([bench.built("peers_bench"), "posts"]).stdout
    except Skipped:
        posts = ""
    latest: dict[str, dict] = {}

    def ours(kind: str) -> float:
        if kind == "one_per_s" or "ours" not in latest:
            latest["ours"] = bench.json_of([bench.built("peers_bench"), "checks", bench.seconds / 2])
        return latest["ours"][kind]

    def vamp(kind: str) -> float:
        if not posts:
            raise Skipped("peers_bench is not built")
        latest["VAMP"] = bench.peer("vamp", "vamp_side.py", "checks", bench.seconds / 2, input=posts)
        return latest["VAMP"][kind]

    for kind, name in (("one_per_s", "one a call, VAMP's from Python"), ("many_per_s", "many a call")):
        sides = {"ours": lambda k=kind: ours(k), "VAMP": lambda k=kind: vamp(k)}
        bench.row(7, f"collision checks among ten posts, {name}", "checks/s", sides)


def workers(bench: Bench) -> None:
    pictures = ["--images", "all", "--size", "128x128"]
    for what, episodes, words in (("state only", 400, []), ("five cameras", 24, pictures)):
        count = bench.episodes(episodes)

        def rate(number: int, count: int = count, words: list[str] = words) -> float:
            return 3600 * count / bench.run_task("pick_and_lift", count, *words, workers=number)["wall"]

        sides = {"two workers": lambda r=rate: r(2), "one": lambda r=rate: r(1)}
        bench.row(8, f"pick_and_lift, {what}", "episodes an hour", sides)


def cpu_of(command: list, folder: Path, limit: float) -> tuple[float, str]:
    """CPU seconds of a program and all that it starts, and what it prints."""
    words = [str(word) for word in command]
    with tempfile.TemporaryFile("w+") as out:
        limits = f"ulimit -t {int(limit)}; exec " + " ".join(f"'{word}'" for word in words)
        child = subprocess.Popen(["bash", "-c", limits], stdout=out, stderr=subprocess.STDOUT, cwd=folder)
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        return used.ru_utime + used.ru_stime, out.read()


def classical(bench: Bench) -> None:
    limit = 10 if bench.options.quick else 60  # CPU seconds
    folder = bench.folder / "classical"
    folder.mkdir()
    try:
        bench.call([bench.built("classical_bench"), "write", folder])
    except Skipped as why:
        bench.say(f" 9  task planning skipped: {why}")
        bench.keep(9, "task planning", "", {}, {}, {"ours": str(why)})
        return
    package = find_spec("up_fast_downward")  # importing it wants more packages
    program = Path(package.submodule_search_locations[0]) / "downward/fast-downward.py" if package else None
    sizes = 1 if bench.options.quick else 2
    for domain in CLASSICAL:
        problems = sorted(folder.glob(f"{domain}-n*.pddl"), key=lambda p: int(re.findall(r"\d+", p.stem)[-1]))
        for problem in problems[:sizes]:
            given_up: set[str] = set()
            steps: dict[str, int] = {}
            search: list[float] = []
            pair = [folder / f"{domain}-domain.pddl", problem]

            def ours(pair: list = pair, given_up: set = given_up, steps: dict = steps) -> float:
                used, said = cpu_of([bench.options.stampede, "plan", *pair, "--json"], folder, limit)
                begin = said.find("{")
                answer = json.JSONDecoder().raw_decode(said[begin:])[0] if begin >= 0 else {}
                if not answer.get("solved"):
                    raise Skipped(f"no plan within {limit} s")
                steps["ours"] = len(answer["plan"])
                return used

            def theirs(pair: list = pair, steps: dict = steps, search: list = search) -> float:
                if not program:
                    raise Skipped("up_fast_downward is not installed; see .build/peers-venv/why/up_fast_downward")
                used, said = cpu_of([sys.executable, program, "--alias", "lama-first", *pair], folder, limit)
                length = re.search(r"Plan length: (\d+) step", said)
                if not length:
                    raise Skipped(f"no plan within {limit} s")
                steps["Fast Downward"] = int(length.group(1))
                search.append(float(re.findall(r"\] Total time: ([0-9.]+)s", said)[-1]))
                return used

            name = f"task planning, {problem.stem.replace('-n', ' ')}"
            sides = {"ours": ours, "Fast Downward": theirs}
            bench.row(9, name, "CPU s", sides, faster_is="less", rounds=min(3, bench.options.rounds))
            note = "steps: " + ", ".join(f"{side} {n}" for side, n in steps.items())
            if search:
                note += f"; Fast Downward's search without its translator {statistics.median(search):.3g} s"
            bench.say(f"    {note}")
            bench.results[-1].update(note=note, steps=steps, search_s=search)
    ratios = [r["ratios"]["Fast Downward"]["median"] for r in bench.results if r["row"] == 9 and r["ratios"]]
    if ratios:
        mean = statistics.geometric_mean(ratios)
        bench.say(f" 9  task planning, {len(ratios)} problems solved by both: geometric mean of the ratios {mean:.3g}")


def all_tasks(bench: Bench) -> None:
    programs = {"ours": bench.options.stampede}
    if bench.options.against:
        programs["other"] = bench.options.against.resolve()
    rounds = min(2, bench.options.rounds) if bench.options.against else 1
    sums = {side: {"wall": [0.0] * rounds, "good": 0, "count": 0} for side in programs}
    missing = []
    for task in sorted(path.stem for path in (ROOT / "tasks").glob("*.lua")):
        many = bench.episodes(8) if task != "sort_blocks" else 1  # an episode of it has sixty skills
        tally = {side: {"wall": [], "good": 0, "count": 0} for side in programs}

        def rate(side: str, task: str = task, many: int = many, tally: dict = tally) -> float:
            mine = tally[side]
            answer = bench.run_task(task, many, program=programs[side], seed=100 * len(mine["wall"]), workers=2)
            mine["wall"].append(answer["wall"])
            mine["good"] += answer["succeeded"]
            mine["count"] += answer["episodes"]
            return 3600 * answer["succeeded"] / answer["wall"]

        sides = {side: lambda s=side, r=rate: r(s) for side in programs}
        bench.row(10, task, "demonstrations an hour", sides, rounds=rounds)
        success = ", ".join(f"{side} {tally[side]['good']} of {tally[side]['count']}" for side in programs)
        bench.say(f"    succeeded: {success}")
        bench.results[-1]["note"] = f"succeeded: {success}"
        if bench.results[-1]["skipped"]:
            missing.append(task)
            continue
        for side, one in tally.items():
            sums[side]["good"] += one["good"]
            sums[side]["count"] += one["count"]
            sums[side]["wall"] = [a + b for a, b in zip(sums[side]["wall"], one["wall"], strict=True)]
    line, values = "10  all tasks, as many episodes of each as above:", {}
    for side, one in sums.items():
        if one["count"]:
            values[side] = 3600 * one["good"] / sum(one["wall"])
            line += f" {side} {values[side]:,.0f} demonstrations an hour, {one['good']} of {one['count']} succeeded;"
    ratios = {}
    if len(values) == 2:
        pairs = zip(sums["ours"]["wall"], sums["other"]["wall"], strict=True)
        ratios["other"] = spread([b / a for a, b in pairs])
        one = ratios["other"]
        line += f" times of all: ours/other {one['median']:.3g} ({one['min']:.3g} .. {one['max']:.3g});"
    if missing:
        line += f" without {', '.join(missing)}"
    bench.say(line.rstrip(";"))
    bench.keep(10, "all tasks", "demonstrations an hour", values, ratios, {task: "skipped" for task in missing})


def growth(bench: Bench) -> None:
    def ours(objects: int) -> float:
        answer = bench.run_task(f"pick_and_lift_{objects}", bench.episodes(60), "--path", str(HERE))
        return answer["wall"] / answer["simulated_s"]

    sides = {"10 objects": lambda: ours(10), "30": lambda: ours(30)}
    bench.row(11, "pick-and-lift, state only, one moves", "wall s per simulated s", sides)


ROWS: dict[int, tuple[str, Callable[[Bench], None]]] = {
    1: ("physics steps, beside MuJoCo and PyBullet", physics),
    2: ("the engine's step beside a bare Bullet loop", bare),
    3: ("pick-and-lift, state only, beside MuJoCo", pick),
    4: ("pick-and-lift with pictures, beside MuJoCo", pick_pictures),
    5: ("pictures alone, beside MuJoCo", pictures),
    6: ("motion planning, beside VAMP", motions),
    7: ("collision checks, beside VAMP", checks),
    8: ("two workers beside one", workers),
    9: ("task planning, beside Fast Downward", classical),
    10: ("all tasks, and beside another build of Stampede", all_tasks),
    11: ("a scene with 30 objects beside one with 10", growth),
}


def main() -> None:
    listed = "\n".join(f"  {number:>2}  {name}" for number, (name, _) in ROWS.items())
    parser = argparse.ArgumentParser(
        description=__doc__, epilog="rows:\n" + listed, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--rows", default=",".join(map(str, ROWS)), help="which, as 1,3,6 (all)")
    parser.add_argument("--rounds", type=int, help="how often each side is asked (5, with --quick 2)")
    parser.add_argument("--quick", action="store_true", help="short rounds: to see that all works")
    parser.add_argument("--json", type=Path, help="also write all values to this file")
    parser.add_argument("--build", type=Path, default=ROOT / ".build/release", help="the build (.build/release)")
    parser.add_argument("--stampede", type=Path, help="the program (that of the build)")
    parser.add_argument("--against", type=Path, help="another build's program, for row 10")
    parser.add_argument(
        "--problems",
        type=Path,
        default=ROOT / "../shared/data/mbm_panda_dev.json",
        help="MotionBenchMaker's problems, for row 6 (../shared/data/mbm_panda_dev.json)",
    )
    options = parser.parse_args()
    options.rounds = options.rounds or (2 if options.quick else 5)
    options.build = options.build.resolve()
    options.stampede = (options.stampede or options.build / "stampede").resolve()
    if not options.stampede.exists():
        parser.error(f"there is no {options.stampede}: cmake --preset release && cmake --build --preset release")
    try:
        wanted = [int(word) for word in options.rows.split(",")]
        functions = [ROWS[number][1] for number in wanted]
    except (ValueError, KeyError):
        parser.error(f"--rows {options.rows}: numbers of 1 to {len(ROWS)}")
    bench = Bench(options)
    begin = time.perf_counter()
    try:
        for function in functions:
            function(bench)
            if options.json:
                options.json.write_text(json.dumps(bench.results, indent=1) + "\n")
    finally:
        subprocess.run(["rm", "-rf", str(bench.folder)], check=False)
    bench.say(f"{time.perf_counter() - begin:.0f} s in all")


if __name__ == "__main__":
    main()
