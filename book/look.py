#!/usr/bin/env python3
"""Opens the built book in a browser that has no network, and looks at what it shows.

    book/look.py [FOLDER]       the built book [target/book]

On every page with formulas, and on some others: all formulas are rendered, and none with an error; each output below a
command is marked as one and has no button to copy it; no page and no formula is wider than a phone. The search finds
"Shah". No script fails, and nothing is loaded from elsewhere.
"""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from pathlib import Path

import websocket

from run import ROOT, SOURCE, blocks, follows, included

NAMES = ["chromium", "chromium-browser", "google-chrome"]
PHONE = {"width": 420, "height": 900, "deviceScaleFactor": 1, "mobile": False}
SECONDS = 60  # until a step has failed
OTHERS = ["tutorial.md", "tutorial-python.md", "mistakes/robot.md", "references.md"]

# what a page shows, counted in the page
SHOWN = """(async () => {
    const main = document.querySelector("main");
    await document.fonts.ready;
    const label = (pre) => getComputedStyle(pre, "::before").content;
    const outputs = Array.from(main.querySelectorAll("pre")).filter((pre) => label(pre).startsWith('"Output'));
    const copied = outputs.filter((pre) => Array.from(pre.querySelectorAll("button")).some((b) => b.offsetParent));
    return {
        formulas: main.querySelectorAll(".katex").length,
        errors: Array.from(main.querySelectorAll(".katex-error"), (e) => e.textContent),
        unseen: Array.from(main.querySelectorAll(".katex-html")).filter((e) => !e.getClientRects().length).length,
        outputs: outputs.length,
        copied: copied.length,
        wide: Math.max(...Array.from(document.querySelectorAll(".content, .formula"), (e) => e.scrollWidth - e.clientWidth)),
    };
})()"""


class Browser:
    """One tab, by the protocol of the browser."""

    def __init__(self, program, work):
        flags = [
            "--headless", "--no-sandbox", "--no-first-run", "--disable-gpu", "--disable-background-networking", "--disable-sync",
            "--disable-component-update", "--host-resolver-rules=MAP * ~NOTFOUND", "--remote-debugging-port=0",
            "--remote-allow-origins=*", f"--user-data-dir={work}",
        ]  # fmt: skip
        self.process = subprocess.Popen([program, *flags, "about:blank"], stderr=subprocess.DEVNULL, start_new_session=True)
        self.count, self.events = 0, []
        port_file = Path(work) / "DevToolsActivePort"
        port = until(lambda: port_file.is_file() and port_file.read_text().split("\n")[0], "the browser starts")
        tabs = until(lambda: [t for t in get(f"http://127.0.0.1:{port}/json") if t["type"] == "page"], "a tab opens")
        self.socket = websocket.create_connection(tabs[0]["webSocketDebuggerUrl"], timeout=SECONDS)
        for domain in ("Runtime", "Page", "Network", "Log"):
            self.call(f"{domain}.enable")
        self.call("Emulation.setDeviceMetricsOverride", **PHONE)

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

    def open(self, address):
        """Loads a page, and waits until all its scripts have run."""
        self.call("Page.navigate", url=address)
        until(lambda: self.value(f"document.readyState == 'complete' && location.href == {json.dumps(address)}"), address)

    def troubles(self):
        """What went wrong in the pages so far."""
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
                if url.split(":")[0] not in ("file", "data", "blob", "about"):
                    yield f"loads {url}"


def get(url):
    with urllib.request.urlopen(url, timeout=10) as answer:
        return json.load(answer)


def until(is_done, what):
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        found = is_done()
        if found:
            return found
        time.sleep(0.02)
    sys.exit(f"failed: {what}")


def written(page):
    """How many formulas and outputs of commands a page of the source has."""
    text = included(page)
    lines = text.splitlines(keepends=True)
    found = blocks(lines)
    inside = {k for block in found for k in range(block.first - 1, block.last + 1)}
    prose = "".join(line for k, line in enumerate(lines) if k not in inside)
    formulas = sum(b.language == "math" for b in found) + len(re.findall(r"\$`[^`]+`\$", prose))
    pairs = zip(found, found[1:])
    outputs = sum(
        a.language in ("sh", "python") and b.language == "text" and follows(lines, a, b) for a, b in pairs
    )
    return formulas, outputs


def look(browser, folder):
    """Problems of all pages that are opened, and a sentence about them."""
    problems, count = [], [0, 0, 0]
    for page in sorted(SOURCE.rglob("*.md")):
        name = str(page.relative_to(SOURCE))
        formulas, outputs = written(page)
        if name == "SUMMARY.md" or not (formulas or name in OTHERS):
            continue
        browser.open((folder / name).with_suffix(".html").as_uri())
        if formulas:
            until(lambda: browser.value("!!document.querySelector('.katex')"), f"{name}: formulas are rendered")
        shown = browser.value(SHOWN)
        expected = {"formulas": formulas, "outputs": outputs, "errors": [], "unseen": 0, "copied": 0, "wide": 0}
        problems += [f"{name}: {k}: {shown[k]}, not {v}" for k, v in expected.items() if shown[k] != v]
        count = [a + b for a, b in zip(count, (1, formulas, outputs))]
    return problems, "{} pages opened: {} formulas and {} outputs".format(*count)


def search(browser, folder):
    """Whether the search finds the page of a method; nothing where the book was built without a search."""
    if not list(folder.glob("searchindex*.js")):
        print("SKIPPED: this mdbook was built without its feature `search`")
        return []
    browser.open((folder / "index.html").as_uri() + "?search=Shah")
    until(lambda: browser.value("!!document.querySelector('#mdbook-searchresults li')"), "the search finds something")
    links = browser.value("Array.from(document.querySelectorAll('#mdbook-searchresults a'), (a) => a.pathname)")
    found = any(link.endswith("/methods/shah.html") for link in links)
    return [] if found else [f"the search for Shah does not find its page: {links}"]


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "target" / "book").resolve()
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        print("SKIPPED: no chromium to open the book with")
        return 0
    began = time.monotonic()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        browser = Browser(program, work)
        try:
            problems, sentence = look(browser, folder)
            problems += search(browser, folder)
            problems += browser.troubles()
        finally:
            os.killpg(browser.process.pid, signal.SIGKILL)
    for problem in problems:
        print(problem)
    print(f"{sentence}, in {time.monotonic() - began:.0f} s: ", end="")
    print(f"{len(problems)} problems" if problems else "all as they should be, nothing loaded from elsewhere")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
