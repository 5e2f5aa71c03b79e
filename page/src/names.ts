// Names beside marks, where there is room for them.

export interface Spot {
  x: number; // pixels
  y: number;
}

export interface Placement {
  dx: number;
  dy: number;
  textAnchor: "start" | "end";
}

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

// In the order in which they are tried: below, beside, above, to the left, and the same farther away.
export const placements: Placement[] = [
  { dx: -5, dy: 13, textAnchor: "start" },
  { dx: 9, dy: 0, textAnchor: "start" },
  { dx: -5, dy: -13, textAnchor: "start" },
  { dx: -9, dy: 0, textAnchor: "end" },
  { dx: -5, dy: 22, textAnchor: "start" },
  { dx: -5, dy: -22, textAnchor: "start" },
  { dx: 5, dy: 13, textAnchor: "end" },
  { dx: 5, dy: -13, textAnchor: "end" },
];

const letter = 6.3;

function boxOf({ x, y }: Spot, text: string, { dx, dy, textAnchor }: Placement): Box {
  const left = x + dx - (textAnchor === "end" ? letter * text.length : 0);
  return { left, right: left + letter * text.length, top: y + dy - 6, bottom: y + dy + 6 };
}

const around = ({ x, y }: Spot): Box => ({ left: x - 5, right: x + 5, top: y - 5, bottom: y + 5 });
const overlap = (a: Box, b: Box) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

// A bar from left to right, as of an interval.
export interface Bar {
  from: number;
  to: number;
  y: number;
}

const along = ({ from, to, y }: Bar): Box => ({ left: from, right: to, top: y - 2, bottom: y + 2 });

// A placement for each name that has one at which it hides no mark, no other name, no bar strikes it and it stays within the
// chart's room.
export function placed<T extends Spot & { text: string }>(
  names: T[],
  marks: Spot[],
  bars: Bar[],
  room: { right: number; bottom: number },
): { name: T; placement: Placement }[] {
  const taken = [...marks.map(around), ...bars.map(along)];
  return names.flatMap((name) => {
    const placement = placements.find((candidate) => {
      const box = boxOf(name, name.text, candidate);
      const isInside = box.left > 0 && box.right < room.right && box.top > 0 && box.bottom < room.bottom;
      return isInside && !taken.some((other) => overlap(box, other));
    });
    if (!placement) return [];
    taken.push(boxOf(name, name.text, placement));
    return [{ name, placement }];
  });
}
