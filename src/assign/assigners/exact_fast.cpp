// Fast form of `exact`. Balls outside the view are culled a vector at a time. Slice by slice, the rows of many balls
// are found at once, one ball per lane; a slice's lists are built by compression while its spans are in the cache. Rows
// that single precision leaves uncertain, and the ends of a spot's rows, are decided as in exact.cpp. Threads share the
// slices. Grids whose numbers single precision cannot multiply, for example with slices that begin a nanometre from the
// eye, are left to `exact`: all of their rows would be uncertain.

#include <algorithm>
#include <cmath>
#include <functional>

#include "assign/cone/bounding_spheres.h"
#include "assign/contract/assigner.h"
#include "assign/exact/exact_slices.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel.h"

namespace clusterbench::assign {

extern const AssignerDescriptor exact_descriptor;

namespace {

class ExactFast final : public ListAssigner {
 public:
  explicit ExactFast(const Params& params)
      : exact_(exact_descriptor.make(Params(exact_descriptor.params))),
        thread_pool_(static_cast<int>(params.number("threads"))) {
    if (thread_pool_.threads() > 1) parts_.resize(2 * static_cast<std::size_t>(thread_pool_.threads()));
  }

  void build(const grid::Grid& grid, const LightKinds& kinds) override {
    if (grid.cells().x > k_most_columns)
      throw Error("", "tiles",
                  "make " + std::to_string(grid.cells().x) + " columns; exact-fast takes at most " +
                      std::to_string(k_most_columns));
    grid_ = &grid;
    planes_ = RowPlanes(grid.screen());
    is_left_to_exact_ = std::isinf(planes_.least_reach);
    if (is_left_to_exact_) exact_->build(grid, kinds);
  }

  void assign(const FrameInput& input, Lists& out) override {
    if (is_left_to_exact_) return exact_->assign(input, out);
    const view::LightArrays& lights = input.lights;
    tests_ = lights.size();
    fallbacks_ = 0;
    lights_ = &lights;
    cull_lights();
    set_up_spheres(visible_, first_spot_, shapes_);
    slice_bins_.sort(visible_, planes_.slices);
    const ExactFrame frame{*grid_, planes_, lights, visible_, first_spot_, shapes_, slice_bins_};
    if (parts_.empty() || slice_bins_.count() < k_worth_threads) {
      whole_.find(frame, 0, planes_.slices, out);
      count(whole_);
    } else {
      find_in_parts(frame, out);
    }
  }

  std::uint64_t tests_done() const override { return is_left_to_exact_ ? exact_->tests_done() : tests_; }
  std::uint64_t fallbacks() const override { return is_left_to_exact_ ? exact_->fallbacks() : fallbacks_; }
  EarlierFrames earlier_frames() const override { return EarlierFrames::matter_to_scratch; }
  std::size_t scratch_bytes() const override {
    std::size_t bytes = exact_->scratch_bytes() + whole_.scratch_bytes() + slice_bins_.capacity_bytes() +
                        visible_.capacity_bytes() + spots_.capacity_bytes() + shapes_.capacity_bytes();
    for (const Part& part : parts_)
      bytes += part.slices.scratch_bytes() +
               (part.lists.begin.capacity() + part.lists.lights.capacity()) * sizeof(std::uint32_t);
    return bytes;
  }

 private:
  // Fewer balls in slices than this are finished before other threads have woken up.
  static constexpr std::uint32_t k_worth_threads = 1000;

  // Slices first .. last - 1.
  struct Part {
    int first = 0, last = 0;
    ExactSlices slices;
    Lists lists;
  };

  void count(const ExactSlices& slices) {
    tests_ += slices.tests();
    fallbacks_ += slices.fallbacks();
  }

