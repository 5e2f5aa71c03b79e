// A camera that circles a point, moved by mouse, touch and keys. Matrices are column by column, as WebGL takes them.

import type { Vec3 } from "./details.ts";

export interface Orbit {
  target: Vec3;
  distance: number;
  yaw: number; // radians; 0 looks along -z, as the frame's camera does
  pitch: number; // radians; above 0 looks down
}

const fieldOfView = 0.7;

function product(a: Float32Array, b: Float32Array): Float32Array {
  return Float32Array.from({ length: 16 }, (_, at) => {
    const row = at % 4,
      column = at - row;
    return (
      a[row]! * b[column]! + a[row + 4]! * b[column + 1]! + a[row + 8]! * b[column + 2]! + a[row + 12]! * b[column + 3]!
    );
  });
}

// The orbit's right, up and backward axes.
export function axesOf({ yaw, pitch }: Orbit): [Vec3, Vec3, Vec3] {
  const [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  return [
    [cy, 0, -sy],
    [-sy * sp, cp, -cy * sp],
    [sy * cp, sp, cy * cp],
  ];
}

const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export function matrixOf(orbit: Orbit, aspect: number): Float32Array {
  const { target, distance } = orbit,
    [right, up, back] = axesOf(orbit);
  const eye = target.map((value, axis) => value + back[axis]! * distance) as Vec3;
  const view = Float32Array.of(
    right[0],
    up[0],
    back[0],
    0,
    right[1],
    up[1],
    back[1],
    0,
    right[2],
    up[2],
    back[2],
    0,
    -dot(right, eye),
    -dot(up, eye),
    -dot(back, eye),
    1,
  );
  const near = distance / 200,
    far = distance * 50,
    focus = 1 / Math.tan(fieldOfView / 2);
  const wide = Math.max(1, 1 / aspect); // a high picture shows as much across as a square one
  const projection = Float32Array.of(
    focus / (aspect * wide),
    0,
    0,
    0,
    0,
    focus / wide,
    0,
    0,
    0,
    0,
    (far + near) / (near - far),
    -1,
    0,
    0,
    (2 * far * near) / (near - far),
    0,
  );
  return product(projection, view);
}

function turn(orbit: Orbit, yaw: number, pitch: number): void {
  orbit.yaw += yaw;
  orbit.pitch = Math.min(1.55, Math.max(-1.55, orbit.pitch + pitch));
}

function shift(orbit: Orbit, right: number, up: number): void {
  const axes = axesOf(orbit);
  orbit.target = orbit.target.map(
    (value, at) => value + orbit.distance * (right * axes[0][at]! + up * axes[1][at]!),
  ) as Vec3;
}

function zoom(orbit: Orbit, factor: number): void {
  orbit.distance *= factor;
}

const step = 0.12;
const keys: Record<string, (orbit: Orbit, isShifted: boolean) => void> = {
  ArrowLeft: (orbit, isShifted) => (isShifted ? shift(orbit, -step, 0) : turn(orbit, -step, 0)),
  ArrowRight: (orbit, isShifted) => (isShifted ? shift(orbit, step, 0) : turn(orbit, step, 0)),
  ArrowUp: (orbit, isShifted) => (isShifted ? shift(orbit, 0, step) : turn(orbit, 0, step)),
  ArrowDown: (orbit, isShifted) => (isShifted ? shift(orbit, 0, -step) : turn(orbit, 0, -step)),
  "+": (orbit) => zoom(orbit, 1 / 1.2),
  "=": (orbit) => zoom(orbit, 1 / 1.2),
  "-": (orbit) => zoom(orbit, 1.2),
};

// Drags turn, with a second button, Shift or two fingers they shift; the wheel zooms while the canvas has the focus, so
// that a page scrolls past it. Home goes back to the start.
export function control(
  canvas: HTMLCanvasElement,
  orbit: Orbit,
  start: () => Orbit,
  redraw: () => void,
  onClick: (x: number, y: number) => void,
): void {
  const pointers = new Map<number, PointerEvent>();
  let travelled = 0;
  const move = (event: PointerEvent) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const dx = (event.clientX - last.clientX) / canvas.clientHeight,
      dy = (event.clientY - last.clientY) / canvas.clientHeight;
    travelled += Math.hypot(event.clientX - last.clientX, event.clientY - last.clientY);
    pointers.set(event.pointerId, event);
    if (pointers.size > 1 || event.shiftKey || event.buttons > 1) shift(orbit, -dx, dy);
    else turn(orbit, -4 * dx, 4 * dy);
    redraw();
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
    travelled = 0;
  });
  canvas.addEventListener("pointermove", move);
  canvas.addEventListener("pointerup", (event) => {
    pointers.delete(event.pointerId);
    const box = canvas.getBoundingClientRect();
    if (travelled < 4) onClick(event.clientX - box.left, event.clientY - box.top);
  });
  canvas.addEventListener("pointercancel", (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      zoom(orbit, Math.exp(0.0015 * event.deltaY));
      redraw();
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const key = keys[event.key];
    if (event.ctrlKey || event.metaKey || event.altKey || (!key && event.key !== "Home")) return;
    event.preventDefault();
    if (key) key(orbit, event.shiftKey);
    else Object.assign(orbit, start());
    redraw();
  });
}
