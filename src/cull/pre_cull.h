#pragma once
// The culls of a frame's lights before a method gets them: which lights are removed, and copies of the kept ones.
//
// The copies have indices of their own, in the original order. So `kept` maps an index of the method's lists back, and
// ascending lists stay ascending.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cull/pre_cull_spec.h"
#include "cull/visible_sets.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::cull {

// The result of a pre-cull for one frame. Keeps its memory between frames.
struct FrameCull {
  std::vector<std::uint32_t> kept;     // indices of the frame's lights, ascending
  std::vector<std::uint32_t> removed;  // number of lights, by step
  std::vector<std::uint32_t> dropped;  // indices of those that limits have removed, ascending for each limit
  std::vector<std::uint32_t> before;   // scratch
  view::LightArrays lights;            // the kept ones; their `source` is the one below
  std::vector<scene::WorldLight> source;
};

class PreCull {
 public:
  PreCull() = default;  // removes nothing
  // `sets`: one per VisibleSetStep, in their order.
  PreCull(PreCullSpec spec, std::vector<std::shared_ptr<const VisibleSets>> sets);

  const PreCullSpec& spec() const { return spec_; }
  bool is_none() const { return spec_.is_none(); }

  // `lights`: of the frame, in the grid's space. The part that engines run in each frame: it is timed. No allocation in
  // a steady state.
  void cull(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights, FrameCull& out) const;
  // Gives kept lights their double-precision numbers. Engines do not do that: not timed.
  static void give_source(const view::LightArrays& lights, FrameCull& out);

  // Whether it removed no light that shares a point with a cell of this grid, in the frame of `cull`. By the view's
  // planes: true if cells end with the picture (frustum and distance grids), and no light is beyond the camera's near
  // or far plane and still at the depth of a cell. By distance: true if no cell reaches farther. A limit that removed
  // nothing loses nothing. A visible set is never conservative.
  bool is_conservative(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights,
                       const FrameCull& cull) const;

  std::uint64_t bytes() const;  // of its visible sets
  double build_ns() const;      // time to build them
  std::size_t view_cells() const;

 private:
  PreCullSpec spec_;
  std::vector<std::shared_ptr<const VisibleSets>> sets_;  // parallel to the steps; null for other steps
};

}  // namespace clusterbench::cull
