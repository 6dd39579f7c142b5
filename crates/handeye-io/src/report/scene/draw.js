// Where things are, and drawing them.
// ---- where things are

function placeOf(layer) {
  var all = layer.places;
  if (!all.length) { return rigid([0, 0, 0], [0, 0, 0, 1]); }
  if (all.length === 1) { return rigid(all[0].translation, all[0].rotation); }
  return between(all[0], all[1], state);
}

/// Corners of the box around a body, in its own frame.
function corners(body) {
  var low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  body.lines.concat(body.faces).forEach(function (part) { part.points.forEach(function (p) {
    for (var k = 0; k < 3; k++) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); }
  }); });
  return [0, 1, 2, 3, 4, 5, 6, 7].map(function (k) { return [k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]]; });
}

function ends(layer) {
  var all = [], place = placeOf(layer);
  if (layer.shape) {
    var f = layer.shape.focus;
    for (var k = 0; k < 8; k++) { all.push(apply(place, [f[k & 1][0], f[k >> 1 & 1][1], f[k >> 2][2]])); }
  }
  layer.lines.forEach(function (line) { line.points.forEach(function (p) { all.push(apply(place, p)); }); });
  (layer.bodies || []).forEach(function (body) {
    if (body.is_aside || body.is_for_selected) { return; }
    var own = corners(body);
    body.copies.forEach(function (copy) { var m = rigid(copy.translation, copy.rotation); own.forEach(function (p) { all.push(apply(m, p)); }); });
  });
  if (layer.has_links) { data.captures.forEach(function (k) { if (k.is_used && k.links) { all.push.apply(all, k.links); } }); }
  return all;
}

/// The box around all that is shown, as long as that is the same.
function box() {
  var key = shown.join() + state;
  if (!box.found || box.key !== key) { box.key = key; box.found = boxNow(); }
  return box.found;
}

function boxNow() {
  var some = data.layers.filter(function (layer, k) { return shown[k] && !layer.is_ground; });
  var all = [].concat.apply([], (some.length ? some : data.layers).map(ends));
  var low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  all.forEach(function (p) { for (var k = 0; k < 3; k++) { low[k] = Math.min(low[k], p[k]); high[k] = Math.max(high[k], p[k]); } });
  if (!all.length) { low = [-0.5, -0.5, -0.5]; high = [0.5, 0.5, 0.5]; }
  return { low: low, high: high, all: all };
}

function axes(l) {
  var R = data.basis[0], F = data.basis[1], U = data.basis[2];
  var cy = Math.cos(l.yaw), sy = Math.sin(l.yaw), cp = Math.cos(l.pitch), sp = Math.sin(l.pitch);
  var right = [0, 1, 2].map(function (k) { return cy * R[k] + sy * F[k]; });
  var back = [0, 1, 2].map(function (k) { return cp * (sy * R[k] - cy * F[k]) + sp * U[k]; });
  var up = [0, 1, 2].map(function (k) { return -sp * (sy * R[k] - cy * F[k]) + cp * U[k]; });
  return { right: right, up: up, back: back };
}

/// Centre and distance at which everything shown is just inside, with a margin: the planes of the view's sides touch it.
function fitting(l) {
  var b = box(), a = axes(l), w = canvas.clientWidth || 1, h = canvas.clientHeight || 1, flat = l.flat > 0.5;
  var middle = b.low.map(function (v, k) { return (v + b.high[k]) / 2; });
  function along(axis, slope) {
    var most = -Infinity, least = -Infinity;
    b.all.forEach(function (p) {
      var d = add(p, middle, -1), s = dot(d, axis), z = flat ? 0 : slope * dot(d, a.back);
      most = Math.max(most, s + z); least = Math.max(least, z - s);
    });
    return b.all.length ? { at: (most - least) / 2, distance: (most + least) / (2 * slope) } : { at: 0, distance: 1 };
  }
  // above stand the buttons
  var bars = figure.querySelector(".bars"), free = bars ? bars.offsetHeight + 24 : 24, room = Math.max(0.4, 1 - (free + 36) / h), x = along(a.right, 0.9 * FIELD * w / h), y = along(a.up, room * FIELD);
  var distance = Math.max(x.distance, y.distance, 1e-3);
  return { centre: add(add(middle, a.right, x.at), a.up, y.at + distance * FIELD * (free - 36) / h), distance: distance };
}