  // Each part finds its own lists; then all lists are copied to their final place.
  void find_in_parts(const ExactFrame& frame, Lists& out) {
    cut_into_parts();
    const auto find_part = [&](std::size_t i) {
      Part& part = parts_[i];
      part.slices.find(frame, part.first, part.last, part.lists);
    };
    thread_pool_.each(parts_.size(), std::cref(find_part));
    starts_.assign(1, 0);
    std::uint64_t pairs = 0;
    for (const Part& part : parts_) {
      pairs += part.lists.lights.size();
      check_pair_count(pairs);
      starts_.push_back(static_cast<std::uint32_t>(pairs));
      count(part.slices);
    }
    check_memory("pairs of light lists", pairs, sizeof(std::uint32_t));
    out.begin.resize(grid_->cell_count() + std::size_t{1});
    out.lights.resize(pairs);
    out.begin.back() = starts_.back();
    const std::size_t slice_cells = grid_->cell_count() / static_cast<std::size_t>(planes_.slices);
    const auto move_part = [&](std::size_t i) {
      const Part& part = parts_[i];
      const std::size_t first_cell = static_cast<std::size_t>(part.first) * slice_cells;
      std::transform(part.lists.begin.begin(), part.lists.begin.end() - 1,
                     out.begin.begin() + static_cast<std::ptrdiff_t>(first_cell),
                     [&](std::uint32_t begin) { return begin + starts_[i]; });
      std::copy(part.lists.lights.begin(), part.lists.lights.end(),
                out.lights.begin() + static_cast<std::ptrdiff_t>(starts_[i]));
    };
    thread_pool_.each(parts_.size(),
                      std::cref(move_part));  // a copy would be too large for a std::function without memory
  }

  // Each part gets about equally many balls and cells.
  void cut_into_parts() {
    const auto slices = static_cast<std::size_t>(planes_.slices);
    const std::size_t row_cost = static_cast<std::size_t>(planes_.rows);
    const std::size_t whole = slice_bins_.count() + slices * row_cost;
    std::size_t done = 0, part = 0;
    parts_[0].first = 0;
    for (int slice = 0; slice < planes_.slices; ++slice) {
      done += slice_bins_.of(slice).size() + row_cost;
      while (part + 1 < parts_.size() && done * parts_.size() >= whole * (part + 1)) {
        parts_[part].last = slice + 1;
        parts_[++part].first = slice + 1;
      }
    }
    parts_[part].last = planes_.slices;
    for (++part; part < parts_.size(); ++part) parts_[part].first = parts_[part].last = planes_.slices;
  }

  void cull_lights() {
    visible_.count = 0;
    visible_.reserve(lights_->size());
    cull_balls(planes_, given_points(*lights_), visible_);
    first_spot_ = visible_.count;
    if (lights_->spots.empty()) return;
    find_spot_balls(*lights_, view::k_given_roundoffs, true, spots_);
    cull_balls(planes_, given_spots(*lights_, spots_), visible_);
  }

  std::unique_ptr<ListAssigner> exact_;
  bool is_left_to_exact_ = false;
  const grid::Grid* grid_ = nullptr;
  const view::LightArrays* lights_ = nullptr;  // of the current frame
  RowPlanes planes_;
  BallArrays spots_;  // around their cones
  VisibleBalls visible_;
  std::uint32_t first_spot_ = 0;  // in the balls
  SphereSetup shapes_;
  SliceBins slice_bins_;
  ExactSlices whole_;
  ThreadPool thread_pool_;
  std::vector<Part> parts_;
  std::vector<std::uint32_t> starts_;  // of the parts' pairs
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace

extern const AssignerDescriptor exact_fast_descriptor;
const AssignerDescriptor exact_fast_descriptor{
    .name = "exact-fast",
    .summary =
        "the lists of exact by another algorithm, one sphere per lane, lists by compression (SIMD, dispatched at run "
        "time)",
    .source = "this project",
    .kinds = {grid::Kind::frustum},
    .exact = true,
    .params = {{.name = "threads",
                .summary = "threads that share a frame; the lists do not depend on it",
                .default_value = 1.0,
                .unit = "",
                .min = 1.0,
                .max = 256.0,
                .choices = {},
                .whole = true,
                .is_thread_count = true}},
    .make = make_list_assigner<ExactFast>,
};

}  // namespace clusterbench::assign
