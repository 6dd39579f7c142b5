// A field for a number with a large button on either side, for gloves. What is no number is marked and not sent.

import { attribute, field, h } from "./dom";
import { named, said, type Key } from "./words";

interface Options {
  label: Key;
  unit?: string;
  step: number;
  least: number;
  buttons?: boolean;
  changed(): void;
}

export interface NumberField {
  element: HTMLElement;
  value(): number | null;
  set(value: number | null | undefined): void;
  disable(off: boolean): void;
}

const HOLD = 1000; // ms in which what was entered here is not replaced by an older value from the server

let fields = 0;

export function numberField(options: Options): NumberField {
  fields += 1;
  const [id, labelId] = [`number-${fields}`, `number-label-${fields}`];
  const input = h("input", { type: "text", inputmode: "decimal", autocomplete: "off", id });

  function value(): number | null {
    const read = Number(input.value.trim().replace(",", "."));
    return input.value.trim() !== "" && Number.isFinite(read) && read >= options.least ? read : null;
  }

  let changedAt = -HOLD;

  function changed(): void {
    changedAt = performance.now();
    attribute(input, "aria-invalid", value() === null && "true");
    if (value() !== null) options.changed();
  }

  function stepBy(sign: number): void {
    const next = Math.max(options.least, (value() ?? 0) + sign * options.step);
    input.value = String(Math.round(next * 1e6) / 1e6);
    changed();
  }

  const stepper = (sign: number, mark: string) => {
    const made = named(h("button", { type: "button", class: "stepper", "aria-describedby": labelId }, mark), sign < 0 ? "less" : "more");
    made.addEventListener("click", () => stepBy(sign));
    return made;
  };

  input.addEventListener("change", changed);
  const unit = options.unit ? h("span", { class: "unit" }, options.unit) : null;
  const parts = options.buttons === false ? [input, unit] : [stepper(-1, "−"), input, unit, stepper(1, "+")];
  const label = said(h("label", { for: id, id: labelId }), options.label);
  const element = h("div", { class: "number-field labelled" }, label, h("div", { class: "row" }, ...parts));
  return {
    element,
    value,
    disable(off) {
      for (const part of parts) if (part && "disabled" in part) attribute(part, "disabled", off);
    },
    set(wanted) {
      if (typeof wanted === "number" && performance.now() - changedAt > HOLD) field(input, String(wanted));
      const isBad = input.value !== "" && value() === null;
      if (document.activeElement !== input) attribute(input, "aria-invalid", isBad && "true");
    },
  };
}
