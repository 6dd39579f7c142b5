// The sheet of keys.

import { button } from "./controls";
import { h } from "./dom";
import { named, said, type Key } from "./words";

const KEYS: [keys: string[], what: Key][] = [
  [["␣", "↵"], "key_primary"],
  [["N"], "key_next"],
  [["T"], "key_take"],
  [["A"], "key_automatic"],
  [["↑", "↓"], "key_select"],
  [["D"], "key_delete"],
  [["R"], "key_retake"],
  [["Z"], "key_undo"],
  [["1", "6"], "key_steps"],
  [["C"], "key_swap"],
  [["M"], "key_mute"],
  [["Esc"], "key_escape"],
  [["?"], "key_help"],
];

export function makeHelp(): HTMLDialogElement {
  const rows = KEYS.flatMap(([keys, what]) => [
    h("dt", {}, ...keys.flatMap((key, i) => [i && keys[0] === "1" ? " – " : i ? " " : null, h("kbd", {}, key)])),
    said(h("dd"), what),
  ]);
  const dialog = h("dialog", {}, said(h("h2"), "keys"), h("dl", { class: "keys" }, ...rows));
  dialog.append(button("close", () => dialog.close(), { class: "large" }));
  named(dialog, "keys");
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}
