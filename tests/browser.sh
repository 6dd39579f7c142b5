#!/usr/bin/env bash
# Opens a report in a real browser, without a network, and looks at what it drew: the verdict is
# there, the 3D view was drawn, nothing was loaded from elsewhere and no script failed.
set -euo pipefail
page=$(realpath "$1")
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [ -z "$browser" ]; then echo "SKIPPED: no chromium to open the report with"; exit 0; fi
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
flags=(--headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking
  --disable-component-update --disable-sync --disable-quic --user-data-dir="$work/profile"
  --window-size=1120,2400 --enable-logging=stderr --v=0)
# a probe that writes what the canvas holds into the page's title, appended to a copy of the page
sed 's#</body>#<script>window.addEventListener("load",function(){var c=document.querySelector("canvas.scene");var n=0;if(c){var d=c.getContext("2d").getImageData(0,0,c.width,c.height).data;for(var i=3;i<d.length;i+=4){if(d[i])n++;}}var p=document.createElement("p");p.id="probe";p.textContent="drawn="+n;document.body.appendChild(p);});</script></body>#' \
  "$page" > "$work/page.html"
"$browser" "${flags[@]}" --dump-dom "file://$work/page.html" > "$work/dom.html" 2> "$work/log"
grep -q 'class="verdict ' "$work/dom.html" || { echo "no verdict in the page"; exit 1; }
drawn=$(grep -o 'drawn=[0-9]*' "$work/dom.html" | tail -1 | cut -d= -f2)
[ "${drawn:-0}" -gt 500 ] || { echo "the 3D view drew ${drawn:-0} pixels"; exit 1; }
if grep -E 'Uncaught|SyntaxError' "$work/log"; then echo "a script failed"; exit 1; fi
if grep -oE '(src|href)="https?://[^"]*"' "$page"; then echo "the page loads from elsewhere"; exit 1; fi
echo "report opened: verdict shown, 3D view drew $drawn pixels, nothing loaded from elsewhere"
