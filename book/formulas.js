// Formulas: a code span between dollar signs, $`R_X`$, and a block of the language `math` are LaTeX. KaTeX lies
// beside the pages and is loaded where a page has formulas. Where it cannot be loaded, the LaTeX stays.
(function () {
    "use strict";
    const spans = Array.from(document.querySelectorAll("main code")).filter(function (code) {
        const before = code.previousSibling, after = code.nextSibling;
        return code.parentElement.tagName !== "PRE" && before && after
            && before.nodeType === Node.TEXT_NODE && before.data.endsWith("$")
            && after.nodeType === Node.TEXT_NODE && after.data.startsWith("$");
    });
    const blocks = Array.from(document.querySelectorAll("main pre > code.language-math"));
    if (spans.length + blocks.length === 0) {
        return;
    }

    // what KaTeX cannot read stays as it is written, and the console says why
    function render(latex, place, displayMode) {
        try {
            katex.render(latex, place, { displayMode, strict: "error" });
        } catch (error) {
            console.error(String(error));
            place.textContent = latex;
            place.classList.add("katex-error");
        }
    }

    function renderAll() {
        for (const code of spans) {
            const place = document.createElement("span"), formula = document.createElement("span");
            render(code.textContent, formula, false);
            place.append(formula);
            code.previousSibling.data = code.previousSibling.data.slice(0, -1);
            code.nextSibling.data = code.nextSibling.data.slice(1);
            const mark = /^[.,;:)]+/.exec(code.nextSibling.data);
            if (mark) { // no line begins with the mark behind a formula
                code.nextSibling.data = code.nextSibling.data.slice(mark[0].length);
                place.append(mark[0]);
                place.style.whiteSpace = "nowrap";
            }
            code.replaceWith(place);
        }
        for (const code of blocks) {
            const place = document.createElement("div");
            place.className = "formula";
            render(code.textContent, place, true);
            code.parentElement.replaceWith(place);
        }
    }

    const style = document.createElement("link");
    style.rel = "stylesheet";
    style.href = path_to_root + "katex/katex.min.css";
    const script = document.createElement("script");
    script.src = path_to_root + "katex/katex.min.js";
    script.onload = renderAll;
    document.head.append(style, script);
})();
