"""Makes the wheel for Windows out of one for Linux and the module for Windows: `wheel.py WHEEL MODULE.dll FOLDER`.

The wheels are the same but for the compiled module and the platform in their names. The build tool for wheels links
modules inside a package for this target by a name with a dot, which no module has; so this one is put together here.
"""

import base64
import hashlib
import pathlib
import sys
import time
import zipfile

import archive

PLATFORM = "win_amd64"


def digest(content: bytes) -> str:
    """As RECORD has it."""
    return "sha256=" + base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def main() -> None:
    linux, module, out = map(pathlib.Path, sys.argv[1:])
    with zipfile.ZipFile(linux) as wheel:
        files = {about.filename: wheel.read(about) for about in wheel.infolist()}
    [library] = [name for name in files if name.endswith(".abi3.so")]
    [about] = [name for name in files if name.endswith(".dist-info/WHEEL")]
    record = about.replace("WHEEL", "RECORD")
    del files[library], files[record]
    files[library.replace(".abi3.so", ".pyd")] = module.read_bytes()
    lines = [line for line in files[about].decode().splitlines() if not line.startswith("Tag: ")]
    files[about] = "\n".join([*lines, f"Tag: cp39-abi3-{PLATFORM}", ""]).encode()
    rows = [f"{name},{digest(content)},{len(content)}" for name, content in sorted(files.items())]
    files[record] = "\n".join([*rows, f"{record},,", ""]).encode()
    front = linux.name.split("-manylinux")[0]
    path = out / f"{front}-{PLATFORM}.whl"
    # ZIP counts from 1980
    when = time.gmtime(max(archive.EPOCH, 315_532_800))[:6]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as wheel:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, when)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            wheel.writestr(entry, content, compresslevel=9)
    print(path.name)


main()
