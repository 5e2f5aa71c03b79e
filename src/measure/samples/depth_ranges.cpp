#include "measure/samples/depth_ranges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/memory.h"

namespace clusterbench::measure {
namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
// Of a step from one pixel to the next, as a share of the change over the whole tile; in addition to the step of a
// plane.
constexpr double k_discontinuity = 0.25;
constexpr int k_parts = 32;

// Step 0 is for length 0. Lengths below 2^-30 m are in step 1, those from 2^66 m on in the last.
constexpr int k_steps = 16, k_least_exponent = -30, k_exponents = 96;

// frexp is exact, so the result is the same on every machine.
std::size_t step_of(double length_m) {
  int exponent = 0;
  const double mantissa = 2.0 * std::frexp(length_m, &exponent) - 1.0;  // 0 to 1
  if (length_m <= 0.0) return 0;
  if (exponent - 1 < k_least_exponent) return 1;
  const int at = (exponent - 1 - k_least_exponent) * k_steps + static_cast<int>(mantissa * k_steps) + 1;
  return static_cast<std::size_t>(std::min(at, k_exponents * k_steps));
}

double end_of_step(std::size_t step) {
  const int at = static_cast<int>(step);
  return std::ldexp(1.0 + static_cast<double>(at % k_steps) / k_steps, at / k_steps + k_least_exponent);
}

// The range of some numbers.
struct Span {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  std::uint64_t pixels = 0;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
    ++pixels;
  }
  double length() const { return high - low; }
};

struct Tile {
  Span depth, evenly;  // evenly: a quantity that is linear along a plane in screen space
  Span columns, rows;  // of the tile's pixels with a surface
  double widest_step = 0.0;
  std::uint32_t parts = 0;

  bool is_discontinuity() const {
    const double steps = std::max(columns.length(), rows.length());
    return steps >= 2.0 && widest_step > (1.0 / steps + k_discontinuity) * evenly.length();
  }
  int part_of(double of_depth) const {
    if (depth.length() <= 0.0) return 0;
    return std::min(k_parts - 1, static_cast<int>(k_parts * ((of_depth - depth.low) / depth.length())));
  }
};

// The pixels of a picture in the cells of a grid.
class Picture {
 public:
  Picture(const depth::DepthImage& image, std::span<const grid::Sample> samples, const grid::ScreenGrid& grid)
      : size_(image.pixels.size), is_orthographic_(grid.tiles.orthographic), tile_count_(tiles_in(grid)) {
    const std::size_t cell_count = tile_count_ * static_cast<std::size_t>(grid.slices.count());
    check_memory("depths of pixels and their cells", image.nearest.size(), sizeof(double) + sizeof(std::int64_t));
    check_memory("ranges of depth in cells", cell_count, sizeof(Span));
    cells_.reserve(image.nearest.size());
    depths_.reserve(image.nearest.size());
    std::size_t next = 0;
    for (const float depth : image.nearest) {
      std::int64_t cell = k_nothing;
      if (std::isfinite(depth)) {
        cell = grid.lookup(samples[next++], grid::Log2::rounded);
        outside_ += cell < 0 ? 1 : 0;
      }
      cells_.push_back(cell);
      depths_.push_back(static_cast<double>(depth));
    }
    tiles_.resize(tile_count_);
    spans_.resize(cell_count);
    const auto width = static_cast<std::size_t>(size_.x);
    each_pixel([&](std::size_t pixel, Tile& tile) {
      tile.depth.add(depths_[pixel]);
      tile.evenly.add(evenly(pixel));
      const std::size_t row = pixel / width;
      tile.columns.add(static_cast<double>(pixel - row * width));
      tile.rows.add(static_cast<double>(row));
      spans_[static_cast<std::size_t>(cells_[pixel])].add(depths_[pixel]);
    });
    each_pixel([&](std::size_t pixel, Tile& tile) {
      tile.parts |= std::uint32_t{1} << tile.part_of(depths_[pixel]);
      if ((pixel + 1) % width != 0) add_neighbour(tile, pixel, pixel + 1);
      if (pixel + width < cells_.size()) add_neighbour(tile, pixel, pixel + width);
    });
  }

  std::uint64_t outside() const { return outside_; }
  const std::vector<Tile>& tiles() const { return tiles_; }
  const std::vector<Span>& cells() const { return spans_; }  // range of the surface depths in each cell
  const Tile& tile_of_cell(std::size_t cell) const { return tiles_[cell % tile_count_]; }
  std::size_t slice_of_cell(std::size_t cell) const { return cell / tile_count_; }

