"""Registration of scans: handeye beside small_gicp, Open3D and PCL, its k-d tree beside small_gicp's, SciPy's, kiddo.

    pip install -r bench/registration/requirements.txt
    apt-get install --no-install-recommends g++ pkg-config libpcl-dev     without them, PCL is not measured
    python bench/registration/run.py                  writes its sections of BENCHMARK.md
    python bench/registration/run.py --only basin     or others, threads: writes that section alone
    python bench/registration/run.py --dry            prints only
    python bench/registration/run.py --folder DIR     keeps the scans there

Cargo builds handeye and, from its registry, kiddo; g++ builds what runs PCL. The run takes twenty minutes and a
gigabyte of disk.
"""

import os

# before the libraries that read it
os.environ["OMP_NUM_THREADS"] = "1"

import argparse
import collections
import importlib.metadata
import json
import pathlib
import statistics
import subprocess
import tempfile
import time
import tomllib

import numpy as np
import open3d
import scipy.spatial
import small_gicp

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BENCHMARK = ROOT / "BENCHMARK.md"
# of the scenes that are timed, and of the one whose memory is measured: pixels
SMALL, LARGE, LARGEST = (366, 274), (1280, 1024), (3660, 2745)
GATE = 0.01
# a call is repeated until so much processor time went by, s
LONG_ENOUGH = 0.4
# how often two threads are tried; each time after waiting for the machine to be quiet, s, at most
ATTEMPTS, PATIENCE = 5, 60
# share of the processors that others take on a quiet machine
QUIET = 0.1
# questions that registration asks of a tree have an answer within, m
NEAR = 0.01
# rad, m
TIGHT = {"rotation_epsilon": 1e-5, "translation_epsilon": 1e-6, "max_iterations": 50}
NEIGHBOURS = 30
ORDERS = {"organised": "organised", "cloud": "cloud, row by row", "shuffled": "cloud, shuffled"}
MOST_MEMORY = 1.5 * 2**30
SETTING = """Two scans of one simulated cell (a table, a board, blocks, balls, bars; `Room::of_a_cell`) from two
places 0.3 m apart: they share a part of what they see, each range has a normal error of 0.5 mm. All get the
same points in memory, and a start 5 mm and 1 degree off about the middle of the scene. The time ends with the
answer: grid, tree, normals and rounds are in it. It is the process's own processor time on one thread, because
other work ran on the machine: a call is repeated for 0.4 s after one that is not counted, the calls of all
programs follow one another scene by scene, and the median over the first scenes is told. The errors are medians
over all scenes: the angle, and the distance at the middle of the source's points. handeye runs at its defaults
(which try other starts, and come with a covariance and a verdict); the others get a gate of 10 mm, and come as
their packages are built."""
PEERS_TOLD = """GICP, VGICP and point-to-plane of small_gicp on the voxels named; *tight*: ended at 0.00001 rad and 0.001
mm instead of its 0.1 degrees and 1 mm. Open3D point-to-plane with normals of 30 neighbours. {pcl}
*Share*: of this program's time, handeye takes that much on organised scans, on clouds, on shuffled clouds. Answers
that handeye refused count in its errors like the others."""

PCL_MEASURED = """PCL {version}
from C++, with the library as its package is built: point-to-plane with normals of 30 neighbours, point-to-point, and
GICP (whose solver stops early, where it sees no progress), in double precision where it has that, ended as *tight*
or after 50 rounds. On all points of the larger scans, Open3D and PCL are not measured: that would take minutes."""
PCL_MISSING = """PCL is not
measured: it could not be compiled. On all points of the larger scans, Open3D is not either: that would take minutes."""
PCL_MODULES = ["registration", "features", "filters", "search", "kdtree", "common"]

# --- scans --------------------------------------------------------------------------------------


