"""Uses the 3D cell of a report: rows, images and captures in 3D select one another, by pointer and by keys.

cell_page.py REPORT.html
"""

import pathlib
import sys
import tempfile

import devtools

# what the page keeps for this: the selected capture, and where in the view it is (px)
FIGURE = "document.querySelector('figure.scene')"
CANVAS = f"{FIGURE}.querySelector('canvas.solid')"
SELECTED = f"{FIGURE}.dataset.selected"


def main():
    page = pathlib.Path(sys.argv[1]).resolve()
    if devtools.program() is None:
        print("SKIPPED: no chromium to open the report with")
        return
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work, devtools.Browser(work, page.as_uri()) as browser:
        browser.wait(f"document.readyState == 'complete' && !!{FIGURE} && !!{FIGURE}.dataset.drawn", "the view is drawn")
        # without the way between two looks, which a page cannot be asked to end
        browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
        count = look(browser)
    print(f"{page.name}: {count} captures are selected by row, by image, in 3D and by keys")


def look(browser):
    """Selects captures in every way."""
    rows = browser.value("Array.from(document.querySelectorAll('tr[data-capture]'), e => e.dataset.capture)")
    assert len(rows) > 2, rows
    picture = pixels(browser)
    browser.value("document.querySelector('tr[data-capture]').click()")
    browser.wait(f"{SELECTED} == {rows[0]!r} && !!{FIGURE}.dataset.at", "a row selects its capture in 3D")
    assert pixels(browser) != picture, "the selected capture looks as before"
    card = browser.value(f"{FIGURE}.querySelector('.card').innerText")
    assert rows[0] in card and ("residual" in card or "rejected" in card), card
    marked(browser, rows[0])
    # where each capture is, a click in the view finds one: that very one, where no other one covers it
    found = [click(browser, name) for name in rows]
    same = sum(name == other for name, other in zip(rows, found))
    assert same >= len(rows) / 4, list(zip(rows, found))
    keys(browser, rows)
    if browser.value("!!document.querySelector('.pictures figure[data-capture]')"):
        name = browser.value("document.querySelector('.pictures figure[data-capture]').dataset.capture")
        browser.value("document.querySelector('.pictures figure[data-capture]').click()")
        browser.wait(f"{SELECTED} == {name!r}", "an image selects its capture in 3D")
    # the view on a phone: nothing is wider than the screen
    browser.call("Emulation.setDeviceMetricsOverride", width=420, height=800, deviceScaleFactor=2, mobile=True)
    browser.wait(f"{CANVAS}.clientWidth <= 420", "the view fits on a phone")
    assert browser.value("document.documentElement.scrollWidth") <= 420, "the page is wider than a phone"
    assert not list(browser.troubles()), list(browser.troubles())
    return len(rows)


def pixels(browser):
    return browser.value(f"new Promise(done => requestAnimationFrame(() => done({CANVAS}.toDataURL())))")


def marked(browser, name):
    """The row of this capture is marked, and no other one."""
    all_marked = "Array.from(document.querySelectorAll('tr.marked'), e => e.dataset.capture)"
    assert browser.value(all_marked) == [name], (browser.value(all_marked), name)


def click(browser, name):
    """Where a capture is, with none selected; the one that is selected then."""
    browser.value(f"Array.from(document.querySelectorAll('tr[data-capture]')).find(e => e.dataset.capture == {name!r}).click()")
    browser.wait(f"{SELECTED} == {name!r} && !!{FIGURE}.dataset.at", "a row selects its capture in 3D")
    browser.value("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))")
    x, y = map(float, browser.value(f"{FIGURE}.dataset.at").split())
    browser.value(f"{FIGURE}.querySelector('.card .close').click()")
    assert browser.value(f"{SELECTED} === undefined && !document.querySelector('.marked')"), "none is selected"
    browser.value(f"{CANVAS}.scrollIntoView({{ block: 'center' }})")
    left, top = browser.value(f"(() => {{ const r = {CANVAS}.getBoundingClientRect(); return [r.left, r.top]; }})()")
    for kind in ("mousePressed", "mouseReleased"):
        browser.call("Input.dispatchMouseEvent", type=kind, x=left + x, y=top + y, button="left", clickCount=1)
    browser.wait(f"!!{SELECTED}", f"a click on capture {name} selects one")
    found = browser.value(SELECTED)
    marked(browser, found)
    return found


def keys(browser, rows):
    """The arrows go from capture to capture, Esc selects none."""
    browser.value(f"{CANVAS}.focus()")
    first = browser.value(SELECTED)
    press(browser, "ArrowRight")
    browser.wait(f"{SELECTED} != {first!r}", "an arrow key selects the next capture")
    marked(browser, browser.value(SELECTED))
    press(browser, "ArrowLeft")
    browser.wait(f"{SELECTED} == {first!r}", "the other arrow key goes back")
    press(browser, "Escape")
    browser.wait(f"{SELECTED} === undefined", "Esc selects none")
    visited = []
    for _ in rows:
        press(browser, "ArrowRight")
        visited.append(browser.value(SELECTED))
    assert sorted(visited) == sorted(rows), f"the arrow keys do not reach all captures: {visited}"


def press(browser, key):
    for kind in ("keyDown", "keyUp"):
        browser.call("Input.dispatchKeyEvent", type=kind, key=key)


main()
