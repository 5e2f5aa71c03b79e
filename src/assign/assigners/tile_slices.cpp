// Each tile has its own slices: as many as the grid, from the grid's near to its far end, each thicker than the one
// before it by the tile's own factor. The factor is chosen so that half of the slices lie in front of the tile's
// farthest opaque pixel; a tile of sky uses the far end instead. Every point of the view has a cell, so samples in the
// air have their lights.
//
// Roundoffs: of the tests the one against a box has the largest error (CellAabbs); extents and depth - r, depth + r
// lose one. The ends of slices are padded separately, by the rounding of the lookup (TileSlicing::bounds).

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "assign/bounds/bounds_method.h"
#include "assign/contract/light_test.h"
#include "assign/contract/storage.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/occupied/first_depth.h"
#include "assign/occupied/pixel_depths.h"
#include "core/arrays.h"
#include "core/memory.h"
#include "geom/numbers/round_to_float.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench::assign {
namespace {

double whole_power(double base, int exponent) {
  double power = 1.0;
  for (; exponent > 0; exponent >>= 1, base *= base)
    if (exponent & 1) power *= base;
  return power;
}

// One tile's slices, as a shader computes them from the tile's growth.
struct TileSlicing {
  float near = 0.0f;
  int count = 1;
  float growth = 2.0f;  // the ratio of a slice's thickness to that of the one before it
  float scale = 1.0f, per_octave = 1.0f;

  TileSlicing() = default;
  TileSlicing(float begin, float end, int slices, float factor) : near(begin), count(slices), growth(factor) {
    const double all = whole_power(growth, count) - 1.0;
    scale = static_cast<float>(all / (static_cast<double>(end) - static_cast<double>(begin)));
    per_octave = static_cast<float>(1.0 / std::log2(static_cast<double>(growth)));
  }

  // A shader's lookup, clamped. Every step is monotonic in the depth, however it is rounded (grid::Log2::rounded).
  int slice_of(float depth, grid::Log2 way = grid::Log2::rounded) const {
    const float from_near = std::max(depth - near, 0.0f);
    const float slice = grid::log2_by(way, from_near * scale + 1.0f) * per_octave;
    return slice >= 1.0f ? static_cast<int>(std::min(slice, static_cast<float>(count - 1))) : 0;
  }

  // Bounds of the depth at which slice `slice` begins. With x = growth^slice = 1 + scale * (depth - near), three
  // operations round x, each relative to it; the logarithm, the product and per_octave round the slice: 4 u for x and 3
  // u ln(x) in terms of x, with scale's own. One is added to each for terms of higher order.
  struct Bounds {
    float lo, hi;
  };
  Bounds bounds(int slice, double x) const {
    const double thickness = x / static_cast<double>(scale);
    const double at = static_cast<double>(near) + thickness - 1.0 / static_cast<double>(scale);
    const double slack = 0x1p-24 * thickness * (5.0 + 4.0 * slice * std::log(static_cast<double>(growth)));
    return {geom::rounded_down(at - slack), geom::rounded_up(at + slack)};
  }
};

class TileSliceLists final : public LightStructure {
 public:
  TileSliceLists() {
    const StorageDescriptor& packed = *find_storage("packed");
    packed_ = packed.make(Params(packed.params));
  }

  // No allocation in a steady state. `grid` must outlive the structure.
  void store(const grid::Grid& grid, const std::vector<TileSlicing>& slicings, const Lists& lists,
             const view::LightRanges& lights) {
    grid_ = &grid;
    slicings_ = slicings;
    packed_->start(lists.cell_count(), lights);
    packed_->store(lists);
  }

  bool lights_at(const grid::Sample& sample, grid::Log2 way, std::vector<std::uint32_t>& out) const override {
    out.clear();
    const std::int64_t cell = cell_of(sample, way);
    if (cell < 0) return false;
    packed_->read_cell(static_cast<std::uint32_t>(cell), out);
    return true;
  }
  // Reads the tile's number, then the list.
  Reads reads_at(const grid::Sample& sample, grid::Log2 way) const override {
    const std::int64_t cell = cell_of(sample, way);
    if (cell < 0) return {};
    return Reads::of(1, sizeof(float)) + packed_->reads_of_cell(static_cast<std::uint32_t>(cell));
  }

  StructureUse use() const override {
    StructureUse use = packed_->use();
    use.header_bytes += growth_bytes();
    use.upload_bytes += growth_bytes();
    return use;
  }
  StructureLimit limit() const override {
    StructureLimit limit = packed_->limit();
    limit.bytes += growth_bytes();
    return limit;
  }
  std::vector<BufferNeed> buffers() const override {
    std::vector<BufferNeed> all = packed_->buffers();
    all.push_back({"growths", sizeof(float), slicings_.size(), slicings_.size()});
    return all;
  }
  std::uint32_t index_bits() const override { return packed_->index_bits(); }
  bool has_cells() const override { return true; }
  bool has_occupied_cells() const override { return true; }
  void expand(Lists& out) const override { packed_->expand(out); }

