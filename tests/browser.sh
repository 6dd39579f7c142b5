#!/usr/bin/env bash
# Opens pages in a real browser, without a network, and looks at what they draw: the verdict is there, the
# 3D view is not blank, turns, and is blank without its layers; nothing is loaded from elsewhere and no script
# fails. Where there is no WebGL, a sentence stands in its place.
set -euo pipefail
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [ -z "$browser" ]; then echo "SKIPPED: no chromium to open the pages with"; exit 0; fi
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
flags=(--headless --no-sandbox --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --no-first-run
  --disable-background-networking --disable-component-update --disable-sync --disable-quic
  --force-prefers-reduced-motion --user-data-dir="$work/profile" --window-size=1120,1400
  --enable-logging=stderr --v=0)
# a probe that uses the view and writes what it drew, appended to a copy of the page
cat > "$work/probe.html" <<'PROBE'
<script>
window.addEventListener("load", function () {
  var figure = document.querySelector("figure.scene"), canvas = figure.querySelector("canvas.solid");
  var missing = getComputedStyle(figure.querySelector(".missing")).display !== "none";
  // pixels that are not the background, which is the same along a row
  function drawn() {
    var copy = document.createElement("canvas"), count = 0, sum = 0;
    copy.width = canvas.width; copy.height = canvas.height;
    var context = copy.getContext("2d");
    context.drawImage(canvas, 0, 0);
    var d = context.getImageData(0, 0, copy.width, copy.height).data, row = 4 * copy.width;
    for (var k = 0; k < d.length; k += 4) {
      var first = k - k % row;
      if (Math.abs(d[k] - d[first]) + Math.abs(d[k + 1] - d[first + 1]) + Math.abs(d[k + 2] - d[first + 2]) > 24) {
        count++; sum = (sum * 31 + k) % 1000000007;
      }
    }
    return { count: count, sum: sum };
  }
  function press(name) { figure.querySelector(name).click(); return drawn(); }
  var said = "drawn=none turned=no states=no empty=none", two = figure.querySelector("[data-state]");
  if (!missing) {
    var first = drawn(), top = press("[data-view=top]");
    var before = two ? press("[data-state='0']") : null;
    figure.querySelectorAll("[data-layer]").forEach(function (tick) { if (tick.checked) { tick.click(); } });
    requestAnimationFrame(function () { requestAnimationFrame(function () {
      write("drawn=" + first.count + " turned=" + (top.sum !== first.sum ? "yes" : "no") +
        " states=" + (!two || before.sum !== top.sum ? "yes" : "no") + " empty=" + drawn().count);
    }); });
  } else { write(said); }
  function write(text) {
    var p = document.createElement("p");
    p.id = "probe"; p.textContent = text + " missing=" + (missing ? "yes" : "no");
    document.body.appendChild(p);
  }
});
</script></body>
PROBE
failed() { echo "$page: $*"; exit 1; }
open_page() { # further flags
  sed -e "/<\/body>/{s///;r $work/probe.html
}" "$page" > "$work/page.html"
  # a browser that falls over, or is too slow, on a busy machine says nothing of the page
  for attempt in 1 2 3; do
    "$browser" "${flags[@]}" "$@" --virtual-time-budget=5000 --dump-dom "file://$work/page.html" \
      > "$work/dom.html" 2> "$work/log" && grep -q 'id="probe">' "$work/dom.html" && break
    if [ "$attempt" = 3 ]; then failed "the page did not come to its end: $(tail -3 "$work/log")"; fi
  done
  if grep -E 'Uncaught|SyntaxError|CONSOLE.*(rror|WebGL)' "$work/log"; then failed "a script failed"; fi
  probe=$(grep -o 'id="probe">[^<]*' "$work/dom.html" | tail -1 | cut -d'>' -f2)
}
for page in "$@"; do
  page=$(realpath "$page")
  if ! grep -q '<h1>View' "$page"; then
    grep -q 'class="verdict ' "$page" || failed "no verdict in the page"
  fi
  if grep -oE '(src|href)="(https?:)?//[^"]*"' "$page"; then failed "the page loads from elsewhere"; fi
  open_page
  drawn=$(grep -o 'drawn=[0-9]*' <<< "$probe" | cut -d= -f2)
  [ "${drawn:-0}" -gt 2000 ] || failed "the 3D view is blank ($probe)"
  [[ $probe == *turned=yes* ]] || failed "the 3D view does not turn ($probe)"
  [[ $probe == *states=yes* ]] || failed "before and after look the same ($probe)"
  [[ $probe == *empty=0* ]] || failed "layers cannot be switched off ($probe)"
  echo "$(basename "$page") opened: the 3D view drew $drawn pixels and turns; nothing loaded from elsewhere"
done
open_page --disable-gpu --disable-3d-apis
[[ $probe == *missing=yes* ]] || failed "no word where there is no WebGL ($probe)"
echo "without WebGL a sentence stands in its place"
