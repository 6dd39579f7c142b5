// The 3D view: lines, clouds and meshes by WebGL 2, without a library. It is drawn only when something
// changes. Clouds and meshes go into a picture with depth first, which is then shaded where neighbouring
// pixels lie nearer (after eye-dome lighting, C. Boucheny, 2009); lines and labels are drawn over it.
(function () {
  "use strict";
  var FIELD = Math.tan(17 * Math.PI / 180); // half the height of the view, at distance one
  var MOST_PIXELS = 9e6;
  var SHADE = 250; // how dark a step in depth makes
  var still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;

  var POINTS = ["#version 300 es",
    "precision highp float;",
    "in vec3 cell; in float value0; in float value1;",
    "uniform mat4 clip, eye; uniform vec3 up; uniform vec2 heights; uniform vec4 colour, missing;",
    "uniform float pixels, metres, most, state, top, nearer; uniform int paint; uniform highp sampler2D scale;",
    "out vec4 shade; out vec3 place;",
    "vec4 ramp(float s) { return vec4(texture(scale, vec2((0.5 + clamp(s, 0.0, 1.0) * 63.0) / 64.0, 0.5)).rgb, 1.0); }",
    "void main() {",
    "  gl_Position = clip * vec4(cell, 1.0);",
    "  vec4 seen = eye * vec4(cell, 1.0);",
    "  gl_Position.z -= nearer;",
    "  place = seen.xyz;",
    "  gl_PointSize = clamp(metres / gl_Position.w, pixels, 16.0 * pixels);",
    "  shade = colour;",
    "  if (paint == 1) {",
    "    bool none0 = value0 > 0.99999, none1 = value1 > 0.99999;",
    "    float v = none0 ? value1 : none1 ? value0 : mix(value0, value1, state);",
    "    bool none = state < 0.5 ? none0 : none1;",
    "    shade = none ? missing : ramp(v * most / top);",
    "  } else if (paint == 2) {",
    "    shade = ramp((dot(up, cell) - heights.x) / heights.y);",
    "  }",
    "}"].join("\n");
  var DISC = ["#version 300 es",
    "precision highp float;",
    "in vec4 shade; in vec3 place; uniform int kind; out vec4 colour;",
    "void main() {",
    "  colour = shade;",
    "  if (kind == 1) {",
    "    vec3 n = normalize(cross(dFdx(place), dFdy(place)));",
    "    float light = 0.76 + 0.3 * abs(dot(n, normalize(vec3(0.25, 0.45, 0.85))));",
    "    colour = vec4(shade.rgb * light, 1.0);",
    "  } else {",
    "    vec2 d = gl_PointCoord - 0.5;",
    "    if (dot(d, d) > 0.25) { discard; }",
    "  }",
    "}"].join("\n");
  var WHOLE = ["#version 300 es",
    "precision highp float; out vec2 at;",
    "void main() { at = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0); gl_Position = vec4(2.0 * at - 1.0, 0.0, 1.0); }"].join("\n");
  var LIGHT = ["#version 300 es",
    "precision highp float;",
    "in vec2 at; uniform sampler2D picture; uniform highp sampler2D depth;",
    "uniform vec3 sky, ground, lens; uniform vec2 pixel, wide; uniform float strength; out vec4 colour;",
    // the distance before the eye, from the depth: lens is the third row of the projection, and whether it is one
    "float away(vec2 p) { float z = 2.0 * texture(depth, p).r - 1.0; return lens.z > 0.5 ? lens.y / (z + lens.x) : (z - lens.y) / -lens.x; }",
    // how far opposite neighbours, taken together, lie nearer: none on planes, however they lean
    "float near(vec2 p, float d) { return texture(depth, p).r < 1.0 ? 1.0 - away(p) / d : 0.0; }",
    "float ring(float d, float radius) {",
    "  float sum = 0.0;",
    "  for (int k = 0; k < 4; k++) {",
    "    float a = (float(k) + 0.5) * 0.7853981634;",
    "    vec2 way = radius * pixel * vec2(cos(a), sin(a));",
    "    sum += clamp(strength / radius * (near(at + way, d) + near(at - way, d)), 0.0, 1.0);",
    "  }",
    "  return sum / 4.0;",
    "}",
    // how far the surface leans away from the light, by the slope of the depth; nothing is said across edges
    "float slope(float d, vec2 way) {",
    "  float a = away(at + way * pixel), b = away(at - way * pixel);",
    "  float fore = (a - d) / d, back = (d - b) / d, one = abs(fore) < abs(back) ? fore : back;",
    "  return abs(fore - back) < 0.004 * strength / 100.0 ? 0.5 * (fore + back) : clamp(one, -0.002, 0.002);",
    "}",
    "void main() {",
    "  float own = texture(depth, at).r;",
    "  gl_FragDepth = own;",
    "  if (own >= 1.0) { colour = vec4(mix(ground, sky, at.y), 1.0); return; }",
    "  float d = away(at), reach = wide.y;",
    "  vec3 n = normalize(vec3(slope(d, vec2(reach, 0.0)), slope(d, vec2(0.0, reach)), reach * wide.x));",
    "  float light = 0.62 + 0.42 * max(0.0, dot(n, normalize(vec3(-0.35, 0.5, 0.8))));",
    "  float dark = 0.5 * ring(d, 1.2 * wide.y / 3.0) + 0.5 * ring(d, 1.4 * wide.y);",
    "  colour = vec4(texture(picture, at).rgb * light * (1.0 - 0.6 * dark), 1.0);",
    "}"].join("\n");
  var STROKE = ["#version 300 es",
    "precision highp float;",
    "in vec3 from, to; in vec4 tint; in float width; uniform mat4 clip; uniform vec2 size; uniform float ratio, near;",
    "out vec4 shade; out float across; out float half_;",
    "void main() {",
    "  vec4 a = clip * vec4(from, 1.0), b = clip * vec4(to, 1.0);",
    "  if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }",
    "  if (a.w < near) { a = mix(a, b, (near - a.w) / (b.w - a.w)); }",
    "  if (b.w < near) { b = mix(b, a, (near - b.w) / (a.w - b.w)); }",
    "  vec2 run = (b.xy / b.w - a.xy / a.w) * size;",
    "  run = dot(run, run) > 0.0 ? normalize(run) : vec2(1.0, 0.0);",
    "  half_ = 0.5 * width * ratio + 1.0;",
    "  bool end = (gl_VertexID & 1) == 1; float side = gl_VertexID < 2 ? -1.0 : 1.0;",
    "  vec4 p = end ? b : a;",
    "  p.xy += (vec2(-run.y, run.x) * side + run * (end ? 0.5 : -0.5)) * half_ * 2.0 / size * p.w;",
    "  p.z -= 2e-4 * p.w;",
    "  gl_Position = p; shade = tint; across = side * half_;",
    "}"].join("\n");
  var INK = ["#version 300 es",
    "precision highp float; in vec4 shade; in float across; in float half_; out vec4 colour;",
    "void main() { colour = vec4(shade.rgb, shade.a * clamp(half_ - abs(across), 0.0, 1.0)); }"].join("\n");

  // vectors and matrices; a matrix is 16 numbers, column by column
  function add(a, b, s) { return [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]; }
  function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  function times(a, b) {
    var m = new Array(16);
    for (var c = 0; c < 4; c++) { for (var r = 0; r < 4; r++) {
      m[4 * c + r] = a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] + a[12 + r] * b[4 * c + 3];
    } }
    return m;
  }
  function apply(m, p) {
    return [0, 1, 2, 3].map(function (r) { return m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r]; });
  }
  function rigid(t, q) {
    var x = q[0], y = q[1], z = q[2], w = q[3];
    return [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
      2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
      2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0, t[0], t[1], t[2], 1];
  }
  function between(a, b, s) {
    var sign = a.rotation.reduce(function (sum, v, k) { return sum + v * b.rotation[k]; }, 0) < 0 ? -1 : 1;
    var q = a.rotation.map(function (v, k) { return (1 - s) * v + s * sign * b.rotation[k]; });
    var n = Math.hypot(q[0], q[1], q[2], q[3]);
    var t = a.translation.map(function (v, k) { return (1 - s) * v + s * b.translation[k]; });
    return rigid(t, q.map(function (v) { return v / n; }));
  }
  function bytes(text) {
    var raw = atob(text), all = new Uint8Array(raw.length);
    for (var k = 0; k < raw.length; k++) { all[k] = raw.charCodeAt(k); }
    return all;
  }
  function rgb(colour) {
    return [1, 3, 5].map(function (k) { return parseInt(colour.slice(k, k + 2), 16) / 255; });
  }

  document.querySelectorAll("figure.scene").forEach(function (figure) {
    if (figure.dataset.ready) { return; }
    figure.dataset.ready = "yes";
    var data = JSON.parse(figure.querySelector("script.data").textContent);
    var canvas = figure.querySelector("canvas.solid"), marks = figure.querySelector("canvas.marks");
    var gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true, alpha: false });
    if (!gl) { figure.classList.add("without"); return; }
    figure.classList.add("with");
    var context = marks.getContext("2d");

    var shown = data.layers.map(function (layer) { return layer.is_shown; });
    var look = { yaw: data.look[0], pitch: data.look[1], distance: 1, centre: [0, 0, 0], flat: 0 };
    var first = null, state = Math.max(0, data.states - 1), paint = "own", size = 1, top = data.top_mm || 1;
    var picked = null, printing = false, asked = false, gpu = null, ratio = 2;

    // ---- what is on the graphics card

    function program(vertex, fragment) {
      var made = gl.createProgram();
      [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]].forEach(function (part) {
        var shader = gl.createShader(part[0]);
        gl.shaderSource(shader, part[1]); gl.compileShader(shader); gl.attachShader(made, shader);
      });
      gl.linkProgram(made);
      if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) { throw new Error("3D view: " + gl.getProgramInfoLog(made)); }
      var names = { id: made };
      for (var k = 0; k < gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS); k++) {
        var name = gl.getActiveUniform(made, k).name;
        names[name] = gl.getUniformLocation(made, name);
      }
      return names;
    }

    function attribute(made, name, source, count, type, normalised, stride, offset, each) {
      var at = gl.getAttribLocation(made.id, name);
      if (at < 0) { return; }
      if (source) {
        if (source instanceof WebGLBuffer) { gl.bindBuffer(gl.ARRAY_BUFFER, source); } else {
          gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, source, gl.STATIC_DRAW);
        }
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, count, type, normalised, stride || 0, offset || 0);
        if (each) { gl.vertexAttribDivisor(at, 1); }
      }
    }

    function build() {
      gpu = { points: program(POINTS, DISC), light: program(WHOLE, LIGHT), stroke: program(STROKE, INK), size: [0, 0] };
      gpu.layers = data.layers.map(function (layer) { return { shape: shape(layer.shape), lines: lines(layer.lines) }; });
      gpu.scale = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, gpu.scale);
      var colours = bytes(data.scale);
      gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, colours.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, colours);
      [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER].forEach(function (k) { gl.texParameteri(gl.TEXTURE_2D, k, gl.LINEAR); });
      [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T].forEach(function (k) { gl.texParameteri(gl.TEXTURE_2D, k, gl.CLAMP_TO_EDGE); });
      gpu.empty = gl.createVertexArray();
    }

    function shape(packed) {
      if (!packed) { return null; }
      var made = { array: gl.createVertexArray(), count: packed.count };
      gl.bindVertexArray(made.array);
      made.cells = new Uint16Array(bytes(packed.cells).buffer);
      attribute(gpu.points, "cell", made.cells, 3, gl.UNSIGNED_SHORT, false, 6);
      (packed.values || []).forEach(function (text, k) {
        attribute(gpu.points, "value" + k, bytes(text), 1, gl.UNSIGNED_SHORT, true, 2);
      });
      if (packed.corners) {
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, bytes(packed.corners.numbers), gl.STATIC_DRAW);
        made.corners = packed.corners.count;
        made.type = packed.corners.bytes === 2 ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
      }
      gl.bindVertexArray(null);
      return made;
    }

    function lines(all) {
      var numbers = [];
      all.forEach(function (line) {
        var c = rgb(line.colour);
        for (var k = 1; k < line.points.length; k++) {
          line.points[k - 1].concat(line.points[k], c, [line.alpha, line.width]).forEach(function (v) { numbers.push(v); });
        }
      });
      if (!numbers.length) { return null; }
      var made = { array: gl.createVertexArray(), count: numbers.length / 11 };
      gl.bindVertexArray(made.array);
      var buffer = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
      [["from", 3, 0], ["to", 3, 12], ["tint", 4, 24], ["width", 1, 40]].forEach(function (part) {
        attribute(gpu.stroke, part[0], buffer, part[1], gl.FLOAT, false, 44, part[2], true);
      });
      gl.bindVertexArray(null);
      return made;
    }

    /// The picture with depth that clouds and meshes are drawn into.
    function target(w, h) {
      if (gpu.size[0] === w && gpu.size[1] === h) { return; }
      [gpu.picture, gpu.depth].forEach(function (texture) { if (texture) { gl.deleteTexture(texture); } });
      gpu.size = [w, h];
      gpu.picture = gl.createTexture(); gpu.depth = gl.createTexture();
      [[gpu.picture, gl.RGBA8], [gpu.depth, gl.DEPTH_COMPONENT24]].forEach(function (part) {
        gl.bindTexture(gl.TEXTURE_2D, part[0]);
        gl.texStorage2D(gl.TEXTURE_2D, 1, part[1], w, h);
        [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER].forEach(function (k) { gl.texParameteri(gl.TEXTURE_2D, k, gl.NEAREST); });
        [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T].forEach(function (k) { gl.texParameteri(gl.TEXTURE_2D, k, gl.CLAMP_TO_EDGE); });
      });
      gpu.frame = gpu.frame || gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, gpu.frame);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gpu.picture, 0);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, gpu.depth, 0);
    }

    // ---- where things are

    function placeOf(layer) {
      var all = layer.places;
      if (!all.length) { return rigid([0, 0, 0], [0, 0, 0, 1]); }
      if (all.length === 1) { return rigid(all[0].translation, all[0].rotation); }
      return between(all[0], all[1], state);
    }

    function ends(layer) {
      var all = [], place = placeOf(layer);
      if (layer.shape) {
        var f = layer.shape.focus;
        for (var k = 0; k < 8; k++) { all.push(apply(place, [f[k & 1][0], f[k >> 1 & 1][1], f[k >> 2][2]])); }
      }
      layer.lines.forEach(function (line) { line.points.forEach(function (p) { all.push(apply(place, p)); }); });
      return all;
    }

    function box() {
      var some = data.layers.filter(function (layer, k) { return shown[k]; });
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

    /// Centre and distance at which everything shown is inside.
    function fitting(l) {
      var b = box(), a = axes(l), w = canvas.clientWidth || 1, h = canvas.clientHeight || 1, wide = FIELD * w / h, distance = 0;
      var centre = b.low.map(function (v, k) { return (v + b.high[k]) / 2; });
      b.all.forEach(function (p) {
        var d = add(p, centre, -1);
        var side = Math.max(Math.abs(dot(d, a.right)) / wide, Math.abs(dot(d, a.up)) / FIELD);
        distance = Math.max(distance, side + (l.flat > 0.5 ? 0 : dot(d, a.back)));
      });
      return { centre: centre, distance: Math.max(distance * 1.08, 1e-3) };
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
      data.layers.forEach(function (layer, k) { if (shown[k] && gpu.layers[k].shape) { solid(layer, gpu.layers[k].shape, c, ph); } });
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      light(c, pw, ph);
      strokes(c, pw, ph);
      annotate(c, w, h);
      figure.dataset.drawn = String(data.layers.filter(function (l, k) { return shown[k]; }).length);
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
      gl.useProgram(p.id);
      gl.enable(gl.BLEND); gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE);
      gl.depthMask(false);
      gl.uniform2f(p.size, pw, ph); gl.uniform1f(p.ratio, ratio); gl.uniform1f(p.near, c.flat ? 0 : c.near);
      data.layers.forEach(function (layer, k) {
        var made = gpu.layers[k].lines;
        if (!shown[k] || !made) { return; }
        gl.uniformMatrix4fv(p.clip, false, times(c.clip, placeOf(layer)));
        gl.bindVertexArray(made.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, made.count);
      });
      gl.depthMask(true); gl.disable(gl.BLEND);
    }

    // ---- labels, the scale bar, the small axes

    function onScreen(c, p, w, h) {
      var q = apply(c.clip, p);
      return q[3] > 0 ? [(q[0] / q[3] + 1) * w / 2, (1 - q[1] / q[3]) * h / 2, q[3], q[2] / q[3]] : null;
    }

    function annotate(c, w, h) {
      var dense = Math.min(3, window.devicePixelRatio || 1);
      marks.width = Math.round(w * dense); marks.height = Math.round(h * dense);
      context.setTransform(dense, 0, 0, dense, 0, 0);
      context.font = "12px system-ui,-apple-system,'Segoe UI',Roboto,'DejaVu Sans',sans-serif";
      context.lineJoin = "round";
      // browsers print this canvas, and not all of them the other
      if (printing) { context.drawImage(canvas, 0, 0, w, h); }
      var ink = printing ? "#1c2430" : style("--ink"), soft = printing ? "#5b6675" : style("--soft"), halo = printing ? "#ffffff" : style("--sky");
      function words(text, x, y, colour) {
        context.strokeStyle = halo; context.lineWidth = 3.5; context.strokeText(text, x, y);
        context.fillStyle = colour; context.fillText(text, x, y);
      }
      data.layers.forEach(function (layer, k) {
        if (!shown[k]) { return; }
        layer.labels.forEach(function (label) {
          var q = onScreen(c, apply(placeOf(layer), label.at), w, h);
          if (q) { words(label.text, q[0] + 7, q[1] + 14, ink); }
        });
      });
      var metre = h / 2 / FIELD / look.distance, length = Math.pow(10, Math.floor(Math.log10(150 / metre)));
      [5, 2].some(function (k) { if (length * k * metre < 150) { length *= k; return true; } return false; });
      context.strokeStyle = soft; context.lineWidth = 1.5;
      context.beginPath(); context.moveTo(16.5, h - 22); context.lineTo(16.5, h - 16); context.lineTo(16.5 + length * metre, h - 16);
      context.lineTo(16.5 + length * metre, h - 22); context.stroke();
      words(millimetres(length), 22, h - 22, soft);
      var middle = [w - 42, h - 42];
      [["x", "#d0433a"], ["y", "#2e9f55"], ["z", "#3d74d8"]].map(function (name, k) {
        return { name: name, x: c.axes.right[k], y: c.axes.up[k], z: c.axes.back[k] };
      }).sort(function (a, b) { return a.z - b.z; }).forEach(function (axis) {
        var x = middle[0] + 22 * axis.x, y = middle[1] - 22 * axis.y;
        context.strokeStyle = context.fillStyle = axis.name[1]; context.lineWidth = 2;
        context.beginPath(); context.moveTo(middle[0], middle[1]); context.lineTo(x, y); context.stroke();
        words(axis.name[0], middle[0] + 30 * axis.x - 3, middle[1] - 30 * axis.y + 4, axis.name[1]);
      });
      if (picked) {
        var q = onScreen(c, picked, w, h);
        if (q) {
          context.strokeStyle = ink; context.lineWidth = 1.5;
          context.beginPath(); context.arc(q[0], q[1], 5, 0, 7); context.stroke();
          words(picked.map(function (v) { return (v * 1000).toFixed(1); }).join(", ") + " mm", q[0] + 10, q[1] - 8, ink);
        }
      }
    }

    function millimetres(metres) {
      return metres >= 1 ? metres + " m" : Number((metres * 1000).toPrecision(6)) + " mm";
    }

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

    var held = new Map();
    function inside(e) { var r = canvas.getBoundingClientRect(); return [e.clientX - r.left, e.clientY - r.top]; }
    canvas.addEventListener("pointerdown", function (e) {
      run.number = (run.number || 0) + 1;
      held.set(e.pointerId, inside(e));
      canvas.setPointerCapture(e.pointerId);
      canvas.classList.add("held");
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
        "1": VIEWS.front, "2": VIEWS.top, "3": VIEWS.side, f: VIEWS.fit, Home: VIEWS.fit, p: VIEWS.perspective,
        ",": function () { grow(0.8); }, ".": function () { grow(1.25); }
      };
      if (keys[e.key]) { e.preventDefault(); keys[e.key](); }
    });

    // ---- buttons and legend

    function grow(factor) { size = Math.max(0.3, Math.min(8, size * factor)); ask(); }
    figure.querySelectorAll("button").forEach(function (button) {
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
      shown[Number(tick.dataset.layer)] = tick.checked;
      tick.addEventListener("change", function () { shown[Number(tick.dataset.layer)] = tick.checked; ask(); });
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
  });
})();
