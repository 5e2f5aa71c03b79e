#pragma once
// Lights as engines pack them for the GPU: what an assigner sees after they are unpacked, how far that can be from what
// was packed, and lights grown by so much that they hold what was packed.

#include <cstdint>
#include <span>
#include <vector>

#include "view/frame.h"

namespace clusterbench::view {

// float32: as lights_in() makes them.
// half:    position, range, axis and half-angle as IEEE binary16.
// unorm16: position as 3 x 16-bit unorm over the box around the frame's lights in the grid's space, range as unorm16 of
//          the largest one, axis as octahedral 2 x snorm16, half-angle as unorm16 of pi/2.
// Ranges are rounded up, all else to nearest. Axes are normalised after unpacking.
enum class Packing : std::uint8_t { float32, half, unorm16 };
inline constexpr Packing k_packings[] = {Packing::float32, Packing::half, Packing::unorm16};
const char* packing_name(Packing packing);

// How far a light can be from what was packed, as its unpacked numbers alone tell it. 0: nothing was packed.
struct PackingBound {
  double position_m = 0.0;
  double axis_rad = 0.0, angle_rad = 0.0;  // spots

  // How far any point of the packed volume can be from it: what is enough to grow the light by in all directions. A
  // range needs nothing, because it was rounded up.
  double inflation_m(double range_m) const {
    const double turn_rad = axis_rad + angle_rad;
    return turn_rad > 0.0 ? position_m + turn_rad * range_m : position_m;
  }
};

struct PackedLights {
  LightArrays lights;                // source and space are those of what was packed
  std::vector<PackingBound> bounds;  // one per light
  // Lights that the format cannot hold, by their index: a range without end; in half, what is beyond 65504. They keep
  // their single-precision numbers here. An engine's conversion makes half's infinite, and such a light is in no cell
  // or in all.
  std::vector<std::uint32_t> unrepresentable;
};

PackedLights packed(const LightArrays& lights, Packing packing);

// Each light grown by its bound, so that it holds the volume that was packed. A spot's apex moves back along its axis
// far enough for its cone to hold all points where the apex can be, and the cone is widened by what axis and angle can
// be off, or by more where the apex would else move back by over half of the range.
LightArrays inflated(const PackedLights& packed);

}  // namespace clusterbench::view
