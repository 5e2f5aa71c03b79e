#pragma once
// Lists of the cells that contain the depths of a frame: light by light, the cells of its extents that show a visible
// surface and whose part between the depths passes the tests.

#include <vector>

#include "assign/bounds/bounds_method.h"
#include "assign/contract/assigner.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/occupied/depth_parts.h"
#include "assign/occupied/occupied_lists.h"

namespace clusterbench::assign {

// The grid's tiles without its slices: the frame's depths limit them.
grid::Grid tiles_of(const grid::Grid& grid);

// `test`, for methods with a list per tile: "planes", "aabb" or "both" (the default).
ParamSpec tile_test_param();
std::vector<ParamSpec> tiled_params();

// The part at the end of a tile's range of depth: see DepthParts, DepthPartsTo32.
enum class EndOfParts : std::uint8_t { part_31, part_32 };

class OccupiedMethod : public AssignerOf<OccupiedLists> {
 public:
  // `params`: tiled_params() or, for cells with slices, light_params().
  OccupiedMethod(const Params& params, CellBounds bounds, EndOfParts end = EndOfParts::part_31);

  void build(const grid::Grid& grid, const LightKinds& kinds) override;
  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override;

 protected:
  void fill(const FrameInput& input, OccupiedLists& out) override;

 private:
  void find_cells(const depth::DepthImage& image);
  void find_masks(const depth::DepthImage& image);
  bool meets_mask(std::uint32_t tile, float near, float far) const;
  // Bounds of the cells that show a surface: they depend on the frame.
  void bound_cells(bool with_balls);
  // The cells to be tested.
  CellBox candidate_cells(const view::LightArrays& lights, std::uint32_t light) const;
  void add_light(const view::LightArrays& lights, std::uint32_t light);
  bool touches(const TestedLight& light, std::uint32_t cell) const;

  LightTest test_;
  CellBounds bounds_;
  bool by_planes_ = true, by_boxes_ = true;
  const grid::Grid* grid_ = nullptr;
  grid::Grid extents_;  // the grid in which extents are found: that grid or, for tiles, the same with a single slice
  Vec3i cells_{0};      // the number of its cells
  ViewCull view_;
  PixelDepths pixels_;
  FrameCells frame_cells_;
  std::vector<DepthParts> parts_;  // of masked tiles
  // Used for tests in place of parts_ and the frame's masks, which still define the cells.
  EndOfParts end_;
  std::vector<DepthPartsTo32> late_parts_;
  std::vector<std::uint32_t> late_masks_;
  std::vector<geom::Box> boxes_;   // around cells; valid only for cells that are not empty
  std::vector<geom::Ball> balls_;  // around cells, likewise
  PairBuffer pairs_;
  Lists lists_;
  std::uint64_t tests_ = 0;
};

template <CellBounds bounds>
std::unique_ptr<StructureAssigner> make_occupied(const Params& params) {
  return std::make_unique<OccupiedMethod>(params, bounds);
}

}  // namespace clusterbench::assign
