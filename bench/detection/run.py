"""Corners of boards: handeye beside OpenCV, chess-corners and pupil-apriltags on the same pictures.

    pip install -r bench/detection/requirements.txt
    python bench/detection/run.py                     writes its section of BENCHMARK.md
    python bench/detection/run.py --dry               prints it only
    python bench/detection/run.py --search            handeye alone, 2016 hard and 1000 empty pictures: an hour
    python bench/detection/run.py --folder DIR        keeps the pictures there, and uses those that are there

Cargo builds handeye. Without --search it takes ten minutes of processor time.
"""

import argparse
import collections
import functools
import json
import multiprocessing
import pathlib
import statistics
import subprocess
import tempfile
import time

import cv2
import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BENCHMARK = ROOT / "BENCHMARK.md"
BEGIN, END = "<!-- detection:begin -->", "<!-- detection:end -->"
BEGIN_SEARCH, END_SEARCH = "<!-- detection-search:begin -->", "<!-- detection-search:end -->"
OWN = "handeye"
# a corner farther from every true one is wrong, px
WRONG = 2.0
# seconds of processor time after which a call is not repeated, and most calls
LONG, MOST_CALLS = 0.08, 40
# half-sides of the window of cornerSubPix
WINDOWS = [3, 5, 7, 9, 11]
USUAL_WINDOW = 5
STOP = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 100, 1e-4)
CLASSIC = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
THOROUGH = cv2.CALIB_CB_EXHAUSTIVE | cv2.CALIB_CB_ACCURACY
SUB_PIX = ", cornerSubPix "
SETTING = """Rendered pictures with exactly known corners: scene integrated over quarters of pixels, point spread,
pixels, noise of 2 grey values at a contrast of 170 unless told, 8 bits; a lens with distortion; tilts up to 60
degrees. handeye and the others get the same PNG files in one run, each on one thread, timed by its own
process's processor time; reading files is not counted. Corners of the others are matched to the nearest
true one, whatever their order; handeye's must have the right id."""

# --- the others ---------------------------------------------------------------------------------


def points(found):
    return np.empty((0, 2)) if found is None else np.asarray(found, float).reshape(-1, 2)


def refined(image, rough, window):
    if not len(rough):
        return rough
    corners = rough.astype(np.float32).reshape(-1, 1, 2)
    return points(cv2.cornerSubPix(image, corners, (window, window), (-1, -1), STOP))


def classic(flags):
    def find(image, target):
        found, corners = cv2.findChessboardCorners(image, (target["columns"], target["rows"]), flags=flags)
        return points(corners if found else None)
    return find


def sector_based(flags):
    def find(image, target):
        found, corners = cv2.findChessboardCornersSB(image, (target["columns"], target["rows"]), flags)
        return points(corners if found else None)
    return find


def charuco(image, target):
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, target["dictionary"]))
    size = target["squares_x"], target["squares_y"]
    board = cv2.aruco.CharucoBoard(size, target["square_mm"], target["marker_mm"], dictionary)
    return points(cv2.aruco.CharucoDetector(board).detectBoard(image)[0])


def saddles(multiscale):
    def find(image, _):
        import chess_corners as cc

        config = cc.DetectorConfig.chess_multiscale() if multiscale else cc.DetectorConfig.chess()
        config = config.with_chess(refiner=cc.ChessRefiner.saddle_point()).without_orientation()
        return points(cc.Detector(config.with_uncertainty(cc.Uncertainty.OFF)).detect(image).xy)
    return find


@functools.cache
def april_tag_detector(family, decimate):
    import pupil_apriltags

    return pupil_apriltags.Detector(families=f"tag{family}", nthreads=1, quad_decimate=decimate)


def april_tags(decimate):
    def find(image, target):
        tags = april_tag_detector(target["family"], decimate).detect(image)
        first, count = target["first_id"], target["tags_x"] * target["tags_y"]
        return points([tag.corners for tag in tags if 0 <= tag.tag_id - first < count] or None)
    return find


def markers(refinement):
    def find(image, target):
        dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, target["dictionary"]))
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = refinement
        corners, ids, _ = cv2.aruco.ArucoDetector(dictionary, parameters).detectMarkers(image)
        first, count = target["first_id"], target["tags_x"] * target["tags_y"]
        own = [c for c, k in zip(corners, [] if ids is None else ids.ravel()) if 0 <= k - first < count]
        return points(own or None)
    return find


