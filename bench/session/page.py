"""How fast the page is while a camera streams, and whether memory grows: the whole program, its page open in a browser.

    pip install websocket-client opencv-python-headless
    python bench/session/page.py PROGRAM IMAGES [BENCHMARK.md]

Images of a simulated cell are sent by HTTP, of 2.3 MP at 10 Hz for 20 s, and the images that the page has drawn are counted.
Then IMAGES of 640 x 480 are sent as fast as they are taken, the memory of the program, of the page's scripts and of the page's process is printed on the way (somebody looks
at the page for the last twentieth of each tenth), and once more images come at 10 Hz. Writes its section of BENCHMARK.md.
"""

import contextlib
import http.client
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import cv2

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "tests"))
import devtools  # noqa: E402

NO_OTHER_HOST = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"
# counts what is drawn into the page's picture, once per image; while nobody looks, the page draws none
COUNTER = """window.drawn = 0;
window.away = false;
Object.defineProperty(document, "hidden", { get: () => window.away });
const bitmap = window.createImageBitmap;
window.createImageBitmap = async (...all) => { const image = await bitmap(...all);
    requestAnimationFrame(() => { window.drawn += 1; }); return image; };"""


class Camera:
    """Sends images of which no two have the same bytes."""

    def __init__(self, address, folder):
        url, token = address.split("?token=")
        self.connection = http.client.HTTPConnection(url.split("/")[2], timeout=60)
        self.headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/octet-stream"}
        read = (cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted(folder.iterdir()))
        self.images = [bytearray(cv2.imencode(".bmp", image)[1].tobytes()) for image in read]
        self.count = 0

    def send(self):
        image = self.images[self.count // 20 % len(self.images)]
        image[-8:] = self.count.to_bytes(8, "little")
        self.count += 1
        self.post("/api/image", bytes(image))

    def post(self, path, body):
        self.connection.request("POST", path, body, self.headers)
        answer = self.connection.getresponse()
        text = answer.read().decode()
        assert answer.status < 300, (answer.status, text)

    def command(self, **do):
        self.connection.request("POST", "/api/do", json.dumps(do), {**self.headers, "Content-Type": "application/json"})
        answer = self.connection.getresponse()
        text = answer.read().decode()
        assert answer.status < 300, (do, answer.status, text)


def resident_mb(pid):
    line = next(line for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines() if line.startswith("VmRSS"))
    return int(line.split()[1]) / 1024


def main():
    program, images = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
    with opened(program, 1920, 1200) as (page, camera, pid):
        large = measure(page, camera, pid).replace("the page", "of 1920 x 1200 the page")
    with opened(program, 640, 480) as (page, camera, pid):
        first, last = soak(page, camera, pid, images)
        after = measure(page, camera, pid)
    text = (
        f"## The page of a session\n\n`bench/session/page.py`: the whole program, its page open in a browser that draws without a "
        f"graphics card. {large}\n\n{images} images of 640 x 480 (at 5 Hz those of {images / 18000:.1f} hours), sent as fast as they "
        f"are taken: memory of the program {first[0]:.0f} MB after the first tenth and {last[0]:.0f} MB after all, of the page's scripts "
        f"{first[1]:.1f} and {last[1]:.1f} MB, of the page's process {first[2]:.0f} and {last[2]:.0f} MB. {after}"
    )
    if len(sys.argv) > 3:
        write_section(pathlib.Path(sys.argv[3]), text)


def write_section(file, text):
    begin, end = "<!-- session-page:begin -->", "<!-- session-page:end -->"
    before = file.read_text()
    section = f"{begin}\n{text}\n{end}"
    if begin in before:
        file.write_text(before[: before.index(begin)] + section + before[before.index(end) + len(end) :])
    else:
        file.write_text(f"{before.rstrip()}\n\n{section}\n")


@contextlib.contextmanager
def opened(program, width, height):
    """A session of uploads at the step of the captures, and its page."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        cell, folder = pathlib.Path(work) / "cell", pathlib.Path(work) / "session"
        simulate = [program, "simulate", cell, "--captures", "6", "--width", str(width), "--height", str(height), "--quiet"]
        subprocess.run(simulate, check=True, stdout=subprocess.DEVNULL)
        command = [program, "session", folder, "--upload", "--target", cell / "handeye.toml", "--no-open"]
        session = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        try:
            address = next(line.split()[1] for line in session.stdout if line.startswith("session: "))
            camera = Camera(address, cell / "images")
            with devtools.Browser(work, more=(NO_OTHER_HOST,)) as page:
                page.call("Page.addScriptToEvaluateOnNewDocument", source=COUNTER)
                page.call("Page.navigate", url=address)
                page.wait("document.body?.dataset.step == 'cell'", "the page opens")
                # the log of its tools would hold every answer
                page.call("Network.disable")
                camera.command(do="confirm", step="cell")
                camera.send()
                camera.command(do="confirm", step="camera")
                camera.command(do="pose", text="0.4 0.1 0.5 3.1 0.1 0.2")
                camera.command(do="confirm", step="robot")
                time.sleep(2)
                camera.command(do="confirm", step="board")
                page.wait("document.body.dataset.step == 'capture'", "the step capture")
                yield page, camera, session.pid
        finally:
            session.terminate()
            session.wait()


def soak(page, camera, pid, images):
    """Sends them all; what program and page held after the first tenth, and after all, MB."""
    tenth, held, begin = max(1, images // 10), [], time.monotonic()
    for k in range(1, images + 1):
        if k % 20 == 0:
            page.value(f"window.away = {str(k % tenth < 0.95 * tenth).lower()}")
            page.events.clear()
        camera.send()
        if k % tenth == 0:
            held.append(memory_mb(page, pid))
            print(f"{k} images, {time.monotonic() - begin:.0f} s: program {held[-1][0]:.0f} MB, page {held[-1][1]:.1f} of {held[-1][2]:.0f} MB, "
                  f"{page.value('drawn')} drawn", flush=True)
    page.value("window.away = false")
    return held[0], held[-1]


def memory_mb(page, pid):
    page.call("HeapProfiler.collectGarbage")
    return resident_mb(pid), page.call("Runtime.getHeapUsage")["usedSize"] / 2**20, max(map(resident_mb, renderers(page)))


def renderers(page):
    """The browser's processes that show pages; the one that holds most is the page's."""
    for folder in pathlib.Path("/proc").iterdir():
        with contextlib.suppress(OSError, ValueError):
            if os.getpgid(int(folder.name)) == page.process.pid and b"--type=renderer" in (folder / "cmdline").read_bytes():
                yield int(folder.name)


def measure(page, camera, pid, hertz=10, seconds=20):
    """Images at this rate for so long; what the page drew, in a sentence."""
    camera.send()
    time.sleep(1)
    before, begin = page.value("drawn"), time.monotonic()
    cpu = pathlib.Path(f"/proc/{pid}/stat").read_text().split()
    sent = 0
    while (now := time.monotonic() - begin) < seconds:
        due = sent / hertz
        if now < due:
            time.sleep(due - now)
        camera.send()
        sent += 1
    elapsed = time.monotonic() - begin
    time.sleep(0.3)
    drawn = page.value("drawn") - before
    after = pathlib.Path(f"/proc/{pid}/stat").read_text().split()
    ms = sum(int(after[k]) - int(cpu[k]) for k in (13, 14)) * 10 / sent
    found = (f"At {sent / elapsed:.1f} images a second the page drew {drawn / elapsed:.1f}; the program takes {ms:.0f} ms of processor "
             f"for each.")
    print(found, flush=True)
    return found


main()
