"""Plays a session in a browser as a person would: from nothing to an accepted result and an export of it.

session_page.py PROGRAM [folder for a picture of every step]

In a virtual cell, once with the mouse, whose clicks are counted, and once with the keyboard alone. The program calibrates
the folder to the same bytes, a second tab shows the same, and nothing is loaded from elsewhere. In a session of uploads, the
browser's own camera (a simulated one) sees the board, and its image makes a capture. With a camera beside the robot a board
is laid into the view, and its corners are touched; that page speaks German, and nothing on it stays English. Views and touches
of which the calibration knows nothing verify both.
"""

import contextlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.parse

import cv2
import devtools

MOST_CLICKS = 25
SEED = "5"
# a result says when it was made: that of the session at the same time as that of the program
ENVIRONMENT = {**os.environ, "SOURCE_DATE_EPOCH": "1773480413"}
ROOT = pathlib.Path(__file__).resolve().parent.parent
AXE = ROOT / "crates/handeye-session/web/node_modules/axe-core/axe.min.js"
# this machine's own address is reached, no other one; of two switches of a browser the last one counts
NO_OTHER_HOST = "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"
# of the fields of any page a browser may ask its maker what belongs into them
ONLY_PAGES = "--disable-features=AutofillServerCommunication"
CHOICES = ["cell", "camera", "robot", "board"]
FORMAT = "quaternion-xyzw"
TOUCHES = 6
VIEWS = 3
VERIFYING = 4
DESK, TABLET, PHONE = (1280, 800), (800, 1280), (400, 800)

STEP = "document.body?.dataset.step"
PRIMARY = "document.querySelector('button.primary')"
# what the primary button does; empty while it cannot be pressed
ACTION = f"({PRIMARY}.getAttribute('aria-disabled') ? '' : {PRIMARY}.querySelector('[data-say]').dataset.say)"
STATE = f"JSON.stringify([{STEP}, {ACTION}])"
TOUCH_STEP = "document.querySelector('[data-say=step_touch]').closest('button')"
VERIFY_STEP = "document.querySelector('[data-say=step_verify]').closest('button')"
BY_TOUCHES = "document.querySelector('input[name=verify-by][value=touches]')"
# what is the same in every tab
SHOWN = f"""JSON.stringify([{STEP}, ...['h1', '.accuracy .number', 'ol.captures', '.banner']
    .map((part) => document.querySelector(part).textContent)])"""
TAB = f"Array.from(document.querySelectorAll('[role=tab]')).find((tab) => tab.textContent == {FORMAT!r})"
EXPORT = "document.querySelector('#export-text').textContent"
GERMAN = "document.querySelector('[data-name=in_german]')"
# what the server says and the page has no German for is marked as English; all of that is kept from now on
HEAR = """(() => { window.heard = new Set(); new MutationObserver(() => {
    for (const element of document.body.querySelectorAll('[lang=en]'))
        if (element.checkVisibility() && element.dataset.name !== 'in_english') heard.add(element.textContent);
}).observe(document.body, { subtree: true, childList: true, characterData: true, attributes: true }); })()"""

# what is wider than the card that it is in, where it is not to be scrolled
OVERHANG = """[...document.querySelectorAll('.card')].flatMap((card) => {
    const ends = card.getBoundingClientRect().right + 1;
    const scrolls = (part) => part !== card && (getComputedStyle(part).overflowX !== 'visible' || scrolls(part.parentElement));
    return [...card.querySelectorAll('*')].filter((part) => part.checkVisibility() && part.getBoundingClientRect().right > ends
        && !scrolls(part.parentElement)).map((part) => part.outerHTML.slice(0, 150)); })"""


