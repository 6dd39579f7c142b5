"""Packs a folder as an archive that is the same whenever it is made: `archive.py FOLDER OUT`.

A ZIP where the folder holds a program for Windows, else a `tar.gz`. All files carry the time of `SOURCE_DATE_EPOCH`.
"""

import gzip
import io
import os
import pathlib
import sys
import tarfile
import time
import zipfile

EPOCH = int(os.environ.get("SOURCE_DATE_EPOCH", "0"))
PROGRAMS = {"handeye", "handeye.exe"}


def tar(files: "list[tuple[str, bytes, int]]") -> bytes:
    """A tar file, `(name, content, mode)` each; folders come before what is in them."""
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w", format=tarfile.GNU_FORMAT) as archive:
        for name, content, mode in files:
            about = tarfile.TarInfo(name)
            about.mtime, about.mode = EPOCH, mode
            about.uname = about.gname = "root"
            if name.endswith("/"):
                about.type = tarfile.DIRTYPE
                archive.addfile(about)
            else:
                about.size = len(content)
                archive.addfile(about, io.BytesIO(content))
    return out.getvalue()


def compressed(content: bytes) -> bytes:
    """With gzip, and without a time in it."""
    return gzip.compress(content, 9, mtime=0)


def main() -> None:
    folder, out = map(pathlib.Path, sys.argv[1:])
    files = sorted(folder.iterdir())
    if any(file.name.endswith(".exe") for file in files):
        # ZIP counts from 1980
        when = time.gmtime(max(EPOCH, 315_532_800))[:6]
        path = pathlib.Path(f"{out}.zip")
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
            for file in files:
                about = zipfile.ZipInfo(f"{folder.name}/{file.name}", when)
                about.compress_type = zipfile.ZIP_DEFLATED
                about.external_attr = (0o755 if file.name in PROGRAMS else 0o644) << 16
                archive.writestr(about, file.read_bytes(), compresslevel=9)
    else:
        path = pathlib.Path(f"{out}.tar.gz")
        inside = [(f"{folder.name}/", b"", 0o755)]
        for file in files:
            inside.append((f"{folder.name}/{file.name}", file.read_bytes(), 0o755 if file.name in PROGRAMS else 0o644))
        path.write_bytes(compressed(tar(inside)))
    print(path.name)


if __name__ == "__main__":
    main()