class Scene:
    def __init__(self, folder, name):
        known = json.loads((folder / f"{name}.json").read_text())
        self.truth, self.start = (np.array(known[key]).reshape(4, 4) for key in ("truth", "start"))
        self.files = [folder / f"{name}_{role}.f32" for role in ("source", "target")]
        self.source, self.target = map(seen, self.files)
        self.middle = self.source.mean(0)

    def errors(self, answer):
        """Degrees, and mm at the middle."""
        turn = self.truth[:3, :3].T @ answer[:3, :3]
        sine = np.linalg.norm([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        angle = np.degrees(np.arctan2(sine, (np.trace(turn) - 1) / 2))
        return angle, 1e3 * np.linalg.norm((self.truth - answer) @ np.append(self.middle, 1))


def seen(file):
    points = np.fromfile(file, np.float32).reshape(-1, 3)
    return points[np.isfinite(points).all(1)].astype(np.float64)


def handeye(*arguments):
    command = ["cargo", "run", "--release", "-q", "-p", "handeye-bench", "--bin", "registration", "--"]
    done = subprocess.run([*command, *map(str, arguments)], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
    return json.loads(done.stdout) if done.stdout else None


# --- the others ---------------------------------------------------------------------------------


def gicp(kind, voxel, wide=None, **stop):
    """small_gicp on voxels of `voxel`; of VGICP, the target's are `wide`."""
    def measure(scene, timed):
        return milliseconds(lambda: small_gicp.align(
            scene.target, scene.source, scene.start, registration_type=kind, voxel_resolution=wide or voxel,
            downsampling_resolution=voxel, max_correspondence_distance=GATE, num_threads=1, **stop,
        ).T_target_source, timed)
    return measure


def point_to_plane(voxel=None):
    """Open3D."""
    def measure(scene, timed):
        vectors = open3d.utility.Vector3dVector
        source, target = (open3d.geometry.PointCloud(vectors(p)) for p in (scene.source, scene.target))
        registration = open3d.pipelines.registration

        def call():
            some, others = (c.voxel_down_sample(voxel) if voxel else c for c in (source, target))
            others.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NEIGHBOURS))
            estimation = registration.TransformationEstimationPointToPlane()
            return registration.registration_icp(some, others, GATE, scene.start, estimation).transformation
        return milliseconds(call, timed)
    return measure


def pcl_program(folder):
    """Compiled; none where the library is not."""
    program = folder / "pcl"
    try:
        wanted = ["pkg-config", "--cflags", "--libs", *(f"pcl_{module}" for module in PCL_MODULES)]
        flags = subprocess.run(wanted, check=True, text=True, stdout=subprocess.PIPE).stdout.split()
        # as Debian builds the library: not for this processor alone
        subprocess.run(["g++", "-O3", "-DNDEBUG", HERE / "pcl.cpp", "-o", program, *flags], check=True)
    except (FileNotFoundError, subprocess.CalledProcessError) as missing:
        print(f"PCL is not measured (is libpcl-dev there?): {missing}")
        return None
    return program


def pcl_told(program):
    if not program:
        return PCL_MISSING
    asked = ["pkg-config", "--modversion", "pcl_common"]
    done = subprocess.run(asked, check=True, text=True, stdout=subprocess.PIPE)
    return PCL_MEASURED.format(version=done.stdout.strip())


def pcl(program, method, voxel=0):
    def measure(scene, timed):
        numbers = [GATE, NEIGHBOURS, LONG_ENOUGH if timed else 0, *scene.start.ravel()]
        command = [*map(str, [program, method, voxel, *scene.files, *numbers])]
        done = subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE)
        row = json.loads(done.stdout)
        return row["ms"] if timed else np.nan, np.array(row["transform"]).reshape(4, 4)
    return measure


def pcl_peers(program):
    return {
        "PCL point-to-plane, 5 mm": pcl(program, "plane", 0.005),
        "PCL point-to-plane, all points": pcl(program, "plane"),
        "PCL point-to-point, 5 mm": pcl(program, "point", 0.005),
        "PCL GICP, 5 mm": pcl(program, "gicp", 0.005),
    } if program else {}


