// The step "robot": is it connected, do the numbers follow when it moves, and in which notation are they shown?

import { sendTyped } from "./actions";
import type { App, Part } from "./app";
import { button, card, labelled } from "./controls";
import { field, h, show } from "./dom";
import { facts } from "./facts";
import { makeJog } from "./jog";
import { makeTyping } from "./typing";
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
  ["quaternion-xyzw", "x y z qx qy qz qw (m)"],
  ["quaternion-wxyz", "x y z qw qx qy qz (m)"],
  ["matrix4x4", "4 × 4 (m)"],
];

export function makeStepRobot(app: App): Part {
  const seen = facts();
  const choice = () => h("select", {}, ...NOTATIONS.map(([value, what]) => h("option", { value }, what)));
  const notation = choice();
  notation.addEventListener("change", () => void app.send({ do: "notation", name: notation.value }));
  const really = choice();
  const reread = button("reread", () => void app.send({ do: "notation", name: really.value, reread: true }));
  const typedOtherwise = card(
    "typed_otherwise",
    said(h("p", { class: "hint" }), "typed_otherwise_hint"),
    labelled("typed_in", really),
    reread,
  );
  const typed = makeTyping(app, () => void sendTyped(app));
  const use = button("use_pose", () => void sendTyped(app));
  const jog = makeJog(app);
  const typing = card("type_pose", typed.element, use);
  const element = h(
    "div",
    { class: "stack" },
    card("robot", seen.element, labelled("notation", notation), said(h("p", { class: "hint" }), "flange_hint")),
    typing,
    typedOtherwise,
    jog.element,
  );
  return {
    element,
    update(state) {
      const robot = state.robot;
      const connected = robot?.connected === true;
      seen.update([
        ...(robot?.typed
          ? [{ name: t("poses"), value: t("from_pendant"), good: undefined }]
          : [{ name: t("poses"), value: t(connected ? "streaming" : "no_robot"), good: connected }]),
        { name: t(robot?.typed ? "newest" : "rest"), said: robot?.why, good: robot?.typed ? undefined : robot?.stands },
      ]);
      const wanted = state.cell?.notation ?? "";
      if (wanted && ![...notation.options].some(({ value }) => value === wanted)) {
        notation.append(h("option", { value: wanted }, wanted));
      }
      field(notation, wanted);
      typed.update(state);
      show(typing, robot?.typed === true);
      show(typedOtherwise, robot?.typed === true && (state.captures?.length ?? 0) > 0);
      jog.update(state);
    },
  };
}
