#include "gpu/reading/reading_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/memory.h"

namespace clusterbench::gpu {
namespace {

constexpr float k_idle_pixel = -2.0f;  // read.glsl
constexpr std::uint32_t k_block_side = 8;

// The column of number n of a block along a Morton curve; its row is the column of n / 2.
std::uint32_t column_of(std::uint32_t n) {
  return (n & 1) | (n >> 1 & 2) | (n >> 2 & 4);
}

}  // namespace

WaveOrder in_given_order(std::size_t samples) {
  WaveOrder order(samples);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

WaveOrder in_pixel_blocks(const depth::DepthImage& image) {
  const auto width = static_cast<std::uint32_t>(image.pixels.size.x);
  const auto height = static_cast<std::uint32_t>(image.pixels.size.y);
  std::vector<std::uint32_t> sample_of_pixel;
  std::uint32_t samples = 0;
  for (const float depth : image.nearest)
    sample_of_pixel.push_back(depth < std::numeric_limits<float>::infinity() ? samples++ : k_idle);
  WaveOrder order;
  for (std::uint32_t top = 0; top < height; top += k_block_side)
    for (std::uint32_t left = 0; left < width; left += k_block_side)
      for (std::uint32_t n = 0; n < k_block_side * k_block_side; ++n) {
        const std::uint32_t x = left + column_of(n), y = top + column_of(n / 2);
        order.push_back(x < width && y < height ? sample_of_pixel[std::size_t{y} * width + x] : k_idle);
      }
  return order;
}

ReadingSamples::ReadingSamples(std::span<const grid::Sample> samples, WaveOrder order, const grid::Grid& grid)
    : samples_(samples), order_(std::move(order)), world_origin_(grid.world_origin()), buffers_(device()) {
  upload();
}

void ReadingSamples::upload() {
  std::vector<float> positions, pixels;
  positions.reserve(3 * order_.size());
  pixels.reserve(2 * order_.size());
  for (std::uint32_t i = 0; i < invocations(); ++i) {
    const grid::Sample* sample = sample_of(i);
    Vec3f at(0.0f);
    if (sample != nullptr) at = world_origin_ ? Vec3f(sample->from(*world_origin_)) : sample->view;
    positions.insert(positions.end(), {at.x, at.y, at.z});
    const auto pixel = [sample](float grid::Sample::*which) {  // NaN behind the eye: beside the picture as well
      return sample == nullptr ? k_idle_pixel : std::isnan(sample->*which) ? -1.0f : sample->*which;
    };
    pixels.insert(pixels.end(), {pixel(&grid::Sample::pixel_x), pixel(&grid::Sample::pixel_y)});
  }
  buffers_.reserve(ReadingBinding::positions, positions.size() * sizeof(float), "positions of samples");
  buffers_.reserve(ReadingBinding::pixels, pixels.size() * sizeof(float), "pixels of samples");
  buffers_.reserve(ReadingBinding::results, 2 * sizeof(std::uint32_t) * order_.size(), "results of samples");
  Commands commands(device(), buffers_);
  commands.upload(ReadingBinding::positions, positions.data(), positions.size() * sizeof(float));
  commands.upload(ReadingBinding::pixels, pixels.data(), pixels.size() * sizeof(float));
  commands.run();
}

void ReadingSamples::give_cells(std::span<const std::int32_t> cells) {
  buffers_.reserve(ReadingBinding::cells, cells.size_bytes(), "cells of samples");
  Commands commands(device(), buffers_);
  commands.upload(ReadingBinding::cells, cells.data(), cells.size_bytes());
  commands.run();
}

std::uint64_t ReadingSamples::reserve_flushed(std::uint64_t bytes) {
  bytes = std::min({bytes, device().facts().max_buffer_bytes, memory_limit()}) / 4 * 4;
  buffers_.reserve(ReadingBinding::flushed, bytes, "bytes that flush caches");
  return bytes;
}

}  // namespace clusterbench::gpu
