"""Drops folders into the page for the browser, without a network, and compares with the program.

web_page.py PAGE.html HANDEYE [picture for a look at it]

A demo folder gives the same result as the program; one without a manifest is asked about, answered and calibrated; other
commands run; files come out. Nothing is loaded from elsewhere, and no script fails.
"""

import base64
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

import devtools


class Page(devtools.Browser):
    """The page, as a person uses it, and its disk."""

    def drop(self, folder):
        """Drops a folder on the page."""
        data = {"items": [], "files": [str(folder)], "dragOperationsMask": 1}
        for kind in ("dragEnter", "dragOver", "drop"):
            self.call("Input.dispatchDragEvent", type=kind, x=400, y=250, data=data)

    def read(self, path):
        """The bytes of a file on the page's disk."""
        code = f"""ask("read", {{ path: {json.dumps(path)} }}).then((bytes) => {{
            let all = ""; for (const b of bytes) all += String.fromCharCode(b); return btoa(all); }})"""
        return base64.b64decode(self.value(code))


def same(a, b, path=""):
    """The largest difference of two results' numbers; all else is equal."""
    if isinstance(a, dict):
        assert a.keys() == b.keys(), path
        return max((same(a[k], b[k], f"{path}/{k}") for k in a if k not in ("run_id", "created")), default=0.0)
    if isinstance(a, list):
        assert len(a) == len(b), path
        return max((same(x, y, f"{path}/{k}") for k, (x, y) in enumerate(zip(a, b))), default=0.0)
    if isinstance(a, float) and isinstance(b, float):
        # in metres and radians; of large numbers, such as a condition, the part that is off
        # a probability is of differences of micrometres: what those are off, it is a thousand times
        unit = 1e-3 if "_mm" in path or path.endswith("/chance") else math.radians(1.0) if "_deg" in path else 1.0
        return unit * abs(a - b) / max(1.0, unit * abs(b)) if math.isfinite(a - b) else float(a != b)
    assert a == b, (path, a, b)
    return 0.0


def main():
    page, handeye = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    if devtools.program() is None:
        print("SKIPPED: no chromium to open the page with")
        return
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        work = pathlib.Path(work)
        quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run([handeye, "demo", "--out", work / "demo"], **quiet)
        cell = work / "demo" / "dataset"
        subprocess.run([handeye, "calibrate", cell, "--out", work / "native"], **quiet)
        with Page(work, page.as_uri()) as browser:
            look(browser, cell, work, page)


def look(browser, cell, work, page):
    """Uses the page as a person would."""
    native = json.loads((work / "native" / "calibration.json").read_text())
    browser.wait("!!document.querySelector('#format option') && !document.querySelector('#choose').disabled", "it loads")
    began = time.monotonic()
    browser.drop(cell)
    browser.wait("!document.querySelector('#report').hidden", "the demo folder is calibrated")
    seconds = time.monotonic() - began
    off = same(json.loads(browser.read("dataset-result/calibration.json")), native)
    assert off < 1e-9, f"another result than that of the program: {off:.1e}"
    inside = "document.querySelector('#report').contentDocument"
    browser.wait(f"!!({inside} && {inside}.querySelector('.verdict .word'))", "the report is shown")
    word = browser.value(f"{inside}.querySelector('.verdict .word').textContent")
    assert word.lower() == native["verdict"], word
    if len(sys.argv) > 3:
        time.sleep(1.0)
        browser.picture(sys.argv[3])
    # another command, and a file out of it
    browser.value("command('export dataset-result --format kuka --out exported')")
    assert b"A " in browser.read("exported/base_from_camera_kuka.txt")
    browser.value("command('check dataset')")
    assert "No mistake found" in browser.value("document.querySelector('#output').textContent")
    # without a manifest: a proposal, its questions, a refusal, and answers
    bare = work / "bare"
    shutil.copytree(cell, bare, ignore=shutil.ignore_patterns("handeye.toml", "truth.json", "touches.csv", "place-*"))
    browser.drop(bare)
    browser.wait("document.querySelectorAll('#questions li').length > 2", "questions are asked")
    browser.value("document.querySelector('#setup').value = 'eye-to-hand'; document.querySelector('#setup').onchange()")
    browser.wait("document.querySelector('#text').value.includes('setup = \"eye-to-hand\"')", "an answer is taken")
    browser.wait("!document.querySelector('#calibrate').disabled", "it is ready again")
    browser.value("document.querySelector('#calibrate').click()")
    browser.wait("!document.querySelector('#trouble').hidden", "open questions are refused")
    answered = (cell / "handeye.toml").read_text().split("[[placements]]")[0]
    browser.value(f"document.querySelector('#text').value = {json.dumps(answered)}")
    browser.wait("!document.querySelector('#calibrate').disabled", "it is ready again")
    browser.value("document.querySelector('#calibrate').click()")
    browser.wait("!document.querySelector('#report').hidden", "answered, it is calibrated")
    assert json.loads(browser.read("bare-result/calibration.json"))["hand_eye"]["mount_from_camera"]
    assert not list(browser.troubles()), list(browser.troubles())
    megabytes = os.path.getsize(page) / 1e6
    print(f"{page.name} ({megabytes:.1f} MB): a folder dropped without a network, {len(native['captures'])} captures"
          f" in {seconds:.1f} s, off the program's result by {off:.0e}; commands, questions and files work")


if __name__ == "__main__":
    main()
