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
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request

import websocket

NAMES = ["chromium", "chromium-browser", "google-chrome"]
SLOW = 120  # seconds until a step has failed


class Browser:
    """One page of a browser that has no network, by its own protocol."""

    def __init__(self, program, work, page, size=(1400, 1000)):
        flags = [
            "--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync",
            "--disable-component-update", "--host-resolver-rules=MAP * ~NOTFOUND", "--remote-debugging-port=0",
            "--remote-allow-origins=*", f"--user-data-dir={work}/profile", f"--window-size={size[0]},{size[1]}",
            "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
        ]  # fmt: skip
        self.process = subprocess.Popen([program, *flags, page.as_uri()], stderr=subprocess.DEVNULL, start_new_session=True)
        self.count, self.said = 0, []
        port_file = pathlib.Path(work) / "profile" / "DevToolsActivePort"
        port = until(lambda: port_file.is_file() and port_file.read_text().split("\n")[0], "the browser starts")
        targets = until(
            lambda: [t for t in get(f"http://127.0.0.1:{port}/json") if t["type"] == "page"], "the page opens"
        )
        self.socket = websocket.create_connection(targets[0]["webSocketDebuggerUrl"], timeout=SLOW)
        for domain in ("Runtime", "Page", "Network", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method, **given):
        """A command and its result; what the page said in the meantime is kept."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": given}))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("id") == self.count:
                assert "error" not in answer, answer
                return answer["result"]
            self.said.append(answer)

    def value(self, expression):
        """What an expression of JavaScript is."""
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def wait(self, expression, what):
        """Until an expression is true."""
        return until(lambda: self.value(expression), what, lambda: self.value("document.body.innerText")[:3000])

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

    def picture(self, path):
        """A picture of the whole page."""
        height = self.value("document.documentElement.scrollHeight")
        width = self.value("innerWidth")
        clip = {"x": 0, "y": 0, "width": width, "height": min(height, 6000), "scale": 1}
        data = self.call("Page.captureScreenshot", clip=clip, captureBeyondViewport=True)["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(data))

    def close(self):
        """Ends it; what went wrong in the page meanwhile is an error."""
        self.value("1")
        for event in self.said:
            kind, about = event["method"], event["params"]
            assert kind != "Runtime.exceptionThrown", about
            assert kind != "Log.entryAdded" or about["entry"]["level"] != "error", about
            if kind == "Network.requestWillBeSent":
                url = about["request"]["url"]
                assert url.split(":")[0] in ("file", "blob", "data", "about"), f"loads {url}"


def get(url):
    with urllib.request.urlopen(url, timeout=10) as answer:
        return json.load(answer)


def until(is_done, what, state=lambda: ""):
    end = time.monotonic() + SLOW
    while time.monotonic() < end:
        found = is_done()
        if found:
            return found
        time.sleep(0.05)
    sys.exit(f"failed: {what}\n{state()}")


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
        unit = 1e-3 if "_mm" in path else math.radians(1.0) if "_deg" in path else 1.0
        return unit * abs(a - b) / max(1.0, unit * abs(b)) if math.isfinite(a - b) else float(a != b)
    assert a == b, (path, a, b)
    return 0.0


def main():
    page, handeye = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        print("SKIPPED: no chromium to open the page with")
        return
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        work = pathlib.Path(work)
        quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run([handeye, "demo", "--out", work / "demo"], **quiet)
        cell = work / "demo" / "dataset"
        subprocess.run([handeye, "calibrate", cell, "--out", work / "native"], **quiet)
        browser = Browser(program, work, page)
        try:
            look(browser, cell, work, page)
        finally:
            os.killpg(browser.process.pid, signal.SIGKILL)


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
    browser.close()
    megabytes = os.path.getsize(page) / 1e6
    print(f"{page.name} ({megabytes:.1f} MB): a folder dropped without a network, {len(native['captures'])} captures"
          f" in {seconds:.1f} s, off the program's result by {off:.0e}; commands, questions and files work")


if __name__ == "__main__":
    main()
