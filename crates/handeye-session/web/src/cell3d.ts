// The cell in 3D: robot, camera, target, the captures so far and the next view. With the robot's model the arm is drawn
// through its joints, and faintly where the next view is; without it an arm stands for the robot, whose joints are not known.
// Drawn only when something has changed.

import {
  Color,
  CylinderGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Object3D,
  PerspectiveCamera,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from "three";
import type { App, Part } from "./app";
import { button } from "./controls";
import { h, show } from "./dom";
import { Orbit } from "./orbit";
import { ArmShape, axes, boardShape, cameraShape, edgesAt, elbow, halfView, lines, matrix, pyramid, rim, span, tripod } from "./shapes";
import { takesCaptures, type Maybe, type Point, type Pose, type State } from "./state";
import { extent } from "./targets";
import { named, said } from "./words";

const PYRAMID = 0.14; // m
const SMALL_PYRAMID = 0.07;
const GRID = 0.1; // m between the lines of the floor
const GHOST = 0.22; // opacity of the arm at the next view

interface Looks {
  paper: string;
  line: string;
  arm: string;
  camera: string;
  next: string;
  earlier: string;
  selected: string;
}

function looks(): Looks {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  return {
    paper: colour("--scene"),
    line: colour("--scene-line"),
    arm: colour("--scene-arm"),
    camera: colour("--accent"),
    next: colour("--next"),
    earlier: colour("--soft"),
    selected: colour("--ink"),
  };
}

const product = (a: Maybe<Pose>, b: Maybe<Pose>): Matrix4 | null => (a && b ? matrix(a).multiply(matrix(b)) : null);

/** Where camera and target are while the flange is at a pose. */
export function placesAt(state: State, flange: Maybe<Pose>): { camera: Matrix4 | null; target: Matrix4 | null } {
  const { mount_from_camera: x, anchor_from_target: y } = state.progress ?? {};
  if (state.cell?.setup === "eye-to-hand") return { camera: x ? matrix(x) : null, target: product(flange, y) };
  return { camera: product(flange, x), target: y ? matrix(y) : null };
}

export function makeCell(app: App): Part {
  const canvas = h("canvas", { tabindex: 0, role: "img" });
  named(canvas, "cell_3d");
  const without = said(h("p", { class: "without" }), "no_3d");
  const element = h("div", { class: "pane cell" }, canvas, without);
  const swap = button("swap", () => app.choose({ large: app.choices.large === "cell" ? "picture" : "cell" }), {
    icon: "swap",
    bare: true,
    class: "swap",
  });
  element.append(swap);
  let drawing: Drawing | null = null;
  try {
    drawing = new Drawing(canvas, element);
  } catch {
    canvas.hidden = true;
  }
  show(without, drawing === null);
  return {
    element,
    update(state) {
      if (element.clientWidth) drawing?.update(state, app.choices.selected);
    },
  };
}

/** A part of the scene that is made anew only when what it shows has changed. */
class Piece {
  private made = "";
  readonly group = new Group();

  set(name: string, make: () => Object3D[]): boolean {
    if (name === this.made) return false;
    this.made = name;
    this.group.clear();
    for (const object of make()) this.group.add(object);
    return true;
  }
}

class Drawing {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly eye = new PerspectiveCamera(35, 1, 0.01, 100);
  private readonly orbit: Orbit;
  private readonly pieces = { board: new Piece(), camera: new Piece(), next: new Piece(), captures: new Piece(), floor: new Piece() };
  private readonly flange = axes(0.1);
  private readonly links: Mesh[];
  private readonly joints: Mesh[];
  private readonly armLook = new MeshLambertMaterial({ color: "#9aa7b8" });
  private readonly ghostLook = new MeshLambertMaterial({ transparent: true, opacity: GHOST, depthWrite: false });
  private readonly model = new ArmShape(this.armLook);
  private readonly ghost = new ArmShape(this.ghostLook);
  private looks: Looks = looks();
  private reach = 1;
  private readonly bend = new Vector3(0, 0, 0.6);
  private pending = false;
  private drawn = ""; // what is to be seen

  constructor(canvas: HTMLCanvasElement, private readonly element: HTMLElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.orbit = new Orbit(canvas, () => this.draw());
    this.eye.up.set(0, 0, 1);
    this.links = [0.07, 0.055, 0.045, 0.035].map((radius) => new Mesh(new CylinderGeometry(radius, radius, 1, 24), this.armLook));
    this.joints = [0.065, 0.055, 0.045].map((radius) => new Mesh(new SphereGeometry(radius, 24, 16), this.armLook));
    const sun = new DirectionalLight("#ffffff", 2);
    sun.position.set(1, -1.5, 3);
    this.scene.add(new HemisphereLight("#ffffff", "#8a93a0", 2), sun, axes(0.2), this.flange);
    this.scene.add(this.model.group, this.ghost.group, ...this.links, ...this.joints, ...Object.values(this.pieces).map((piece) => piece.group));
    new ResizeObserver(() => this.draw()).observe(element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.looks = looks();
      for (const piece of Object.values(this.pieces)) piece.set("", () => []);
      this.drawn = "";
      this.draw();
    });
  }

  update(state: State, selected: string | null): void {
    // a state comes with every image, and most change nothing here
    const name = shown(state, selected);
    if (name === this.drawn) return;
    this.drawn = name;
    const here = placesAt(state, state.robot?.base_from_flange);
    const there = takesCaptures(state) ? placesAt(state, state.next?.base_from_flange) : { camera: null, target: null };
    this.floor();
    this.arm(state.robot?.base_from_flange, state.arm?.points);
    this.ghost.update(takesCaptures(state) ? state.arm?.next_points : null);
    this.board(state, here.target);
    this.camera(state, here.camera);
    this.next(state, there);
    this.captures(state, selected);
    this.frame(state, here);
    this.draw();
  }

  private floor(): void {
    this.pieces.floor.set("floor", () => {
      const half = 10 * GRID;
      const grid: number[] = [];
      for (let at = -half; at <= half + 1e-9; at += GRID) grid.push(-half, at, 0, half, at, 0, at, -half, 0, at, half, 0);
      this.scene.background = new Color(this.looks.paper);
      this.armLook.color.set(this.looks.arm);
      this.ghostLook.color.set(this.looks.next);
      return [lines(grid, this.looks.line)];
    });
  }

  private arm(pose: Maybe<Pose>, points: Maybe<Point[]>): void {
    this.model.update(points);
    for (const mesh of [...this.links, ...this.joints]) mesh.visible = Boolean(pose) && !points;
    this.flange.visible = Boolean(pose);
    if (!pose) return;
    const flange = matrix(pose);
    this.flange.matrixAutoUpdate = false;
    this.flange.matrix.copy(flange);
    if (points) {
      this.bend.copy(highest(points));
      return;
    }
    const end = new Vector3().setFromMatrixPosition(flange);
    const wrist = new Vector3(0, 0, -0.12).applyMatrix4(flange);
    const shoulder = new Vector3(0, 0, 0.25);
    this.reach = Math.max(this.reach, shoulder.distanceTo(wrist) * 1.15);
    const bend = elbow(shoulder, wrist, this.reach);
    const path = [new Vector3(), shoulder, bend, wrist, end];
    this.links.forEach((link, i) => span(link, path[i] as Vector3, path[i + 1] as Vector3));
    this.joints.forEach((joint, i) => joint.position.copy(path[i + 1] as Vector3));
    this.bend.copy(bend);
  }

  private board(state: State, place: Matrix4 | null): void {
    const target = state.cell?.target;
    this.pieces.board.set(JSON.stringify(target ?? null), () => [boardShape(extent(target))]);
    put(this.pieces.board.group, place);
  }

  private view(state: State): [number, number] {
    return halfView(state.cell?.intrinsics, state.camera?.width || 1280, state.camera?.height || 800);
  }

  private camera(state: State, place: Matrix4 | null): void {
    const half = this.view(state);
    this.pieces.camera.set(String(half), () => [cameraShape(half, PYRAMID, this.looks.camera, true)]);
    put(this.pieces.camera.group, place);
  }

  private next(state: State, { camera, target }: { camera: Matrix4 | null; target: Matrix4 | null }): void {
    const isBoard = state.cell?.setup === "eye-to-hand";
    const flange = takesCaptures(state) ? state.next?.base_from_flange : null;
    const moving = isBoard ? target : camera;
    const half = this.view(state);
    this.pieces.next.set(`${moving !== null} ${isBoard} ${half} ${JSON.stringify(state.cell?.target ?? null)}`, () => {
      if (!moving) return [lines(tripod(PYRAMID).flat(), this.looks.next)];
      if (isBoard) return [lines(rim(extent(state.cell?.target)).flat(), this.looks.next)];
      return [cameraShape(half, PYRAMID, this.looks.next, true)];
    });
    put(this.pieces.next.group, moving ?? (flange ? matrix(flange) : null));
  }

  private captures(state: State, selected: string | null): void {
    const captures = state.captures ?? [];
    const { mount_from_camera: x, anchor_from_target: y } = state.progress ?? {};
    const name = JSON.stringify([captures.map(({ id, used }) => [id, used]), x, y, selected, state.cell?.setup]);
    this.pieces.captures.set(name, () => {
      const isBoard = state.cell?.setup === "eye-to-hand";
      const isKnown = Boolean(isBoard ? y : x);
      const edges = !isKnown ? tripod(SMALL_PYRAMID) : isBoard ? rim(extent(state.cell?.target)) : pyramid(this.view(state), SMALL_PYRAMID);
      const place = (pose: Maybe<Pose>) =>
        isKnown ? placesAt(state, pose)[isBoard ? "target" : "camera"] : pose ? matrix(pose) : null;
      const of = (chosen: boolean) =>
        captures
          .filter(({ id }) => (id === selected) === chosen)
          .map((capture) => place(capture.base_from_flange))
          .filter((found) => found !== null);
      return [edgesAt(edges, of(false), this.looks.earlier, 0.75), edgesAt(edges, of(true), this.looks.selected, 1)];
    });
  }

  /** Looks at the middle of what there is. */
  private frame(state: State, { camera, target }: { camera: Matrix4 | null; target: Matrix4 | null }): void {
    const points = [new Vector3(), this.bend];
    if (camera) points.push(new Vector3().setFromMatrixPosition(camera));
    const size = extent(state.cell?.target);
    if (target) points.push(...rim(size).map((corner) => new Vector3(...corner).applyMatrix4(target)));
    const next = state.next?.base_from_flange;
    for (const pose of [state.robot?.base_from_flange, next]) if (pose) points.push(new Vector3(...pose.translation_m));
    const low = points.reduce((a, b) => a.clone().min(b));
    const high = points.reduce((a, b) => a.clone().max(b));
    const middle = low.clone().add(high).multiplyScalar(0.5);
    const radius = Math.max(0.4, ...points.map((point) => 1.08 * point.distanceTo(middle)));
    if (middle.distanceTo(this.orbit.centre) > 0.1 * radius) this.orbit.centre.copy(middle);
    if (Math.abs(radius - this.orbit.radius) > 0.15 * radius) this.orbit.radius = radius;
  }

  private draw(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      const { clientWidth: wide, clientHeight: high } = this.element;
      if (!wide || !high) return;
      this.renderer.setSize(wide, high, false);
      this.eye.aspect = wide / high;
      this.orbit.place(this.eye);
      this.eye.updateProjectionMatrix();
      this.renderer.render(this.scene, this.eye);
    });
  }
}

/** All of a state that the scene shows, as text. */
function shown(state: State, selected: string | null): string {
  const { cell, robot, arm, camera, captures, progress } = state;
  const taken = captures?.map(({ id, used, base_from_flange }) => [id, used, base_from_flange]);
  const places = [robot?.base_from_flange, arm, state.next?.base_from_flange, progress?.mount_from_camera, progress?.anchor_from_target];
  const sizes = [cell?.target, cell?.setup, cell?.intrinsics, camera?.width, camera?.height];
  // a robot that stands still moves by its noise: nobody sees a tenth of a millimetre here
  const rounded = (_: string, value: unknown) => (typeof value === "number" ? Math.round(value * 1e4) : value);
  return JSON.stringify([places, sizes, taken, selected, takesCaptures(state)], rounded);
}

function highest(points: Point[]): Vector3 {
  return points.map((point) => new Vector3(...point)).reduce((a, b) => (b.z > a.z ? b : a), new Vector3());
}

function put(group: Group, place: Matrix4 | null): void {
  group.visible = place !== null;
  if (!place) return;
  group.matrixAutoUpdate = false;
  group.matrix.copy(place);
}