PEERS = {
    "small_gicp GICP, 10 mm": gicp("GICP", 0.01),
    "small_gicp GICP, 10 mm, tight": gicp("GICP", 0.01, **TIGHT),
    "small_gicp GICP, 5 mm": gicp("GICP", 0.005),
    "small_gicp GICP, 5 mm, tight": gicp("GICP", 0.005, **TIGHT),
    "small_gicp GICP, 3 mm, tight": gicp("GICP", 0.003, **TIGHT),
    "small_gicp VGICP, 10 mm": gicp("VGICP", 0.01),
    "small_gicp VGICP, 5 mm": gicp("VGICP", 0.005),
    "small_gicp VGICP, 5 mm on 10 mm, tight": gicp("VGICP", 0.005, 0.01, **TIGHT),
    "small_gicp point-to-plane, 5 mm, tight": gicp("PLANE_ICP", 0.005, **TIGHT),
    "Open3D, 5 mm": point_to_plane(0.005),
    "Open3D, all points": point_to_plane(),
}
# these would take minutes
TOO_LARGE = {("Open3D, all points", LARGE), ("PCL point-to-plane, all points", LARGE)}


def milliseconds(call, timed=True):
    """Processor time of a call, and what the one that is not counted gave."""
    answer = call()
    if not timed:
        return np.nan, answer
    start, calls = time.process_time(), 0
    while calls == 0 or time.process_time() - start < LONG_ENOUGH:
        call()
        calls += 1
    return 1e3 * (time.process_time() - start) / calls, answer


# --- registration -------------------------------------------------------------------------------


def measured(folder, size, others, options):
    """Per program: medians of ms, degrees and mm; how many points there are, and refused answers."""
    rows, points, refused = {}, [], 0
    for seed in range(options.scenes):
        name, timed = f"{size[0]}_{seed}", seed < options.timed
        scene = Scene(folder, name)
        points += [len(scene.source), len(scene.target)]
        for order, own in handeye("register", folder, name).items():
            answer = np.array(own["transform"]).reshape(4, 4)
            rows.setdefault(order, []).append((own["ms"] if timed else np.nan, *scene.errors(answer)))
            refused += own["verdict"] != "accepted"
        for peer, measure in others.items():
            if (peer, size) not in TOO_LARGE:
                ms, answer = measure(scene, timed)
                rows.setdefault(peer, []).append((ms, *scene.errors(answer)))
    medians = {program: np.nanmedian(values, axis=0) for program, values in rows.items()}
    return medians, statistics.median(points), refused


def registration_lines(size, medians, points, refused):
    peers = {program: row for program, row in medians.items() if program not in ORDERS}
    own = {order: medians[order] for order in ORDERS}
    lines = [[f"**handeye**, {told}", *figures(own[order]), ""] for order, told in ORDERS.items()]
    for program, row in peers.items():
        shares = " / ".join(f"{own[order][0] / row[0]:.2f}" for order in ORDERS)
        lines.append([program, *figures(row), shares])
    fastest = min(peers, key=lambda p: peers[p][0])
    surest = min(peers, key=lambda p: peers[p][1] * peers[p][2])
    goals = []
    for order, told in ORDERS.items():
        most = 1 / 6 if order == "organised" else 1 / 2
        for what, peer in [("the fastest", fastest), ("the most accurate", surest)]:
            ratios = own[order] / peers[peer]
            goals.append([told, f"{what}: {peer}", f"{ratios[0]:.2f}", f"1/{round(1 / most)}, {met(ratios[0] <= most)}",
                          f"{ratios[1]:.2f}", f"{ratios[2]:.2f}", met(max(ratios[1:]) <= 1)])
    return [
        f"### {size[0]} x {size[1]}: {points / 1e3:.0f} k points seen", "",
        *table(["program", "ms", "error, degrees", "error, mm", "share of its time"], lines),
        f"handeye refused {refused} of its answers. Against the fastest of the others and the most accurate (by the",
        "product of both errors), each by both:", "",
        *table(["handeye", "against", "time", "goal", "angle", "distance", "both at most 1"], goals),
    ]


