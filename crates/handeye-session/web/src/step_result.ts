// The step "result": the verdict in one sentence, the transform, and the exports to copy or to save.

import { openReport } from "./actions";
import type { App, Part } from "./app";
import { button } from "./controls";
import { attribute, h, kind, list, show, text } from "./dom";
import { icon, setIcon } from "./icons";
import { getJson } from "./link";
import type { State, Verdict } from "./state";
import { named, said, t, type Key } from "./words";

const SIGNS: Record<Verdict, "check" | "cross" | "warning"> = { accepted: "check", rejected: "cross", undetermined: "warning" };
const COPIED_FOR = 2000; // ms

async function copy(words: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(words);
    return true;
  } catch {
    const area = h("textarea", { class: "unseen", readonly: true });
    area.value = words;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy"); // where the page is not served from this machine, there is no clipboard
    area.remove();
    return done;
  }
}

/** A button that copies what it is asked to, and says so. */
function copyButton(words: () => string): HTMLButtonElement {
  const label = said(h("span"), "copy");
  const made = h("button", { type: "button", class: "copy" }, icon("copy"), label);
  made.addEventListener("click", () => {
    void copy(words()).then((done) => {
      said(label, done ? "copied" : "not_copied");
      setTimeout(() => said(label, "copy"), COPIED_FOR);
    });
  });
  return made;
}

interface Format {
  name: string;
  what?: string;
}

/** Every format as a link to a file. */
function downloads() {
  const links = h("ul", { class: "downloads" });
  const element = h("details", {}, said(h("summary"), "more_formats"), links);
  element.addEventListener("toggle", () => {
    if (!element.open || links.childElementCount) return;
    getJson<Format[]>("/api/formats")
      .then((formats) => {
        for (const { name, what } of formats) {
          const address = `/api/export?format=${encodeURIComponent(name)}`;
          links.append(h("li", {}, h("a", { href: address, download: "" }, icon("down"), h("b", {}, name), h("small", {}, what ?? ""))));
        }
      })
      .catch(() => (element.open = false));
  });
  return element;
}

/** Exports as tabs: the keys left and right change between them. */
function exportTabs() {
  const tabs = h("div", { role: "tablist" });
  named(tabs, "exports");
  const code = h("code");
  const panel = h("pre", { role: "tabpanel", id: "export-text", tabindex: 0 }, code);
  let chosen = "";
  let all: { name: string; text: string }[] = [];
  const copying = copyButton(() => all.find(({ name }) => name === chosen)?.text ?? "");
  const draw = list<{ name: string }>(
    tabs,
    ({ name }) => name,
    ({ name }) => {
      const tab = h("button", { type: "button", role: "tab", "aria-controls": "export-text" }, name);
      tab.addEventListener("click", () => choose(name));
      return {
        element: tab,
        update(): void {
          attribute(tab, "aria-selected", String(name === chosen));
          attribute(tab, "tabindex", name === chosen ? 0 : -1);
        },
      };
    },
  );
  tabs.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (!step || !all.length) return;
    event.preventDefault();
    event.stopPropagation();
    const now = all.findIndex(({ name }) => name === chosen);
    choose(all[(now + step + all.length) % all.length]?.name ?? "");
    (tabs.querySelector('[aria-selected="true"]') as HTMLElement | null)?.focus();
  });

  function choose(name: string): void {
    chosen = name;
    update(all);
  }

  function update(given: { name: string; text: string }[]): void {
    all = given;
    if (!all.some(({ name }) => name === chosen)) chosen = all[0]?.name ?? "";
    draw(all);
    text(code, all.find(({ name }) => name === chosen)?.text);
    attribute(panel, "aria-label", chosen);
  }

  const element = h("div", { class: "exports" }, h("div", { class: "bar" }, tabs, copying), panel);
  return { element, update };
}

export function makeStepResult(_app: App): Part {
  const sign = icon("check");
  const badge = h("h2");
  const headline = h("p", { class: "headline" });
  const banner = h("div", { class: "banner" }, sign, h("div", {}, badge, headline));
  const transform = h("code");
  const transformBox = h("section", { class: "card" }, said(h("h2"), "transform"), h("div", { class: "line" }, transform, copyButton(() => transform.textContent ?? "")));
  const tabs = exportTabs();
  const exportsBox = h("section", { class: "card" }, said(h("h2"), "exports"), tabs.element, downloads());
  const files = h("ul", { class: "files" });
  const drawFiles = list<string>(
    files,
    (path) => path,
    (path) => ({ element: h("li", {}, h("code", {}, path)), update: () => undefined }),
  );
  const report = button("open_report", openReport, { icon: "page" });
  const filesBox = h("section", { class: "card" }, h("div", { class: "top" }, said(h("h2"), "files"), report), files);
  const element = h("div", { class: "result stack" }, banner, transformBox, exportsBox, filesBox);
  return {
    element,
    update(state: State) {
      const result = state.result;
      const verdict = result?.verdict ?? "undetermined";
      text(badge, result ? t(`result_${verdict}` as Key) : t("no_result"));
      text(headline, result?.headline);
      setIcon(sign, SIGNS[verdict] ?? "warning");
      for (const name of Object.keys(SIGNS)) kind(banner, name, verdict === name);
      text(transform, state.progress?.transform_text);
      show(transformBox, Boolean(state.progress?.transform_text));
      tabs.update(result?.exports ?? []);
      show(exportsBox, Boolean(result?.exports?.length));
      drawFiles(result?.files ?? []);
      show(filesBox, Boolean(result));
    },
  };
}
