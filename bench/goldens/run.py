"""What `handeye` answers today: transforms, covariances, verdicts and codes of some 600 runs, kept in goldens.json.

    cargo build --release -p handeye-cli
    python bench/goldens/run.py              compares with what is kept; exit code 1 where an answer differs
    python bench/goldens/run.py --write      keeps what it answers now
    python bench/goldens/run.py --only solve register

Needs nothing but Python. A refactoring must leave all of it as it is: numbers within 1e-9 of the largest of their kind,
verdicts, codes and captures the same. Measured sets are compared where the folder of the data is there.
"""

import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import sessions
import solving
import surfaces

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
KEPT = HERE / "goldens.json"
PROGRAM = ROOT / "target/release/handeye"
DATA = pathlib.Path(os.environ.get("HANDEYE_DATA", ROOT.parent / "shared/data"))
REAL = ROOT / "crates/handeye-cli/tests/real"
TOLERANCE = 1e-9
SPOILT, CELLS, MISREAD = 150, 92, 64


def answered(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--json", "-q"], capture_output=True, text=True)
    try:
        return done.returncode, json.loads(done.stdout)
    except json.JSONDecodeError:
        raise SystemExit(f"{' '.join(map(str, arguments))}: no JSON, exit code {done.returncode}: {done.stderr}") from None


def rounded(value):
    if isinstance(value, float):
        return float(f"{value:.13g}") if math.isfinite(value) else None
    if isinstance(value, list):
        return [rounded(v) for v in value]
    if isinstance(value, dict):
        return {key: rounded(v) for key, v in value.items()}
    return value


def codes(some):
    return sorted(entry["code"] for entry in some or [])


def pose(some):
    return [*some["translation_m"], *some["rotation_xyzw"]] if some else None


def triangle(matrix):
    return [matrix[i][j] for i in range(len(matrix)) for j in range(i + 1)] if matrix else None


def hand_eye(found):
    if not found:
        return None
    covariance = found.get("covariance") or {}
    names = ("mount_from_camera", "anchor_from_target")
    return {name: {"pose": pose(found.get(name)), "covariance": triangle(covariance.get(name))} for name in names}


def failed(code, answer):
    return {"exit": code, "error": answer.get("error", {}).get("code")}


def calibrated(code, answer):
    if "verdict" not in answer:
        return failed(code, answer)
    used = [capture["id"] for capture in answer["captures"] if not capture["used"]]
    kept = ("verdict", "chosen", "predicted_tre_mm", "residual", "held_out", "time_offset_s", "scale", "target_scale")
    made = {key: answer.get(key) for key in kept}
    for key in ("predicted_tre_mm", "target_scale"):
        if isinstance(made[key], dict):
            made[key] = {k: v for k, v in made[key].items() if isinstance(v, (int, float))}
    return {"exit": code, **made, "hand_eye": hand_eye(answer["hand_eye"]), "not_used": used, "undetermined": len(answer["undetermined"]),
            "candidates": [c["name"] for c in answer["candidates"]], "warnings": codes(answer["warnings"]),
            "findings": codes(answer.get("findings"))}


def checked(code, answer):
    if "ok" not in answer:
        return failed(code, answer)
    declared = answer["declared"] or {}
    return {"exit": code, "ok": answer["ok"], "declared": {k: v for k, v in declared.items() if isinstance(v, (int, float))},
            "explanations": [[e.get("code"), e.get("change")] for e in answer["explanations"]], "warnings": codes(answer["warnings"])}


def registered(code, answer):
    if "verdict" not in answer:
        return failed(code, answer)
    kept = ("verdict", "stop", "iterations", "inlier_fraction", "agreement", "rms_mm", "size_ratio", "explained")
    return {"exit": code, **{key: answer[key] for key in kept}, "pose": pose(answer["target_from_source"]),
            "covariance": triangle(answer["covariance"]), "undetermined": len(answer["undetermined"]),
            "places": [pose(place["target_from_source"]) for place in answer["places"]], "warnings": codes(answer["warnings"])}


def solved(code, answer):
    if "hand_eye" not in answer:
        return failed(code, answer)
    kept = ("verdict", "method", "time_offset_s", "time_offset_sigma_s", "scale")
    return {"exit": code, **{key: answer.get(key) for key in kept}, "hand_eye": hand_eye(answer["hand_eye"]),
            "undetermined": len(answer.get("undetermined") or []), "warnings": codes(answer["warnings"])}


def digest(folder):
    """Of all files that were made."""
    total = hashlib.sha256()
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        total.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return total.hexdigest()[:16]


class Suite:
    """Cases by name; each is a function of the program and an empty folder."""

    def __init__(self):
        self.cases = {}

    def sessions(self):
        def made(maker, seed):
            def case(program, folder):
                folder = folder / "cell"
                maker(program, folder, seed)
                of_input = digest(folder)
                return {"input": of_input, "calibrate": calibrated(*answered(program, "calibrate", folder)),
                        "check": checked(*answered(program, "check", folder))}

            return case

        for group, maker, names, count in (("spoilt", sessions.spoilt, sessions.SPOILT, SPOILT),
                                           ("cell", sessions.cell, sessions.CELLS, CELLS),
                                           ("misread", sessions.misread, sessions.MISREAD, MISREAD)):
            for seed in range(count):
                self.cases[f"{group}/{list(names)[seed % len(names)]}-{seed}"] = made(maker, seed)

    def solve(self):
        def made(kind, seed):
            def case(program, folder):
                options = solving.write(folder / "pairs.json", kind, seed)
                return {"input": digest(folder), **solved(*answered(program, "solve", folder / "pairs.json", *options))}

            return case

        for name, kind, seed in solving.cases():
            self.cases[f"solve/{name}"] = made(kind, seed)

    def register(self):
        def made(maker):
            def case(program, folder):
                arguments = maker(folder)
                return {"input": digest(folder), **registered(*answered(program, "register", *arguments))}

            return case

        for name, maker in surfaces.cases():
            self.cases[f"register/{name}"] = made(maker)

    def demo(self):
        self.cases["demo/demo"] = lambda program, folder: calibrated(*answered(program, "demo", "--out", folder / "demo"))

    def real(self):
        def made(manifest):
            def case(program, _):
                there = (manifest, "--root", DATA)
                return {"calibrate": calibrated(*answered(program, "calibrate", *there)),
                        "check": checked(*answered(program, "check", *there))}

            return case

        if not DATA.is_dir():
            print(f"measured sets are skipped: there is no {DATA}", file=sys.stderr)
            return
        for manifest in sorted(REAL.glob("*.toml")):
            self.cases[f"real/{manifest.stem}"] = made(manifest)


def run(job):
    name, case, program = job
    with tempfile.TemporaryDirectory() as folder:
        return name, rounded(case(program, pathlib.Path(folder)))


def differences(path, old, new):
    """What differs, as lines; numbers of one list are compared with the largest of them."""
    if isinstance(old, dict) and isinstance(new, dict):
        keys = [*old, *(key for key in new if key not in old)]
        return [line for key in keys for line in differences(f"{path}.{key}", old.get(key), new.get(key))]
    if is_numbers(old) and is_numbers(new) and len(old) == len(new):
        most = max((abs(x) for x in old), default=0.0)
        off = max((abs(x - y) for x, y in zip(old, new)), default=0.0)
        return [f"{path}: {off / most if most else off:.1e} of the largest"] if off > TOLERANCE * max(most, 1e-12) else []
    if is_number(old) and is_number(new):
        return [f"{path}: {old} -> {new}"] if abs(old - new) > TOLERANCE * max(abs(old), 1e-6) else []
    return [f"{path}: {old} -> {new}"] if old != new else []


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def is_numbers(value):
    return isinstance(value, list) and len(value) > 0 and all(is_number(x) for x in value)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", action="store_true", help="keep what it answers now")
    parser.add_argument("--program", type=pathlib.Path, default=PROGRAM)
    parser.add_argument("--only", nargs="*", default=[], help="names begin so: solve, real/tabb ...")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args()
    suite = Suite()
    for add in (suite.demo, suite.real, suite.sessions, suite.solve, suite.register):
        add()
    chosen = {name: case for name, case in suite.cases.items() if not options.only or any(name.startswith(o) for o in options.only)}
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        found = dict(pool.map(run, [(name, case, options.program) for name, case in chosen.items()]))
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    if options.write:
        kept = {**({name: case for name, case in kept.items() if name not in found} if options.only else {}), **found}
        lines = [f"{json.dumps(name)}: {json.dumps(case, separators=(',', ':'))}" for name, case in sorted(kept.items())]
        KEPT.write_text("{\n" + ",\n".join(lines) + "\n}\n")
        print(f"{len(found)} answers kept")
        return 0
    different = 0
    for name, answer in found.items():
        lines = differences(name, kept[name], answer) if name in kept else [f"{name}: not kept"]
        different += bool(lines)
        print("".join(f"{line}\n" for line in lines[:12]), end="")
    print(f"{len(found)} answers, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