function camera() {
  var a = axes(look), w = canvas.width, h = canvas.height, d = look.distance, flat = look.flat > 0.5;
  var b = box(), reach = Math.hypot.apply(null, b.high.map(function (v, k) { return v - b.low[k]; })) + d;
  var eye = add(look.centre, a.back, flat ? d + reach : d);
  var view = [a.right[0], a.up[0], a.back[0], 0, a.right[1], a.up[1], a.back[1], 0, a.right[2], a.up[2], a.back[2], 0,
    -dot(a.right, eye), -dot(a.up, eye), -dot(a.back, eye), 1];
  var near = flat ? 0 : d * 0.02, far = d + 3 * reach;
  var wide = FIELD * w / h, lens;
  if (flat) {
    lens = [1 / (wide * d), 0, 0, 0, 0, 1 / (FIELD * d), 0, 0, 0, 0, -2 / (far - near), 0, 0, 0, -(far + near) / (far - near), 1];
  } else {
    lens = [1 / wide, 0, 0, 0, 0, 1 / FIELD, 0, 0, 0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0];
  }
  return { view: view, lens: lens, clip: times(lens, view), flat: flat, near: near, axes: a, away: flat ? 1 + reach / d : 1 };
}

// ---- drawing

function ask() {
  if (!asked) { asked = true; requestAnimationFrame(function () { asked = false; draw(); }); }
}

function style(name) { return getComputedStyle(figure).getPropertyValue(name).trim(); }

function draw() {
  var w = canvas.clientWidth, h = canvas.clientHeight;
  if (!w || !h || gl.isContextLost()) { return; }
  ratio = Math.min(3, Math.max(2, window.devicePixelRatio || 1));
  ratio = Math.min(ratio, Math.sqrt(MOST_PIXELS / (w * h)));
  var pw = Math.round(w * ratio), ph = Math.round(h * ratio);
  if (canvas.width !== pw || canvas.height !== ph) { canvas.width = pw; canvas.height = ph; }
  if (!first) { first = fitting(look); look.centre = first.centre; look.distance = first.distance; }
  var c = camera();
  target(pw, ph);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gpu.frame);
  gl.viewport(0, 0, pw, ph);
  gl.clearColor(0, 0, 0, 1); gl.clearDepth(1); gl.depthMask(true);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST); gl.depthFunc(gl.LEQUAL); gl.disable(gl.BLEND);
  data.layers.forEach(function (layer, k) { if (isDrawn(k) && gpu.layers[k].shape) { solid(layer, gpu.layers[k].shape, c, ph); } });
  bodies(c, "solid", gpu.face);
  arm(c);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  light(c, pw, ph);
  strokes(c, pw, ph);
  annotate(c, w, h);
  var at = chosen >= 0 && onScreen(c, captures[chosen].at, w, h);
  if (at) { figure.dataset.at = at[0].toFixed(1) + " " + at[1].toFixed(1); }
  figure.dataset.drawn = String(data.layers.filter(function (l, k) { return shown[k]; }).length);
}

/// Scans of other captures are not drawn while one is selected.
function isDrawn(k) {
  var own = data.layers[k].capture;
  return shown[k] && (own === undefined || chosen < 0 || own === chosen);
}

/// The capture at which what moves is drawn in full: that which is selected, or the first one.
function standing() { return chosen >= 0 ? chosen : firstUsed; }