  // For each cell the depths whose lookup gives it.
  grid::OccupiedCells occupied_cells() const override {
    const std::vector<std::vector<float>> begins = begins_of_tiles();
    grid::OccupiedCells out;
    out.counts = grid_->cells();
    for (std::uint32_t cell = 0; cell < grid_->cell_count(); ++cell) {
      const std::size_t tile = cell % slicings_.size(), slice = cell / slicings_.size();
      geom::FrustumCell part = std::get<geom::FrustumCell>(grid_->cell(cell));
      part.depth0 = begins[tile][slice];
      part.depth1 = begins[tile][slice + 1];
      if (part.depth0 < part.depth1) out.parts.push_back(part);
      out.end_cell();
    }
    return out;
  }

 private:
  // -1: in no cell.
  std::int64_t cell_of(const grid::Sample& sample, grid::Log2 way) const {
    const grid::Tiles& tiles = grid_->screen().tiles;
    const float depth = -sample.view.z;
    if (!tiles.shows(sample.pixel_x, sample.pixel_y) || !(depth <= grid_->screen().slices.boundaries.back())) return -1;
    if (!tiles.orthographic && !(depth > 0.0f)) return -1;
    const Vec2i at = tiles.tile_of(sample.pixel_x, sample.pixel_y);
    const TileSlicing& slicing = slicings_[grid::cell_index({at.x, at.y, 0}, grid_->cells())];
    return grid::cell_index({at.x, at.y, slicing.slice_of(depth, way)}, grid_->cells());
  }

  // One number per tile, from which a shader computes its slices.
  std::uint64_t growth_bytes() const { return slicings_.size() * sizeof(float); }

  std::vector<std::vector<float>> begins_of_tiles() const {
    const float near = grid_->screen().slices.boundaries.front(), far = grid_->screen().slices.boundaries.back();
    std::vector<std::vector<float>> begins;
    for (const TileSlicing& slicing : slicings_) {
      std::vector<float>& of_tile = begins.emplace_back(1, near);
      for (int slice = 1; slice < slicing.count; ++slice) {
        const float before = of_tile.back();
        const auto is_behind = [&](float depth) { return slicing.slice_of(depth) >= slice; };
        of_tile.push_back(is_behind(before) ? before : first_between(before, far, is_behind));
      }
      of_tile.push_back(far);
    }
    return begins;
  }

  std::unique_ptr<Storage> packed_;
  const grid::Grid* grid_ = nullptr;
  std::vector<TileSlicing> slicings_;
};

class TileSlices final : public AssignerOf<TileSliceLists> {
 public:
  explicit TileSlices(const Params& params)
      : test_(params, CellAabbs::k_roundoffs), least_growth_(params.number("least_growth")) {}

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    grid_ = &grid;
    near_ = grid.screen().slices.boundaries.front();
    far_ = grid.screen().slices.boundaries.back();
    grid::ScreenGrid one_slice = grid.screen();
    one_slice.slices.boundaries = {near_, far_};
    tiles_ = {one_slice};
    view_ = ViewCull(grid.screen());
    pixels_.build(grid.screen());
    check_memory("slices of tiles", grid.cell_count(), sizeof(geom::Box) + (kinds.spots ? sizeof(geom::Ball) : 0));
    slicings_.resize(tiles_.cell_count());
    boxes_.resize(grid.cell_count());
    balls_.resize(kinds.spots ? grid.cell_count() : 0);
    depths_.clear(tiles_.cell_count());
  }
  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override {
    return pixels_.capacity_bytes() + depths_.capacity_bytes() + bytes_of(slicings_, boxes_, balls_) +
           pairs_.capacity_bytes() + bytes_of(lists_.begin, lists_.lights);
  }

 protected:
  void fill(const FrameInput& input, TileSliceLists& out) override {
    const view::LightArrays& lights = input.lights;
    tests_ = 0;
    pixels_.find_in_tiles(checked(input.depth, grid_->screen().tiles), depths_);
    for (std::uint32_t tile = 0; tile < slicings_.size(); ++tile) slice(tile);
    pairs_.start(grid_->cell_count());
    for (std::uint32_t light = 0; light < lights.size(); ++light)
      if (!lights.is_empty(light)) add_light(lights, light);
    pairs_.finish(lists_);
    out.store(*grid_, slicings_, lists_, lights);
  }

