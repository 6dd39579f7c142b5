"""How fast the page is while a camera streams, and whether memory grows: the whole program, its page open in a browser.

    pip install websocket-client opencv-python-headless
    python bench/session/page.py PROGRAM WIDTHxHEIGHT HERTZ SECONDS [IMAGES]

Images of a simulated cell are sent by HTTP at HERTZ for SECONDS, and the images that the page has drawn are counted. With
IMAGES, as many are sent before as fast as they are taken, and the memory of program and page is printed on the way: somebody
looks at the page for the last twentieth of each tenth.
"""

import http.client
import json
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
    program, size, hertz, seconds = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], float(sys.argv[3]), float(sys.argv[4])
    images = int(sys.argv[5]) if len(sys.argv) > 5 else 0
    width, height = size.split("x")
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        cell, folder = pathlib.Path(work) / "cell", pathlib.Path(work) / "session"
        simulate = [program, "simulate", cell, "--captures", "6", "--width", width, "--height", height, "--quiet"]
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
                camera.command(do="confirm", step="cell")
                camera.send()
                camera.command(do="confirm", step="camera")
                camera.command(do="pose", text="0.4 0.1 0.5 3.1 0.1 0.2")
                camera.command(do="confirm", step="robot")
                time.sleep(2)
                camera.command(do="confirm", step="board")
                page.wait("document.body.dataset.step == 'capture'", "the step capture")
                begin = time.monotonic()
                tenth = max(1, images // 10)
                for k in range(1, images + 1):
                    if k % 200 == 0:
                        page.value(f"window.away = {str(k % tenth < 0.95 * tenth).lower()}")
                        page.events.clear()
                    camera.send()
                    if k % tenth == 0:
                        print_memory(page, session.pid, k, time.monotonic() - begin)
                page.value("window.away = false")
                measure(page, camera, session.pid, hertz, seconds)
        finally:
            session.terminate()
            session.wait()


def print_memory(page, pid, count, elapsed):
    page.call("HeapProfiler.collectGarbage")
    heap = page.call("Runtime.getHeapUsage")["usedSize"] / 2**20
    page.events.clear()
    print(f"{count} images, {elapsed:.0f} s: program {resident_mb(pid):.0f} MB, page {heap:.1f} MB, "
          f"{page.value('drawn')} drawn", flush=True)


def measure(page, camera, pid, hertz, seconds):
    camera.send()
    time.sleep(1)
    before, begin = page.value("drawn"), time.monotonic()
    cpu = pathlib.Path(f"/proc/{pid}/stat").read_text().split()
    sent = late = 0
    while (now := time.monotonic() - begin) < seconds:
        due = sent / hertz
        if now < due:
            time.sleep(due - now)
        late += now > due + 0.5 / hertz
        camera.send()
        sent += 1
    elapsed = time.monotonic() - begin
    time.sleep(0.3)
    drawn = page.value("drawn") - before
    after = pathlib.Path(f"/proc/{pid}/stat").read_text().split()
    ms = sum(int(after[k]) - int(cpu[k]) for k in (13, 14)) * 10 / sent
    print(f"{sent} images sent in {elapsed:.1f} s ({late} late), {drawn} drawn: {drawn / elapsed:.1f} a second; the program takes "
          f"{ms:.0f} ms of processor for each")


main()
