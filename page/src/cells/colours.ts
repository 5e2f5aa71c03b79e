// Colours of cells: a scale that rises in lightness evenly and is told apart with any colour vision (after viridis), and
// one each for false positives and false negatives.

export type Rgb = [number, number, number]; // 0..255
export type What = "reported" | "true" | "excess" | "missing"; // excess: false positives, missing: false negatives

const lengths: Rgb[] = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 74, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
];
const excess: Rgb[] = [
  [122, 70, 0],
  [196, 118, 0],
  [240, 160, 20],
  [255, 205, 110],
];
const missing: Rgb[] = [
  [150, 20, 110],
  [205, 50, 150],
  [245, 110, 195],
];

function along(scale: Rgb[], share: number): Rgb {
  const position = Math.min(Math.max(share, 0), 1) * (scale.length - 1),
    low = Math.min(Math.floor(position), scale.length - 2);
  return scale[low]!.map((value, channel) =>
    Math.round(value + (scale[low + 1]![channel]! - value) * (position - low)),
  ) as Rgb;
}

export interface Counts {
  reported: number;
  truth: number;
  falsePositives: number;
  falseNegatives: number;
}

interface Look {
  label: string;
  scale: Rgb[];
  value: (counts: Counts) => number; // 0: nothing to see
}

const looks: Record<What, Look> = {
  reported: { label: "lights in the list", scale: lengths, value: (counts) => counts.reported },
  true: { label: "lights that reach the cell", scale: lengths, value: (counts) => counts.truth },
  excess: {
    label: "lights in the list that do not reach the cell",
    scale: excess,
    value: (counts) => counts.falsePositives,
  },
  missing: {
    label: "lights that reach the cell and are not in the list",
    scale: missing,
    value: (counts) => counts.falseNegatives,
  },
};

export const shownValue = (what: What, counts: Counts) => looks[what].value(counts);

// By the logarithm: a few long lists leave room for the others.
export function colourOf(what: What, counts: Counts, most: number): Rgb {
  return along(looks[what].scale, most <= 1 ? 1 : Math.log(shownValue(what, counts)) / Math.log(most));
}

export const css = (colour: Rgb) => `rgb(${colour.join(" ")})`;

// A legend's colours, from 1 to the most.
export function legendOf(what: What): { label: string; colours: string[] } {
  return {
    label: looks[what].label,
    colours: Array.from({ length: 24 }, (_, at) => css(along(looks[what].scale, at / 23))),
  };
}

export const marks: { word: string; colour: Rgb }[] = [
  { word: "true", colour: [0, 150, 170] },
  { word: "false positive", colour: [225, 140, 0] },
  { word: "false negative", colour: [215, 60, 160] },
];
