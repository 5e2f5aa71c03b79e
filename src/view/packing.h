#pragma once
// Lights as engines pack them for the GPU: the lights of an assigner after unpacking, the bound of their error, and
// lights grown by it, so that they contain the packed ones.

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

// The largest error of a light by packing, computed from its unpacked numbers alone. 0: nothing was packed.
struct PackingBound {
  double position_m = 0.0;
  double axis_rad = 0.0, angle_rad = 0.0;  // spots

  // The largest distance of any point of the packed volume from this light: growing the light by it in all directions
  // is enough. The range needs no share, because it was rounded up.
  double inflation_m(double range_m) const {
    const double turn_rad = axis_rad + angle_rad;
    return turn_rad > 0.0 ? position_m + turn_rad * range_m : position_m;
  }
};

struct PackedLights {
  LightArrays lights;                // source and space are those of the packed lights
  std::vector<PackingBound> bounds;  // one per light
  // Lights that the format cannot represent, by their index: a range without end; in half, numbers beyond 65504. They
  // keep their single-precision numbers here. An engine's conversion to half makes them infinite, and such a light is
  // in no cell or in all.
  std::vector<std::uint32_t> unrepresentable;
};

PackedLights packed(const LightArrays& lights, Packing packing);

// Each light grown by its bound, so that it contains the packed volume. A spot's apex moves back along its axis far
// enough for its cone to contain all possible positions of the apex, and the cone is widened by the errors of axis and
// angle, or by more if the apex would otherwise move back by over half of the range.
LightArrays inflated(const PackedLights& packed);

}  // namespace clusterbench::view
