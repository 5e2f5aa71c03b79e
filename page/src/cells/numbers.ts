// Rows of numbers as a result carries them (src/core/run_length_text.h): "5 1*40" is 5 and forty times 1.

export function numbers(text: string): Float64Array {
  const words = text ? text.split(" ") : [];
  const runs = words.map((word): [number, number] => {
    const star = word.indexOf("*");
    return star < 0 ? [Number(word), 1] : [Number(word.slice(0, star)), Number(word.slice(star + 1))];
  });
  const all = new Float64Array(runs.reduce((sum, [, count]) => sum + count, 0));
  let at = 0;
  for (const [value, count] of runs) {
    all.fill(value, at, at + count);
    at += count;
  }
  return all;
}

// Ascending numbers from their gaps.
export function ascending(gaps: Float64Array): Float64Array {
  let sum = 0;
  return gaps.map((gap) => (sum += gap));
}
