// What is drawn: vectors, the state of the view, and its data on the graphics card.
var FIELD = Math.tan(17 * Math.PI / 180); // half the height of the view, at distance one
var MOST_PIXELS = 9e6;
var SHADE = 250; // how dark a step in depth makes
var still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;

// vectors and matrices; a matrix is 16 numbers, column by column
function add(a, b, s) { return [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]; }
function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
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
var chosen = -1, picked = null, printing = false, asked = false, gpu = null, ratio = 2;

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
  gpu = { points: program(POINTS, DISC), light: program(WHOLE, LIGHT), stroke: program(STROKE, INK), face: program(FACES, DISC), glass: program(FACES, GLASS), size: [0, 0] };
  gpu.layers = data.layers.map(function (layer) { return { shape: shape(layer.shape), lines: lines(layer.lines), bodies: (layer.bodies || []).map(body) }; });
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
    var c = line.colour ? rgb(line.colour) : [-1, -1, -1];
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

/// Triangles of faces, opaque or not.
function faces(all) {
  var numbers = [];
  all.forEach(function (face) {
    var tint = (face.colour ? rgb(face.colour) : [-1, -1, -1]).concat(face.alpha);
    for (var k = 2; k < face.points.length; k++) {
      [0, k - 1, k].forEach(function (n) { numbers.push.apply(numbers, face.points[n].concat(tint)); });
    }
  });
  if (!numbers.length) { return null; }
  var made = { array: gl.createVertexArray(), buffer: gl.createBuffer(), count: numbers.length / 7 };
  gl.bindVertexArray(made.array);
  gl.bindBuffer(gl.ARRAY_BUFFER, made.buffer);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(numbers), gl.STATIC_DRAW);
  [gpu.face, gpu.glass].forEach(function (p) {
    attribute(p, "cell", made.buffer, 3, gl.FLOAT, false, 28, 0);
    attribute(p, "tint", made.buffer, 4, gl.FLOAT, false, 28, 12);
  });
  gl.bindVertexArray(null);
  return made;
}

function body(all) {
  var is = function (opaque) { return all.faces.filter(function (face) { return face.alpha >= 1 === opaque; }); };
  return { lines: lines(all.lines), solid: faces(is(true)), glass: faces(is(false)) };
}

/// A tube along a path, closed by a ball at each bend, as faces.
function tube(path, radius) {
  var all = [], ROUND = 10;
  function quad(a, b, c, d) { all.push({ points: [a, b, c, d], colour: "#a9b2be", alpha: 1 }); }
  function ring(at, x, y, r) {
    var points = [];
    for (var k = 0; k < ROUND; k++) { var t = 2 * Math.PI * k / ROUND; points.push(add(add(at, x, r * Math.cos(t)), y, r * Math.sin(t))); }
    return points;
  }
  function join(a, b) { a.forEach(function (p, k) { var n = (k + 1) % ROUND; quad(p, a[n], b[n], b[k]); }); }
  path.forEach(function (p, k) {
    var rings = [];
    for (var j = 0; j <= 6; j++) { var t = Math.PI * (j / 6 - 0.5); rings.push(ring(add(p, [0, 0, 1], 1.25 * radius * Math.sin(t)), [1, 0, 0], [0, 1, 0], 1.25 * radius * Math.cos(t))); }
    rings.forEach(function (r, j) { if (j) { join(rings[j - 1], r); } });
    if (!k) { return; }
    var way = add(p, path[k - 1], -1), far = Math.hypot(way[0], way[1], way[2]);
    if (far < 1e-6) { return; }
    var z = way.map(function (v) { return v / far; }), side = Math.abs(z[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
    var x = cross(side, z), norm = Math.hypot(x[0], x[1], x[2]);
    x = x.map(function (v) { return v / norm; });
    join(ring(path[k - 1], x, cross(z, x), radius), ring(p, x, cross(z, x), radius));
  });
  return all;
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