 private:
  static constexpr std::int64_t k_nothing = -2;  // no surface is visible

  static std::size_t tiles_in(const grid::ScreenGrid& grid) {
    return static_cast<std::size_t>(grid.tiles.count.x) * static_cast<std::size_t>(grid.tiles.count.y);
  }
  template <class Action>
  void each_pixel(const Action& action) {
    for (std::size_t pixel = 0; pixel < cells_.size(); ++pixel)
      if (cells_[pixel] >= 0) action(pixel, tiles_[static_cast<std::size_t>(cells_[pixel]) % tile_count_]);
  }
  double evenly(std::size_t pixel) const { return is_orthographic_ ? depths_[pixel] : 1.0 / depths_[pixel]; }
  void add_neighbour(Tile& tile, std::size_t pixel, std::size_t neighbour) const {
    if (cells_[neighbour] < 0) return;
    if (&tile != &tiles_[static_cast<std::size_t>(cells_[neighbour]) % tile_count_]) return;
    tile.widest_step = std::max(tile.widest_step, std::abs(evenly(pixel) - evenly(neighbour)));
  }

  Vec2i size_;
  bool is_orthographic_;
  std::size_t tile_count_;
  std::vector<std::int64_t> cells_;  // cell of each pixel
  std::vector<double> depths_;
  std::vector<Tile> tiles_;
  std::vector<Span> spans_;
  std::uint64_t outside_ = 0;
};

LengthDistribution& lengths(DepthRanges::Tiles& tiles, ListKind kind) {
  return tiles.lengths[static_cast<std::size_t>(kind)];
}

}  // namespace

const char* name_of(ListKind kind) {
  constexpr std::array<const char*, k_list_kind_count> k_names{"tiled", "tiled_2_5d", "clusters", "explicit_clusters"};
  return k_names[static_cast<std::size_t>(kind)];
}

void LengthDistribution::add(double length_m, std::uint64_t pixels) {
  if (pixels == 0) return;
  const std::size_t step = step_of(length_m);
  if (step >= counts_.size()) counts_.resize(step + 1, 0);
  counts_[step] += pixels;
  count_ += pixels;
  sum_m_ += length_m * static_cast<double>(pixels);
  max_m_ = std::max(max_m_, length_m);
}

double LengthDistribution::mean_m() const {
  return count_ > 0 ? sum_m_ / static_cast<double>(count_) : k_nan;
}

double LengthDistribution::max_m() const {
  return count_ > 0 ? max_m_ : k_nan;
}

double LengthDistribution::quantile_m(double share) const {
  if (count_ == 0) return k_nan;
  const double wanted = share * static_cast<double>(count_);
  std::uint64_t so_far = 0;
  std::size_t step = 0;
  while (step < counts_.size() && static_cast<double>(so_far += counts_[step]) < wanted) ++step;
  return std::min(max_m_, step == 0 ? 0.0 : end_of_step(step));
}

void add_frame(DepthRanges& ranges, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const grid::ScreenGrid& grid) {
  const Picture picture(image, samples, grid);
  ranges.outside += picture.outside();
  const auto tiles_like = [&](const Tile& tile) -> DepthRanges::Tiles& {
    return tile.is_discontinuity() ? ranges.discontinuities : ranges.slopes;
  };
  for (const Tile& tile : picture.tiles()) {
    if (tile.depth.pixels == 0) continue;
    DepthRanges::Tiles& tiles = tiles_like(tile);
    ++tiles.tiles;
    tiles.pixels += tile.depth.pixels;
    const double part_m = tile.depth.length() / k_parts;
    lengths(tiles, ListKind::tiled).add(tile.depth.length(), tile.depth.pixels);
    lengths(tiles, ListKind::tiled_2_5d).add(std::popcount(tile.parts) * part_m, tile.depth.pixels);
  }
  for (std::size_t cell = 0; cell < picture.cells().size(); ++cell) {
    const Span& depths = picture.cells()[cell];
    if (depths.pixels == 0) continue;
    DepthRanges::Tiles& tiles = tiles_like(picture.tile_of_cell(cell));
    const std::size_t slice = picture.slice_of_cell(cell);
    const double near = static_cast<double>(grid.slices.boundaries[slice]),
                 far = static_cast<double>(grid.slices.boundaries[slice + 1]);
    lengths(tiles, ListKind::clusters).add(far - near, depths.pixels);
    lengths(tiles, ListKind::explicit_clusters).add(depths.length(), depths.pixels);
  }
}

}  // namespace clusterbench::measure