def figures(row):
    return [f"{row[0]:.1f}", f"{row[1]:.4f}", f"{row[2]:.4f}"]


# --- threads, basin, trees, pairs, memory -------------------------------------------------------


def others_share():
    """Of the processors, over a second."""
    def times():
        line = pathlib.Path("/proc/stat").read_text().splitlines()[0]
        return np.array(line.split()[1:9], float)
    before = times()
    time.sleep(1)
    spent = times() - before
    return 1 - spent[3:5].sum() / spent.sum()


def waited_for_quiet():
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if others_share() < QUIET:
            return True
    return False


def thread_lines(folder):
    handeye("render", folder, *LARGE, 1)
    least, same, quiet = {order: np.full(2, np.inf) for order in ORDERS}, dict.fromkeys(ORDERS, True), 0
    for _ in range(ATTEMPTS):
        quiet += waited_for_quiet()
        for order, row in handeye("threads", folder, f"{LARGE[0]}_0").items():
            least[order] = np.minimum(least[order], [row["one"], row["two"]])
            same[order] &= row["same"]
    rows = []
    for order, (one, two) in least.items():
        rows.append([ORDERS[order], f"{one:.1f}", f"{two:.1f}", f"{one / two:.2f}", met(one / two >= 1.8),
                     "yes" if same[order] else "**no**"])
    return ["## Registration by two threads", "",
            f"{LARGE[0]} x {LARGE[1]}, wall time, ms: the least of {ATTEMPTS} times 9 runs of each in turn. Two threads need both",
            f"processors of the machine; others took less than a tenth of them when {quiet} of the {ATTEMPTS}",
            "began, none can be sure of them throughout, and the gain may be larger. Goal: 1.8 times as fast, and the same answer, bit for bit.", "",
            *table(["handeye", "one", "two", "gain", "met", "same bits"], rows)]


def basin_lines(scenes):
    rows, answers = [], handeye("basin", scenes)
    for row in answers:
        start = "none; turned by up to 170 degrees" if row["start"] is None else "{:.0f} degrees, {:.0f} mm".format(*row["start"])
        normalised = row["normalised"]
        rows.append([row["order"], start, str(row["right"]), str(row["refused"]),
                     f"**{row['wrong']}**" if row["wrong"] else "0", f"{normalised:.2f}", met(0.8 <= normalised <= 1.25)])
    wrong, count = sum(r["wrong"] for r in answers), scenes * len(answers)
    why = collections.Counter()
    for row in answers:
        why.update(row["reasons"])
    told = "; ".join(f"“{reason} …” {times}" for reason, times in why.most_common())
    return ["## Registration: how far off a start may be", "",
            f"{scenes} scenes for each row, 240 x 180, views drawn at random: 0.15 m aside, 0.2 rad tilted, 0.3 rad turned",
            "at most. *Wrong*: accepted and off by more than 0.3 degrees or 1.5 mm. *Normalised error*: the mean of the",
            "squared error over the stated covariance, over 6, of all that was accepted: 1 is right, above 1 handeye is",
            "too sure; goal: 0.8 to 1.25.", "",
            *table(["points", "start is off by", "right", "refused", "wrong", "normalised error", "met"], rows),
            f"Wrong: {wrong} of {count} (goal: none; {met(wrong == 0)}). Right or refused: "
            f"{100 * (1 - wrong / count):.2f} % (goal: 99 %; {met(wrong <= 0.01 * count)}).", "",
            f"Refused because, in the first words of the first reason: {told}.", ""]


