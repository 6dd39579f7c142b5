// The kinds of targets: which numbers each is declared by, under the names that `[target]` of `handeye.toml` has, and how
// large it is.

import type { Maybe, Target } from "./state";
import type { Key } from "./words";

export interface TargetField {
  name: string;
  label: Key;
  kind: "count" | "length" | "ratio" | "id" | "dictionary" | "family";
  initial: number | string;
}

const count = (name: string, label: Key, initial: number): TargetField => ({ name, label, kind: "count", initial });
const length = (name: string, label: Key, initial: number): TargetField => ({ name, label, kind: "length", initial });
const dictionary: TargetField = { name: "dictionary", label: "dictionary", kind: "dictionary", initial: "DICT_5X5_100" };

export const TARGETS: Record<string, { label: Key; fields: TargetField[] }> = {
  checkerboard: {
    label: "checkerboard",
    fields: [count("columns", "inner_columns", 9), count("rows", "inner_rows", 6), length("square_mm", "square", 30)],
  },
  charuco: {
    label: "charuco",
    fields: [
      count("squares_x", "squares_x", 9),
      count("squares_y", "squares_y", 6),
      length("square_mm", "square", 28),
      length("marker_mm", "marker", 21),
      dictionary,
    ],
  },
  aprilgrid: {
    label: "aprilgrid",
    fields: [
      count("tags_x", "tags_x", 6),
      count("tags_y", "tags_y", 6),
      length("tag_mm", "tag_size", 30),
      { name: "spacing", label: "spacing", kind: "ratio", initial: 0.3 },
      { name: "family", label: "family", kind: "family", initial: "36h11" },
    ],
  },
  "tag-grid": {
    label: "tag_grid",
    fields: [
      count("tags_x", "tags_x", 5),
      count("tags_y", "tags_y", 4),
      length("tag_mm", "tag_size", 40),
      length("gap_mm", "gap", 10),
      dictionary,
    ],
  },
  tag: {
    label: "tag",
    fields: [dictionary, { name: "id", label: "tag_id", kind: "id", initial: 0 }, length("size_mm", "tag_size", 60)],
  },
  "circle-grid": {
    label: "circle_grid",
    fields: [count("columns", "circles_x", 9), count("rows", "circles_y", 7), length("pitch_mm", "pitch", 20)],
  },
  "asymmetric-circle-grid": {
    label: "asymmetric_circle_grid",
    fields: [count("columns", "circles_x", 4), count("rows", "circles_y", 11), length("pitch_mm", "row_pitch", 20)],
  },
  "modified-circle-grid": {
    label: "modified_circle_grid",
    fields: [count("columns", "circles_x", 10), count("rows", "circles_y", 10), length("pitch_mm", "pitch", 20)],
  },
  sphere: { label: "sphere", fields: [length("diameter_mm", "diameter", 40)] },
};

const sizes = ["4X4", "5X5", "6X6", "7X7"].flatMap((bits) => [50, 100, 250, 1000].map((many) => `DICT_${bits}_${many}`));
export const FAMILIES = ["16h5", "25h9", "36h10", "36h11"];
export const DICTIONARIES = [...sizes, "DICT_ARUCO_ORIGINAL", ...FAMILIES.map((family) => `DICT_APRILTAG_${family}`)];

/** Where a target reaches in its own x and y, in metres; `squares` are those of a board of squares. */
export interface Extent {
  left: number;
  top: number;
  right: number;
  bottom: number;
  squares: [number, number] | null;
  radius: number | null; // of a ball
}

export function extent(target: Maybe<Target>): Extent {
  const n = (name: string, otherwise: number) => {
    const value = Number(target?.[name]);
    return Number.isFinite(value) && value > 0 ? value : otherwise;
  };
  const box = (left: number, top: number, right: number, bottom: number, squares: [number, number] | null = null) => {
    const [l, t, r, b] = [left / 1000, top / 1000, right / 1000, bottom / 1000];
    return { left: l, top: t, right: r, bottom: b, squares, radius: null };
  };
  const [columns, rows, pitch] = [n("columns", 9), n("rows", 6), n("pitch_mm", 20)];
  const [wide, high] = [n("squares_x", columns), n("squares_y", rows)];
  const square = n("square_mm", 30);
  const tag = n("tag_mm", 30);
  const gap = n("gap_mm", tag * n("spacing", 0.3));
  const tags = (many: number) => many * tag + (many - 1) * gap;
  switch (target?.kind) {
    case "charuco":
      return box(0, 0, wide * square, high * square, [wide, high]);
    case "circle-grid":
      return box(-pitch, -pitch, columns * pitch, rows * pitch);
    case "asymmetric-circle-grid":
      return box(-pitch, -pitch, 2 * columns * pitch, rows * pitch);
    case "modified-circle-grid":
      return box(-pitch, -rows * pitch, columns * pitch, pitch);
    case "aprilgrid":
      return box(-gap, -tags(n("tags_y", 6)) - gap, tags(n("tags_x", 6)) + gap, gap);
    case "tag-grid":
      return box(-gap, -gap, tags(n("tags_x", 5)) + gap, tags(n("tags_y", 4)) + gap);
    case "tag":
      return box(-0.6 * n("size_mm", 60), -0.6 * n("size_mm", 60), 0.6 * n("size_mm", 60), 0.6 * n("size_mm", 60));
    case "sphere":
      return { ...box(-20, -20, 20, 20), radius: n("diameter_mm", 40) / 2000 };
    default:
      return box(-square, -square, columns * square, rows * square, [columns + 1, rows + 1]);
  }
}
