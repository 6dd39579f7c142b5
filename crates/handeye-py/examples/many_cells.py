"""Calibrates many recorded cells, on as many machines as there are: folders in, one table out.

    python many_cells.py                                      six cells that it makes up
    python many_cells.py TABLE.csv FOLDER...                  workers on this machine
    python many_cells.py TABLE.csv FOLDER... --scheduler tcp://host:8786

The engine is Dask (pip install "dask[distributed]"); a worker that dies is replaced, and its folders are done again. Each
row is written when its folder is done: run again, only the folders that are missing from the table are calibrated. A
folder that cannot be used is a row with its error.

The same without Python, by GNU parallel, restartable by its log:

    parallel --joblog done.log --resume 'handeye calibrate {} --oneline' ::: cells/* > table.txt
"""

import argparse
import csv
import os
import pathlib

COLUMNS = ["folder", "verdict", "x_mm", "y_mm", "z_mm", "qx", "qy", "qz", "qw", "p95_mm", "used", "captures", "reason"]


def row_of(folder: str) -> dict:
    """What is known of one folder afterwards; never an exception."""
    import handeye  # on the worker

    row = {"folder": folder}
    try:
        found = handeye.calibrate(folder)
    except handeye.HandEyeError as error:
        return {**row, "verdict": "error", "reason": str(error)}
    row.update(verdict=found.verdict, reason=found.reasons[0] if found.reasons else "")
    row.update(used=sum(c["used"] for c in found.captures), captures=len(found.captures))
    if found.mount_from_camera is not None:
        x, y, z = (1e3 * found.mount_from_camera.translation).tolist()
        row.update(x_mm=x, y_mm=y, z_mm=z)
        row.update(zip(("qx", "qy", "qz", "qw"), found.mount_from_camera.quaternion_xyzw.tolist()))
    if found.predicted_tre_mm is not None:
        row["p95_mm"] = found.predicted_tre_mm["p95"]
    return row


def done_before(table: pathlib.Path) -> set:
    """Folders that the table has; a line that was cut short by a crash is taken off."""
    if not table.is_file():
        return set()
    text = table.read_text()
    if not text.endswith("\n"):
        table.write_text(text[: text.rfind("\n") + 1])
    with table.open(newline="") as file:
        return {row["folder"] for row in csv.DictReader(file)}


def run(table: pathlib.Path, folders: list, client) -> int:
    """Calibrates what the table lacks, and returns how many that were."""
    from dask.distributed import as_completed

    done = done_before(table)
    left = [folder for folder in folders if folder not in done]
    # pure: the same folder twice is one piece of work; a worker that dies under it is not blamed at once
    futures = client.map(row_of, left, pure=True, retries=3)
    with table.open("a", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        if file.tell() == 0:
            writer.writeheader()
        for future, row in as_completed(futures, with_results=True, raise_errors=False):
            if not isinstance(row, dict):
                folder = left[futures.index(future)]
                row = {"folder": folder, "verdict": "error", "reason": f"the worker failed: {row!r}"}
            writer.writerow(row)
            file.flush()
            os.fsync(file.fileno())
    return len(left)


def made_up() -> list:
    """Simulated cells, one of which has another board than its manifest says."""
    import handeye

    folders = [f"cells/{k}" for k in range(1, 7)]
    for k, folder in enumerate(folders):
        handeye.simulate(folder, captures=10, images=False, seed=k + 1, force=True)
    manifest = pathlib.Path(folders[2]) / "handeye.toml"
    manifest.write_text(manifest.read_text().replace("square_mm = 30", "square_mm = 33"))
    return folders


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("table", type=pathlib.Path, nargs="?", default=pathlib.Path("table.csv"))
    parser.add_argument("folders", nargs="*")
    parser.add_argument("--scheduler", help="address of a running scheduler [default: workers on this machine]")
    given = parser.parse_args()
    folders = given.folders or made_up()
    from dask.distributed import Client

    with Client(given.scheduler) if given.scheduler else Client(threads_per_worker=1, dashboard_address=None) as client:
        count = run(given.table, folders, client)
    print(f"{count} calibrated, {len(folders) - count} were in {given.table} before")


if __name__ == "__main__":
    main()
