#include "dump/page_frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace clusterbench::dump {
namespace {

result::Vector vector_record(const Vec3d& v) {
  return {{v.x, v.y, v.z}};
}

std::vector<double> scaled(const std::vector<float>& numbers, double factor) {
  std::vector<double> out;
  for (const float number : numbers) out.push_back(factor * static_cast<double>(number));
  return out;
}

result::Matrix matrix_record(const Mat3d& m) {
  result::Matrix out;
  for (int row = 0; row < 3; ++row) out[static_cast<std::size_t>(row)] = {{m[0][row], m[1][row], m[2][row]}};
  return out;
}

// In the dump's own world: cells of a mirrored one are mirrored back.
result::CheckPageGrid world_grid(const DumpFrame& frame, double metres_per_unit) {
  const grid::WorldGrid& world = frame.grid.world();
  std::vector<double> z = scaled(world.z, metres_per_unit);
  Mat3d to_view = frame.frame.view_space.rotation;
  Vec3d eye = metres_per_unit * (frame.frame.view_space.origin - world.origin);
  if (frame.has_mirrored_cells) {
    std::ranges::reverse(z);
    for (double& plane : z) plane = -plane;
    to_view[2] = -to_view[2];
    eye.z = -eye.z;
  }
  return {"box", scaled(world.x, metres_per_unit), scaled(world.y, metres_per_unit),
          z,     matrix_record(to_view),           vector_record(eye)};
}

result::CheckPageGrid screen_grid(const grid::ScreenGrid& screen, double metres_per_unit) {
  const bool is_box = screen.tiles.orthographic && !screen.by_distance;
  const double across = is_box ? metres_per_unit : 1.0;  // slopes have no unit
  return {is_box               ? "box"
          : screen.by_distance ? "shells"
                               : "slopes",
          scaled(screen.tiles.x, across),
          scaled(screen.tiles.y, across),
          scaled(screen.slices.boundaries, is_box ? -metres_per_unit : metres_per_unit),
          matrix_record(Mat3d(1.0)),
          vector_record(Vec3d(0.0))};
}

std::vector<std::uint64_t> in_dump(std::span<const std::uint32_t> lights, const DumpFrame& frame) {
  std::vector<std::uint64_t> out;
  for (const std::uint32_t light : lights) out.push_back(frame.dump_index[light]);
  std::ranges::sort(out);
  return out;
}

// Those of `all` that `others` lacks; both ascend.
std::vector<std::uint32_t> without(std::span<const std::uint32_t> all, std::span<const std::uint32_t> others) {
  std::vector<std::uint32_t> out;
  std::ranges::set_difference(all, others, std::back_inserter(out));
  return out;
}

}  // namespace

result::CheckPageFrame page_frame(const DumpFrame& frame, double metres_per_unit) {
  result::CheckPageFrame out;
  out.grid =
      frame.grid.has_tiles() ? screen_grid(frame.grid.screen(), metres_per_unit) : world_grid(frame, metres_per_unit);
  const view::Projection& projection = frame.frame.projection;
  out.sides = {projection.left, projection.right, projection.bottom, projection.top};
  out.orthographic = projection.orthographic;
  if (projection.orthographic)
    for (double& side : out.sides) side *= metres_per_unit;
  return out;
}

result::CheckPageSet page_set(const std::string& name, const DumpFrame& frame, const assign::Lists& truth,
                              const assign::Lists& listed, const LostLights& lost, std::size_t& room) {
  result::CheckPageSet out;
  out.name = name;
  out.cells_left_out = 0;
  std::set<std::uint32_t> seen;
  for (const LostPair& pair : lost.deepest) {
    if (!seen.insert(pair.cell).second) continue;
    const std::size_t entries = truth.of(pair.cell).size() + listed.of(pair.cell).size();
    if (entries > room) {
      ++out.cells_left_out;
      continue;
    }
    room -= entries;
    out.cells.push_back({grid::cell_index(frame.dump_cell(pair.cell), frame.grid.cells()), 100.0 * pair.reach,
                         in_dump(listed.of(pair.cell), frame),
                         in_dump(without(truth.of(pair.cell), listed.of(pair.cell)), frame),
                         in_dump(without(listed.of(pair.cell), truth.of(pair.cell)), frame)});
  }
  return out;
}

void add_lights(const DumpFrame& frame, double metres_per_unit, result::CheckPageFrame& page) {
  std::set<std::uint64_t> named;
  for (const result::CheckPageSet& set : page.sets)
    for (const result::CheckPageCell& cell : set.cells) {
      named.insert(cell.listed.begin(), cell.listed.end());
      named.insert(cell.lost.begin(), cell.lost.end());
    }
  const view::Space& space = frame.frame.view_space;
  for (const std::uint64_t index : named) {
    const scene::WorldLight& light = frame.frame.lights[frame.frame_index[index]];
    result::CheckPageLight& out = page.lights.emplace_back();
    out.index = index;
    out.position = vector_record(metres_per_unit * (space.rotation * (light.position - space.origin)));
    out.range_m = metres_per_unit * light.range_m;
    if (light.type != scene::LightType::spot) continue;
    out.direction = vector_record(space.rotation * light.direction);
    out.half_angle_rad = light.outer_cone_rad;
  }
}

}  // namespace clusterbench::dump
