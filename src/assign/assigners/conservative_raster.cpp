// Shell and fill: each light is a low-poly mesh around it; a conservative rasterizer finds the least and greatest depth
// in each tile that the mesh touches (the shell), and the slices between these depths list the light (the fill).
//
// Roundoffs: vertices, depths and tiles are in double precision, whose errors stay below one roundoff of the light's
// reach. A spot's axis (3 components off by half a roundoff) and its angle (a sine and a cosine off by half a roundoff)
// turn it by less than two roundoffs; the displacement is that angle times its range. All lights are enlarged by the
// sum.

#include <cmath>

#include "assign/bounds/cell_bounds.h"
#include "assign/contract/light_test.h"
#include "assign/grid_cull/view_cull.h"
#include "assign/pipeline/light_by_light.h"
#include "assign/raster/tile_depths.h"
#include "geom/numbers/round_to_float.h"
#include "grid/index_range.h"

namespace clusterbench::assign {
namespace {

constexpr float k_raster_roundoffs = 3.0f;

// The greatest distance of a grid's cells from the eye.
double reach_of(const grid::ScreenGrid& grid) {
  const auto farther = [](float a, float b) { return std::max(std::fabs(a), std::fabs(b)); };
  const double x = farther(grid.tiles.x.front(), grid.tiles.x.back());
  const double y = farther(grid.tiles.y.front(), grid.tiles.y.back());
  const double depth = farther(grid.slices.boundaries.front(), grid.slices.boundaries.back());
  const double across = std::sqrt(x * x + y * y);
  return grid.tiles.orthographic ? std::hypot(across, depth) : depth * std::hypot(across, 1.0);
}

class ConservativeRaster final : public LightByLight<ConservativeRaster> {
 public:
  explicit ConservativeRaster(const Params& params)
      : test_(Params(light_params(), {{"inflation", params.number("inflation")}}), k_raster_roundoffs),
        coverage_(params.text("coverage") == "exact" ? Coverage::exact : Coverage::triangle),
        largest_excess_(params.number("excess")) {
    const std::string& level = params.text("level");
    if (level != "screen") level_ = level[0] - '0';
  }

  void build(const grid::Grid& grid, const LightKinds&) override {
    start_grid(grid);
    view_ = ViewCull(grid.screen());
    grid_reach_ = reach_of(grid.screen());
    depths_.build(grid.screen());
  }

  void start_frame(const view::LightArrays&) {}
  void add_light(const view::LightArrays& lights, std::uint32_t light) {
    const Vec3d center{lights.x[light], lights.y[light], lights.z[light]};
    // Parts beyond all cells are never listed, so lights without end can be cut there.
    const double range = std::min(double{lights.radius[light]}, glm::length(center) + grid_reach_);
    const double reach = std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z) + range;
    const double margin = double{test_.own_padding()} * 0x1p-24 * reach;
    ++tests_;
    const geom::Ball ball = ball_around(center, range + margin);
    if (view_.misses(ball)) return;
    make_mesh(lights, light, {center, {}, range, 0.0, margin}, level_for(ball));
    const CellBox window = window_of(center);
    if (window.empty()) return;
    depths_.find(mesh_, coverage_, window);
    tests_ += depths_.tests_done();
    fill(window, light);
  }
  std::size_t own_bytes() const { return depths_.capacity_bytes() + bytes_of(mesh_.vertices); }

 private:
  static geom::Ball ball_around(const Vec3d& center, double radius) {
    return {Vec3f(center), geom::rounded_up(radius)};
  }

  // The coarsest level whose mesh extends past the light by no more tiles than allowed.
  int level_for(const geom::Ball& ball) const {
    if (level_ >= 0) return level_;
    const CellBox box = cell_box(*grid_, ball);
    const double radius_tiles = 0.5 * std::max(box.last.x - box.first.x + 1, box.last.y - box.first.y + 1);
    int level = 0;
    while (level + 1 < k_mesh_levels && (meshes_.ball_scale(level) - 1.0) * radius_tiles > largest_excess_) ++level;
    return level;
  }

  // In x, y and depth.
  void make_mesh(const view::LightArrays& lights, std::uint32_t light, SpotShape shape, int level) {
    shape.apex.z = -shape.apex.z;
    if (!lights.is_spot(light)) return meshes_.enclose_ball(shape.apex, shape.range + shape.margin, level, mesh_);
    const geom::SphericalCone cone = lights.cone(light, 0.0f);
    shape.axis = {cone.axis.x, cone.axis.y, -cone.axis.z};
    shape.half_angle_rad = std::atan2(double{cone.sin_angle}, double{cone.cos_angle});
    meshes_.enclose_spot(shape, level, mesh_);
  }

  // The cells that the mesh can touch.
  CellBox window_of(const Vec3d& center) const {
    double farthest = 0.0;
    for (const Vec3d& vertex : mesh_.vertices)
      farthest = std::max(farthest, glm::length(vertex - Vec3d{center.x, center.y, -center.z}));
    const double size = std::fabs(center.x) + std::fabs(center.y) + std::fabs(center.z) + farthest;
    return cell_box(*grid_, ball_around(center, farthest + double{k_cell_box_roundoffs} * 0x1p-24 * size));
  }

  void fill(const CellBox& window, std::uint32_t light) {
    const std::vector<float>& boundaries = grid_->screen().slices.boundaries;
    for (int y = window.first.y; y <= window.last.y; ++y)
      for (int x = window.first.x; x <= window.last.x; ++x) {
        const Extent& depths = depths_.of(x, y);
        const grid::IndexRange slices = grid::intervals_touched(boundaries, depths.lo, depths.hi);
        for (int z = slices.first; z <= slices.last; ++z) pairs_.add(index_of({x, y, z}), light);
      }
  }

  LightTest test_;
  Coverage coverage_;
  double largest_excess_;  // in tiles
  int level_ = -1;         // -1: chosen by the light's size on the screen
  LightMeshes meshes_;
  ViewCull view_;
  double grid_reach_ = 0.0;
  LightMesh mesh_;
  TileDepths depths_;
};

std::vector<ParamSpec> conservative_raster_params() {
  return {{.name = "level",
           .summary =
               "how fine meshes are: 0 (a sphere has 20 triangles), 1 (80), 2 (320), 3 (1280), or screen: the first of "
               "them whose spheres stand off by at most `excess`",
           .default_value = std::string("screen"),
           .unit = "",
           .choices = {"screen", "0", "1", "2", "3"}},
          {.name = "excess",
           .summary = "level screen: how far a mesh may stand off its sphere, but for the finest one",
           .default_value = 0.25,
           .unit = "tiles",
           .min = 0.0,
           .max = 1000.0,
           .choices = {}},
          {.name = "coverage",
           .summary =
               "the depths of a tile that a triangle touches. exact: those of the part in the tile; triangle: all of "
               "the triangle's",
           .default_value = std::string("exact"),
           .unit = "",
           .choices = {"exact", "triangle"}},
          inflation_param()};
}

}  // namespace

extern const AssignerDescriptor conservative_raster_descriptor;
const AssignerDescriptor conservative_raster_descriptor{
    .name = "conservative-raster",
    .summary =
        "low-poly meshes around the lights, rasterized conservatively: the slices between the least and the greatest "
        "depth of the mesh in each tile",
    .source = "Örtegren and Persson 2016, Clustered Shading: Assigning Lights Using Conservative Rasterization",
    .kinds = {grid::Kind::frustum},
    .by_name = true,
    .params = conservative_raster_params(),
    .make = make_list_assigner<ConservativeRaster>,
};

}  // namespace clusterbench::assign
