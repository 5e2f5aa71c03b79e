// The picture in space: a canvas with WebGL2, its camera, and what is drawn in it.

import { h } from "../dom.ts";
import type { Rgb } from "./colours.ts";
import type { Vec3 } from "./details.ts";
import { type Cells, Painter, type Strokes } from "./gl.ts";
import { axesOf, control, matrixOf, type Orbit } from "./orbit.ts";

export interface Picture {
  cells: Cells;
  strokes: Strokes[];
  extent: { centre: Vec3; radius: number };
  about: string; // in words
  onPick: (instance: number) => void; // -1: the background
}

export interface Space {
  element: HTMLCanvasElement;
  show: (picture: Picture) => void;
  ink: () => Rgb; // of text, in the present colour scheme
  start: () => void; // puts the camera where it sees all of the picture
}

function orbitAround({ centre, radius }: Picture["extent"]): Orbit {
  return { target: [...centre], distance: 2.4 * radius, yaw: -0.75, pitch: 0.42 };
}

// null without WebGL2.
export function space(): Space | null {
  const element = h("canvas", { class: "cells-3d", tabindex: 0, role: "application", id: "cells-3d" });
  const gl = element.getContext("webgl2", { antialias: true });
  if (!gl) return null;
  let painter = new Painter(gl);
  let picture: Picture | null = null;
  let isWaiting = false;
  const orbit: Orbit = { target: [0, 0, 0], distance: 1, yaw: 0, pitch: 0 };
  const start = () => (picture ? orbitAround(picture.extent) : orbit);
  const camera = () => matrixOf(orbit, element.width / element.height);

  function paint(): void {
    isWaiting = false;
    const pixels = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(element.clientWidth * pixels),
      height = Math.round(element.clientHeight * pixels);
    if (!picture || width === 0 || gl!.isContextLost()) return;
    if (element.width !== width || element.height !== height) [element.width, element.height] = [width, height];
    painter.paint(camera(), axesOf(orbit)[2], picture.strokes, pixels);
  }
  function redraw(): void {
    if (!isWaiting) requestAnimationFrame(paint);
    isWaiting = true;
  }
  function pick(x: number, y: number): void {
    const pixels = element.width / element.clientWidth;
    const instance = painter.pick(camera(), Math.floor(x * pixels), element.height - 1 - Math.floor(y * pixels));
    redraw();
    picture?.onPick(instance);
  }

  control(element, orbit, start, redraw, pick);
  element.addEventListener("webglcontextlost", (event) => event.preventDefault());
  element.addEventListener("webglcontextrestored", () => {
    painter = new Painter(gl);
    if (picture) painter.setCells(picture.cells);
    redraw();
  });
  new ResizeObserver(redraw).observe(element);
  return {
    element,
    show: (next) => {
      picture = next;
      painter.setCells(next.cells);
      element.setAttribute("aria-label", next.about);
      redraw();
    },
    ink: () => (getComputedStyle(element).color.match(/[\d.]+/g) ?? [0, 0, 0]).slice(0, 3).map(Number) as Rgb,
    start: () => {
      Object.assign(orbit, start());
      redraw();
    },
  };
}
