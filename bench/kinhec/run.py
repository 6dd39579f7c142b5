"""handeye beside the solvers of KinHEC, on KinHEC's own synthetic sequences and by its protocol.

    pip install -r bench/kinhec/requirements.txt
    kinhec generate --tier smoke --out DATA           also: small, medium, full
    python bench/kinhec/run.py DATA                   writes its section of BENCHMARK.md
    python bench/kinhec/run.py DATA --dry             prints it only

A. Aiersilan, KinHEC: a kinematic trajectory benchmark for hand-eye and robot-world calibration, 2026
(MIT; https://github.com/Ezharjan/kinhec).
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import kinhec
import numpy as np
import pandas
from kinhec import benchmark, load_manifest, load_sequence, metrics, se3
from scipy.spatial.transform import Rotation

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BENCHMARK = ROOT / "BENCHMARK.md"
BEGIN, END = "<!-- kinhec:begin -->", "<!-- kinhec:end -->"
OWN = "handeye"
ROTATION, TRANSLATION = "X_rot_err_deg", "X_trans_err_mm"


def stored(pose):
    quaternion = Rotation.from_matrix(pose[:3, :3]).as_quat()
    return {"translation_m": list(pose[:3, 3]), "rotation_xyzw": list(quaternion)}


def matrix(pose):
    m = np.eye(4)
    m[:3, :3] = Rotation.from_quat(pose["rotation_xyzw"]).as_matrix()
    m[:3, 3] = pose["translation_m"]
    return m


def pairs_of(sequence, offset):
    """The keyframes that KinHEC's solvers get; the camera's pose as the camera saw it."""
    data = benchmark._keyframe_data(sequence, offset)
    if data is None:
        return None
    robot, other = data[0], data[1]
    seen = se3.inverse(other) if sequence.eye_in_hand else other
    pair = lambda a, c: {"base_from_flange": stored(a), "camera_from_target": stored(c)}
    return {"pairs": [pair(a, c) for a, c in zip(robot, seen)]}


def streams_of(sequence):
    """Both measured streams, each by its own clock."""
    robot, camera = sequence.robot, sequence.camera
    seen = np.isfinite(camera.T_cam_target_meas).all(axis=(1, 2))
    return {
        "robot": [
            {"time_s": t, "base_from_flange": stored(p)} for t, p in zip(robot.t, robot.T_base_ee_meas)
        ],
        "camera": [
            {"time_s": t, "camera_from_target": stored(p)}
            for t, p in zip(camera.t[seen], camera.T_cam_target_meas[seen])
        ],
    }


def run(program, document, sequence, monocular):
    document["setup"] = "eye-in-hand" if sequence.eye_in_hand else "eye-to-hand"
    if monocular:
        document["unknown_scale"] = True
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(document, file)
        file.flush()
        start = time.perf_counter()
        done = subprocess.run(
            [program, "solve", file.name, "--json", "--quiet"], capture_output=True, text=True, check=False
        )
        milliseconds = 1e3 * (time.perf_counter() - start)
    if done.returncode not in (0, 3):
        return {"verdict": done.stderr.strip() or "failed", "runtime_ms": milliseconds}
    answer = json.loads(done.stdout)
    found = {"verdict": answer["verdict"], "runtime_ms": milliseconds}
    pose = answer["hand_eye"]
    if pose["mount_from_camera"] is None:
        return found
    # KinHEC's X is on the flange, its Y in the base
    x, y = matrix(pose["mount_from_camera"]), matrix(pose["anchor_from_target"])
    x, y = (x, y) if sequence.eye_in_hand else (y, x)
    found.update(metrics.calibration_errors(x, sequence.X, y, sequence.Y))
    if monocular and answer["scale"] is not None:
        found["scale_err_rel"] = abs(answer["scale"] - sequence.scale) / sequence.scale
    if answer["time_offset_s"] is not None and not sequence.synchronous:
        found["time_offset_err_ms"] = 1e3 * abs(answer["time_offset_s"] - sequence.time_offset)
    return found


def tier_of(root):
    return json.loads((root / "generation_info.json").read_text()).get("tier", root.name)


def earlier(stored, **wanted):
    """Rows of an earlier run."""
    if stored is None:
        return []
    same = np.logical_and.reduce([stored[column] == value for column, value in wanted.items()])
    return stored[same].to_dict("records")


def own(sequence, mode, program):
    """The row of handeye."""
    known = None if sequence.synchronous else sequence.time_offset
    document = streams_of(sequence) if mode == "estimated" else pairs_of(sequence, known)
    found = {"verdict": "too few frames"}
    if document is not None:
        found = run(program, document, sequence, sequence.scale != 1.0)
    return {"solver": OWN, "ok": TRANSLATION in found, **found}


def evaluated(root, program, limit, stored):
    manifest, tier = load_manifest(root), tier_of(root)
    rows = []
    for track, group in manifest.groupby("track"):
        names = list(group.sequence_id)
        # evenly over all levels of difficulty
        for name in names[:: max(1, -(-len(names) // limit))] if limit else names:
            sequence = load_sequence(root, name, manifest)
            for mode in ["oracle"] if sequence.synchronous else ["oracle", "estimated"]:
                here = {"tier": tier, "sequence_id": name, "eval_sync": mode}
                known = earlier(stored, **here)
                theirs = [row for row in known if row["solver"] != OWN] or benchmark.evaluate_sequence(
                    sequence, list(benchmark.SOLVERS), sync=mode, rng=np.random.default_rng(0)
                )
                ours = [row for row in known if row["solver"] == OWN] or [own(sequence, mode, program)]
                rows.extend({**row, **here, "track": track} for row in [*theirs, *ours])
        print(f"{track}: {len(group)} sequences", flush=True)
    return pandas.DataFrame(rows)


def medians(rows):
    return rows[ROTATION].median(), rows[TRANSLATION].median()


def cell(rows):
    rotation, translation = medians(rows)
    return f"{rotation:.3f} / {translation:.2f}"


def table(rows):
    """One line a track: medians over the sequences that handeye answers."""
    lines = [
        "| track | sequences | answered | handeye | shah+lm | park_martin+lm | ransac_park_martin "
        "| least of the eleven |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for (track, mode), group in rows.groupby(["track", "eval_sync"]):
        own = group[group.solver == OWN]
        answered = own[own.ok]
        same = group[group.sequence_id.isin(answered.sequence_id) & group.ok]
        if answered.empty:
            continue
        others = [solver for solver in same.solver.unique() if solver != OWN]
        errors = {solver: medians(same[same.solver == solver]) for solver in others}
        turn, shift = (min(others, key=lambda solver: errors[solver][k]) for k in (0, 1))
        name = track if mode == "oracle" else f"{track}, offset unknown"
        of = lambda solver: cell(same[same.solver == solver])
        lines.append(
            f"| {name} | {len(own)} | {len(answered)} | {of(OWN)} | {of('shah+lm')} "
            f"| {of('park_martin+lm')} | {of('ransac_park_martin')} "
            f"| {turn} {errors[turn][0]:.3f} / {shift} {errors[shift][1]:.2f} |"
        )
    return lines


def extras(rows):
    """Offsets, scales, and what was not answered."""
    lines = []
    unknown = rows[rows.eval_sync == "estimated"]
    if len(unknown):
        theirs = unknown[unknown.solver == "shah"].time_offset_err_ms
        ours = unknown[(unknown.solver == OWN) & unknown.ok].time_offset_err_ms
        lines.append(
            f"Time offset, median and 90th percentile of the error: handeye {ours.median():.2f} and "
            f"{ours.quantile(0.9):.2f} ms, KinHEC's cross-correlation {theirs.median():.2f} and "
            f"{theirs.quantile(0.9):.2f} ms."
        )
    monocular = rows[rows.track == "monocular"]
    if len(monocular):
        scale = lambda solver: monocular[(monocular.solver == solver) & monocular.ok].scale_err_rel
        lines.append(
            f"Scale, median relative error: handeye {scale(OWN).median():.4f}, andreff_scale "
            f"{scale('andreff_scale').median():.4f}."
        )
    open_ones = rows[(rows.solver == OWN) & ~rows.ok]
    if len(open_ones):
        theirs = rows[rows.sequence_id.isin(open_ones.sequence_id) & (rows.solver == "shah+lm") & rows.ok]
        lines.append(
            f"Not answered by handeye, which calls them undetermined: {len(open_ones)}; there shah+lm "
            f"errs by {cell(theirs)}."
        )
    return lines


def section(rows, root):
    setting = (
        f"KinHEC {kinhec.__version__}, tier `{tier_of(root)}`: synthetic pose streams with known truth. Medians of "
        "the error of X (deg / mm) over the sequences that handeye answers, all solvers on the same keyframes; "
        "with the offset unknown, handeye gets both raw streams, the others KinHEC's own estimate of it. Where "
        "distances are scaled, handeye is told that the scale is unknown; of the others only andreff_scale "
        "finds it."
    )
    planned = json.loads((root / "generation_info.json").read_text())["tracks"]
    for track, names in rows.groupby("track").sequence_id:
        found, all_of_it = names.nunique(), planned.get(track, {}).get("planned_sequences", 0)
        if found < all_of_it:
            setting += f" Of `{track}`, {found} of {all_of_it} sequences."
    return [setting, "", *table(rows), "", *extras(rows), ""]


def write(lines):
    text = BENCHMARK.read_text()
    block = "\n".join(lines)
    if BEGIN in text:
        before, rest = text.split(BEGIN, 1)
        text = before + block + rest.split(END, 1)[1]
    else:
        text = text.rstrip("\n") + "\n\n" + block + "\n"
    BENCHMARK.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=pathlib.Path, nargs="+")
    parser.add_argument("--program", default=str(ROOT / "target/release/handeye"))
    parser.add_argument("--limit", type=int, help="sequences per track")
    parser.add_argument("--rows", type=pathlib.Path, help="write every single result as CSV")
    parser.add_argument(
        "--stored", type=pathlib.Path, nargs="+", help="earlier --rows; what they have is not run again"
    )
    parser.add_argument("--dry", action="store_true")
    arguments = parser.parse_args()
    lines, every = [BEGIN, "## KinHEC", ""], []
    stored = None
    if arguments.stored:
        stored = pandas.concat([pandas.read_csv(path) for path in arguments.stored])
    for root in arguments.data:
        every.append(evaluated(root, arguments.program, arguments.limit, stored))
        lines += section(every[-1], root)
    lines.append(END)
    if arguments.rows:
        pandas.concat(every).to_csv(arguments.rows, index=False)
    print("\n".join(lines))
    if not arguments.dry:
        write(lines)


if __name__ == "__main__":
    main()
