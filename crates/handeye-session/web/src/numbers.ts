// Numbers as people read them: with as many digits as count, and their units.

import type { Maybe } from "./state";

/** Millimetres with three digits that count: 0.062, 0.62, 6.2, 62. */
export function mm(value: Maybe<number>): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  return value.toFixed(size < 0.1 ? 3 : size < 10 ? 2 : size < 100 ? 1 : 0);
}

/** A small number of any unit, with two digits that count. */
export function small(value: Maybe<number>): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  return value.toFixed(size < 0.01 ? 4 : size < 0.1 ? 3 : size < 10 ? 2 : 1);
}

export interface Column {
  name: string;
  unit: string;
  digits: number;
}

/** What the makers' notations count in: position, then rotation. */
const UNITS: Record<string, [string, string]> = {
  ur: ["m", "rad"],
  "ur-rpy": ["m", "rad"],
  kuka: ["mm", "°"],
  fanuc: ["mm", "°"],
  abb: ["mm", ""],
  yaskawa: ["mm", "°"],
  kawasaki: ["mm", "°"],
  staubli: ["mm", "°"],
  doosan: ["mm", "°"],
  denso: ["mm", "°"],
};

const DIGITS: Record<string, number> = { m: 5, mm: 2, rad: 4, "°": 3, deg: 3 };

/** Names, units and digits of the numbers of a pose. */
export function columns(names: Maybe<string[]>, count: number, notation: Maybe<string>, units: Maybe<string[]>): Column[] {
  const [position, rotation] = UNITS[notation ?? ""] ?? ["", ""];
  return Array.from({ length: count }, (_, i) => {
    const name = names?.[i] ?? String(i + 1);
    const [, plain, suffix] = /^(.*?)_(mm|m|deg|rad)$/.exec(name) ?? [null, name, null];
    const unit = units?.[i] ?? suffix ?? (count === 16 ? "" : i < 3 ? position : rotation);
    return { name: plain ?? name, unit: unit === "deg" ? "°" : unit, digits: DIGITS[unit] ?? 5 };
  });
}
