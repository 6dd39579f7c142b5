// The step "robot": is it connected, do the numbers follow when it moves, and in which notation are they shown?

import type { App, Part } from "./app";
import { button, card, labelled } from "./controls";
import { attribute, field, h, show } from "./dom";
import { facts } from "./facts";
import { makeJog } from "./jog";
import { said, t } from "./words";

const NOTATIONS: [name: string, what: string][] = [
  ["ur", "Universal Robots: x y z rx ry rz"],
  ["ur-rpy", "Universal Robots: x y z roll pitch yaw"],
  ["kuka", "KUKA: X Y Z A B C"],
  ["fanuc", "FANUC: X Y Z W P R"],
  ["abb", "ABB: x y z q1 q2 q3 q4"],
  ["yaskawa", "Yaskawa: X Y Z Rx Ry Rz"],
  ["kawasaki", "Kawasaki: X Y Z O A T"],
  ["staubli", "Stäubli: x y z rx ry rz"],
  ["doosan", "Doosan: X Y Z A B C"],
  ["denso", "Denso: X Y Z RX RY RZ"],
];

export function makeStepRobot(app: App): Part {
  const seen = facts();
  const notation = h("select", {}, ...NOTATIONS.map(([value, what]) => h("option", { value }, what)));
  notation.addEventListener("change", () => void app.send({ do: "notation", name: notation.value }));
  const typed = h("input", { type: "text", autocomplete: "off", spellcheck: "false" });
  const use = button("use_pose", () => {
    void app.send({ do: "pose", text: typed.value }).then((sent) => {
      if (sent) typed.value = "";
    });
  });
  const jog = makeJog(app);
  const typing = card("type_pose", labelled("typed_pose", typed), use);
  const element = h(
    "div",
    { class: "stack" },
    card("robot", seen.element, labelled("notation", notation), said(h("p", { class: "hint" }), "flange_hint")),
    jog.element,
    typing,
  );
  return {
    element,
    update(state) {
      const robot = state.robot;
      const connected = robot?.connected === true;
      seen.update([
        { name: t("connected"), value: connected ? robot?.name : t("no_robot"), good: connected },
        { name: t("rest"), value: robot?.why, good: robot?.stands },
      ]);
      const wanted = state.cell?.notation ?? "";
      if (wanted && ![...notation.options].some(({ value }) => value === wanted)) {
        notation.append(h("option", { value: wanted }, wanted));
      }
      field(notation, wanted);
      attribute(typed, "placeholder", (robot?.columns ?? []).join(" "));
      show(typing, !connected);
      jog.update(state);
    },
  };
}