Peer = collections.namedtuple("Peer", "find finishes boards", defaults=[False, True])
# by kind of target; `finishes`: cornerSubPix comes after it; `boards`: finds boards, not corners only
PEERS = {
    "checkerboard": {
        "OpenCV": Peer(classic(CLASSIC), finishes=True),
        "OpenCV fast check": Peer(classic(CLASSIC | cv2.CALIB_CB_FAST_CHECK), finishes=True),
        "OpenCV SB": Peer(sector_based(0)),
        "OpenCV SB thorough": Peer(sector_based(THOROUGH)),
        "chess-corners": Peer(saddles(False), boards=False),
        "chess-corners multiscale": Peer(saddles(True), boards=False),
    },
    "charuco": {"OpenCV": Peer(charuco), "OpenCV" + SUB_PIX.strip(): Peer(charuco, finishes=True)},
    "aprilgrid": {
        "pupil-apriltags": Peer(april_tags(1.0)),
        "pupil-apriltags decimate 2": Peer(april_tags(2.0)),
    },
    "tag-grid": {
        "OpenCV": Peer(markers(cv2.aruco.CORNER_REFINE_NONE)),
        "OpenCV REFINE_SUBPIX": Peer(markers(cv2.aruco.CORNER_REFINE_SUBPIX)),
        "OpenCV REFINE_CONTOUR": Peer(markers(cv2.aruco.CORNER_REFINE_CONTOUR)),
        "OpenCV REFINE_APRILTAG": Peer(markers(cv2.aruco.CORNER_REFINE_APRILTAG)),
        "OpenCV" + SUB_PIX.strip(): Peer(markers(cv2.aruco.CORNER_REFINE_NONE), finishes=True),
    },
}


def answer(kind, name, file, target, timed):
    """Corners by way of refining, and milliseconds of processor time."""
    peer = PEERS[kind][name]
    image = cv2.imread(file, cv2.IMREAD_GRAYSCALE)

    def call():
        rough = peer.find(image, target)
        return rough, refined(image, rough, USUAL_WINDOW) if peer.finishes else rough

    start, calls = time.process_time(), 0
    while calls == 0 or (timed and time.process_time() - start < LONG and calls < MOST_CALLS):
        rough, corners = call()
        calls += 1
    cost = 1e3 * (time.process_time() - start) / calls
    if not peer.finishes:
        return {None: corners}, cost
    return {w: refined(image, rough, w) for w in (WINDOWS if timed else [USUAL_WINDOW])}, cost


def serve(pipe):
    cv2.setNumThreads(1)
    while True:
        try:
            request = pipe.recv()
        except EOFError:
            return
        try:
            pipe.send(answer(*request))
        except cv2.error as error:
            pipe.send(({None: points(None)}, None))
            print(request[1], request[2], error)


class Server:
    """A process that answers, and is ended when it takes too long."""

    def __init__(self, timeout):
        self.timeout, self.process = timeout, None

    def start(self):
        context = multiprocessing.get_context("spawn")
        self.pipe, other = context.Pipe()
        self.process = context.Process(target=serve, args=(other,), daemon=True)
        self.process.start()

    def ask(self, *request):
        if self.process is None:
            self.start()
        self.pipe.send(request)
        if self.pipe.poll(self.timeout):
            return self.pipe.recv()
        self.process.terminate()
        self.process = None
        return None


# --- figures ------------------------------------------------------------------------------------


def true_corners(board):
    """Ids, pixels, and whether visible (1), hidden (0) or unsure (nan)."""
    seen = np.array([np.nan if c[3] is None else c[3] for c in board], float)
    return np.array([c[0] for c in board]), np.array([c[1:3] for c in board], float).reshape(-1, 2), seen


def nearest(some, others):
    """Index of the nearest of `others` to each of `some`, and its distance."""
    if not len(some) or not len(others):
        return np.zeros(len(some), int), np.full(len(some), np.inf)
    distance = np.linalg.norm(some[:, None] - others[None], axis=2)
    return distance.argmin(1), distance.min(1)


