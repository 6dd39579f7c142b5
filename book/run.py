#!/usr/bin/env python3
"""Runs every code block of the book, and compares what the book shows with what the programs print.

    book/run.py                     run all pages; exit code 1 where a block fails or an output differs
    book/run.py --write             put the real outputs into the pages
    book/run.py tutorial.md ...     these pages only

The program is target/release/handeye, or $HANDEYE; Python blocks run with the interpreter that runs this
script, where the package `handeye` must be installed.

Blocks of a page run in order, in one fresh folder:

    ```sh               by bash; `exit=3` behind it names another exit code than 0
    ```python           one interpreter for the whole page
    ```text             directly behind a block: what that block prints
    ```rust             compiled and run by rustdoc, against the library that lies beside the program
    ```toml             a manifest, or a part of one: the program must know every key
    ```json             must be JSON
    ```math             a formula in LaTeX; $`x`$ within a line
    ``` ... file=NAME   is written into the page's folder under that name
    ``` ... norun       is neither run nor parsed

    <!-- sh             a block that is run and not shown
    ...
    -->

Beside that: links between pages, pages missing in SUMMARY.md, warning codes of the program that the page of
codes does not explain, and DOIs that references.bib and the page of references do not both have.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from urllib.parse import unquote

BOOK = Path(__file__).resolve().parent
ROOT = BOOK.parent
SOURCE = BOOK / "src"
CODES = SOURCE / "trouble" / "codes.md"
SECONDS = 120

# what runs the Python blocks of a page: code comes in as a JSON string a line, output ends with a mark
DRIVER = r"""
import io, json, sys, traceback
from contextlib import redirect_stdout, redirect_stderr
space = {"__name__": "__main__"}
for line in sys.stdin:
    out, failed = io.StringIO(), False
    with redirect_stdout(out), redirect_stderr(out):
        try:
            exec(compile(json.loads(line), "block", "exec"), space)
        except BaseException:
            failed = True
            traceback.print_exc(limit=0)
    sys.__stdout__.write(json.dumps([failed, out.getvalue()]) + "\n")
    sys.__stdout__.flush()
