// Moving: by pointer, by keys, by buttons.
// ---- moving

function run(milliseconds, change) {
  if (still) { change(1); draw(); return; }
  var began = performance.now(), mine = run.number = (run.number || 0) + 1;
  (function frame() {
    if (mine !== run.number) { return; }
    var s = Math.min(1, (performance.now() - began) / milliseconds);
    change(s * s * (3 - 2 * s)); draw();
    if (s < 1) { requestAnimationFrame(frame); }
  })();
}

function go(to) {
  var from = { yaw: look.yaw, pitch: look.pitch, distance: look.distance, centre: look.centre };
  var turn = Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
  run(350, function (s) {
    look.yaw = from.yaw + s * turn;
    look.pitch = from.pitch + s * (to.pitch - from.pitch);
    look.distance = from.distance * Math.pow(to.distance / from.distance, s);
    look.centre = add(from.centre, add(to.centre, from.centre, -1), s);
  });
}

function fit(yaw, pitch) {
  var to = fitting({ yaw: yaw, pitch: pitch, flat: look.flat });
  picked = null;
  go({ yaw: yaw, pitch: pitch, distance: to.distance, centre: to.centre });
}

/// Where to look from in another state, if not all of it is inside the view as it is.
function goalAt(to) {
  var now = state;
  state = to;
  var c = camera(), isOutside = box().all.some(function (p) {
    var q = apply(c.clip, p);
    return q[3] <= 0 || Math.abs(q[0]) > q[3] || Math.abs(q[1]) > q[3];
  });
  var goal = isOutside ? fitting(look) : null;
  state = now;
  return goal;
}

var VIEWS = {
  front: function () { fit(0, 0); },
  top: function () { fit(0, Math.PI / 2); },
  side: function () { fit(Math.PI / 2, 0); },
  fit: function () { fit(look.yaw, look.pitch); },
  perspective: function () { look.flat = 1 - look.flat; pressed("[data-view=perspective]", function () { return !look.flat; }); ask(); }
};

function pressed(which, is) {
  figure.querySelectorAll(which).forEach(function (button) { button.setAttribute("aria-pressed", is(button) ? "true" : "false"); });
}

function turn(dx, dy) {
  look.yaw += dx;
  look.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, look.pitch + dy));
  ask();
}

function move(dx, dy) {
  var a = axes(look), metre = 2 * FIELD * look.distance / canvas.clientHeight;
  look.centre = add(add(look.centre, a.right, -dx * metre), a.up, dy * metre);
  ask();
}

/// Nearer by a factor, with what is under the pointer staying there.
function zoom(factor, x, y) {
  var w = canvas.clientWidth, h = canvas.clientHeight, dx = (x === undefined ? 0 : x - w / 2), dy = (y === undefined ? 0 : y - h / 2);
  move(-dx, -dy);
  look.distance = Math.min(1e4, Math.max(1e-4, look.distance * factor));
  move(dx, dy);
}

/// The point under a place of the screen that is nearest to the eye.
function pick(x, y) {
  var c = camera(), w = canvas.clientWidth, h = canvas.clientHeight, best = null, depth = Infinity;
  data.layers.forEach(function (layer, n) {
    var made = gpu.layers[n].shape;
    if (!shown[n] || !made) { return; }
    var m = unpacking(layer), all = times(c.clip, m), cells = made.cells;
    for (var k = 0; k < cells.length; k += 3) {
      var p = [cells[k], cells[k + 1], cells[k + 2]], q = apply(all, p);
      if (q[3] <= 0) { continue; }
      var dx = (q[0] / q[3] + 1) * w / 2 - x, dy = (1 - q[1] / q[3]) * h / 2 - y, z = q[2] / q[3];
      if (dx * dx + dy * dy < 36 && z < depth) { depth = z; best = apply(m, p).slice(0, 3); }
    }
  });
  return best;
}