def errors(found, board):
    """Of each true corner that has a found one nearby: the difference."""
    _, true, _ = true_corners(board)
    index, distance = nearest(true, found)
    near = distance < WRONG
    return found[index[near]] - true[near]


def own_errors(corners, board):
    """Of each found corner: the difference from the one with its id, and its normalised square."""
    true = {c[0]: np.array(c[1:3]) for c in board}
    rows = [(np.array(c[1:3]) - true[c[0]], np.array([[c[3], c[4]], [c[4], c[5]]]))
            for c in corners if c[0] in true]
    away = np.array([e for e, _ in rows]).reshape(-1, 2)
    near = [(e, s) for e, s in rows if np.linalg.norm(e) < WRONG]
    return away, [e @ np.linalg.solve(s, e) / 2 for e, s in near]


def rms(pictures):
    all_errors = np.concatenate([e for e in pictures if len(e)] or [np.zeros((0, 2))])
    return np.sqrt((all_errors**2).sum(1).mean()) if len(all_errors) else np.nan


def bias(pictures):
    """Medians over pictures of the mean error: its length, along x, along y."""
    means = np.array([e.mean(0) for e in pictures if len(e)]).reshape(-1, 2)
    if not len(means):
        return [np.nan] * 3
    return [np.median(np.linalg.norm(means, axis=1)), *np.median(means, axis=0)]


# --- runs ---------------------------------------------------------------------------------------


