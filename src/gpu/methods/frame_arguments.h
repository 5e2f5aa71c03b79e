#pragma once
// The arguments of all shaders, as shaders/common.glsl declares them.

#include <bit>
#include <cstdint>

#include "gpu/device/device.h"

namespace clusterbench::gpu {

struct FrameArguments {
  std::uint32_t cells = 0, lights = 0, points = 0, tests_cones = 0;
  std::uint32_t columns = 0, rows = 0, slices = 0;
  std::uint32_t column_pitch = 0, row_pitch = 0;  // bounds from one slice to the next
  std::uint32_t first_row = 0, first_slice = 0;   // where the bounds of rows and of slices begin
  std::uint32_t words = 0;                        // of 32 lights each
  std::uint32_t capacity = 0;                     // of a cell (fixed), of all lists (fill)
  float cone_slack = 0.0f;
  std::uint32_t picture_width = 0, is_orthographic = 0;
  std::uint32_t first_box = 0;  // boxes follow points and spots
  float corner_slack = 0.0f;

  operator Arguments() const {  // NOLINT(google-explicit-constructor)
    return {{cells, lights, points, tests_cones, columns, rows, slices, column_pitch, row_pitch, first_row, first_slice,
             words, capacity, std::bit_cast<std::uint32_t>(cone_slack), picture_width, is_orthographic, first_box,
             std::bit_cast<std::uint32_t>(corner_slack)}};
  }
};

// Bindings of the buffers.
enum Binding : std::uint32_t {
  balls,
  bounds,
  cell_balls,
  cones,
  counts,
  begins,
  lists,
  sums,
  offsets,
  masks,
  dropped,
  depths,
  tile_sides,
  tiles,
  box_bounds,
  tile_queue = dropped  // of methods whose lists are not fixed
};

// Modes of the shaders that come in two or three.
enum Mode : std::uint32_t { count, fill, fixed };

}  // namespace clusterbench::gpu