var held = new Map(), pressedAt = null;
function inside(e) { var r = canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; }
canvas.addEventListener("pointerdown", function (e) {
  run.number = (run.number || 0) + 1;
  held.set(e.pointerId, inside(e));
  pressedAt = held.size === 1 && e.button === 0 ? inside(e) : null;
  canvas.setPointerCapture(e.pointerId);
  canvas.classList.add("held");
});
canvas.addEventListener("pointerup", function (e) {
  var now = inside(e), isTouch = e.pointerType === "touch";
  if (!pressedAt || !captures.length || Math.hypot(now[0] - pressedAt[0], now[1] - pressedAt[1]) > (isTouch ? 9 : 4)) { return; }
  // a click beside all captures changes nothing: it may be the first of two, and Esc selects none
  var found = captureAt(now[0], now[1], isTouch ? 18 : 8);
  if (found >= 0) { choose(found); }
});
["pointerup", "pointercancel"].forEach(function (name) {
  canvas.addEventListener(name, function (e) { held.delete(e.pointerId); if (!held.size) { canvas.classList.remove("held"); } });
});
canvas.addEventListener("pointermove", function (e) {
  var was = held.get(e.pointerId), now = inside(e);
  if (!was) { return; }
  var dx = now[0] - was[0], dy = now[1] - was[1];
  if (held.size === 2) {
    var other = Array.from(held).filter(function (p) { return p[0] !== e.pointerId; })[0][1];
    move(dx / 2, dy / 2);
    var before = Math.hypot(was[0] - other[0], was[1] - other[1]), after = Math.hypot(now[0] - other[0], now[1] - other[1]);
    if (before > 5 && after > 5) { zoom(before / after, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2); }
  } else if (e.shiftKey || e.ctrlKey || (e.buttons & 6)) { move(dx, dy); } else { turn(-dx * 0.008, dy * 0.008); }
  held.set(e.pointerId, now);
});
canvas.addEventListener("contextmenu", function (e) { e.preventDefault(); });
canvas.addEventListener("wheel", function (e) {
  e.preventDefault();
  var at = inside(e), lines = e.deltaMode === 1 ? 30 : 1;
  zoom(Math.exp(Math.max(-120, Math.min(120, e.deltaY * lines)) * 0.0015), at[0], at[1]);
}, { passive: false });
canvas.addEventListener("dblclick", function (e) {
  var at = inside(e), found = pick(at[0], at[1]);
  if (!found) { fit(look.yaw, look.pitch); return; }
  picked = found;
  go({ yaw: look.yaw, pitch: look.pitch, distance: look.distance * 0.7, centre: found });
});
canvas.addEventListener("keydown", function (e) {
  if (e.altKey || e.ctrlKey || e.metaKey) { return; }
  var by = e.shiftKey ? function (x, y) { move(-x * 40, y * 40); } : function (x, y) { turn(x * 0.12, y * 0.12); };
  var keys = {
    ArrowLeft: function () { by(-1, 0); }, ArrowRight: function () { by(1, 0); }, ArrowUp: function () { by(0, 1); }, ArrowDown: function () { by(0, -1); },
    "+": function () { zoom(0.87); }, "=": function () { zoom(0.87); }, "-": function () { zoom(1.15); },
    w: function () { turn(0, 0.12); }, s: function () { turn(0, -0.12); }, a: function () { turn(-0.12, 0); }, d: function () { turn(0.12, 0); },
    "1": VIEWS.front, "2": VIEWS.top, "3": VIEWS.side, f: VIEWS.fit, Home: VIEWS.fit, p: VIEWS.perspective,
    ",": function () { grow(0.8); }, ".": function () { grow(1.25); }
  };
  if (captures.length && !e.shiftKey) {
    keys.ArrowLeft = keys.ArrowUp = function () { step(-1); };
    keys.ArrowRight = keys.ArrowDown = function () { step(1); };
    keys.Escape = function () { choose(-1); };
  }
  if (keys[e.key]) { e.preventDefault(); keys[e.key](); }
});

// ---- buttons and legend

function grow(factor) { size = Math.max(0.3, Math.min(8, size * factor)); ask(); }
figure.querySelectorAll(".bar button").forEach(function (button) {
  button.addEventListener("click", function () {
    var d = button.dataset;
    if (d.view) { VIEWS[d.view](); }
    if (d.size) { grow(Number(d.size)); }
    if (d.paint) { paint = d.paint; pressed("[data-paint]", function (b) { return b.dataset.paint === paint; }); ask(); }
    if (d.state) {
      var from = state, to = Number(d.state);
      pressed("[data-state]", function (b) { return b === button; });
      var was = look.centre, far = look.distance, goal = goalAt(to);
      run(600, function (s) {
        state = from + s * (to - from);
        if (goal) { look.centre = add(was, add(goal.centre, was, -1), s); look.distance = far * Math.pow(goal.distance / far, s); }
      });
    }
  });
});
figure.querySelectorAll("[data-layer]").forEach(function (tick) {
  var numbers = tick.dataset.layer.split(" ").map(Number);
  function update() { numbers.forEach(function (k) { shown[k] = tick.checked; }); }
  update();
  tick.addEventListener("change", function () { update(); ask(); });
});
var range = figure.querySelector(".values input");
if (range) {
  var ticks = figure.querySelector(".ticks"), said = figure.querySelector(".values output");
  var least = Math.log(data.top_mm / 20), most = Math.log(Math.max(data.most_mm, data.top_mm * 2));
  var tell = function () {
    said.textContent = Number(top.toPrecision(2)) + " mm";
    ticks.innerHTML = "";
    [0, 0.25, 0.5, 0.75, 1].forEach(function (s) {
      var tick = document.createElement("span");
      tick.textContent = (s === 1 ? "≥ " : "") + Number((s * top).toPrecision(2)) + (s === 1 ? " mm" : "");
      ticks.appendChild(tick);
    });
  };
  range.value = String(100 * (Math.log(data.top_mm) - least) / (most - least));
  range.addEventListener("input", function () { top = Math.exp(least + Number(range.value) / 100 * (most - least)); tell(); ask(); });
  tell();
}

// ---- what happens around it

canvas.addEventListener("webglcontextlost", function (e) { e.preventDefault(); });
canvas.addEventListener("webglcontextrestored", function () { build(); ask(); });
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", ask);
window.addEventListener("beforeprint", function () { printing = true; draw(); });
window.addEventListener("afterprint", function () { printing = false; draw(); });
new ResizeObserver(draw).observe(canvas); // before it is painted, so never stretched
build();
draw();