def handeye(*arguments):
    command = ["cargo", "run", "--release", "-q", "-p", "handeye-bench", "--bin", "detection", "--"]
    done = subprocess.run([*command, *map(str, arguments)], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
    return done.stdout


def measured(pictures, folder, own, server):
    """Per group of pictures and solver: errors of each picture, by file; and milliseconds."""
    found, cost = collections.defaultdict(dict), collections.defaultdict(dict)
    nees, wrong = collections.defaultdict(list), collections.Counter()
    late = collections.Counter()
    for picture in pictures:
        kind, file, board = picture["target"]["kind"], picture["file"], picture["boards"][0]
        group = kind, picture["table"], picture["size"], picture["case"]
        away, normalised = own_errors(own[file]["corners"], board)
        near = np.linalg.norm(away, axis=1) < WRONG
        found[group, OWN][file], cost[group, OWN][file] = away[near], own[file]["ms"]
        nees[group] += normalised
        wrong[group] += int((~near).sum())
        for name in PEERS[kind]:
            if late[group, name] > 1:
                continue
            reply = server.ask(kind, name, str(folder / file), picture["target"], True)
            if reply is None:
                late[group, name] += 1
                continue
            for window, corners in reply[0].items():
                label = name if window is None else (name, window)
                found[group, label][file] = errors(corners, board)
            cost[group, name][file] = reply[1]
    return found, cost, nees, wrong, late


def best_windows(found):
    """In place of each window of cornerSubPix: the one with the least error in its group."""
    least = {}
    for (group, label), pictures in found.items():
        if isinstance(label, tuple):
            value = rms(pictures.values())
            if (group, label[0]) not in least or value < least[group, label[0]][0]:
                least[group, label[0]] = value, label[1], pictures
    chosen = {key: pictures for key, pictures in found.items() if not isinstance(key[1], tuple)}
    chosen.update({key: pictures for key, (_, _, pictures) in least.items()})
    return chosen, {key: window for key, (_, window, _) in least.items()}


def offsets(found):
    """Half pixels by which a solver's pixels are off throughout, and the medians that show it."""
    result = {}
    for label in {(group[0], label) for group, label in found}:
        all_pictures = [e for (g, n), ps in found.items() if (g[0], n) == label for e in ps.values()]
        result[label] = np.array(bias(all_pictures)[1:])
    return result


def corrected(found, shown):
    half = {key: np.round(2 * np.nan_to_num(offset)) / 2 for key, offset in shown.items()}
    return {(group, label): {f: e - half[group[0], label] for f, e in pictures.items()}
            for (group, label), pictures in found.items()}


def judged(found, boards, labelled):
    """Right, wrong and all visible corners; of two boards alike, the better one counts."""
    best = None
    for board in boards:
        ids, true, seen = true_corners(board)
        if labelled:
            at = {i: k for k, i in enumerate(ids)}
            index = np.array([at.get(c[0], -1) for c in found], int)
            pixels = np.array([c[1:3] for c in found], float).reshape(-1, 2)
            distance = np.linalg.norm(pixels - true[index], axis=1) if len(true) else np.full(len(found), np.inf)
            distance[index < 0] = np.inf
        else:
            index, distance = nearest(found, true)
        near = distance < WRONG
        right = len(set(index[near & (seen[index] == 1)])) if len(found) else 0
        result = right, int((~near).sum()), int((seen == 1).sum())
        if best is None or result[:1] > best[:1]:
            best = result
    return best if boards else (0, len(found), 0)


def searched(pictures, folder, own, server):
    """Per kind, table and case, and solver: pictures, boards, boards with wrong corners, corners."""
    rows = collections.defaultdict(lambda: np.zeros(6, int))
    late = collections.Counter()
    for picture in pictures:
        kind, file, boards = picture["target"]["kind"], picture["file"], picture["boards"]
        group = kind, picture["table"], picture["case"]

        def count(name, found, labelled):
            right, wrong, visible = judged(found, boards, labelled)
            rows[group, name] += [1, len(found) > 0, wrong > 0, right, wrong, visible]

        count(OWN, own[file]["corners"], True)
        for name, peer in PEERS[kind].items():
            if not peer.boards or (kind != "checkerboard" and peer.finishes):
                continue
            reply = server.ask(kind, name, str(folder / file), picture["target"], False)
            late[group, name] += reply is None
            found = points(None) if reply is None else next(iter(reply[0].values()))
            count(name, found, False)
    return rows, late


# --- tables -------------------------------------------------------------------------------------


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return [*lines, *("| " + " | ".join(row) + " |" for row in rows), ""]


def number(value, digits=4):
    return "" if value is None or np.isnan(value) else f"{value:.{digits}f}"


def groups_of(found, kind, name):
    return list(dict.fromkeys(g for g, _ in found if g[0] == kind and g[1] == name))


def peers_in(found, kind):
    return [name for name in PEERS[kind] if any(g[0] == kind and n == name for g, n in found)]


def against(found, group, name, figure):
    """Figures of handeye and another, of the pictures in which both found corners."""
    ours, theirs = found[group, OWN], found.get((group, name), {})
    both = [f for f in theirs if len(theirs[f]) and len(ours.get(f, []))]
    if 2 * len(both) < len(ours):
        return np.nan, np.nan
    return figure([ours[f] for f in both]), figure([theirs[f] for f in both])


def hardest(found, group, names, figure):
    """The other that is best beside handeye: its name, both figures, their ratio."""
    pairs = [(name, *against(found, group, name, figure)) for name in names]
    pairs = [(name, a, b, a / b) for name, a, b in pairs if np.isfinite(a) and b > 0]
    return max(pairs, key=lambda pair: pair[3], default=("none", np.nan, np.nan, np.nan))


def accuracy_tables(kind, found, nees, wrong, windows):
    names, rows, wide = peers_in(found, kind), [], []
    for group in groups_of(found, kind, "accuracy") + groups_of(found, kind, "noise"):
        ours = found[group, OWN]
        some = [e for e in ours.values() if len(e)]
        length, x, y = bias(some)
        best = hardest(found, group, names, rms)
        least = hardest(found, group, names, lambda pictures: bias(pictures)[0])
        case = group[3] if group[1] == "accuracy" else f"SNR {group[3]}"
        rows.append([
            group[2], case, f"{len(some)} of {len(ours)}", number(rms(some)),
            f"{number(best[2])} ({best[0]})", number(best[3], 2),
            f"{number(length)} ({x:+.4f}, {y:+.4f})", f"{number(least[2])} ({least[0]})",
            number(least[3], 2), number(np.mean(nees[group]) if nees[group] else np.nan, 2), str(wrong[group]),
        ])
        cells = []
        for name in names:
            theirs = [e for e in found.get((group, name), {}).values() if len(e)]
            window = windows.get((group, name))
            cells.append(f"{number(rms(theirs))} / {number(bias(theirs)[0])}"
                         + (f" ({window})" if window else "") + f", {len(theirs)}")
        wide.append([group[2], case, *cells])
    head = ["size", "spread or noise", "found", "RMS px", "best other", "ratio", "bias px (x, y)",
            "least other", "ratio", "normalised error", "wrong"]
    return [*table(head, rows), "The others, each over all that it found: RMS px / bias px (best window), pictures.", "",
            *table(["size", "spread or noise", *names], wide)]


def timing_table(kind, found, cost):
    names, rows = peers_in(found, kind), []
    for size in dict.fromkeys(g[2] for g in groups_of(found, kind, "accuracy")):
        def median(name):
            all_costs = [c for g in groups_of(found, kind, "accuracy") if g[2] == size
                         for c in cost[g, name].values() if c is not None]
            return statistics.median(all_costs) if all_costs else np.nan
        ours, theirs = median(OWN), {name: median(name) for name in names}
        of_boards = {n: t for n, t in theirs.items() if PEERS[kind][n].boards and np.isfinite(t)}
        fastest = min(of_boards, key=of_boards.get)
        rows.append([size, number(ours, 1), f"{ours / of_boards[fastest]:.2f} ({fastest})",
                     *(number(t, 1) for t in theirs.values())])
    return table(["size", OWN, "ratio to the fastest that finds boards", *names], rows)


def finding_table(kind, name, rows):
    groups = list(dict.fromkeys(g for g, _ in rows if g[:2] == (kind, name)))
    if not groups:
        return []
    solvers = list(dict.fromkeys(n for g, n in rows if g[:2] == (kind, name)))

    def cell(group, solver):
        _, boards, with_wrong, right, wrong, visible = rows[group, solver]
        if name == "empty":
            return str(boards)
        share = f"{100 * right / visible:.1f} %" if visible else ""
        return f"{boards}, {share}" + (f", **{wrong} wrong in {with_wrong}**" if wrong else "")

    lines = [[g[2], str(rows[g, OWN][0]), *(cell(g, s) for s in solvers)] for g in groups]
    total = {s: sum(rows[g, s] for g in groups) for s in solvers}
    rows = {**rows, **{((kind, name, "**all**"), s): total[s] for s in solvers}}
    last = kind, name, "**all**"
    lines.append([last[2], str(total[OWN][0]), *(cell(last, s) for s in solvers)])
    return table(["pictures of", "count", *solvers], lines)


def section(results, settings):
    (found, cost, nees, wrong, late), (rows, slow) = results
    found, windows = best_windows(found)
    shown = offsets(found)
    found = corrected(found, shown)
    kinds = list(dict.fromkeys(g[0] for g, _ in found))
    lines = ["## Corners of boards", "", *SETTING.splitlines(), "",
             f"Written by `bench/detection/run.py` with OpenCV {cv2.__version__}.", settings, ""]
    lines += ["Median offset of all corners from the truth, px (x, y); half pixels are taken off before anything "
              "else: " + "; ".join(f"{kind} {name} {o[0]:+.4f}, {o[1]:+.4f}" for (kind, name), o in sorted(shown.items()))
              + ".", ""]
    lines += [
        "*Bias* is the length of the mean error of a picture, median over pictures (and the medians along x",
        "and y). *Ratio* is handeye over the best other, of the pictures in which both found corners: above 1",
        "handeye is the worse one. *Normalised error* is the mean of the squared error over the stated",
        "covariance, over 2: 1 is right, above 1 handeye is too sure. cornerSubPix comes with the best of the",
        "windows 3, 5, 7, 9, 11 for each row. *Wrong*: corners of handeye more than 2 px off, or of the wrong id.",
        ""]
    for kind in kinds:
        lines += [f"### {kind}: accuracy", "", *accuracy_tables(kind, found, nees, wrong, windows),
                  f"### {kind}: processor time, ms", "", "Median over the pictures of the table of spreads.", "",
                  *timing_table(kind, found, cost)]
        hard, empty = finding_table(kind, "hard", rows), finding_table(kind, "empty", rows)
        if hard:
            lines += [f"### {kind}: hard pictures", "",
                      "Boards of which anything was found, share of the visible corners found; corners more than "
                      "2 px off.", "", *hard]
        if empty:
            lines += [f"### {kind}: pictures without a board", "", "Boards found where none is.", "", *empty]
    ended = {**{k: v for k, v in late.items() if v}, **{k: v for k, v in slow.items() if v}}
    if ended:
        text = "; ".join(f"{name}: {', '.join(group)}: {n}" for (group, name), n in ended.items())
        lines += [f"Ended for taking too long: {text}.", ""]
    return lines


def search_section(rows, hard, empty):
    """handeye alone on many pictures."""
    hard_rows = [r for r in rows if r["table"] == "hard"]
    kinds = list(dict.fromkeys(r["kind"] for r in hard_rows))
    cases = list(dict.fromkeys(r["case"] for r in hard_rows))

    def total(kind, name):
        return sum(r["tally"][name] for r in hard_rows if r["kind"] == kind)

    def cell(kind, case):
        tally = next(r["tally"] for r in hard_rows if (r["kind"], r["case"]) == (kind, case))
        return shown(*(tally[name] for name in ("boards", "right", "visible", "wrong")))

    def shown(boards, right, visible, wrong):
        return f"{boards}, {100 * right / max(visible, 1):.1f} %" + (f", **{wrong} wrong**" if wrong else "")

    lines = [[case, *(cell(kind, case) for kind in kinds)] for case in cases]
    sums = [shown(*(total(kind, name) for name in ("boards", "right", "visible", "wrong"))) for kind in kinds]
    lines.append(["**all**", *sums])
    false = {kind: sum(r["tally"]["boards"] for r in rows if r["table"] == "empty" and r["kind"] == kind) for kind in kinds}
    return ["## Corners of boards: handeye alone on many pictures", "",
            f"{hard} hard pictures of each case and target, {empty} pictures without a board, of 1.3 MP each; boards of",
            "which anything was found, share of the visible corners found, corners more than 2 px off or of a wrong id.",
            "", *table(["pictures of", *kinds], lines),
            f"Boards found in the {empty} pictures without one: "
            + ", ".join(f"{kind} {count}" for kind, count in false.items()) + ".", ""]


def write_section(lines, begin, end):
    text = BENCHMARK.read_text() if BENCHMARK.exists() else "# Benchmark\n"
    if begin not in text:
        text += f"\n{begin}\n{end}\n"
    block = "\n".join([begin, *lines, end])
    BENCHMARK.write_text(text[:text.index(begin)] + block + text[text.index(end) + len(end):])


def run(folder, options):
    hard, empty = options.hard, options.empty
    if not (folder / "truth.json").exists():
        handeye("render", folder, options.accuracy, hard, empty)
    handeye("detect", folder)
    truth = json.loads((folder / "truth.json").read_text())
    own = json.loads((folder / "handeye.json").read_text())
    server = Server(options.timeout)
    exact = [p for p in truth if p["table"] in ("accuracy", "noise")]
    rest = [p for p in truth if p["table"] in ("hard", "empty")]
    settings = (f"{options.accuracy} pictures a row (half as many of 12 MP), {hard} of each hard case, {empty} without "
                f"a board; a call may take {options.timeout:.0f} s.")
    return section((measured(exact, folder, own, server), searched(rest, folder, own, server)), settings)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--accuracy", type=int, default=2, help="pictures for each spread and size")
    parser.add_argument("--hard", type=int, default=4, help="pictures for each hard case and target")
    parser.add_argument("--empty", type=int, default=10, help="pictures without a board")
    parser.add_argument("--search", action="store_true", help="handeye alone on many hard and empty pictures")
    parser.add_argument("--each", type=int, default=63, help="hard pictures of each case and target of --search")
    parser.add_argument("--none", type=int, default=1000, help="pictures without a board of --search")
    parser.add_argument("--timeout", type=float, default=15.0, help="seconds that a call may take")
    parser.add_argument("--folder", type=pathlib.Path, help="keep the pictures there; use those that are there")
    parser.add_argument("--dry", action="store_true", help="print only")
    options = parser.parse_args()
    marks = BEGIN, END
    if options.search:
        marks = BEGIN_SEARCH, END_SEARCH
        lines = search_section(json.loads(handeye("search", options.each, options.none)), options.each, options.none)
    elif options.folder:
        lines = run(options.folder.resolve(), options)
    else:
        with tempfile.TemporaryDirectory() as folder:
            lines = run(pathlib.Path(folder), options)
    print("\n".join(lines))
    if not options.dry:
        write_section(lines, *marks)


if __name__ == "__main__":
    main()