/// Calls back for every copy of every body that is drawn, what is selected last.
function eachCopy(back) {
  var late = [];
  data.layers.forEach(function (layer, k) {
    if (!shown[k]) { return; }
    (layer.bodies || []).forEach(function (body, n) {
      body.copies.forEach(function (copy) {
        var own = copy.capture === undefined ? -1 : copy.capture;
        if (body.is_for_selected && own !== standing()) { return; }
        var one = function () { back(gpu.layers[k].bodies[n], rigid(copy.translation, copy.rotation), own); };
        if (own >= 0 && own === chosen) { late.push(one); } else { one(); }
      });
    });
  });
  late.forEach(function (one) { one(); });
}

/// The colour of a capture, and how much it steps back behind the one that is selected.
function dress(p, own) {
  gl.uniform4fv(p.own, own < 0 ? [0, 0, 0, 1] : colours[own]);
  gl.uniform1f(p.fade, chosen < 0 || own < 0 || own === chosen ? 1 : 0.3);
  if (p.thick) { gl.uniform1f(p.thick, own >= 0 && own === chosen ? 2.2 : 1); }
}

function bodies(c, what, p) {
  gl.useProgram(p.id);
  if (p.kind) { gl.uniform1i(p.kind, 1); }
  eachCopy(function (made, place, own) {
    if (!made[what]) { return; }
    dress(p, own);
    gl.uniformMatrix4fv(p.clip, false, times(c.clip, place));
    if (p.eye) { gl.uniformMatrix4fv(p.eye, false, times(c.view, place)); }
    gl.bindVertexArray(made[what].array);
    gl.drawArrays(gl.TRIANGLES, 0, made[what].count);
  });
}

/// The links of the robot's arm at one capture.
function arm(c) {
  var at = standing(), links = at >= 0 && data.captures[at].links;
  var isShown = data.layers.some(function (layer, k) { return layer.has_links && shown[k]; });
  if (!links || !isShown) { return; }
  if (!gpu.arm || gpu.arm.at !== at) {
    if (gpu.arm) { gl.deleteVertexArray(gpu.arm.made.array); gl.deleteBuffer(gpu.arm.made.buffer); }
    gpu.arm = { at: at, made: faces(tube(links, data.link_m)) };
  }
  var p = gpu.face;
  gl.useProgram(p.id);
  dress(p, -1);
  gl.uniform1i(p.kind, 1);
  gl.uniformMatrix4fv(p.clip, false, c.clip);
  gl.uniformMatrix4fv(p.eye, false, c.view);
  gl.bindVertexArray(gpu.arm.made.array);
  gl.drawArrays(gl.TRIANGLES, 0, gpu.arm.made.count);
}

/// From steps through the layer's box to the eye.
function unpacking(layer) {
  var s = layer.shape;
  return times(placeOf(layer), [s.step[0], 0, 0, 0, 0, s.step[1], 0, 0, 0, 0, s.step[2], 0, s.low[0], s.low[1], s.low[2], 1]);
}

