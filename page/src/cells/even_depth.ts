// Slices drawn equally deep, so that those near the eye can be seen beside those far away.

import type { Vec3 } from "./details.ts";
import type { Geometry } from "./geometry.ts";

// Depths (or distances) become what they are on an axis with equal slices that ends where the real one does.
export function evenDepth(
  geometry: Geometry,
  boundaries: number[],
): { geometry: Geometry; warp: (point: Vec3) => Vec3 } {
  const slices = boundaries.length - 1,
    end = boundaries[slices]!;
  const even = (k: number) => (end * (k + 1)) / (slices + 1);
  const warped = (depth: number): number => {
    if (depth <= boundaries[0]!) return (depth * even(0)) / boundaries[0]!;
    const k = boundaries.findIndex((boundary) => depth < boundary) - 1;
    if (k < 0) return depth;
    return even(k) + ((even(k + 1) - even(k)) * (depth - boundaries[k]!)) / (boundaries[k + 1]! - boundaries[k]!);
  };
  return {
    geometry: {
      ...geometry,
      block: (x, y, z) => {
        const block = geometry.block(x, y, z);
        return [block[0], block[1], block[2], block[3], even(z), even(z + 1)];
      },
    },
    warp: ([x, y, z]) => {
      const along = geometry.shape === "shells" ? Math.hypot(x, y, z) : Math.abs(z);
      const scale = along > 0 ? warped(along) / along : 1;
      return [x * scale, y * scale, z * scale];
    },
  };
}

export const canBeEven = (geometry: Geometry, boundaries: number[]) =>
  geometry.shape !== "box" && boundaries.length > 2 && boundaries[0]! > 0;
