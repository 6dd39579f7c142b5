#!/usr/bin/env python3
"""Opens the built book in a browser that has no network, and looks at what it shows.

    book/look.py [FOLDER]       the built book [target/book]

On every page with formulas, and on some others: all formulas are rendered, and none with an error; each output below a
command is marked as one and has no button to copy it; no page and no formula is wider than a phone. The search finds
"Shah". No script fails, and nothing is loaded from elsewhere.
"""

import re
import sys
import tempfile
import time
from pathlib import Path

from run import ROOT, SOURCE, blocks, follows, included

sys.path.append(str(ROOT / "tests"))
import devtools  # noqa: E402

PHONE = {"width": 420, "height": 900, "deviceScaleFactor": 1, "mobile": False}
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
            browser.wait("!!document.querySelector('.katex')", f"{name}: formulas are rendered")
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
    browser.wait("!!document.querySelector('#mdbook-searchresults li')", "the search finds something")
    links = browser.value("Array.from(document.querySelectorAll('#mdbook-searchresults a'), (a) => a.pathname)")
    found = any(link.endswith("/methods/shah.html") for link in links)
    return [] if found else [f"the search for Shah does not find its page: {links}"]


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "target" / "book").resolve()
    if devtools.program() is None:
        print("SKIPPED: no chromium to open the book with")
        return 0
    began = time.monotonic()
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work, devtools.Browser(work) as browser:
        browser.call("Emulation.setDeviceMetricsOverride", **PHONE)
        problems, sentence = look(browser, folder)
        problems += search(browser, folder)
        problems += browser.troubles()
    for problem in problems:
        print(problem)
    print(f"{sentence}, in {time.monotonic() - began:.0f} s: ", end="")
    print(f"{len(problems)} problems" if problems else "all as they should be, nothing loaded from elsewhere")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
