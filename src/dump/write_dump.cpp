#include "dump/write_dump.h"

#include <cmath>

#include "core/error.h"
#include "os/output_file.h"

namespace clusterbench::dump {
namespace {

result::DumpCamera camera_record(const view::Frame& frame) {
  result::DumpCamera out;
  const Mat3d& turn = frame.view_space.rotation;  // its rows are the camera's axes in the world
  std::vector<double>& m = out.view_to_world.emplace();
  for (int axis = 0; axis < 3; ++axis) m.insert(m.end(), {turn[0][axis], turn[1][axis], turn[2][axis], 0.0});
  const Vec3d& eye = frame.view_space.origin;
  m.insert(m.end(), {eye.x, eye.y, eye.z, 1.0});
  const view::Projection& projection = frame.projection;
  out.sides = result::Sides{projection.left, projection.right, projection.bottom, projection.top};
  out.orthographic = projection.orthographic;
  out.near_m = projection.near_m;
  out.far_m.emplace();
  if (std::isfinite(projection.far_m)) out.far_m->emplace(projection.far_m);
  return out;
}

std::vector<double> doubles(const std::vector<float>& numbers) {
  return {numbers.begin(), numbers.end()};
}

void add_screen(const grid::ScreenGrid& screen, result::DumpGrid& out) {
  result::DumpTiles& tiles = out.tiles.emplace();
  if (screen.tiles.pixels.x > 0)
    tiles.pixels = result::Size2{screen.tiles.pixels.x, screen.tiles.pixels.y};
  else
    tiles.count = result::Size2{screen.tiles.count.x, screen.tiles.count.y};
  out.slices.emplace().boundaries_m = doubles(screen.slices.boundaries);
}

// By its planes, since those of a grid that follows the camera are no equal parts of their bounds to the bit.
void add_world(const grid::WorldGrid& world, result::DumpGrid& out) {
  out.planes = result::DumpPlanes{
      {world.origin.x, world.origin.y, world.origin.z}, doubles(world.x), doubles(world.y), doubles(world.z)};
}

result::DumpGrid grid_record(const grid::Grid& grid, const layout::CellOrder& order) {
  result::DumpGrid out;
  out.kind = grid::kind_name(grid.kind());
  if (grid.has_tiles())
    add_screen(grid.screen(), out);
  else if (grid.kind() == grid::Kind::world)
    add_world(grid.world(), out);
  else
    throw Error("", "--write-dump", "dumps have no words for grids of kind " + *out.kind);
  out.axes = order.axes;
  out.first_row = order.is_from_bottom ? "bottom" : "top";
  out.first_slice = order.is_from_far ? "far" : "near";
  return out;
}

// Eight doubles for each light: position, range, direction, half-angle.
constexpr std::uint64_t k_light_bytes = 64;

layout::Buffer light_buffer(const view::Frame& frame) {
  std::vector<double> numbers;
  for (const scene::WorldLight& light : frame.lights) {
    const Vec3d &p = light.position, &d = light.direction;
    numbers.insert(numbers.end(), {p.x, p.y, p.z, light.range_m, d.x, d.y, d.z, light.outer_cone_rad});
  }
  layout::Buffer out{"lights", "", 0, {}};
  const auto* bytes = reinterpret_cast<const std::byte*>(numbers.data());
  out.bytes.assign(bytes, bytes + numbers.size() * sizeof(double));
  return out;
}

result::DumpLights light_record(const view::Frame& frame) {
  if (frame.boxes > 0) throw Error("", "--write-dump", "dumps have no words for boxes, which the scene has");
  result::DumpLightRows points{"lights", {}, k_light_bytes, frame.points, {0, "f64", {}}, {24, "f64", {}}, {}, {},
                               {},       {}};
  result::DumpLightRows spots = points;
  spots.at = k_light_bytes * frame.points;
  spots.count = frame.lights.size() - frame.points;
  spots.direction = result::DumpField{32, "f64", {}};
  spots.cone = result::DumpCone{56, "f64", "radians"};
  result::DumpLights out;
  out.rows = {points, spots};
  return out;
}

}  // namespace

MadeDump make_dump(const view::Frame& frame, const grid::Grid& grid, const layout::Described& lists,
                   const layout::CellOrder& order) {
  MadeDump out;
  out.record.dump_version = 1;
  out.record.viewport = {frame.viewport.x, frame.viewport.y};
  out.record.camera = camera_record(frame);
  out.record.grid = grid_record(grid, order);
  out.record.lights = light_record(frame);
  out.record.lists = {lists.lists};
  out.buffers = lists.buffers;
  out.buffers.push_back(light_buffer(frame));
  return out;
}

std::filesystem::path write_dump(MadeDump dump, const std::filesystem::path& folder, const std::string& name) {
  result::ByName<result::DumpBuffer>& files = dump.record.buffers.emplace();
  for (const layout::Buffer& buffer : dump.buffers) {
    const std::string file = name + "." + buffer.name + ".bin";
    os::write_file(folder / file, {reinterpret_cast<const char*>(buffer.bytes.data()), buffer.bytes.size()});
    files.push_back({buffer.name, {file, {}, {}}});
  }
  std::filesystem::path path = folder / (name + ".json");
  os::write_file(path, result::to_json(dump.record).dump(1) + "\n");
  return path;
}

}  // namespace clusterbench::dump
