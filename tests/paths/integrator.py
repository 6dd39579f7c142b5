"""The path of an integrator with a KUKA: a folder of images and a table of the pendant's values, no manifest.

The table is what a German spreadsheet saves: X;Y;Z;A;B;C with decimal commas, Latin-1. `handeye init` asks on a terminal,
here on a pseudo terminal; then check, calibrate, export.
"""

import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import time

import numpy as np
from session import Truth, distance_in_sigmas, found_in, holds, program, run, work

import handeye

COUNT = 14
# what the integrator types at each prompt; a wrong answer to the first question, once
ANSWERS = {
    "setup": ["on the robot", "1"],
    "kind": ["checkerboard"],
    "columns": ["9"],
    "rows": ["6"],
    "square_mm": ["30,0"],
    "notation": ["kuka"],
    "direction": ["base_from_flange"],
    "frame": ["flange"],
}
# what the program may find in the images by itself
FROM_IMAGES = {"kind", "columns", "rows"}
PROMPT = re.compile(r"(\w+) \(such as [^\n]*> $")
SLOW = 30  # seconds until a prompt is missing


def user_folder(cell):
    """Images and a table, as they come from the cell."""
    images = pathlib.Path("cell/bilder")
    images.mkdir(parents=True)
    rows = handeye.poses_to(cell.base_from_flange, "kuka")
    lines = ["Aufnahme;X;Y;Z;A;B;C"]
    for number, (path, row) in enumerate(zip(cell.images, rows), 1):
        shutil.copy(path, images / f"aufnahme_{number}.png")
        lines.append(";".join([str(number), *(f"{value:.3f}".replace(".", ",") for value in row)]))
    text = "\r\n".join(lines) + "\r\n"
    pathlib.Path("cell/Messpunkte_Prüfzelle.csv").write_bytes(text.encode("latin-1"))


def answer_on_terminal(words, answers):
    """Runs the program on a pseudo terminal and types an answer at every prompt; all that the screen showed."""
    left = {key: list(values) for key, values in answers.items()}
    ours, theirs = pty.openpty()
    child = subprocess.Popen([program(), *words], stdin=theirs, stdout=theirs, stderr=theirs, close_fds=True)
    os.close(theirs)
    screen = seen = ""
    while True:
        ready, _, _ = select.select([ours], [], [], SLOW)
        if not ready:
            child.kill()
            print(screen)
            sys.exit(f"FAILED: no prompt in {SLOW} s")
        try:
            part = os.read(ours, 4096)
        except OSError:  # closed by the other side
            part = b""
        if not part:
            break
        screen += part.decode(errors="replace").replace("\r\n", "\n")
        prompt = PROMPT.search(screen[len(seen) :])
        if prompt:
            seen = screen
            typed = left.get(prompt[1], [])
            os.write(ours, ((typed.pop(0) if typed else "") + "\n").encode())
    os.close(ours)
    holds(child.wait() == 0, f"exit code of handeye {' '.join(words)} is 0", screen)
    unasked = [key for key, values in left.items() if values and key not in FROM_IMAGES]
    holds(not unasked, "every answer was asked for that images and table cannot give", f"{screen}\nnot asked: {unasked}")
    return screen


def main():
    start = time.time()
    folder = work()
    run("simulate", "sim", "--captures", COUNT, "--width", 640, "--height", 400, "--touches", 0, "--seed", 4, "--quiet")
    cell = Truth("sim")
    user_folder(cell)

    print("1. calibrate, before there is a manifest")
    _, error = run("calibrate", "cell", expected=1)
    holds("handeye init cell" in error, f"the error names the command to run: {error.strip()}", error)

    print("2. init, answered on a terminal")
    print("$ handeye init cell")
    screen = answer_on_terminal(["init", "cell"], ANSWERS)
    print("\n".join("  | " + line for line in screen.splitlines()))
    holds("on the robot is none of these" in screen, "a wrong answer is reported, and asked for again", screen)
    holds("next: handeye check cell" in screen, "the next command is named", screen)
    manifest = pathlib.Path("cell/handeye.toml").read_text()
    holds("# QUESTION" not in manifest, "no question is left open in the manifest", manifest)
    for line in ['setup = "eye-in-hand"', "columns = 9", "rows = 6", "square_mm = 30.0", 'notation = "kuka"', 'length_unit = "mm"']:
        holds(line in manifest, f"the manifest has {line}", manifest)

    print("3. check")
    out, errors = run("check", "cell")
    holds(f"{COUNT} agree" in out, f"check agrees: all {COUNT} captures fit", out + errors)

    print("4. calibrate")
    out, errors = run("calibrate", "cell", "--out", "result")
    print("\n".join("  | " + line for line in out.splitlines()[:12]))
    result, found = found_in("result")
    holds(out.strip().startswith("ACCEPTED"), "accepted", out + errors)
    holds(f"{COUNT} of {COUNT} captures used" in out, "all captures are used", out)
    report = pathlib.Path("result/report.html")
    holds(report.stat().st_size > 10_000 and "ACCEPTED" in report.read_text().upper(), f"{report} has the verdict")
    mm, degrees = cell.off(found)
    far = distance_in_sigmas(result, cell)
    # 99.9 % of 6 degrees of freedom
    holds(far < 4.74, f"off the truth by {mm:.3f} mm, {degrees:.4f} degrees: {far:.1f} sigma of the stated covariance")
    limit = result["predicted_tre_mm"]["p95"]
    worst = float(np.percentile(cell.off_at_board_mm(found), 95))
    holds(worst < limit, f"95 % of the board's corners are off by less than {worst:.2f} mm; predicted {limit:.2f} mm")

    print("5. export for the controller")
    out, _ = run("export", "result", "--format", "kuka")
    numbers = dict(re.findall(r"([xyzABC]) (-?[\d.]+)", out.splitlines()[-1]))
    exported = handeye.poses_from([[float(numbers[k]) for k in "xyzABC"]], "kuka")[0]
    apart = np.abs(exported.matrix - found.matrix).max()
    holds(apart < 1e-6, f"the same transform: {out.splitlines()[-1]}", out)
    print(f"path of an integrator: {time.time() - start:.0f} s")
    del folder


if __name__ == "__main__":
    main()
