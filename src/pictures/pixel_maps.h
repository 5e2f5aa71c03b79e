#pragma once
// The lights that the pixels of a picture get from a light structure, compared with the lights that reach each pixel.

#include <cstdint>
#include <functional>
#include <vector>

#include "assign/contract/light_structure.h"
#include "pictures/surface.h"

namespace clusterbench::pictures {

// Sums, and the largest entry with its pixel.
struct MapTotals {
  std::uint64_t sum = 0, pixels = 0;  // pixels: number of entries that are not 0
  std::uint32_t most = 0;
  std::size_t most_at = 0;

  void add(std::size_t pixel, std::uint32_t count);
};

// An entry per pixel of the surface's picture; 0 without a surface.
struct PixelMaps {
  enum class State : std::uint8_t { no_surface, no_answer, answered };
  std::vector<State> state;
  std::vector<std::uint32_t> points, spots;    // lights that the structure gives
  std::vector<std::uint32_t> false_positives;  // of those, lights that do not reach the pixel's surface
  std::vector<std::uint32_t> missed;           // lights that reach it and are not given
  MapTotals lights_total, false_positives_total, missed_total;
  std::uint64_t surfaces = 0, unanswered = 0, points_total = 0, spots_total = 0;

  std::uint32_t lights(std::size_t pixel) const { return points[pixel] + spots[pixel]; }
};

// A good end of a scale for these counts: exceeded by at most one pixel of a hundred, and at least a third of the
// largest. Only pixels with a surface count.
std::uint32_t usual_most(const PixelMaps& maps, const std::function<std::uint32_t(std::size_t pixel)>& count);

// The same for any number of threads.
PixelMaps pixel_maps(const Surface& surface, const NeededAt& needed, std::uint32_t first_spot,
                     const assign::LightStructure& structure, int threads);

// The list of each pixel as a number: equal numbers for the same lights. Numbered from 1 in the order in which they
// appear from the top left; 0: no surface, no answer or no lights.
struct ListMap {
  std::vector<std::uint32_t> list;
  std::uint32_t lists = 0;        // distinct ones, without the empty one
  std::uint64_t most_pixels = 0;  // of the most frequent list
};
ListMap list_map(const Surface& surface, const assign::LightStructure& structure);

}  // namespace clusterbench::pictures
