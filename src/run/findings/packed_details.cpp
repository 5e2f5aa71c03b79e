#include "run/findings/packed_details.h"

#include <algorithm>
#include <iterator>

#include "core/run_length_text.h"

namespace clusterbench::run {
namespace {

// Bytes of JSON besides the rows of numbers: keys, the camera, small numbers.
constexpr std::size_t k_bytes_of_all = 2500, k_bytes_of_frame = 1500, k_bytes_of_name = 3;

std::size_t pair_bytes(const DetailsFrame& frame) {
  return frame.pair_lights.size() + frame.pair_marks.size();
}

std::size_t bytes_without_pairs(const DetailsFrame& frame) {
  std::size_t bytes = k_bytes_of_frame;
  for (const std::string& name : frame.light_names) {
    bytes += name.size() + k_bytes_of_name;
    for (const char letter : name)  // JSON escapes up to six characters long
      if (letter == '"' || letter == '\\' || static_cast<unsigned char>(letter) < ' ') bytes += 5;
  }
  for (const std::string* text : {&frame.boundaries, &frame.cells, &frame.reported, &frame.truth,
                                  &frame.false_positives, &frame.false_negatives, &frame.lights, &frame.light_positions,
                                  &frame.light_ranges, &frame.spot_axes, &frame.spot_half_angles, &frame.box_half_axes})
    bytes += text->size();
  return bytes;
}

std::size_t bytes_of(const Details& details) {
  std::size_t bytes = k_bytes_of_all;
  for (const DetailsFrame& frame : details.frames) bytes += bytes_without_pairs(frame) + pair_bytes(frame);
  return bytes;
}

void leave_out_pairs(DetailsFrame& frame, std::vector<int>& left_out) {
  left_out.insert(std::lower_bound(left_out.begin(), left_out.end(), frame.frame), frame.frame);
  frame.has_pairs = false;
  frame.pair_lights.clear();
  frame.pair_marks.clear();
}

void append(std::vector<double>& row, const Vec3d& v) {
  row.insert(row.end(), {v.x, v.y, v.z});
}

void pack_lights(DetailsFrame& out, const view::Frame& frame, const scene::Scene& scene,
                 const std::vector<std::uint32_t>& lights) {
  std::vector<double> positions, ranges, axes, angles, half_axes;
  for (const std::uint32_t light : lights) {
    const scene::WorldLight& at = frame.lights[light];
    append(positions, frame.view_space.rotation * (at.position - frame.view_space.origin));
    ranges.push_back(at.range_m);
    out.light_names.push_back(scene.lights[static_cast<std::size_t>(at.rig_index)].name);
    if (at.type == scene::LightType::box)
      for (const Vec3d& axis : at.half_axes_m) append(half_axes, frame.view_space.rotation * axis);
    if (at.type != scene::LightType::spot) continue;
    append(axes, frame.view_space.rotation * at.direction);
    angles.push_back(at.outer_cone_rad);
  }
  out.lights = run_length_text(gaps_of(lights));
  out.light_positions = run_length_text(positions);
  out.light_ranges = run_length_text(ranges);
  out.spot_count = angles.size();
  out.box_count = half_axes.size() / 9;
  out.box_half_axes = run_length_text(half_axes);
  out.spot_axes = run_length_text(axes);
  out.spot_half_angles = run_length_text(angles);
}

void pack_pairs(DetailsFrame& out, const measure::FrameDetails& found) {
  std::vector<std::uint32_t> gaps;
  gaps.reserve(found.pair_lights.size());
  std::size_t begin = 0;
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    const std::size_t count = found.reported[i] + found.false_negatives[i];
    const auto cell = gaps_of(std::span(found.pair_lights).subspan(begin, count));
    gaps.insert(gaps.end(), cell.begin(), cell.end());
    begin += count;
  }
  out.has_pairs = true;
  out.pair_lights = run_length_text(gaps);
  out.pair_marks = run_length_text(found.pair_marks);
}

// "" for a grid without slices, and if the boundaries are the case's.
std::string own_boundaries(const grid::Grid& grid, const grid::Grid& case_grid) {
  if (!grid.has_tiles()) return "";
  const std::vector<float>& own = grid.screen().slices.boundaries;
  if (own == case_grid.screen().slices.boundaries) return "";
  return run_length_text(std::vector<double>(own.begin(), own.end()));
}

std::optional<grid::Tiles> own_tiles(const grid::Grid& grid, const grid::Grid& case_grid) {
  if (!grid.has_tiles()) return std::nullopt;
  const grid::Tiles &own = grid.screen().tiles, &of_case = case_grid.screen().tiles;
  return own.count == of_case.count && own.pixels == of_case.pixels ? std::nullopt : std::optional(own);
}

DetailsBox box_of(const grid::WorldGrid& grid) {
  return {grid.origin, Vec3d(Vec3f{grid.x.front(), grid.y.front(), grid.z.front()}),
          Vec3d(Vec3f{grid.x.back(), grid.y.back(), grid.z.back()})};
}

// Empty for other kinds, and if the box is the case's.
std::optional<DetailsBox> own_box(const grid::Grid& grid, const grid::Grid& case_grid) {
  if (grid.kind() != grid::Kind::world || box_of(grid.world()) == box_of(case_grid.world())) return std::nullopt;
  return box_of(grid.world());
}

}  // namespace

DetailsFrame packed_frame(const view::Frame& frame, const scene::Scene& scene, const grid::Grid& grid,
                          const grid::Grid& case_grid, const measure::FrameDetails& found, bool with_pairs) {
  DetailsFrame out;
  out.frame = frame.index;
  out.time_s = frame.time_s;
  out.camera = frame.view_space;
  out.projection = frame.projection;
  out.boundaries = own_boundaries(grid, case_grid);
  out.tiles = own_tiles(grid, case_grid);
  out.box = own_box(grid, case_grid);
  out.cell_count = found.cells.size();
  out.cells = run_length_text(gaps_of(found.cells));
  out.reported = run_length_text(found.reported);
  out.truth = run_length_text(found.truth);
  out.false_positives = run_length_text(found.false_positives);
  out.false_negatives = run_length_text(found.false_negatives);
  pack_lights(out, frame, scene, found.lights);
  if (with_pairs) pack_pairs(out, found);
  return out;
}

void add_frame(Details& details, DetailsFrame frame) {
  const std::size_t needed = bytes_without_pairs(frame);
  std::size_t used_without_pairs = k_bytes_of_all;
  for (const DetailsFrame& kept : details.frames) used_without_pairs += bytes_without_pairs(kept);
  if (used_without_pairs + needed > details.max_bytes) {
    details.frames_left_out.push_back(frame.frame);
    return;
  }
  for (auto kept = details.frames.rbegin(); bytes_of(details) + needed > details.max_bytes; ++kept)
    if (kept->has_pairs) leave_out_pairs(*kept, details.pairs_left_out);
  if (frame.has_pairs && bytes_of(details) + needed + pair_bytes(frame) > details.max_bytes)
    leave_out_pairs(frame, details.pairs_left_out);
  details.frames.push_back(std::move(frame));
}

}  // namespace clusterbench::run
