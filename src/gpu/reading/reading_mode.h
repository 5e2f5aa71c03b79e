#pragma once
// What a reading shader is told: its mode, a specialization constant, and its arguments, as shaders/read.glsl declares
// them.

#include <bit>
#include <cstdint>

#include "gpu/device/device.h"
#include "gpu/reading/walking.h"

namespace clusterbench::gpu {

// What an invocation writes for its sample.
enum class ReadingOutput : std::uint8_t {
  write_only,  // a word, without reading anything: the floor
  nothing,     // what the lookup found, without reading the structure
  cells,       // the cell, -1 outside
  lights,      // the sum of the attenuations of its lights
  check        // two words: the number of its lights, and the sum of their hashes
};

enum class ReadingLookup : std::uint8_t { given, screen, tile, cascades, world, position };

// The bits of MODE.
struct ReadingMode {
  ReadingOutput output = ReadingOutput::lights;
  Walking walking = Walking::by_lane;
  ReadingLookup lookup = ReadingLookup::screen;
  std::uint32_t slice_form = 0;  // of grid::SliceLookup::Form
  bool is_by_distance = false, is_orthographic = false;
  std::uint32_t index_bytes = 4;
  bool has_wide_counts = false, has_boxes = false, has_end_mark = false, is_sparse = false;
  bool has_bin_masks = false, has_range_per_cell = false, has_narrow_ranks = false;

  std::uint32_t bits() const {
    const auto bit = [](bool is_set, int at) { return static_cast<std::uint32_t>(is_set) << at; };
    return static_cast<std::uint32_t>(output) | static_cast<std::uint32_t>(walking) << 3 |
           static_cast<std::uint32_t>(lookup) << 5 | slice_form << 8 | bit(is_by_distance, 10) |
           bit(is_orthographic, 11) | static_cast<std::uint32_t>(std::countr_zero(index_bytes)) << 12 |
           bit(has_wide_counts, 14) | bit(has_boxes, 15) | bit(has_end_mark, 16) | bit(is_sparse, 17) |
           bit(has_bin_masks, 18) | bit(has_range_per_cell, 19) | bit(has_narrow_ranks, 20);
  }
};

struct ReadingArguments {
  std::uint32_t samples = 0;
  std::uint32_t columns = 1, rows = 1, slices = 1;  // of the grid; cascades: of each level
  float viewport_x = 0, viewport_y = 0, tile_scale_x = 0, tile_scale_y = 0;
  float slice_far = 0, slice_scale = 0, slice_bias = 0, slice_first = 0;
  float box_min[3]{}, box_max[3]{}, box_scale[3]{};
  float finest = 0;
  std::uint32_t levels = 0;
  std::uint32_t header_words = 0, per_cell = 0, end_mark = 0;  // of the structure

  operator Arguments() const {  // NOLINT(google-explicit-constructor)
    const auto word = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return {{samples,
             columns,
             rows,
             slices,
             word(viewport_x),
             word(viewport_y),
             word(tile_scale_x),
             word(tile_scale_y),
             word(slice_far),
             word(slice_scale),
             word(slice_bias),
             word(slice_first),
             word(box_min[0]),
             word(box_min[1]),
             word(box_min[2]),
             word(box_max[0]),
             word(box_max[1]),
             word(box_max[2]),
             word(box_scale[0]),
             word(box_scale[1]),
             word(box_scale[2]),
             word(finest),
             levels,
             header_words,
             per_cell,
             end_mark}};
  }
};

// Bindings of the buffers. The first four are the samples', the others the structure's.
struct ReadingBinding {
  enum : std::uint32_t { positions, pixels, results, cells, lights, structure, boundaries = 9, flushed = 11 };
};

}  // namespace clusterbench::gpu
