// The shapes in the 3D cell: board, camera, flange, axes, and an arm that stands for the robot.

import {
  BufferGeometry,
  CanvasTexture,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  NearestFilter,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { Intrinsics, Maybe, Pose } from "./state";
import type { Extent } from "./targets";

export function matrix(pose: Pose): Matrix4 {
  return new Matrix4().compose(
    new Vector3(...pose.translation_m),
    new Quaternion(...pose.rotation_xyzw),
    new Vector3(1, 1, 1),
  );
}

export function lines(points: number[], colour: string, opacity = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour, transparent: opacity < 1, opacity }));
}

type Point = [number, number, number];

/** Half of what a camera sees at a distance of 1. */
export function halfView(intrinsics: Maybe<Intrinsics>, width: number, height: number): [number, number] {
  const fx = intrinsics?.fx || width;
  const fy = intrinsics?.fy || fx;
  return [width / 2 / fx, height / 2 / fy];
}

/** The edges of a camera's pyramid, as pairs of points. */
export function pyramid([half, halfHigh]: [number, number], depth: number): Point[] {
  const corners: Point[] = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x = 0, y = 0]) => [
    x * half * depth,
    y * halfHigh * depth,
    depth,
  ]);
  const origin: Point = [0, 0, 0];
  const edges = corners.flatMap((corner, i): Point[] => [origin, corner, corner, corners[(i + 1) % 4] as Point]);
  const [left, right] = [corners[0] as Point, corners[1] as Point];
  const tip: Point = [0, left[1] * 1.35, depth]; // shows which way is up in the image
  return [...edges, left, tip, tip, right];
}

/** The four sides of a target. */
export function rim({ left, top, right, bottom }: Extent): Point[] {
  const corners: Point[] = [[left, top, 0], [right, top, 0], [right, bottom, 0], [left, bottom, 0]];
  return corners.flatMap((corner, i): Point[] => [corner, corners[(i + 1) % 4] as Point]);
}

/** Three short axes: stands for a flange while nothing is known of the camera. */
export function tripod(length: number): Point[] {
  return [[0, 0, 0], [length, 0, 0], [0, 0, 0], [0, length, 0], [0, 0, 0], [0, 0, length]];
}

/** The same edges seen from many poses, in one object. */
export function edgesAt(edges: Point[], places: Matrix4[], colour: string, opacity: number): LineSegments {
  const points = places.flatMap((place) => edges.flatMap((edge) => new Vector3(...edge).applyMatrix4(place).toArray()));
  return lines(points, colour, opacity);
}

/** A camera: a small body and what it sees. */
export function cameraShape(half: [number, number], depth: number, colour: string, body: boolean): Group {
  const group = new Group();
  group.add(lines(pyramid(half, depth).flat(), colour));
  const [a, b, c, d] = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([x = 0, y = 0]) => [x * half[0] * depth, y * half[1] * depth, depth]);
  const geometry = new BufferGeometry();
  const origin = [0, 0, 0];
  const faces = [origin, a, b, origin, b, c, origin, c, d, origin, d, a].flat() as number[];
  geometry.setAttribute("position", new Float32BufferAttribute(faces, 3));
  const glass = new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.13, side: DoubleSide, depthWrite: false });
  group.add(new Mesh(geometry, glass));
  if (body) {
    const shape = new CylinderGeometry(0.022, 0.022, 0.05, 24);
    shape.rotateX(Math.PI / 2);
    group.add(new Mesh(shape, new MeshLambertMaterial({ color: colour })));
  }
  return group;
}

function boardTexture([wide, high]: [number, number]): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = wide;
  canvas.height = high;
  const draw = canvas.getContext("2d") as CanvasRenderingContext2D;
  for (let row = 0; row < high; row += 1) {
    for (let column = 0; column < wide; column += 1) {
      draw.fillStyle = (row + column) % 2 ? "#f2f4f7" : "#20262e";
      draw.fillRect(column, row, 1, 1);
    }
  }
  const texture = new CanvasTexture(canvas);
  texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.minFilter = NearestFilter;
  texture.colorSpace = SRGBColorSpace;
  texture.flipY = false;
  return texture;
}

/** A target with its squares, in its own frame: y runs down the board, z into it. */
export function boardShape(size: Extent): Group {
  const group = new Group();
  if (size.radius) {
    group.add(new Mesh(new SphereGeometry(size.radius, 32, 24), new MeshLambertMaterial({ color: "#c9d1db" })));
    return group;
  }
  const [wide, high] = [size.right - size.left, size.bottom - size.top];
  const plane = new PlaneGeometry(wide, high);
  const look = size.squares
    ? new MeshBasicMaterial({ map: boardTexture(size.squares), side: DoubleSide })
    : new MeshBasicMaterial({ color: "#e6eaef", side: DoubleSide });
  const board = new Mesh(plane, look);
  board.position.set((size.left + size.right) / 2, (size.top + size.bottom) / 2, 0);
  group.add(board, lines(rim(size).flat(), "#808b99"));
  return group;
}

/** Axes x, y, z in red, green, blue. */
export function axes(length: number): Group {
  const group = new Group();
  const ends: [string, number[]][] = [["#e5484d", [length, 0, 0]], ["#2f9e57", [0, length, 0]], ["#3b82f6", [0, 0, length]]];
  for (const [colour, end] of ends) group.add(lines([0, 0, 0, ...end], colour));
  return group;
}

/** Lays a cylinder from one point to another. */
export function span(mesh: Mesh, from: Vector3, to: Vector3): void {
  const way = new Vector3().subVectors(to, from);
  mesh.position.addVectors(from, to).multiplyScalar(0.5);
  mesh.scale.set(1, Math.max(way.length(), 1e-6), 1);
  mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), way.normalize());
}

const TUBE = 0.035; // m, radius of a link
const LEAST_LINK = 1e-3; // m between two joints that have a link

/** An arm through the points of its joints: a tube for each link, a ball for each joint. */
export class ArmShape {
  readonly group = new Group();
  private readonly tube = new CylinderGeometry(TUBE, TUBE, 1, 20);
  private readonly ball = new SphereGeometry(TUBE * 1.25, 20, 14);
  private readonly parts: { joint: Mesh; link: Mesh }[] = [];

  constructor(private readonly look: Material) {}

  /** Draws it through these points of the base, from the base to the flange; without any it is not drawn. */
  update(points: Maybe<[number, number, number][]>): void {
    const at = (points ?? []).map((point) => new Vector3(...point));
    while (this.parts.length < at.length - 1) {
      const part = { joint: new Mesh(this.ball, this.look), link: new Mesh(this.tube, this.look) };
      this.group.add(part.joint, part.link);
      this.parts.push(part);
    }
    this.parts.forEach(({ joint, link }, i) => {
      const [from, to] = [at[i], at[i + 1]];
      joint.visible = Boolean(from && to);
      link.visible = Boolean(from && to && from.distanceTo(to) > LEAST_LINK);
      if (!from || !to) return;
      joint.position.copy(from);
      if (link.visible) span(link, from, to);
    });
  }
}

/** The elbow of two equal links, above the line from shoulder to wrist. */
export function elbow(shoulder: Vector3, wrist: Vector3, reach: number): Vector3 {
  const middle = new Vector3().addVectors(shoulder, wrist).multiplyScalar(0.5);
  const half = shoulder.distanceTo(wrist) / 2;
  const up = Math.sqrt(Math.max(0, (reach / 2) ** 2 - half ** 2));
  return middle.add(new Vector3(0, 0, up));
}
