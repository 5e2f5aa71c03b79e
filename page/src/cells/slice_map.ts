// One slice as a map of its tiles, drawn on a canvas without WebGL.

import { h } from "../dom.ts";
import { css, type Rgb } from "./colours.ts";
import type { Geometry } from "./geometry.ts";

export interface SliceMap {
  element: HTMLCanvasElement;
  draw: (
    geometry: Geometry,
    z: number,
    picked: [number, number],
    colourAt: (x: number, y: number) => Rgb | null,
    label: string,
  ) => void;
}

const mostHigh = 320;

export function sliceMap(onPick: (x: number, y: number) => void): SliceMap {
  const element = h("canvas", { class: "slice-map", role: "img" });
  let size = [1, 1],
    isTopDown = true;
  element.addEventListener("click", (event) => {
    const box = element.getBoundingClientRect();
    const x = Math.floor(((event.clientX - box.left) / box.width) * size[0]!),
      row = Math.floor(((event.clientY - box.top) / box.height) * size[1]!);
    const inside = (value: number, count: number) => Math.min(Math.max(value, 0), count - 1);
    onPick(inside(x, size[0]!), inside(isTopDown ? row : size[1]! - 1 - row, size[1]!));
  });

  const draw: SliceMap["draw"] = (geometry, z, picked, colourAt, label) => {
    const [nx, ny] = geometry.size;
    size = [nx, ny];
    isTopDown = geometry.topDown;
    const first = geometry.block(0, 0, z),
      last = geometry.block(nx - 1, ny - 1, z);
    const aspect = Math.abs(last[1] - first[0]) / Math.abs(geometry.topDown ? first[3] - last[2] : last[3] - first[2]);
    const width = Math.round(Math.min(element.parentElement?.clientWidth || 480, mostHigh * aspect)),
      height = Math.round(width / aspect);
    const pixels = Math.min(window.devicePixelRatio || 1, 2);
    [element.width, element.height] = [width * pixels, height * pixels];
    [element.style.width, element.style.height] = [`${width}px`, `${height}px`];
    element.setAttribute("aria-label", label);
    const pen = element.getContext("2d")!;
    const style = getComputedStyle(element);
    const [w, t] = [element.width / nx, element.height / ny];
    const box = (x: number, y: number): [number, number, number, number] => [
      x * w,
      (isTopDown ? y : ny - 1 - y) * t,
      w,
      t,
    ];
    const gap = Math.min(w, t) > 6 ? 1 : 0;
    for (let y = 0; y < ny; ++y)
      for (let x = 0; x < nx; ++x) {
        if (geometry.isHole(x, y, z)) continue;
        const colour = colourAt(x, y);
        pen.fillStyle = colour ? css(colour) : style.color;
        pen.globalAlpha = colour ? 1 : 0.09;
        const [left, top, wide, high] = box(x, y);
        pen.fillRect(left, top, wide - gap, high - gap);
      }
    pen.globalAlpha = 1;
    pen.lineWidth = 2 * pixels;
    pen.strokeStyle = style.color;
    const [left, top, wide, high] = box(...picked);
    pen.strokeRect(left, top, wide - gap, high - gap);
  };
  return { element, draw };
}
