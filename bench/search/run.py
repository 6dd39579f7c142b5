"""Search without an initial guess: `handeye register --global` beside Open3D (FPFH, RANSAC, point-to-plane ICP).

    pip install -r bench/search/requirements.txt
    cargo build --release -p handeye-cli
    python bench/search/run.py                        1000 scenes: writes its section of BENCHMARK.md
    python bench/search/run.py --seeds 0 2 --dry      80 scenes, prints only
    python bench/search/run.py --compared 25          the peer on all of them, and not on the first 80 alone: two hours more
    python bench/search/run.py --folder DIR           keeps the scenes there
    python bench/search/run.py --rows rows.json       keeps what each scene gave

Forty kinds of parts; a scene is a scan of one of them from one side and the part itself, as files. The run takes half
an hour of two processors, ten minutes of it for the peer.
"""

import os

# before the libraries that read it
os.environ["OMP_NUM_THREADS"] = "1"

import argparse
import collections
import importlib.metadata
import json
import multiprocessing
import pathlib
import resource
import subprocess
import tempfile
import time

import numpy as np
import open3d
import parts
import scenes
import trimesh

open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BENCHMARK = ROOT / "BENCHMARK.md"
PROGRAM = ROOT / "target/release/handeye"
# an answer is right within, degrees and mm on average over the part
RIGHT = (0.3, 0.5)
# the peer's voxel, as a share of the part's radius, and what its tutorial takes of it
VOXEL = 0.05
OUTCOMES = ["right", "listed", "refused", "wrong"]
SETTING = """{count} scenes, {seeds}: 40 kinds of parts (machined, sheet metal, castings, nearly symmetric, symmetric,
flat) with dimensions drawn at random, 40 to 150 mm long. Of each a scan from one side by ray casting: 0.1 mm of noise
along the ray, points 0.35 to 0.6 mm apart, surfaces beyond 81 degrees of slant missing; half of the scenes show the
part alone, a quarter on a table, a quarter in a bin with others around and above it. Of eight scenes one shows another
part: there the only right answer is none. Scans come as PLY, as NPY in rows and columns, and as PCD in a frame that is
not the camera's; parts as STL in mm or as a cloud; either is the source.

*Right*: accepted, within 0.3 degrees and 0.5 mm on average over the part, of a place where the part is, up to the
part's own symmetry. *Listed*: undetermined, because several places are equally good (they are listed), or because a
motion is free (it is named), or its position is determined too poorly, and the answer or one of the places is right to the same limits. *Wrong*: accepted and not right, also where the part is not there. Open3D has no verdict: whatever is not
right is wrong, and scenes without the part are not counted for it. It runs its tutorial's settings (voxel {voxel:.0f} %
of the part's radius, normals of 2, FPFH of 5 voxels, RANSAC 100000 with edge length 0.9 and distance 1.5, ICP on all points
within 0.4 voxels). Processor time: of handeye the whole process with reading, of Open3D without reading."""


def handeye(files, program):
    """Its answer, and the processor time of the whole process, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "register", *files, "--global", "--json"], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (json.loads(done.stdout) if done.returncode in (0, 3) else {"verdict": "failed", "reasons": [done.stderr]}), spent


def matrix(pose):
    """4 x 4 in mm."""
    x, y, z, w = pose["rotation_xyzw"]
    found = trimesh.transformations.quaternion_matrix([w, x, y, z])
    found[:3, 3] = 1e3 * np.array(pose["translation_m"])
    return found


def is_right(error):
    return error[0] <= RIGHT[0] and error[1] <= RIGHT[1]


def judged(scene, answer):
    """Which outcome it is, and the error of the first place."""
    if "target_from_source" not in answer:
        return "refused", None
    error = scene.error(matrix(answer["target_from_source"]))
    if answer["verdict"] == "accepted":
        return ("right" if is_right(error) else "wrong"), error
    # what is free, or the equally good places, are named: one of the poses given must be right
    given = [answer, *(answer.get("places") or [])] if answer["verdict"] == "undetermined" else []
    if any(is_right(scene.error(matrix(place["target_from_source"]))) for place in given):
        return "listed", error
    return "refused", error


def peer(scene, share):
    """Open3D's target_from_source, and its processor time, s."""
    registration, vectors = open3d.pipelines.registration, open3d.utility.Vector3dVector
    voxel = share * scene.radius
    mesh = scene.part.copy()
    mesh.apply_transform(scene.part_from_centre)
    mesh = open3d.geometry.TriangleMesh(vectors(mesh.vertices), open3d.utility.Vector3iVector(mesh.faces))
    scan, cloud = open3d.geometry.PointCloud(vectors(scene.seen())), open3d.geometry.PointCloud(vectors(scene.cloud()))
    open3d.utility.random.seed(scene.seed)
    began = time.process_time()
    if scene.part_format == "stl":
        cloud = mesh.sample_points_uniformly(scenes.POINTS)
    clouds = (scan, cloud) if scene.scan_is_source else (cloud, scan)
    few, features = [], []
    for points in clouds:
        down = points.voxel_down_sample(voxel)
        down.estimate_normals(open3d.geometry.KDTreeSearchParamHybrid(2 * voxel, 30))
        few.append(down)
        features.append(registration.compute_fpfh_feature(down, open3d.geometry.KDTreeSearchParamHybrid(5 * voxel, 100)))
    within = 1.5 * voxel
    start = registration.registration_ransac_based_on_feature_matching(
        *few, *features, True, within, registration.TransformationEstimationPointToPoint(False), 3,
        [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9), registration.CorrespondenceCheckerBasedOnDistance(within)],
        registration.RANSACConvergenceCriteria(100_000, 0.999))
    clouds[1].estimate_normals(open3d.geometry.KDTreeSearchParamHybrid(2 * voxel, 30))
    found = registration.registration_icp(
        *clouds, 0.4 * voxel, start.transformation, registration.TransformationEstimationPointToPlane())
    return np.array(found.transformation), time.process_time() - began


