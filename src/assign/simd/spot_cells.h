#pragma once
// Do spots touch cells of a slice? Many pairs at once: a filter in single precision that says yes or no only with
// evidence (a point that is in cell and volume, or a plane between them) that is larger than its own error, and leaves
// the rest to exact arithmetic.

#include <cstdint>
#include <vector>

#include "assign/simd/slice_rows.h"
#include "view/frame.h"

namespace clusterbench::assign {

enum class Touch : std::uint8_t { no, yes, open };

// Pairs of a spot (light index - points) and a cell of the slice at hand, and the answers. Whole vectors can be read
// and written beyond `count`.
struct SpotCells {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> spot, row, column;
  std::vector<Touch> touch;

  void add(std::uint32_t of_spot, std::uint32_t of_row, std::uint32_t of_column);
  std::size_t capacity_bytes() const { return spot.capacity() * (3 * sizeof(std::uint32_t) + sizeof(Touch)); }
};

// What the pairs are made of: lights, sides of columns (x / depth), slopes of rows from the top, the slice's depths.
struct SpotsAndPlanes {
  const view::LightArrays* lights;
  const float *side, *slope;
  float depth0, depth1;
};

// Each look settles most of the pairs that the one before leaves open, and costs several times as much.
enum class Look { quick, closer, thorough };
void look_at_cells(const SpotsAndPlanes& from, Look how, SpotCells& cells);

}  // namespace clusterbench::assign
