#pragma once
// What happens to a frame's lights before a method gets them: which are removed, and those that are left side by side.
//
// The method gets copies with indices of their own, in the order that they had. So an index of its lists is mapped back
// by `kept`, and lists that ascend still do.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cull/pre_cull_spec.h"
#include "cull/visible_sets.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::cull {

// What a pre-cull has made of one frame. Keeps its memory between frames.
struct FrameCull {
  std::vector<std::uint32_t> kept;     // indices of the frame's lights, ascending
  std::vector<std::uint32_t> removed;  // by each step: how many
  std::vector<std::uint32_t> dropped;  // indices of those that limits have removed, ascending for each limit
  std::vector<std::uint32_t> before;   // scratch
  view::LightArrays lights;            // those that are kept; their `source` is the one below
  std::vector<scene::WorldLight> source;
};

class PreCull {
 public:
  PreCull() = default;  // removes nothing
  // `sets`: of each step that is a VisibleSetStep, in their order.
  PreCull(PreCullSpec spec, std::vector<std::shared_ptr<const VisibleSets>> sets);

  const PreCullSpec& spec() const { return spec_; }
  bool is_none() const { return spec_.is_none(); }

  // `lights`: of the frame, in the grid's space. What an engine does in each frame: this is timed. No allocation in a
  // steady state.
  void cull(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights, FrameCull& out) const;
  // Gives what is kept the double-precision numbers that it was rounded from. No engine does that: not timed.
  static void give_source(const view::LightArrays& lights, FrameCull& out);

  // Whether it removed no light that shares a point with a cell of this grid, in the frame that `cull` is of. By the
  // view's planes: where cells end with the picture, in frustum and distance grids, and no light is beside the camera's
  // near and far plane and yet at the depth of a cell. By distance: where no cell reaches farther. A limit that removed
  // nothing loses nothing. A visible set never is.
  bool is_conservative(const view::Frame& frame, const grid::Grid& grid, const view::LightArrays& lights,
                       const FrameCull& cull) const;

  std::uint64_t bytes() const;  // of its visible sets
  double build_ns() const;      // what these took
  std::size_t view_cells() const;

 private:
  PreCullSpec spec_;
  std::vector<std::shared_ptr<const VisibleSets>> sets_;  // beside the steps; null for those that are none
};

}  // namespace clusterbench::cull
