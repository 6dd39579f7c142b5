// A capture that is selected: in the view, in its card, in the table and among the images.

var captures = data.captures || (data.captures = []);
var colours = captures.map(function (k) { return rgb(k.colour).concat(1); });
var firstUsed = captures.findIndex(function (k) { return k.is_used; });
var card = figure.querySelector(".card");

/// Rows and images of a capture; names of captures are no part of a selector, as they may hold anything.
function elements(kind, id) {
  return Array.from(document.querySelectorAll(kind + "[data-capture]")).filter(function (e) { return e.dataset.capture === id; });
}

/// Selects a capture by its number; none with -1.
function choose(number) {
  chosen = number;
  var own = captures[number];
  document.querySelectorAll("[data-capture].marked").forEach(function (e) { e.classList.remove("marked"); });
  if (own) {
    figure.dataset.selected = own.id;
    elements("", own.id).forEach(function (e) { e.classList.add("marked"); });
    showCard(own);
  } else {
    delete figure.dataset.selected; delete figure.dataset.at;
    card.hidden = true;
  }
  ask();
}

function showCard(own) {
  card.querySelector("b").textContent = own.id;
  card.querySelector(".text").textContent = own.text;
  var thumb = card.querySelector(".thumb"), image = elements("figure", own.id)[0], svg = image && image.querySelector("svg");
  thumb.textContent = "";
  if (svg) { thumb.appendChild(svg.cloneNode(true)); }
  card.querySelectorAll("[data-to]").forEach(function (button) { button.hidden = !elements(button.dataset.to, own.id).length; });
  card.style.setProperty("--own", own.colour);
  card.hidden = false;
}

/// The next capture in the order of their names, or the previous one.
function step(by) {
  var count = captures.length;
  if (count) { choose(chosen < 0 ? (by > 0 ? 0 : count - 1) : (chosen + by + count) % count); }
}

/// How far a point of the screen is from a segment.
function fromSegment(x, y, a, b) {
  var dx = b[0] - a[0], dy = b[1] - a[1], length = dx * dx + dy * dy;
  var s = length ? Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / length)) : 0;
  return Math.hypot(a[0] + s * dx - x, a[1] + s * dy - y);
}

function isInside(x, y, ring) {
  var inside = false;
  ring.forEach(function (a, k) {
    var b = ring[(k + 1) % ring.length];
    if (a[1] > y !== b[1] > y && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) { inside = !inside; }
  });
  return inside;
}

/// The capture under a place of the screen: the nearest line within reach, or else the face nearest to the eye.
function captureAt(x, y, reach) {
  var c = camera(), w = canvas.clientWidth, h = canvas.clientHeight;
  var byLine = -1, least = reach, byFace = -1, depth = Infinity;
  data.layers.forEach(function (layer, k) {
    if (!shown[k]) { return; }
    (layer.bodies || []).forEach(function (body) {
      body.copies.forEach(function (copy) {
        if (copy.capture === undefined || body.is_for_selected && copy.capture !== standing()) { return; }
        var m = rigid(copy.translation, copy.rotation);
        var points = function (part) { return part.points.map(function (p) { return onScreen(c, apply(m, p), w, h); }); };
        body.lines.forEach(function (line) {
          var all = points(line);
          for (var n = 1; n < all.length; n++) {
            var far = all[n - 1] && all[n] ? fromSegment(x, y, all[n - 1], all[n]) : Infinity;
            if (far < least) { least = far; byLine = copy.capture; }
          }
        });
        body.faces.forEach(function (face) {
          var all = points(face);
          if (all.some(function (p) { return !p; }) || !isInside(x, y, all)) { return; }
          var near = all.reduce(function (sum, p) { return sum + p[3]; }, 0) / all.length;
          if (near < depth) { depth = near; byFace = copy.capture; }
        });
      });
    });
  });
  return byLine >= 0 ? byLine : byFace;
}

/// Rows and images select their capture; images stand below the view, so the page has to be complete.
function link() {
  document.querySelectorAll("tr[data-capture], .pictures figure[data-capture]").forEach(function (element) {
    var number = captures.findIndex(function (k) { return k.id === element.dataset.capture; });
    if (number < 0) { return; }
    element.classList.add("linked");
    element.addEventListener("click", function (e) {
      if (e.target.closest(".to-view")) { figure.scrollIntoView({ block: "center" }); canvas.focus({ preventScroll: true }); return; }
      choose(number);
    });
    var button = document.createElement("button");
    button.type = "button"; button.className = "to-view"; button.textContent = "3D"; button.title = "Show in the 3D view";
    (element.querySelector("figcaption, td") || element).appendChild(button);
  });
}

if (captures.length) {
  if (document.readyState === "loading") { document.addEventListener("DOMContentLoaded", link); } else { link(); }
  card.querySelector(".close").addEventListener("click", function () { choose(-1); });
  card.querySelectorAll("[data-step]").forEach(function (button) {
    button.addEventListener("click", function () { step(Number(button.dataset.step)); });
  });
  card.querySelectorAll("[data-to]").forEach(function (button) {
    button.addEventListener("click", function () {
      var goal = elements(button.dataset.to, captures[chosen].id)[0];
      goal.scrollIntoView({ block: "center", behavior: still ? "auto" : "smooth" });
    });
  });
}