def run(job):
    kind, seed, options = job
    scene = scenes.Scene(kind, seed)
    with tempfile.TemporaryDirectory() as passing:
        folder = options.folder or pathlib.Path(passing)
        files = scene.write(folder)
        answer, spent = handeye(files, options.program)
    outcome, error = judged(scene, answer)
    row = {"name": scene.name, "kind": kind, "seed": seed, "family": scene.family, "setting": scene.setting, "absent": scene.absent,
           "formats": [file.suffix[1:] for file in files], "scan_is_source": scene.scan_is_source, "outcome": outcome,
           "error": error, "s": spent, "verdict": answer["verdict"], "reasons": answer["reasons"],
           "sizes": {key: answer.get(key) for key in ("inlier_fraction", "agreement", "rms_mm", "explained", "sigma_mm", "sigma_deg", "seconds")},
           "places": len(answer.get("places") or [])}
    if seed < options.seeds[0] + options.compared and not scene.absent:
        found, row["peer_s"] = peer(scene, options.voxel)
        row["peer_error"] = scene.error(found)
        row["peer"] = "right" if is_right(row["peer_error"]) else "wrong"
    return row


# --- tables -------------------------------------------------------------------------------------


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows), ""]


def counted(name, rows, is_compared):
    there = [row for row in rows if not row["absent"]]
    outcomes = collections.Counter(row["outcome"] for row in there)
    absent = collections.Counter(row["outcome"] for row in rows if row["absent"])
    wrong = outcomes["wrong"] + absent["wrong"]
    cells = [name, str(len(there)), str(outcomes["right"]), str(outcomes["listed"]), str(outcomes["refused"]),
             f"{absent['refused'] + absent['listed']} of {sum(absent.values())}", f"**{wrong}**" if wrong else "0",
             f"{np.mean([row['s'] for row in rows]):.2f}"]
    both = [row for row in there if "peer" in row]
    if both:
        own = collections.Counter(row["outcome"] for row in both)
        right = sum(row["peer"] == "right" for row in both)
        cells += [f"{own['right']} + {own['listed']} of {len(both)}", f"{np.mean([row['s'] for row in both]):.2f}",
                  f"{right} of {len(both)}", f"{np.mean([row['peer_s'] for row in both]):.2f}"]
    elif is_compared:
        cells += ["", "", "", ""]
    return cells


def groups(rows):
    yield from ((family, [r for r in rows if r["family"] == family]) for family in parts.FAMILIES)
    yield from ((setting, [r for r in rows if r["setting"] == setting]) for setting in dict.fromkeys(scenes.SETTINGS))
    for told, source in (("scan to part", True), ("part to scan", False)):
        yield told, [r for r in rows if r["scan_is_source"] == source]
    for form in scenes.SCANS:
        yield f"scan as {form.upper()}", [r for r in rows if r["formats"][0 if r["scan_is_source"] else 1] == form]
    for told, forms in (("part as STL", ["stl"]), ("part as a cloud", ["ply", "pcd"])):
        yield told, [r for r in rows if r["formats"][1 if r["scan_is_source"] else 0] in forms]
    yield "**all**", rows


def lines(rows, options):
    head = ["scenes", "with the part", "right", "listed", "refused", "refused without it", "wrong", "s"]
    is_compared = any("peer" in row for row in rows)
    if is_compared:
        head += ["beside Open3D: right + listed", "s", "Open3D right", "s"]
    seeds = "seeds {} to {}".format(options.seeds[0], options.seeds[1] - 1)
    setting = SETTING.format(count=len(rows), seeds=seeds, voxel=100 * options.voxel)
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("open3d", "trimesh", "manifold3d"))
    return ["## Search without an initial guess", "", *setting.splitlines(), "", f"Written by `bench/search/run.py` with {versions}.", "",
            *table(head, [counted(name, some, is_compared) for name, some in groups(rows) if some])]


def write_section(lines):
    begin, end = "<!-- search:begin -->", "<!-- search:end -->"
    text = BENCHMARK.read_text()
    if begin not in text:
        text += f"\n{begin}\n{end}\n"
    block = "\n".join([begin, *lines, end])
    BENCHMARK.write_text(text[:text.index(begin)] + block + text[text.index(end) + len(end):])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, nargs=2, default=(100, 125), metavar=("FIRST", "END"), help="of each kind")
    parser.add_argument("--kinds", type=int, nargs="*", default=range(len(parts.KINDS)), help="these alone")
    parser.add_argument("--program", default=str(PROGRAM), help="of handeye")
    parser.add_argument("--voxel", type=float, default=VOXEL, help="of the peer, as a share of the part's radius")
    parser.add_argument("--compared", type=int, default=2, help="seeds of each kind at which the peer runs as well")
    parser.add_argument("--folder", type=pathlib.Path, help="keep the scenes there")
    parser.add_argument("--rows", type=pathlib.Path, help="keep the rows there")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--dry", action="store_true", help="print only")
    options = parser.parse_args()
    if options.folder:
        options.folder.mkdir(parents=True, exist_ok=True)
    jobs = [(kind, seed, options) for seed in range(*options.seeds) for kind in options.kinds]
    with multiprocessing.Pool(options.workers) as pool:
        rows = list(pool.imap(run, jobs))
    if options.rows:
        options.rows.write_text(json.dumps(rows))
    told = lines(rows, options)
    print("\n".join(told))
    if not options.dry:
        write_section(told)


if __name__ == "__main__":
    main()
