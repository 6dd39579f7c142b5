"""Makes a Debian package of the program: `deb.py PROGRAM-THAT-RUNS-HERE PROGRAM VERSION ARCHITECTURE FOLDER`.

The program is static and needs nothing. With it come a man page of each command and completions for bash, zsh and fish,
all of them said by the program itself. A package is an `ar` archive of two tar files (deb(5)); made again, it has the
same bytes.
"""

import hashlib
import pathlib
import re
import subprocess
import sys
import time

import archive

MAINTAINER = "The handeye authors <handeye@localhost>"
SHELLS = {
    "bash": "usr/share/bash-completion/completions/handeye",
    "zsh": "usr/share/zsh/vendor-completions/_handeye",
    "fish": "usr/share/fish/vendor_completions.d/handeye.fish",
}


def said(run: str, *words: str) -> str:
    """What the program says."""
    return subprocess.run([run, *words], check=True, capture_output=True, text=True).stdout


def roff(text: str) -> str:
    """Text as it is, for a man page."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"(?m)^([.'])", r"\\&\1", escaped)


def man_page(name: str, version: str, help_text: str) -> str:
    """A man page out of what `--help` says: the parts that begin at the left edge are its sections."""
    date = time.strftime("%Y-%m-%d", time.gmtime(archive.EPOCH))
    about, _, rest = help_text.partition("\n\n")
    lines = [f'.TH {name.upper()} 1 "{date}" "handeye {version}" "User Commands"', ".SH NAME"]
    lines.append(f"{name} \\- {roff(' '.join(about.split()))}")
    for part in re.split(r"\n(?=[A-Z][A-Za-z ]*:)", rest):
        title, colon, content = part.partition(":")
        if not colon or "\n" in title:
            title, content = "DESCRIPTION", part
        title = {"Usage": "SYNOPSIS"}.get(title, title)
        lines += [f".SH {title.strip().upper()}", ".nf", roff(content.strip("\n")), ".fi"]
    return "\n".join(lines) + "\n"


def commands(run: str) -> "list[str]":
    """Names of the commands, from the program's own help."""
    part = re.search(r"Commands:\n(.*?)\n\n", said(run, "--help"), re.S)
    assert part, "the help lists no commands"
    names = re.findall(r"(?m)^  ([a-z]+)\b", part[1])
    return [name for name in names if name != "help"]


def ar(files: "list[tuple[str, bytes]]") -> bytes:
    """An `ar` archive."""
    out = b"!<arch>\n"
    for name, content in files:
        out += f"{name:<16}{archive.EPOCH:<12}{0:<6}{0:<6}{'100644':<8}{len(content):<10}`\n".encode()
        out += content + b"\n" * (len(content) % 2)
    return out


def with_folders(files: "dict[str, tuple[bytes, int]]") -> "list[tuple[str, bytes, int]]":
    """Files and all folders that they are in, by their names."""
    folders = {str(parent) for name in files for parent in pathlib.PurePosixPath(name).parents} - {"."}
    entries = [("./", b"", 0o755)] + [(f"./{folder}/", b"", 0o755) for folder in folders]
    entries += [(f"./{name}", content, mode) for name, (content, mode) in files.items()]
    return sorted(entries)


def main() -> None:
    run, program, version, architecture, out = sys.argv[1:]
    root = pathlib.Path(__file__).parent.parent
    files = {"usr/bin/handeye": (pathlib.Path(program).read_bytes(), 0o755)}
    for shell, place in SHELLS.items():
        files[place] = (said(run, "completions", shell).encode(), 0o644)
    pages = {"handeye": said(run, "--help")}
    pages.update({f"handeye-{name}": said(run, name, "--help") for name in commands(run)})
    for name, text in pages.items():
        files[f"usr/share/man/man1/{name}.1.gz"] = (archive.compressed(man_page(name, version, text).encode()), 0o644)
    licences = "".join((root / name).read_text() + "\n" for name in ("LICENSE-MIT", "LICENSE-APACHE"))
    files["usr/share/doc/handeye/copyright"] = (f"MIT or Apache-2.0, as you like.\n\n{licences}".encode(), 0o644)
    change = archive.compressed((root / "CHANGELOG.md").read_bytes())
    files["usr/share/doc/handeye/changelog.gz"] = (change, 0o644)
    size = sum(len(content) for content, _ in files.values()) // 1024
    control = f"""Package: handeye
Version: {version}
Architecture: {architecture}
Maintainer: {MAINTAINER}
Installed-Size: {size}
Section: science
Priority: optional
Description: hand-eye calibration of robots and cameras
 The pose of a camera on a robot's flange or in its base, with its uncertainty
 and a verdict, from images, scans, robot poses and touched points.
"""
    sums = "".join(f"{hashlib.md5(content).hexdigest()}  {name}\n" for name, (content, _) in sorted(files.items()))
    inner = archive.tar([("./", b"", 0o755), ("./control", control.encode(), 0o644), ("./md5sums", sums.encode(), 0o644)])
    data = archive.compressed(archive.tar(with_folders(files)))
    parts = [("debian-binary", b"2.0\n"), ("control.tar.gz", archive.compressed(inner)), ("data.tar.gz", data)]
    path = pathlib.Path(out) / f"handeye_{version}_{architecture}.deb"
    path.write_bytes(ar(parts))
    print(path.name)


main()
