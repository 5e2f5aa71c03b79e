// Frames cell by cell. Rows of numbers stay text: see core/run_length_text.h.

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

result::Vector vector_record(const Vec3d& v) {
  return {{v.x, v.y, v.z}};
}

result::DetailedCamera camera_record(const DetailsFrame& frame) {
  const Mat3d rows = glm::transpose(frame.camera.rotation);
  const view::Projection& p = frame.projection;
  result::DetailedCamera out;
  out.eye = vector_record(frame.camera.origin);
  out.view_from_world = {vector_record(rows[0]), vector_record(rows[1]), vector_record(rows[2])};
  out.orthographic = p.orthographic;
  out.sides = {p.left, p.right, p.bottom, p.top};
  out.near_m = p.near_m;
  out.far_m = p.far_m;
  return out;
}

result::DetailedLights lights_record(const DetailsFrame& f) {
  result::DetailedLights out;
  out.indices = f.lights;
  out.names = f.light_names;
  out.positions = f.light_positions;
  out.ranges = f.light_ranges;
  out.spots = f.spot_count;
  out.spot_axes = f.spot_axes;
  out.spot_half_angles = f.spot_half_angles;
  if (f.box_count > 0) {
    out.boxes = f.box_count;
    out.box_half_axes = f.box_half_axes;
  }
  return out;
}

result::DetailedFrame frame_record(const DetailsFrame& f) {
  result::DetailedFrame out;
  out.frame = static_cast<std::uint64_t>(f.frame);
  out.time_s = f.time_s;
  out.camera = camera_record(f);
  if (!f.boundaries.empty()) out.boundaries = f.boundaries;
  if (f.tiles) {
    out.tiles.emplace().count = counts_record(f.tiles->count);
    if (f.tiles->pixels.x > 0) out.tiles->pixels = counts_record(f.tiles->pixels);
  }
  if (f.box) out.box = {vector_record(f.box->origin), vector_record(f.box->lo), vector_record(f.box->hi)};
  out.cells = {f.cell_count, f.cells, f.reported, f.truth, f.false_positives, f.false_negatives};
  out.lights = lights_record(f);
  if (f.has_pairs) out.pairs = {f.pair_lights, f.pair_marks};
  return out;
}

std::vector<std::uint64_t> frames_record(const std::vector<int>& frames) {
  return {frames.begin(), frames.end()};
}

}  // namespace

result::Details details_record(const Details& details) {
  result::Details out;
  out.max_bytes = details.max_bytes;
  for (const DetailsFrame& frame : details.frames) out.frames.push_back(frame_record(frame));
  out.left_out = {frames_record(details.frames_left_out), frames_record(details.pairs_left_out),
                  frames_record(details.frames_not_on_path)};
  return out;
}

}  // namespace clusterbench::run
