// A small orbiting view of lines and points on a 2D canvas: no library, prints as it stands.
(function () {
  "use strict";
  document.querySelectorAll("canvas.scene").forEach(function (canvas) {
    var scene = JSON.parse(document.getElementById(canvas.dataset.scene).textContent);
    var context = canvas.getContext("2d");
    var low = scene.low, high = scene.high;
    var centre = [0, 1, 2].map(function (k) { return (low[k] + high[k]) / 2; });
    var size = Math.max(0.05, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
    var yaw = -0.9, pitch = 0.45, zoom = 1, pan = [0, 0];

    function project(p, w, h) {
      var x = p[0] - centre[0], y = p[1] - centre[1], z = p[2] - centre[2];
      var c = Math.cos(yaw), s = Math.sin(yaw);
      var right = c * x + s * y, away = -s * x + c * y;
      var up = Math.cos(pitch) * z + Math.sin(pitch) * away;
      var depth = Math.cos(pitch) * away - Math.sin(pitch) * z;
      var k = zoom * Math.min(w, h) * 1.35 / size / (1 + 0.35 * depth / size);
      return [w / 2 + pan[0] + right * k, h / 2 + pan[1] - up * k, depth, k];
    }

    function draw() {
      var ratio = window.devicePixelRatio || 1;
      var w = canvas.clientWidth, h = canvas.clientHeight;
      canvas.width = w * ratio; canvas.height = h * ratio;
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
      context.clearRect(0, 0, w, h);
      scene.lines.forEach(function (line) {
        context.strokeStyle = line.colour; context.lineWidth = line.width; context.globalAlpha = line.alpha;
        context.beginPath();
        line.points.forEach(function (p, i) {
          var q = project(p, w, h);
          if (i) { context.lineTo(q[0], q[1]); } else { context.moveTo(q[0], q[1]); }
        });
        context.stroke();
      });
      scene.points.forEach(function (point) {
        var q = project(point.at, w, h);
        context.globalAlpha = 1; context.fillStyle = point.colour;
        context.beginPath(); context.arc(q[0], q[1], point.radius, 0, 7); context.fill();
      });
      context.globalAlpha = 1; context.fillStyle = "#1c2430"; context.font = "12px system-ui,sans-serif";
      scene.labels.forEach(function (label) {
        var q = project(label.at, w, h);
        context.fillText(label.text, q[0] + 5, q[1] - 5);
      });
      var bar = scaleBar(w, h);
      context.strokeStyle = "#5b6675"; context.lineWidth = 2;
      context.beginPath(); context.moveTo(16, h - 16); context.lineTo(16 + bar.pixels, h - 16); context.stroke();
      context.fillStyle = "#5b6675"; context.fillText(bar.text, 16, h - 22);
    }

    function scaleBar(w, h) {
      var k = project(centre, w, h)[3], metres = 0.001;
      [0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2].forEach(function (m) { if (m * k < 160) { metres = m; } });
      return { pixels: metres * k, text: metres * 1000 + " mm" };
    }

    var held = null;
    canvas.addEventListener("pointerdown", function (e) { held = [e.clientX, e.clientY, e.shiftKey || e.button === 1 || e.button === 2]; canvas.setPointerCapture(e.pointerId); });
    canvas.addEventListener("pointerup", function () { held = null; });
    canvas.addEventListener("contextmenu", function (e) { e.preventDefault(); });
    canvas.addEventListener("pointermove", function (e) {
      if (!held) { return; }
      var dx = e.clientX - held[0], dy = e.clientY - held[1];
      if (held[2]) { pan[0] += dx; pan[1] += dy; } else { yaw -= dx * 0.008; pitch = Math.max(-1.55, Math.min(1.55, pitch + dy * 0.008)); }
      held = [e.clientX, e.clientY, held[2]];
      draw();
    });
    canvas.addEventListener("wheel", function (e) { e.preventDefault(); zoom *= Math.exp(-e.deltaY * 0.0012); draw(); }, { passive: false });
    canvas.addEventListener("dblclick", function () { yaw = -0.9; pitch = 0.45; zoom = 1; pan = [0, 0]; draw(); });
    window.addEventListener("resize", draw);
    window.addEventListener("beforeprint", draw);
    draw();
  });
})();
