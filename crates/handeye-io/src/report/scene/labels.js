// Over the drawing: labels, the scale bar, the small axes.
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
  names(c, w, h, words, ink, soft);
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

/// Names beside their points, each where it covers no other; a thin line leads to those that are farther away.
function names(c, w, h, words, ink, soft) {
  var taken = [[0, 0, w, 50], [w - 84, h - 84, w, h]], at = standing();
  var beside = [[9, 4], [9, 20], [9, -12], [0, -22], [0, 34], [26, 48], [26, -40]];
  data.layers.forEach(function (layer, k) {
    if (!shown[k]) { return; }
    layer.labels.forEach(function (label) {
      if (label.capture !== undefined && label.capture !== at) { return; }
      var q = onScreen(c, apply(placeOf(layer), label.at), w, h);
      if (!q || q[0] < 0 || q[1] < 0 || q[0] > w || q[1] > h) { return; }
      var wide = context.measureText(label.text).width, left = q[0] + wide + 14 > w, spot = null, far = null;
      beside.some(function (b) {
        var x = left ? q[0] - b[0] - wide : q[0] + b[0], y = q[1] + b[1], own = [x - 3, y - 12, x + wide + 3, y + 4];
        far = b; spot = own;
        return !taken.some(function (o) { return own[0] < o[2] && own[2] > o[0] && own[1] < o[3] && own[3] > o[1]; });
      });
      taken.push(spot);
      if (Math.abs(far[1]) > 20) {
        context.strokeStyle = soft; context.lineWidth = 1;
        context.beginPath(); context.moveTo(q[0], q[1]); context.lineTo(spot[0] + 3, spot[1] + 8); context.stroke();
      }
      words(label.text, spot[0] + 3, spot[1] + 12, ink);
    });
  });
}

function millimetres(metres) {
  return metres >= 1 ? metres + " m" : Number((metres * 1000).toPrecision(6)) + " mm";
}
