// The symbols of method families: told apart by form as much as by colour. Polygons, so that charts and legends draw the
// same.

type Point = [number, number];

interface Pen {
  moveTo(x: number, y: number): void;
  lineTo(x: number, y: number): void;
  closePath(): void;
}

function around(corners: number, turn: number): Point[] {
  return Array.from({ length: corners }, (_, at) => {
    const angle = (2 * Math.PI * at) / corners + turn;
    return [Math.sin(angle), -Math.cos(angle)];
  });
}

const cross: Point[] = [
  [-0.35, -1],
  [0.35, -1],
  [0.35, -0.35],
  [1, -0.35],
  [1, 0.35],
  [0.35, 0.35],
  [0.35, 1],
  [-0.35, 1],
  [-0.35, 0.35],
  [-1, 0.35],
  [-1, -0.35],
  [-0.35, -0.35],
];
const bar: Point[] = [
  [-1.1, -0.5],
  [1.1, -0.5],
  [1.1, 0.5],
  [-1.1, 0.5],
];
const upright: Point[] = [
  [-0.5, -1.1],
  [0.5, -1.1],
  [0.5, 1.1],
  [-0.5, 1.1],
];
const hourglass: Point[] = [
  [-1, -1],
  [1, -1],
  [0.25, 0],
  [1, 1],
  [-1, 1],
  [-0.25, 0],
];

// By an eighth of a turn.
const turned = (points: Point[]) => points.map(([x, y]): Point => [Math.SQRT1_2 * (x - y), Math.SQRT1_2 * (x + y)]);

// None is a star: that would look like the sign of the Pareto front.
const polygons: Point[][] = [
  around(5, 0), // pentagon
  around(24, 0), // disc
  around(4, Math.PI / 4),
  around(3, 0),
  around(4, 0),
  cross,
  around(6, Math.PI / 6),
  around(3, Math.PI),
  bar,
  turned(cross),
  upright,
  hourglass,
];

function area(polygon: Point[]): number {
  return (
    0.5 *
    Math.abs(
      polygon.reduce((sum, [x, y], at) => {
        const [nextX, nextY] = polygon[(at + 1) % polygon.length]!;
        return sum + x * nextY - y * nextX;
      }, 0),
    )
  );
}

export interface Shape {
  draw(pen: Pen, size: number): void; // size: area in square pixels, as Plot's symbols have it
  path(size: number): string;
}

function shapeOf(polygon: Point[]): Shape {
  const scaled = (size: number) => {
    const scale = Math.sqrt(size / area(polygon));
    return polygon.map(([x, y]): Point => [x * scale, y * scale]);
  };
  return {
    draw(pen, size) {
      for (const [at, [x, y]] of scaled(size).entries()) {
        if (at === 0) pen.moveTo(x, y);
        else pen.lineTo(x, y);
      }
      pen.closePath();
    },
    path: (size) =>
      `M${scaled(size)
        .map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`)
        .join("L")}Z`,
  };
}

export const shapes: Shape[] = polygons.map(shapeOf);