def kiddo(*arguments):
    """What it measured; none where cargo cannot build it."""
    places = {"CARGO_TARGET_DIR": str(ROOT / "target"), **os.environ}

    def cargo(command, *more):
        whole = ["cargo", command, "--release", "-q", "--locked", *map(str, more)]
        return subprocess.run(whole, cwd=HERE / "kiddo", env=places, text=True, stdout=subprocess.PIPE)

    if cargo("build").returncode:
        print("kiddo is not measured: cargo could not build it")
        return None
    done = cargo("run", "--", *arguments)
    done.check_returncode()
    return json.loads(done.stdout)


def tree_rows(folder, size):
    own = handeye("trees", folder, f"{size[0]}_0")
    scene = Scene(folder, f"{size[0]}_0")
    # as handeye asks: the source's points in their true place, to f32
    asked = (scene.source @ scene.truth[:3, :3].T + scene.truth[:3, 3]).astype(np.float32).astype(np.float64)
    near = asked[scipy.spatial.cKDTree(scene.target).query(asked)[0] < NEAR]

    def of_scipy(**options):
        return lambda: scipy.spatial.cKDTree(scene.target, **options)

    def of_gicp():
        return small_gicp.KdTree(scene.target, num_threads=1)

    def ask_scipy(tree, points):
        return tree.query(points)[0].mean()

    def ask_gicp(tree, points):
        return np.sqrt(tree.batch_nearest_neighbor_search(points, num_threads=1)[1]).mean()

    def told_by(program, measured):
        return (program, *(measured[key] for key in ("build_ms", "near_ms", "all_ms", "mean_distance")))

    rows = [told_by("**handeye**", own)]
    quick = of_scipy(balanced_tree=False, compact_nodes=False)
    for program, build, ask in [("small_gicp KdTree", of_gicp, ask_gicp), ("SciPy cKDTree", of_scipy(), ask_scipy),
                                ("SciPy cKDTree, not balanced", quick, ask_scipy)]:
        built, tree = milliseconds(build)
        some, _ = milliseconds(lambda: ask(tree, near))
        everything, distance = milliseconds(lambda: ask(tree, asked))
        rows.append((program, built, some, everything, distance))
    if beside := kiddo(folder, f"{size[0]}_0"):
        rows.append(told_by("kiddo", beside))
    assert all(abs(row[-1] / rows[0][-1] - 1) < 1e-3 for row in rows), rows
    best = [min(row[k] for row in rows[1:]) for k in (1, 2, 3)]
    told = f"{own['points'] / 1e3:.0f} k; {own['near'] / 1e3:.0f} k of {own['questions'] / 1e3:.0f} k"
    return [[told, row[0], *(f"{ms:.1f} ({ms / least:.2f})" for ms, least in zip(row[1:], best))] for row in rows]


def tree_lines(folder):
    rows = [row for size in (SMALL, LARGE) for row in tree_rows(folder, size)]
    with_kiddo = any(row[1] == "kiddo" for row in rows)
    locked = tomllib.loads((HERE / "kiddo" / "Cargo.lock").read_text())["package"]
    version = next(package["version"] for package in locked if package["name"] == "kiddo")
    single = f"handeye and kiddo ({version}, without threads) compute" if with_kiddo else "handeye computes"
    return ["### Nearest neighbours", "",
            "A k-d tree of the target's points, asked for the nearest of points of the source in their true place, row by",
            "row: of those that have one within 10 mm, as registration asks, and of all, also those that lie where the",
            "target shows nothing. Processor time, ms, and in brackets the multiple of the best of the others. The mean",
            f"distances agree to a thousandth. {single} in f32, the others in f64;",
            "small_gicp's answers become Python lists, which is part of its time.", "",
            *table(["points; questions near of all", "program", "build", "ask, near", "ask, all"], rows)]


