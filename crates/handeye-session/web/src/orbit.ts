// Looks around a point: drag to rotate, wheel or two fingers to come nearer, arrow keys where it has the focus.

import { PerspectiveCamera, Vector3 } from "three";

const PER_PIXEL = 0.008; // rad
const PER_KEY = 0.12; // rad
const STEEPEST = 1.5; // rad
const NEAREST = 0.2; // of the distance that shows everything
const FARTHEST = 4;

export class Orbit {
  private azimuth = -0.9;
  private height = 0.5;
  private zoom = 1;
  private readonly fingers = new Map<number, { x: number; y: number }>();
  readonly centre = new Vector3(0.3, 0, 0.3);
  radius = 1;

  constructor(
    element: HTMLElement,
    private readonly moved: () => void,
  ) {
    element.addEventListener("pointerdown", (event) => {
      element.setPointerCapture(event.pointerId);
      this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    for (const end of ["pointerup", "pointercancel"] as const) {
      element.addEventListener(end, (event) => this.fingers.delete(event.pointerId));
    }
    element.addEventListener("pointermove", (event) => this.drag(event));
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    element.addEventListener("keydown", (event) => this.key(event));
  }

  place(camera: PerspectiveCamera): void {
    const flat = Math.cos(this.height);
    const far = (this.radius * this.zoom) / Math.sin((camera.fov * Math.PI) / 360) / Math.min(1, camera.aspect);
    camera.position
      .set(flat * Math.cos(this.azimuth), flat * Math.sin(this.azimuth), Math.sin(this.height))
      .multiplyScalar(far)
      .add(this.centre);
    camera.near = far / 100;
    camera.far = far * 20;
    camera.lookAt(this.centre);
  }

  private turn(sideways: number, up: number): void {
    this.azimuth -= sideways;
    this.height = Math.min(STEEPEST, Math.max(-0.2, this.height + up));
    this.moved();
  }

  private scale(factor: number): void {
    this.zoom = Math.min(FARTHEST, Math.max(NEAREST, this.zoom * factor));
    this.moved();
  }

  private drag(event: PointerEvent): void {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...this.fingers].find(([id]) => id !== event.pointerId)?.[1];
    this.fingers.set(event.pointerId, now);
    if (other) {
      const apart = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
      this.scale(apart(before) / Math.max(1, apart(now)));
    } else this.turn((now.x - before.x) * PER_PIXEL, (now.y - before.y) * PER_PIXEL);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    this.scale(Math.exp(event.deltaY * 0.001));
  }

  private key(event: KeyboardEvent): void {
    const ways: Record<string, [number, number]> = {
      ArrowLeft: [-PER_KEY, 0],
      ArrowRight: [PER_KEY, 0],
      ArrowUp: [0, PER_KEY],
      ArrowDown: [0, -PER_KEY],
    };
    const way = ways[event.key];
    if (way) this.turn(...way);
    else if (event.key === "+") this.scale(1 / 1.2);
    else if (event.key === "-") this.scale(1.2);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
