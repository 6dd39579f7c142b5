// The step "result": the verdict and what it rests on, the transform, and the exports to copy or to save.

import type { App, Part } from "./app";
import { attribute, h, kind, list, show, text } from "./dom";
import { icon, setIcon } from "./icons";
import { getJson, getText } from "./link";
import { mm } from "./numbers";
import type { Pose, State, Verdict } from "./state";
import { named, showOwn, said, sentence, t, showTranslated, type Key } from "./words";

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
}

/** Formats that most people want; the others are shown when they are asked for. The notation of the session comes first. */
const FIRST = ["ros2-launch", "urdf", "opencv-yaml", "matrix4x4", "quaternion-xyzw"];
const BINARY = ["npy"];

/** All exports as tabs: the keys left and right change between them. The text of each is asked for when it is looked at. */
function exportTabs(app: App) {
  const tabs = h("div", { role: "tablist" });
  named(tabs, "exports");
  const code = h("code");
  const panel = h("pre", { role: "tabpanel", id: "export-text", tabindex: 0 }, code);
  const all = h("button", { type: "button", class: "all" });
  const copying = copyButton(() => texts.get(chosen) ?? "");
  const saving = h("a", { class: "save", download: "" }, icon("down"), said(h("span"), "save"));
  let names: string[] = [];
  let chosen = "";
  let showsAll = false;
  let of = ""; // the result that the texts are of
  let texts = new Map<string, string | null>(); // null: it is on its way
  const draw = list<string>(
    tabs,
    (name) => name,
    (name) => {
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
  all.addEventListener("click", () => {
    showsAll = !showsAll;
    app.redraw();
  });
  tabs.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    const seen = shown();
    if (!step || !seen.length) return;
    event.preventDefault();
    event.stopPropagation();
    choose(seen[(seen.indexOf(chosen) + step + seen.length) % seen.length] ?? "");
    (tabs.querySelector('[aria-selected="true"]') as HTMLElement | null)?.focus();
  });

  /** Those that are seen, the notation of the session first. */
  function shown(): string[] {
    const own = app.state?.cell?.notation ?? "";
    const first = [own, ...FIRST.filter((name) => name !== own)].filter((name) => names.includes(name));
    const others = names.filter((name) => !first.includes(name));
    return [...first, ...others.filter((name) => showsAll || name === chosen)];
  }

  function choose(name: string): void {
    chosen = name;
    app.redraw();
  }

  async function ask(name: string): Promise<void> {
    const store = texts;
    store.set(name, null);
    try {
      store.set(name, BINARY.includes(name) ? "" : await getText(address(name)));
      app.redraw();
    } catch {
      setTimeout(() => store.delete(name), AGAIN);
    }
  }

  const top = h("div", { class: "top" }, said(h("h2"), "exports"), h("div", { class: "buttons" }, copying, saving));
  const element = h("section", { class: "card exports" }, top, h("div", { class: "formats" }, tabs, all), panel);
  return {
    element,
    update(state: State): void {
      const result = JSON.stringify([state.assessed, state.result?.files]);
      if (result !== of) [of, texts] = [result, new Map()];
      if (!names.length) void askNames();
      const seen = shown();
      if (!seen.includes(chosen)) chosen = seen[0] ?? "";
      if (chosen && !texts.has(chosen)) void ask(chosen);
      draw(shown());
      const isBinary = BINARY.includes(chosen);
      text(code, isBinary ? t("binary") : texts.get(chosen));
      show(copying, !isBinary);
      said(all, showsAll ? "fewer_formats" : "more_formats");
      attribute(all, "aria-expanded", String(showsAll));
      attribute(panel, "aria-label", chosen);
      attribute(saving, "href", address(chosen));
    },
  };

  async function askNames(): Promise<void> {
    names = ["…"]; // on their way
    try {
      names = (await getJson<Format[]>("/api/formats")).map(({ name }) => name);
      app.redraw();
    } catch {
      setTimeout(() => (names = []), AGAIN);
    }
  }
}

const AGAIN = 2000; // ms until what did not come is asked for again
const address = (format: string) => `/api/export?format=${encodeURIComponent(format)}`;

/** The camera's pose as it is copied: metres and a quaternion, in the order of most programs. */
const numbersOf = ({ translation_m: p, rotation_xyzw: q }: Pose) => [...p, ...q].map((x) => x.toFixed(9)).join(" ");

/** The camera's pose, in numbers with names. */
function transformTable() {
  const name = h("h2");
  const values = h("dl", { class: "transform" });
  const draw = list<[string, string]>(values, ([key]) => key, () => {
    const [key, value] = [h("dt"), h("dd")];
    return {
      element: h("div", {}, key, value),
      update([named, shown]: [string, string]): void {
        text(key, named);
        text(value, shown);
      },
    };
  });
  let numbers = "";
  const copying = copyButton(() => numbers);
  const element = h("section", { class: "card" }, h("div", { class: "top" }, name, copying), values);
  return {
    element,
    update(state: State): void {
      const pose = state.progress?.mount_from_camera;
      if (!pose) return;
      numbers = numbersOf(pose);
      text(name, state.cell?.setup === "eye-to-hand" ? "base_from_camera" : "flange_from_camera");
      const [p, q] = [pose.translation_m, pose.rotation_xyzw];
      draw([
        ...p.map((x, i): [string, string] => ["xyz"[i] as string, `${(1000 * x).toFixed(3)} mm`]),
        ...q.map((x, i): [string, string] => [`q${"xyzw"[i]}`, x.toFixed(6)]),
      ]);
    },
  };
}

export function makeStepResult(app: App): Part {
  const sign = icon("check");
  const badge = h("h2");
  const headline = h("p", { class: "headline" });
  const banner = h("div", { class: "banner" }, sign, h("div", {}, badge, headline));
  const transform = transformTable();
  const tabs = exportTabs(app);
  const files = h("ul", { class: "files" });
  const drawFiles = list<string>(
    files,
    (path) => path,
    (path) => ({ element: h("li", {}, h("code", {}, path)), update: () => undefined }),
  );
  const filesBox = h("section", { class: "card" }, said(h("h2"), "files"), files);
  const element = h("div", { class: "result stack" }, banner, transform.element, tabs.element, filesBox);
  return {
    element,
    update(state: State) {
      const result = state.result;
      const verdict = result?.verdict ?? "undetermined";
      text(badge, result ? t(`result_${verdict}` as Key) : t("no_result"));
      if (result) headlineOf(headline, state, verdict);
      else showOwn(headline, t("no_result_what"));
      setIcon(sign, SIGNS[verdict] ?? "warning");
      for (const name of Object.keys(SIGNS)) kind(banner, name, result ? verdict === name : false);
      // what is not accepted is not to be used: it is not handed out
      const isUsable = Boolean(result) && verdict === "accepted";
      show(transform.element, isUsable && Boolean(state.progress?.mount_from_camera));
      show(tabs.element, isUsable);
      transform.update(state);
      if (isUsable) tabs.update(state);
      drawFiles(result?.files ?? []);
      show(filesBox, Boolean(result));
    },
  };
}

/** What the verdict rests on. */
function headlineOf(element: Element, state: State, verdict: Verdict): void {
  const { p95_mm: error, tolerance_mm: tolerance, reasons, captures } = state.progress ?? {};
  // what views contradict is said in the sentence on top
  if (state.verify?.agrees === false) showTranslated(element, state.say);
  else if (verdict !== "accepted") showTranslated(element, reasons, sentence);
  else showOwn(element, t("accepted_by", { error: mm(error), tolerance: mm(tolerance), count: captures ?? 0 }));
}