def pair_lines():
    row = handeye("pairs")
    return ["### Fit of point pairs", "",
            f"`rigid_fit`, with its covariance: {row['few']} pairs in {row['few_ns']:.0f} ns; {row['many'] / 1e6:.0f} M pairs in "
            f"{row['many_ms']:.2f} ms, {row['many_ms'] / row['reading_ms']:.2f} times the {row['reading_ms']:.2f} ms that it takes to "
            "add up their coordinates (processor time, medians of 9).", ""]


def memory_lines(folder):
    name = f"{LARGEST[0]}_0"
    row = handeye("memory", folder, name)
    angle, distance = Scene(folder, name).errors(np.array(row["transform"]).reshape(4, 4))
    some, others = (f"{count / 1e6:.2f} M" for count in row["points"])
    return ["### Memory", "",
            f"Clouds of {some} against {others} points ({LARGEST[0]} x {LARGEST[1]}): the process held at most "
            f"{row['peak'] / 2**30:.2f} GiB (goal: 1.5; {met(row['peak'] <= MOST_MEMORY)}), of which {row['before'] / 2**30:.2f} GiB before "
            f"it began: the points. It was {row['verdict']} after {row['seconds']:.1f} s on one thread, {angle:.4f} degrees and "
            f"{distance:.4f} mm off.", ""]


# --- the section --------------------------------------------------------------------------------


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return [*lines, *("| " + " | ".join(row) + " |" for row in rows), ""]


def met(fulfilled):
    return "yes" if fulfilled else "**no**"


def machine():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "unknown")
    return f"{os.cpu_count()} processors ({model}); load {os.getloadavg()[2]:.1f} over the last quarter of an hour"


def comparison(folder, options):
    """With the other programs, and what is measured on the same scenes."""
    for size, count in [(SMALL, options.scenes), (LARGE, options.scenes), (LARGEST, 1)]:
        handeye("render", folder, *size, count)
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("small_gicp", "open3d", "scipy"))
    program = pcl_program(folder)
    others = {**PEERS, **pcl_peers(program)}
    registrations = [registration_lines(size, *measured(folder, size, others, options)) for size in (SMALL, LARGE)]
    return ["## Registration", "", *SETTING.splitlines(), "", *PEERS_TOLD.format(pcl=pcl_told(program)).splitlines(), "",
            f"Written by `bench/registration/run.py` with {versions}; {options.scenes} scenes of each size,",
            f"{options.timed} of them timed; {machine()}.", "",
            *(line for lines in registrations for line in lines), *tree_lines(folder), *pair_lines(),
            *memory_lines(folder)]


def write_section(part, lines):
    begin, end = f"<!-- registration-{part}:begin -->", f"<!-- registration-{part}:end -->"
    text = BENCHMARK.read_text() if BENCHMARK.exists() else "# Benchmark\n"
    if begin not in text:
        text += f"\n{begin}\n{end}\n"
    block = "\n".join([begin, *lines, end])
    BENCHMARK.write_text(text[:text.index(begin)] + block + text[text.index(end) + len(end):])


PARTS = {
    "others": comparison,
    "basin": lambda _, options: basin_lines(options.scenes_of_basin),
    "threads": lambda folder, _: thread_lines(folder),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", choices=PARTS, help="this section alone")
    parser.add_argument("--scenes", type=int, default=24, help="scenes of each size")
    parser.add_argument("--timed", type=int, default=6, help="those that are timed")
    parser.add_argument("--scenes-of-basin", type=int, default=100, help="scenes for each start")
    parser.add_argument("--folder", type=pathlib.Path, help="keep the scans there")
    parser.add_argument("--dry", action="store_true", help="print only")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as passing:
        folder = (options.folder or pathlib.Path(passing)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        for part in [options.only] if options.only else PARTS:
            lines = PARTS[part](folder, options)
            print("\n".join(lines))
            if not options.dry:
                write_section(part, lines)


if __name__ == "__main__":
    main()