class Page(devtools.Browser):
    """The page of a session, under a person's hands."""

    def __init__(self, work, more=()):
        self.work, self.clicks, self.keys = pathlib.Path(work), 0, 0
        self.net_log = self.work / "net.json"
        super().__init__(work, more=(*more, NO_OTHER_HOST, ONLY_PAGES, f"--log-net-log={self.net_log}"))
        self.size(*DESK)

    def size(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def sign_in(self, address):
        """Opens the address that the session has printed; it leads to one without the token."""
        self.home = urllib.parse.urljoin(address, "/")
        self.call("Page.navigate", url=address)
        self.wait(f"location.href == {self.home!r} && {STEP} == 'cell' && {ACTION} == 'confirm'", "the page opens")

    def click(self, element):
        """A click in the middle of an element."""
        x, y = self.value(f"""(() => {{ const element = {element}; element.scrollIntoView({{ block: "nearest" }});
            const at = element.getBoundingClientRect(); return [at.left + at.width / 2, at.top + at.height / 2]; }})()""")
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)
        self.clicks += 1

    def press(self, key, number):
        """A key, down and up; not sooner after the last one than a person would: the page takes that for a slip."""
        time.sleep(0.5)
        for kind in ("rawKeyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=key, windowsVirtualKeyCode=number)
        self.keys += 1

    def act(self, do, step):
        """Does the primary action by `do` once it can be done, and waits until something has come of it."""
        before = self.wait(f"{STEP} == {step!r} && {ACTION} && {STATE}", f"something can be done in the step {step}")
        do()
        self.wait(f"{STATE} != {before!r}", f"something comes of {before}")
        return json.loads(before)[1]

    def wrong(self):
        """What went wrong in the page, and what it asked of others."""
        for trouble in self.troubles():
            kind, _, url = trouble.partition(" ")
            if kind != "loads" or not url.startswith(self.home):
                yield trouble

    def sent_elsewhere(self):
        """Closes the browser; what it has asked others for on behalf of the page, by its own log of the network."""
        self.call("Browser.close")
        self.process.wait(devtools.SLOW)
        log = json.loads(self.net_log.read_text())
        begins = log["constants"]["logEventTypes"]["URL_REQUEST_START_JOB"]
        requests = [event["params"] for event in log["events"] if event["type"] == begins and "url" in event.get("params", {})]
        address = self.home.rstrip("/")
        site = address.rpartition(":")[0]
        own = [one["url"] for one in requests if site in one["network_isolation_key"].split() or one["initiator"] == address]
        assert any(url.startswith(f"{self.home}api/") for url in own), "the log of the network knows nothing of the page"
        return [url for url in own if not url.startswith(self.home)]

    def other_tab(self):
        """The session in one more tab, behind this one."""
        name = self.call("Target.createTarget", url=self.home, background=True)["targetId"]
        port = (self.work / "profile" / "DevToolsActivePort").read_text().split("\n")[0]
        return Tab(f"ws://127.0.0.1:{port}/devtools/page/{name}", self.home)


class Tab(Page):
    """One more tab of a browser that runs."""

    def __init__(self, address, home):
        self.home, self.count, self.events = home, 0, []
        self.socket = devtools.websocket.create_connection(address, timeout=devtools.SLOW)
        for domain in ("Runtime", "Page", "Network", "Log"):
            self.call(f"{domain}.enable")


def main():
    program = pathlib.Path(sys.argv[1]).resolve()
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    if devtools.program() is None:
        print("SKIPPED: no chromium to open the session with")
        return
    if not AXE.is_file():
        print(f"SKIPPED in part: no {AXE.relative_to(ROOT)} to look for barriers with")
    with opened(program) as (page, folder):
        captures = with_mouse(page, folder, pictures)
        same_bytes(program, folder)
        assert page.clicks <= MOST_CLICKS, f"{page.clicks} clicks"
        clicks = page.clicks
        with_touches(page, folder, pictures)
        same_bytes(program, folder)
        with_other_views(page, folder, pictures)
        with_other_touches(page, folder, pictures, "verify-touches")
        same_bytes(program, folder)
    with opened(program) as (page, folder):
        again = with_keys(page, folder)
        same_bytes(program, folder)
        assert page.clicks == 0
        keys = page.keys
    with opened(program, ("--virtual", SEED, "--setup", "eye-to-hand")) as (page, folder):
        page.value(HEAR)
        with_placement(page, folder, pictures)
        done = with_other_touches(page, folder, pictures, "verify-placement")
        assert done.count("place") == 1 and len(list((folder / "placements").iterdir())) == 2, done
        assert page.value("document.documentElement.lang") == "de"
        assert not page.value("[...heard]"), f"English on a German page: {page.value('[...heard]')}"
        same_bytes(program, folder)
    with_uploads(program, pictures)
    barriers = "no serious barrier" if AXE.is_file() else "barriers not looked for"
    print(f"session: {captures} captures and an accepted result with {clicks} clicks, {again} with {keys} keys;"
          f" the program gives the same bytes, a second tab shows the same, {barriers}, nothing from elsewhere")


@contextlib.contextmanager
def opened(program, options=("--virtual", SEED), more=()):
    """A new session, of a virtual cell unless said otherwise, and its page; `more` flags for the browser."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as work:
        folder = pathlib.Path(work) / "cell"
        command = [program, "session", folder, *options, "--no-open"]
        session = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=ENVIRONMENT)
        try:
            address = next((line.split()[1] for line in session.stdout if line.startswith("session: ")), None)
            assert address, "the session prints no address"
            with Page(work, more) as page:
                page.sign_in(address)
                yield page, folder
                assert not list(page.wrong()), list(page.wrong())
                elsewhere = page.sent_elsewhere()
                assert not elsewhere, f"sent elsewhere: {elsewhere}"
        finally:
            session.terminate()
            session.wait()


def with_mouse(page, folder, pictures):
    """From nothing to an export with clicks alone."""
    for step in CHOICES:
        look(page, step, pictures)
        page.act(lambda: page.click(PRIMARY), step)
    tab = None
    while page.act(lambda: page.click(PRIMARY), "capture") != "finish":
        if tab is None and count(page):
            page.wait(ACTION, "the first capture is assessed")
            tab = page.other_tab()
            look(page, "capture", pictures)
            alike(page, tab)
    page.wait(f"{STEP} == 'result' && !!{TAB} && !!{EXPORT}", "the result and a first export")
    page.click(TAB)
    exported(page, folder)
    look(page, "result", pictures)
    alike(page, tab)
    assert not list(tab.wrong()), list(tab.wrong())
    return count(page)


def with_touches(page, folder, pictures):
    """Corners are touched with the tip, and the result is one with touches."""
    page.click(TOUCH_STEP)
    page.wait(f"{STEP} == 'touch'", "the step touch")
    touched = "document.querySelectorAll('ol.touches > li').length"
    for number in range(1, TOUCHES + 1):
        page.act(lambda: page.click(PRIMARY), "touch")  # the tip is brought there
        page.act(lambda: page.click(PRIMARY), "touch")
        page.wait(f"{touched} == {number}", f"{number} touches")
        page.wait(ACTION, "the touches are assessed")
        if number == TOUCHES // 2:
            look(page, "touch", pictures)
    page.act(lambda: page.click(PRIMARY), "touch")
    page.wait(f"{STEP} == 'result'", "the result")
    result = json.loads((folder / "result" / "calibration.json").read_text())
    assert result["verdict"] == "accepted" and len(result["touches"]) == TOUCHES, result["verdict"]


def with_placement(page, folder, pictures):
    """With a camera beside the robot a board is laid into the view, and its corners are touched, all of it in German."""
    page.click(GERMAN)
    page.wait("document.querySelector('h1').textContent.startsWith('Ist das Ihre Zelle?')", "the page speaks German at once")
    for step in CHOICES:
        page.act(lambda: page.click(PRIMARY), step)
    while True:
        before = page.wait(f"{STEP} == 'capture' && {ACTION} && {STATE}", "something can be done in the step capture")
        if json.loads(before)[1] == "finish":
            break
        page.act(lambda: page.click(PRIMARY), "capture")
    page.click(TOUCH_STEP)
    page.wait(f"{STEP} == 'touch' && {ACTION} == 'lay_board'", "a board is to be laid into the view")
    look(page, "placement", pictures)
    done = []
    while not done or done[-1] != "finish":
        done.append(page.act(lambda: page.click(PRIMARY), "touch"))
        if done.count("touch_it") == TOUCHES // 2 and done[-1] == "touch_it":
            page.wait(ACTION, "the touches are assessed")
            look(page, "placement-touches", pictures)
    assert done.count("place") == 1, done
    page.wait(f"{STEP} == 'result'", "the result")
    result = json.loads((folder / "result" / "calibration.json").read_text())
    assert result["verdict"] == "accepted" and len(result["touches"]) == TOUCHES, result["verdict"]
    assert len(list((folder / "placements").iterdir())) == 1


def with_other_views(page, folder, pictures):
    """Views that the calibration is not made with agree with it."""
    before = (folder / "result" / "calibration.json").read_bytes()
    page.click(VERIFY_STEP)
    page.wait(f"{STEP} == 'verify' && {ACTION} == 'drive'", "the step verify, and a view to drive to")
    while page.act(lambda: page.click(PRIMARY), "verify") != "finish":
        pass
    page.wait(f"{STEP} == 'result'", "the result")
    assert len(list((folder / "verification").iterdir())) == VIEWS
    assert (folder / "result" / "calibration.json").read_bytes() == before, "views that verify change the result"
    page.click(VERIFY_STEP)
    page.wait(f"{STEP} == 'verify' && {ACTION} == 'finish'", "the views are seen again")
    agree = "document.querySelector('.verified').textContent"
    assert page.value(agree) == "They agree with the calibration.", page.value(agree)
    look(page, "verify", pictures)
    page.act(lambda: page.click(PRIMARY), "verify")
    page.wait(f"{STEP} == 'result'", "the result")


def with_other_touches(page, folder, pictures, name):
    """Corners that the calibration is not made with are touched, and agree with it."""
    before = (folder / "result" / "calibration.json").read_bytes()
    page.click(VERIFY_STEP)
    page.wait(f"{STEP} == 'verify' && {ACTION}", "the step verify")
    page.click(BY_TOUCHES)
    page.wait(f"['lay_board', 'drive_tip'].includes({ACTION})", "a corner to touch, or a board to lay")
    look(page, f"{name}-first", pictures)
    done = []
    while not done or done[-1] != "finish":
        done.append(page.act(lambda: page.click(PRIMARY), "verify"))
        if done.count("touch_it") == VERIFYING and done[-1] == "touch_it":
            page.wait(f"{ACTION} == 'finish'", "the touches agree")
            agree = page.value("document.querySelector('.verified').textContent")
            assert agree in ("They agree with the calibration.", "Sie passen zur Kalibrierung."), agree
            look(page, name, pictures)
    page.wait(f"{STEP} == 'result'", "the result")
    assert (folder / "result" / "calibration.json").read_bytes() == before, "touches that verify change the result"
    return done


def with_keys(page, folder):
    """The same with the keyboard alone."""
    for step in CHOICES:
        page.act(lambda: page.press(" ", 32), step)
    while page.act(lambda: page.press(" ", 32), "capture") != "finish":
        pass
    page.wait(f"{STEP} == 'result' && !!{TAB} && !!{EXPORT}", "the result and a first export")
    reached = "document.activeElement.getAttribute('role') == 'tab'"
    tab_to(page, reached)
    while not page.value(f"document.activeElement == {TAB}"):
        page.press("ArrowRight", 39)
        assert page.keys < 200, "the arrow keys do not reach the export"
    exported(page, folder)
    return count(page)


def with_uploads(program, pictures):
    """The browser's camera sees a board, and its image and a typed pose make a capture."""
    with tempfile.TemporaryDirectory() as work:
        cell = pathlib.Path(work) / "cell"
        simulate = ["simulate", cell, "--captures", "1", "--width", "640", "--height", "480", "--quiet"]
        subprocess.run([program, *simulate], check=True, stdout=subprocess.DEVNULL)
        film = pathlib.Path(work) / "camera.y4m"
        image = cv2.imread(str(next((cell / "images").iterdir())), cv2.IMREAD_GRAYSCALE)
        half = bytes([128]) * (image.size // 2)
        film.write_bytes(b"YUV4MPEG2 W640 H480 F10:1 Ip A1:1 C420jpeg\n" + (b"FRAME\n" + image.tobytes() + half) * 5)
        camera = ["--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream",
                  f"--use-file-for-fake-video-capture={film}"]
        options = ["--upload", "--target", cell / "handeye.toml"]
        with opened(program, options, camera) as (page, folder):
            page.act(lambda: page.click(PRIMARY), "cell")
            page.click("document.querySelector('[data-say=browser_camera]').closest('button')")
            page.wait("document.querySelector('video').videoWidth == 640", "the browser's camera")
            page.click("document.querySelector('.take-image')")
            page.wait("document.querySelector('#stage').textContent.includes('54')", "the board in its image")
            look(page, "upload", pictures)
            page.act(lambda: page.click(PRIMARY), "camera")
            page.value("(() => { document.querySelector('[data-say=type_pose]').closest('section').querySelector('input').focus(); })()")
            page.call("Input.insertText", text="0.4 0.1 0.5 3.1 0.1 0.2")
            page.act(lambda: page.click(PRIMARY), "robot")
            page.act(lambda: page.click(PRIMARY), "board")
            page.act(lambda: page.click(PRIMARY), "capture")
            page.wait("document.querySelectorAll('ol.captures > li').length == 1", "a capture of an uploaded image")
            assert len(list((folder / "images").iterdir())) == 1


def tab_to(page, reached):
    for _ in range(100):
        if page.value(reached):
            return
        page.press("Tab", 9)
    sys.exit("failed: the key Tab does not reach the exports")


def count(page):
    return page.value("document.querySelectorAll('ol.captures > li').length")


def exported(page, folder):
    """The export that is seen is the result that was written; it is accepted."""
    result = json.loads((folder / "result" / "calibration.json").read_text())
    assert result["verdict"] == "accepted", result["verdict"]
    assert page.value("document.querySelector('.banner').classList.contains('accepted')"), "the page does not accept it"
    pose = result["hand_eye"]["mount_from_camera"]
    wanted = [*pose["translation_m"], *pose["rotation_xyzw"]]

    def is_seen():
        lines = [line for line in page.value(EXPORT).splitlines() if line and not line.startswith("#")]
        with contextlib.suppress(ValueError):
            numbers = [float(number) for line in lines for number in line.replace(",", " ").split()]
            return len(numbers) == len(wanted) and all(abs(a - b) < 1e-6 for a, b in zip(numbers, wanted))
        return False

    devtools.until(is_seen, "the export is seen", lambda: f"{page.value(EXPORT)}\nin place of {wanted}")
    assert page.value("fetch('/api/report').then((answer) => answer.status)") == 200, "there is no report"


def same_bytes(program, folder):
    """`calibrate` on the folder gives the session's own result."""
    out = folder.parent / "again"
    command = [program, "calibrate", folder, "--out", out, "--quiet"]
    subprocess.run(command, check=True, env=ENVIRONMENT, stdout=subprocess.DEVNULL)
    mine, again = ((at / "calibration.json").read_bytes() for at in (folder / "result", out))
    assert mine == again, "`handeye calibrate` gives another calibration.json than the session"


def alike(page, tab):
    """Both tabs show the same, as soon as both have drawn it."""
    both = lambda: [one.value(f"document.querySelector('h1') && {SHOWN}") for one in (page, tab)]
    devtools.until(lambda: len(set(both())) == 1, "a second tab shows the same", lambda: "\n".join(map(str, both())))


def look(page, step, pictures):
    """A picture of a step, and what keeps people from using it, in light and in dark, and on other screens."""
    for scheme, name, size in (("light", "", DESK), ("dark", "", DESK), ("light", "-tablet", TABLET), ("dark", "-phone", PHONE)):
        page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
        page.size(*size)
        if pictures:
            pictures.mkdir(parents=True, exist_ok=True)
            page.picture(pictures / f"{step}-{scheme}{name}.png")
        wide = page.value("document.documentElement.scrollWidth")
        assert wide <= size[0], f"the step {step} is {wide} pixels wide on a screen of {size[0]}"
        overhang = page.value(OVERHANG)
        assert not overhang, f"wider than their cards in the step {step}, {scheme}{name}: {overhang}"
        if AXE.is_file():
            page.value(f"window.axe ? 0 : (() => {{ {AXE.read_text()} }})() || 0")
            found = page.value("axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => violations"
                               ".map(({ id, impact, nodes }) => [impact, id, nodes.map(({ html }) => html).slice(0, 5)]))")
            grave = [one for one in found if one[0] in ("serious", "critical")]
            assert not grave, f"barriers in the step {step}, {scheme}{name}: {grave}"
    page.size(*DESK)
    page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "light"}])


main()
