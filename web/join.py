"""Joins the page out of its parts and the program: `join.py PROGRAM.wasm PAGE.html`."""

import base64
import gzip
import pathlib
import re
import sys


def main() -> None:
    here = pathlib.Path(__file__).parent
    program, page = map(pathlib.Path, sys.argv[1:])
    # without a time in it, the same program gives the same bytes
    packed = gzip.compress(program.read_bytes(), 9, mtime=0)

    def part(found: "re.Match[str]") -> str:
        if found[1] == "program":
            return base64.b64encode(packed).decode()
        return (here / found[1]).read_text(encoding="utf-8").replace("</script", "<\\/script")

    whole = re.sub(r"\{\{([a-z.]+)\}\}", part, (here / "page.html").read_text(encoding="utf-8"))
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text(whole, encoding="utf-8")
    size = page.stat().st_size
    print(f"{page}: {size / 1e6:.1f} MB, the program {program.stat().st_size / 1e6:.1f} MB, packed {len(packed) / 1e6:.1f} MB")


main()