"""


class Block:
    """A fenced block, or one in a comment."""

    def __init__(self, language, options, line, body, first, last):
        self.language, self.options, self.line = language, options, line
        self.body, self.first, self.last = body, first, last

    @property
    def text(self):
        return "".join(self.body)


def blocks(lines):
    """All blocks of a page; `first` and `last` bound the lines of the body."""
    found, k = [], 0
    while k < len(lines):
        fence = re.match(r"^(`{3,})(\S*)\s*(.*)$", lines[k])
        hidden = re.match(r"^<!-- (sh|python)( .*)?$", lines[k].rstrip("\n"))
        if fence or hidden:
            end = fence.group(1) if fence else "-->"
            language = fence.group(2) if fence else hidden.group(1)
            words = (fence.group(3) if fence else hidden.group(2) or "").split()
            options = dict(w.split("=", 1) if "=" in w else (w, "") for w in words)
            last = k + 1
            while last < len(lines) and lines[last].rstrip() != end:
                last += 1
            if last == len(lines):
                raise SystemExit(f"line {k + 1}: the block has no end")
            found.append(Block(language, options, k + 1, lines[k + 1 : last], k + 1, last))
            k = last
        k += 1
    return found


def follows(lines, block, other):
    """Whether nothing but blank lines lies between two blocks."""
    return not "".join(lines[block.last + 1 : other.first - 1]).strip()


def plain(text):
    """Without what differs from run to run, or cannot be seen."""
    return "".join(line.rstrip() + "\n" for line in text.splitlines())


class Page:
    """One page, run in a folder of its own."""

    def __init__(self, path, program):
        self.path, self.program = path, program
        self.name = str(path.relative_to(SOURCE))
        self.lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
        self.blocks = blocks(self.lines)
        self.problems, self.outputs, self.python = [], [], None
        self.count = 0

    def problem(self, line, what):
        self.problems.append(f"{self.name}:{line}: {what}")

    def run(self):
        began = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="book") as folder:
            self.folder = Path(folder)
            self.environment = dict(
                os.environ,
                PATH=os.pathsep.join(
                    [str(self.program.parent), str(Path(sys.executable).parent), os.environ["PATH"]]
                ),
                BOOK=str(BOOK),
                LC_ALL="C.UTF-8",
                COLUMNS="80",
                NO_COLOR="1",
                SOURCE_DATE_EPOCH="1773480413",  # results say when they were made
                PYTHONDONTWRITEBYTECODE="1",
            )
            try:
                for k, block in enumerate(self.blocks):
                    after = self.blocks[k + 1] if k + 1 < len(self.blocks) else None
                    shown = (
                        after
                        if after and after.language == "text" and follows(self.lines, block, after)
                        else None
                    )
                    self.one(block, shown)
            finally:
                if self.python:
                    self.python.kill()
                    self.python.wait()
        self.rust()
        self.seconds = time.monotonic() - began
        return self

    def one(self, block, shown):
        options = block.options
        if "file" in options:
            (self.folder / options["file"]).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / options["file"]).write_text(block.text, encoding="utf-8")
        if "norun" in options:
            return
        if block.language == "sh":
            output = self.shell(block)
        elif block.language == "python":
            output = self.interpret(block)
        elif block.language == "toml":
            return self.manifest(block)
        elif block.language == "json":
            try:
                json.loads(block.text)
            except ValueError as error:
                self.problem(block.line, f"no JSON: {error}")
            return
        elif block.language in ("text", "math", "rust", "csv", "cpp", "ini", "xml", "yaml", "bibtex", ""):
            return
        else:
            return self.problem(block.line, f"blocks of {block.language!r} are not known")
        self.count += 1
        if shown is not None and output is not None:
            self.outputs.append((shown, output))
            if plain(output) != plain(shown.text):
                self.problem(shown.line, "the book shows another output than this:\n" + output)

    def shell(self, block):
        run = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", block.text],
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            timeout=SECONDS,
        )
        expected = int(block.options.get("exit", 0))
        if run.returncode != expected:
            self.problem(block.line, f"exit code {run.returncode}, not {expected}:\n{run.stdout}")
            return None
        return run.stdout

    def interpret(self, block):
        if self.python is None:
            self.python = subprocess.Popen(
                [sys.executable, "-c", DRIVER],
                cwd=self.folder,
                env=self.environment,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                encoding="utf-8",
            )
        self.python.stdin.write(json.dumps(block.text) + "\n")
        self.python.stdin.flush()
        answer = self.python.stdout.readline()
        failed, output = json.loads(answer) if answer else (True, "the interpreter ended")
        if failed != ("raises" in block.options):
            self.problem(block.line, f"the Python block fails, or should:\n{output}")
            return None
        return output

    def manifest(self, block):
        """The program reads it; files that it names need not be there."""
        text = block.text
        if not re.search(r"^setup\s*=", text, re.MULTILINE):
            text = 'setup = "eye-in-hand"\n' + text
        with tempfile.TemporaryDirectory(prefix="book") as folder:
            Path(folder, "handeye.toml").write_text(text, encoding="utf-8")
            run = subprocess.run(
                [self.program, "calibrate", folder, "--json"], capture_output=True, encoding="utf-8"
            )
        self.count += 1
        error = json.loads(run.stdout).get("error") or {}
        words = ("unknown field", "unknown variant", "TOML", "expected", "missing field", "duplicate")
        if error.get("code") == "malformed" and any(w in error["message"] for w in words):
            self.problem(block.line, error["message"])

    def rust(self):
        """By rustdoc, against the libraries of the last build."""
        rust = [b for b in self.blocks if b.language == "rust" and "norun" not in b.options]
        if not rust:
            return
        library = self.program.parent / "libhandeye.rlib"
        if not shutil.which("rustdoc") or not library.exists():
            print(f"{self.name}: no rustdoc, or no {library}: its Rust blocks are skipped")
            return
        self.count += len(rust)
        beside = library.parent / "deps"
        # several builds of one library may lie there; one of them is the program's
        for algebra in sorted(beside.glob("libnalgebra-*.rlib"), key=lambda f: -f.stat().st_mtime):
            with tempfile.TemporaryDirectory(prefix="book") as folder:
                page = Path(folder, "page.md")
                page.write_text("".join(f"```rust\n{block.text}```\n\n" for block in rust), encoding="utf-8")
                run = subprocess.run(
                    ["rustdoc", "--test", "--edition", "2024", "--extern", f"handeye={library}"]
                    + ["--extern", f"handeye_io={library.with_name('libhandeye_io.rlib')}"]
                    + ["--extern", f"nalgebra={algebra}", "-L", f"dependency={beside}", str(page)],
                    capture_output=True,
                    encoding="utf-8",
                )
            if run.returncode == 0:
                return
        self.problem(rust[0].line, "Rust blocks fail:\n" + run.stdout + run.stderr)

    def write(self):
        lines = list(self.lines)
        for shown, output in reversed(self.outputs):
            lines[shown.first : shown.last] = [line + "\n" for line in plain(output).splitlines()]
        text = "".join(lines)
        if text != "".join(self.lines):
            self.path.write_text(text, encoding="utf-8")
            print(f"{self.name}: written")


def prose(text):
    """Without fenced blocks and code, where nothing is a link."""
    text = re.sub(r"^(`{3,}).*?^\1\s*$", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def slug(heading):
    """The anchor that mdBook gives a heading."""
    heading = re.sub(r"[`*]", "", heading.strip().lower())
    return "".join(c for c in heading.replace(" ", "-") if c.isalnum() or c in "-_")


def included(path):
    """The text of a page with the files that it includes."""
    text = path.read_text(encoding="utf-8")

    def content(match):
        name, _, anchor = match.group(1).partition(":")
        file = path.parent / name
        if not file.exists():
            return ""
        inside = file.read_text(encoding="utf-8")
        if anchor:
            part = re.search(rf"ANCHOR: {anchor}\b(.*?)ANCHOR_END: {anchor}\b", inside, re.DOTALL)
            inside = part.group(1) if part else ""
        return inside

    return re.sub(r"\{\{#include ([^}]+)\}\}", content, text)


def links():
    """Broken links and includes, and pages that the summary does not name."""
    pages = sorted(SOURCE.rglob("*.md"))
    anchors = {
        p: {slug(h) for h in re.findall(r"^#+ (.*)$", included(p), re.MULTILINE)} for p in pages
    }
    problems = keys_of_the_manifest()
    for page in pages:
        name, text = page.relative_to(SOURCE), page.read_text(encoding="utf-8")
        for target in re.findall(r"\{\{#include ([^}]+)\}\}", text):
            file, _, anchor = target.partition(":")
            there = page.parent / file
            if not there.exists() or (anchor and f"ANCHOR: {anchor}" not in there.read_text()):
                problems.append(f"{name}: nothing to include: {target}")
        targets = re.findall(r"\]\(([^)\s]+)\)", prose(text)) + re.findall(r'src="([^"]+)"', text)
        for target in targets:
            if re.match(r"^(https?|mailto):", target):
                continue
            file, _, anchor = target.partition("#")
            there = (page.parent / file).resolve() if file else page
            if not there.exists():
                problems.append(f"{name}: no such file: {target}")
            elif anchor and there.suffix == ".md" and anchor not in anchors.get(there, ()):
                problems.append(f"{name}: no such heading: {target}")
    summary = set(re.findall(r"\]\(([^)]+\.md)\)", (SOURCE / "SUMMARY.md").read_text()))
    for page in pages:
        name = str(page.relative_to(SOURCE))
        if name != "SUMMARY.md" and name not in summary:
            problems.append(f"{name}: not in SUMMARY.md")
    return problems


def references():
    """DOIs of the pages that references.bib does not have, and its DOIs that the page of references does not show."""
    known = re.findall(r"^\s*doi\s*=\s*\{(.+)\},?$", (SOURCE / "references.bib").read_text(encoding="utf-8"), re.MULTILINE)
    problems = []
    for page in sorted(SOURCE.rglob("*.md")):
        name, text = page.relative_to(SOURCE), page.read_text(encoding="utf-8")
        linked = {unquote(doi) for doi in re.findall(r"\]\(https://doi\.org/([^)\s]+)\)", text)}
        problems += [f"{name}: not in references.bib: {doi}" for doi in sorted(linked - set(known))]
        if page == SOURCE / "references.md":
            problems += [f"{name}: the DOI {doi} of references.bib is missing" for doi in known if doi not in linked]
    return problems


def keys_of_the_manifest():
    """Keys of the schema that neither the page of the manifest nor that of joint values names."""
    page, joints = SOURCE / "files" / "manifest.md", SOURCE / "robots" / "joints.md"
    schema = json.loads((ROOT / "crates/handeye-io/schema/handeye.schema.json").read_text(encoding="utf-8"))
    text = page.read_text(encoding="utf-8") + joints.read_text(encoding="utf-8")
    named = set(re.findall(r"[a-z_]+", text))

    def keys(part):
        if isinstance(part, dict):
            yield from (k for k in part.get("properties", {}))
            for value in part.values():
                yield from keys(value)
        elif isinstance(part, list):
            for value in part:
                yield from keys(value)

    missing = sorted({k for k in keys(schema) if k not in named})
    return [f"{page.relative_to(SOURCE)}: the key {k} is not explained" for k in missing]


def codes_of_the_program():
    """Codes of warnings and of what `check` finds, as they stand in the sources."""
    word = r'"([a-z0-9]+(?:-[a-z0-9]+)*)"'
    found = set()
    for file in sorted(ROOT.glob("crates/*/src/**/*.rs")):
        text = file.read_text(encoding="utf-8").split("#[cfg(test)]\nmod tests {")[0]
        if file.name == "tests.rs":
            continue
        if file.parent.name == "findings":
            found.update(re.findall(rf": Row =\s+Row::[a-z]+\(\s*{word}", text))
        direct = re.findall(rf"Warning::new\(\s*(?:{word}|code\b)", text)
        found.update(code for code in direct if code)
        if "" in direct:  # a variable, whose values stand as the first of a pair
            found.update(re.findall(r'[(\s]\(?"([a-z0-9]+(?:-[a-z0-9]+)+)",\s', text))
    for file in sorted((ROOT / "crates/handeye-io/src/checkup").glob("*.rs")):
        found.update(re.findall(rf"(?:\bFinding::.* =>|\bExplanation::new\() ?{word}", file.read_text(encoding="utf-8")))
    return found


def codes():
    """Every code has an entry, and every entry a code."""
    known = codes_of_the_program()
    entries = set(re.findall(r"^### `([a-z0-9-]+)`", CODES.read_text(encoding="utf-8"), re.MULTILINE))
    name = CODES.relative_to(SOURCE)
    return [f"{name}: the code {c} is not explained" for c in sorted(known - entries)] + [
        f"{name}: the program has no code {c}" for c in sorted(entries - known)
    ]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("pages", nargs="*", help="pages to run, below src/ [all]")
    parser.add_argument("--write", action="store_true", help="put the real outputs into the pages")
    parser.add_argument("--times", action="store_true", help="say how long each page took")
    args = parser.parse_args()

    program = Path(os.environ.get("HANDEYE", ROOT / "target" / "release" / "handeye")).absolute()
    if not program.exists():
        sys.exit(f"no {program}: cargo build --release --locked, or set HANDEYE")
    wanted = [SOURCE / p for p in args.pages] or sorted(SOURCE.rglob("*.md"))
    began = os.times()
    with ThreadPoolExecutor(max_workers=max(1, min(4, os.cpu_count() or 1))) as pool:
        pages = list(pool.map(Page.run, [Page(p, program) for p in wanted]))
    problems = [problem for page in pages for problem in page.problems]
    if not args.pages:
        problems += links() + codes() + references()
    if args.write:
        for page in pages:
            page.write()
    if args.times:
        for page in sorted(pages, key=lambda p: p.seconds):
            print(f"{page.seconds:7.2f} s  {page.name}")
    ended = os.times()
    cpu = ended.children_user + ended.children_system - began.children_user - began.children_system
    for problem in problems:
        print(problem)
    blocks_run = sum(page.count for page in pages)
    print(f"{len(pages)} pages, {blocks_run} blocks run, {cpu:.0f} s of processor: ", end="")
    print(f"{len(problems)} problems" if problems else "all as the book says")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