 private:
  int count() const { return grid_->screen().slices.count(); }
  // In the order of slices, tile by tile.
  std::size_t place_of(std::uint32_t tile, int slice) const {
    return tile * static_cast<std::size_t>(count()) + static_cast<std::size_t>(slice);
  }

  // Half of the slices end at this depth: (g^(n/2) - 1) / (g^n - 1) is its share of the range.
  float growth_for(float farthest) const {
    const double near = near_, range = static_cast<double>(far_) - near;
    const double share = std::clamp((static_cast<double>(farthest) - near) / range, 0x1p-23, 1.0);
    const double half = share < 0.5 ? (1.0 - share) / share : 1.0;
    // With very many slices the last one's thickness must still be finite.
    const double least = std::min(least_growth_, std::exp2(64.0 / count()));
    return static_cast<float>(std::max(least, std::pow(half, 2.0 / count())));
  }

  void slice(std::uint32_t tile) {
    const TileSlicing& slicing = slicings_[tile] =
        TileSlicing(near_, far_, count(), growth_for(depths_.empty(tile) ? far_ : depths_.hi[tile]));
    geom::FrustumCell cell = std::get<geom::FrustumCell>(tiles_.cell(tile));
    cell.depth0 = near_;
    double x = 1.0;
    for (int at = 0; at < count(); ++at) {
      x *= static_cast<double>(slicing.growth);
      const TileSlicing::Bounds end = slicing.bounds(at + 1, x);
      cell.depth1 = at + 1 == count() ? far_ : end.hi;
      boxes_[place_of(tile, at)] = geom::box_around(cell);
      if (!balls_.empty()) balls_[place_of(tile, at)] = geom::ball_around(cell);
      cell.depth0 = end.lo;
    }
  }

  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const geom::Ball ball = test_.ball(lights, light, k_cell_box_roundoffs);
    if (view_.misses(ball)) return;
    const CellBox box = cell_box(tiles_, ball);
    if (box.empty()) return;
    const TestedLight tested = test_.tested(lights, light);
    for (int y = box.first.y; y <= box.last.y; ++y)
      for (int x = box.first.x; x <= box.last.x; ++x) add_in_tile(tested, {x, y});
  }

  void add_in_tile(const TestedLight& light, Vec2i at) {
    const float depth = -light.ball.center.z, near = depth - light.ball.radius, far = depth + light.ball.radius;
    if (!(near <= far_ && far >= near_)) return;
    const std::uint32_t tile = grid::cell_index({at.x, at.y, 0}, tiles_.cells());
    const int last = slicings_[tile].slice_of(std::min(far, far_));
    for (int slice = slicings_[tile].slice_of(std::max(near, near_)); slice <= last; ++slice) {
      ++tests_;
      const std::size_t place = place_of(tile, slice);
      if (geom::ball_touches_box(light.ball, boxes_[place]) &&
          (!light.has_cone || geom::cone_touches_ball(light.cone, balls_[place])))
        pairs_.add(grid::cell_index({at.x, at.y, slice}, grid_->cells()), light.index);
    }
  }

  LightTest test_;
  double least_growth_;
  const grid::Grid* grid_ = nullptr;
  grid::Grid tiles_;  // with a single slice
  float near_ = 0.0f, far_ = 0.0f;
  ViewCull view_;
  PixelDepths pixels_;
  DepthRanges depths_;                 // of the tiles
  std::vector<TileSlicing> slicings_;  // of the tiles
  std::vector<geom::Box> boxes_;       // around the frame's cells
  std::vector<geom::Ball> balls_;      // the same, if there are spots
  PairBuffer pairs_;
  Lists lists_;
  std::uint64_t tests_ = 0;
};

std::vector<ParamSpec> tile_slices_params() {
  std::vector<ParamSpec> params{{.name = "least_growth",
                                 .summary =
                                     "how many times as thick as the one before it a slice is at least; of n slices "
                                     "2^(64/n) is enough",
                                 .default_value = 1.02,
                                 .unit = "",
                                 .min = 1.0001,
                                 .max = 4.0,
                                 .choices = {}}};
  for (ParamSpec& param : light_params()) params.push_back(std::move(param));
  return params;
}

}  // namespace

extern const AssignerDescriptor tile_slices_descriptor;
const AssignerDescriptor tile_slices_descriptor{
    .name = "tile-slices",
    .summary =
        "slices of each tile's own, half of them in front of its farthest opaque pixel; by extents and box as aabb",
    .source = "Unity HDRP's clustered lights with a log base per tile",
    .kinds = {grid::Kind::frustum},
    .needs = {.depth = true},
    .own_lists = true,
    .params = tile_slices_params(),
    .make_own = make_structure_assigner<TileSlices>,
};

}  // namespace clusterbench::assign
