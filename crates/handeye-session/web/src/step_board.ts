// The step "board": which target is it, how large are its squares, and is it found in the live picture?

import { fixedBy } from "./actions";
import type { App, Part } from "./app";
import { card, labelled, makeFixed } from "./controls";
import { attribute, field, h, kind, show } from "./dom";
import { icon, setIcon } from "./icons";
import { numberField, type NumberField } from "./number_field";
import type { Target } from "./state";
import { DICTIONARIES, FAMILIES, TARGETS, type TargetField } from "./targets";
import { showOwn, said, sentence, t, showTranslated } from "./words";

interface Control {
  element: HTMLElement;
  value(): number | string | null;
  set(value: unknown): void;
  disable(off: boolean): void;
}

const STEP = { count: 1, id: 1, length: 0.5, ratio: 0.05 };
const LEAST = { count: 1, id: 0, length: 0.01, ratio: 0.01 };

function control(spec: TargetField, changed: () => void): Control {
  if (spec.kind === "dictionary" || spec.kind === "family") {
    const values = spec.kind === "family" ? FAMILIES : DICTIONARIES;
    const select = h("select", {}, ...values.map((value) => h("option", { value }, value.replace("DICT_", ""))));
    select.addEventListener("change", changed);
    select.value = String(spec.initial);
    return {
      element: labelled(spec.label, select),
      value: () => select.value,
      set: (value) => typeof value === "string" && values.includes(value) && field(select, value),
      disable: (off) => attribute(select, "disabled", off),
    };
  }
  const unit = spec.kind === "length" ? { unit: "mm" } : {};
  const made: NumberField = numberField({ label: spec.label, ...unit, step: STEP[spec.kind], least: LEAST[spec.kind], changed });
  made.set(Number(spec.initial));
  return { ...made, set: (value) => made.set(typeof value === "number" ? value : undefined) };
}

export function makeStepBoard(app: App): Part {
  const sort = h("select", {}, ...Object.entries(TARGETS).map(([value, { label }]) => said(h("option", { value }), label)));
  const forms = new Map<string, { element: HTMLElement; controls: [string, Control][] }>();
  const place = h("div", { class: "forms" });
  const sign = icon("check");
  const proof = h("p");
  const found = h("div", { class: "proof" }, sign, proof);
  const fixed = makeFixed();
  const element = h(
    "div",
    { class: "stack" },
    card("in_picture", found),
    card("board", fixed.element, labelled("target_kind", sort), place, said(h("p", { class: "hint" }), "measure_board")),
  );
  sort.addEventListener("change", () => {
    send(sort.value);
    app.redraw();
  });

  function form(name: string) {
    let made = forms.get(name);
    if (!made) {
      const controls = (TARGETS[name]?.fields ?? []).map((spec): [string, Control] => [spec.name, control(spec, () => send(name))]);
      made = { element: h("div", { class: "grid" }, ...controls.map(([, { element: one }]) => one)), controls };
      forms.set(name, made);
      place.append(made.element);
    }
    return made;
  }

  /** Sends the target; what the form does not know of it stays as it was. */
  function send(name: string): void {
    const values = form(name).controls.map(([key, { value }]) => [key, value()] as const);
    if (values.some(([, value]) => value === null)) return;
    const before = app.state?.cell?.target;
    const kept = before?.kind === name ? before : {};
    const target: Target = { ...kept, kind: name, ...Object.fromEntries(values) };
    void app.send({ do: "target", target });
  }

  return {
    element,
    update(state) {
      const target = state.cell?.target;
      const name = target && TARGETS[target.kind] ? target.kind : sort.value;
      field(sort, name);
      const fixes = fixedBy(state);
      fixed.update(state);
      attribute(sort, "disabled", fixes !== null);
      const shown = form(name);
      for (const one of forms.values()) show(one.element, one === shown);
      for (const [key, one] of shown.controls) {
        one.set(target?.kind === name ? target[key] : undefined);
        one.disable(fixes !== null);
      }
      const good = Boolean(state.camera?.found) && !state.camera?.missing;
      if (good) showTranslated(proof, state.camera?.found);
      else if (state.camera?.missing) showTranslated(proof, state.camera.missing, sentence);
      else showOwn(proof, t("not_found_yet"));
      kind(found, "good", good);
      kind(found, "bad", !good);
      setIcon(sign, good ? "check" : "warning");
    },
  };
}
