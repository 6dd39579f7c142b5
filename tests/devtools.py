"""One page of a browser without a network, driven by the browser's own protocol.

The tests of the report, of the page that calibrates, and of the book use it.
"""

import base64
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import urllib.request

import websocket

NAMES = ["chromium", "chromium-browser", "google-chrome"]
SLOW = 120  # seconds until a step has failed


def program():
    """The browser; None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One page, at first that of an address. All that happens in it is kept until it is closed."""

    def __init__(self, work, address="about:blank", size=(1400, 1000), more=()):
        flags = [
            "--headless", "--no-sandbox", "--no-first-run", "--disable-background-networking", "--disable-sync",
            "--disable-component-update", "--host-resolver-rules=MAP * ~NOTFOUND", "--remote-debugging-port=0",
            "--remote-allow-origins=*", f"--user-data-dir={work}/profile", f"--window-size={size[0]},{size[1]}",
            "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", *more,
        ]  # fmt: skip
        self.process = subprocess.Popen([program(), *flags, address], stderr=subprocess.DEVNULL, start_new_session=True)
        self.count, self.events = 0, []
        port_file = pathlib.Path(work) / "profile" / "DevToolsActivePort"
        port = until(lambda: port_file.is_file() and port_file.read_text().split("\n")[0], "the browser starts")
        targets = until(
            lambda: [t for t in get(f"http://127.0.0.1:{port}/json") if t["type"] == "page"], "the page opens"
        )
        self.socket = websocket.create_connection(targets[0]["webSocketDebuggerUrl"], timeout=SLOW)
        for domain in ("Runtime", "Page", "Network", "Log"):
            self.call(f"{domain}.enable")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(ProcessLookupError):  # one that was closed is gone
            os.killpg(self.process.pid, signal.SIGKILL)

    def call(self, method, **given):
        """A command and its result; events in the meantime are kept."""
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "method": method, "params": given}))
        while True:
            answer = json.loads(self.socket.recv())
            if answer.get("id") == self.count:
                assert "error" not in answer, answer
                return answer["result"]
            self.events.append(answer)

    def value(self, expression):
        """What an expression of JavaScript is."""
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def wait(self, expression, what):
        """Until an expression is true."""
        return until(lambda: self.value(expression), what, lambda: self.value("document.body.innerText")[:3000])

    def open(self, address):
        """Loads a page, and waits until all its scripts have run."""
        self.call("Page.navigate", url=address)
        self.wait(f"document.readyState == 'complete' && location.href == {json.dumps(address)}", address)

    def picture(self, path):
        """A picture of the whole page."""
        height = self.value("document.documentElement.scrollHeight")
        width = self.value("innerWidth")
        clip = {"x": 0, "y": 0, "width": width, "height": min(height, 6000), "scale": 1}
        data = self.call("Page.captureScreenshot", clip=clip, captureBeyondViewport=True)["data"]
        pathlib.Path(path).write_bytes(base64.b64decode(data))

    def troubles(self):
        """What went wrong in the page so far, and what it loaded from elsewhere."""
        self.value("1")  # events that are under way
        for event in self.events:
            kind, about = event["method"], event["params"]
            if kind == "Runtime.exceptionThrown":
                yield f"a script fails: {about['exceptionDetails']}"
            elif kind == "Runtime.consoleAPICalled" and about["type"] in ("error", "assert"):
                yield f"the console has an error: {about['args']}"
            elif kind == "Log.entryAdded" and about["entry"]["level"] == "error":
                yield f"the log has an error: {about['entry']}"
            elif kind == "Network.requestWillBeSent":
                url = about["request"]["url"]
                if url.split(":")[0] not in ("file", "blob", "data", "about"):
                    yield f"loads {url}"


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