function solid(layer, made, c, ph) {
  var p = gpu.points, m = unpacking(layer), values = layer.shape.values;
  gl.useProgram(p.id);
  gl.uniformMatrix4fv(p.clip, false, times(c.clip, m));
  gl.uniformMatrix4fv(p.eye, false, times(c.view, m));
  gl.uniform4fv(p.colour, rgb(layer.colour).concat(1));
  gl.uniform4fv(p.missing, rgb(data.missing).concat(1));
  gl.uniform1i(p.kind, made.corners ? 1 : 0);
  var mode = layer.pixels ? 0 : paint === "rise" ? 2 : values ? 1 : 0;
  gl.uniform1i(p.paint, mode);
  var up = data.rise, h = heights();
  gl.uniform3f(p.up, dot(up, [m[0], m[1], m[2]]), dot(up, [m[4], m[5], m[6]]), dot(up, [m[8], m[9], m[10]]));
  gl.uniform2f(p.heights, h[0] - dot(up, [m[12], m[13], m[14]]), h[1]);
  gl.uniform1f(p.pixels, layer.pixels ? layer.pixels * ratio : 1.25 * ratio * size);
  var metre = ph / 2 / FIELD / (c.flat ? look.distance : 1);
  gl.uniform1f(p.metres, layer.pixels ? 0 : 1.25 * size * layer.shape.spacing * metre);
  // what has values lies over what it is compared with
  gl.uniform1f(p.nearer, values ? Math.abs(c.lens[10]) * 2 * layer.shape.spacing : 0);
  gl.uniform1f(p.most, data.most_mm || 1);
  gl.uniform1f(p.state, data.states > 1 ? state : 0);
  gl.uniform1f(p.top, top);
  gl.activeTexture(gl.TEXTURE0); gl.bindTexture(gl.TEXTURE_2D, gpu.scale); gl.uniform1i(p.scale, 0);
  gl.bindVertexArray(made.array);
  if (made.corners) { gl.drawElements(gl.TRIANGLES, made.corners, made.type, 0); } else { gl.drawArrays(gl.POINTS, 0, made.count); }
}

function heights() {
  var up = data.rise, low = Infinity, high = -Infinity;
  data.layers.forEach(function (layer, k) {
    if (!layer.shape || layer.pixels || !shown[k]) { return; }
    ends(layer).forEach(function (p) { low = Math.min(low, dot(up, p)); high = Math.max(high, dot(up, p)); });
  });
  return high > low ? [low, high - low] : [low, 1];
}

function light(c, pw, ph) {
  var p = gpu.light;
  gl.viewport(0, 0, pw, ph);
  gl.useProgram(p.id);
  gl.depthFunc(gl.ALWAYS);
  gl.activeTexture(gl.TEXTURE0); gl.bindTexture(gl.TEXTURE_2D, gpu.picture); gl.uniform1i(p.picture, 0);
  gl.activeTexture(gl.TEXTURE1); gl.bindTexture(gl.TEXTURE_2D, gpu.depth); gl.uniform1i(p.depth, 1);
  gl.uniform3fv(p.sky, rgb(printing ? "#ffffff" : style("--sky")));
  gl.uniform3fv(p.ground, rgb(printing ? "#ffffff" : style("--ground")));
  gl.uniform2f(p.pixel, 1 / pw, 1 / ph);
  // the width of a pixel at distance one, and how far neighbours are looked for
  gl.uniform2f(p.wide, 2 * FIELD / ph / c.away, 3 * ratio);
  gl.uniform3f(p.lens, c.lens[10], c.lens[14], c.flat ? 0 : 1);
  gl.uniform1f(p.strength, SHADE * c.away);
  gl.bindVertexArray(gpu.empty);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  gl.depthFunc(gl.LEQUAL);
  gl.activeTexture(gl.TEXTURE0);
}

function strokes(c, pw, ph) {
  var p = gpu.stroke;
  gl.enable(gl.BLEND); gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
  gl.depthMask(false);
  bodies(c, "glass", gpu.glass);
  gl.useProgram(p.id);
  dress(p, -1);
  gl.uniform2f(p.size, pw, ph); gl.uniform1f(p.ratio, ratio); gl.uniform1f(p.near, c.flat ? 0 : c.near);
  data.layers.forEach(function (layer, k) {
    var made = gpu.layers[k].lines;
    if (!shown[k] || !made) { return; }
    gl.uniformMatrix4fv(p.clip, false, times(c.clip, placeOf(layer)));
    gl.bindVertexArray(made.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, made.count);
  });
  eachCopy(function (made, place, own) {
    if (!made.lines) { return; }
    dress(p, own);
    gl.uniformMatrix4fv(p.clip, false, times(c.clip, place));
    gl.bindVertexArray(made.lines.array);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, made.lines.count);
  });
  gl.depthMask(true); gl.disable(gl.BLEND);
}
