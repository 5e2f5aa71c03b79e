#include "report/details_json.h"

#include <cmath>

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

Json coordinates(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

Json camera(const run::DetailsFrame& frame) {
  const Mat3d rows = glm::transpose(frame.camera.rotation);
  const view::Projection& p = frame.projection;
  return {{"eye", coordinates(frame.camera.origin)},
          {"view_from_world", {coordinates(rows[0]), coordinates(rows[1]), coordinates(rows[2])}},
          {"orthographic", p.orthographic},
          {"sides", {p.left, p.right, p.bottom, p.top}},
          {"near_m", p.near_m},
          {"far_m", std::isfinite(p.far_m) ? Json(p.far_m) : Json(nullptr)}};
}

Json frame_to_json(const run::DetailsFrame& f) {
  Json out{{"frame", f.frame}, {"time_s", f.time_s}, {"camera", camera(f)}};
  if (!f.boundaries.empty()) out["boundaries"] = f.boundaries;
  if (f.tiles) {
    const Vec2i& pixels = f.tiles->pixels;
    out["tiles"] = {{"count", {f.tiles->count.x, f.tiles->count.y}}};
    if (pixels.x > 0) out["tiles"]["pixels"] = {pixels.x, pixels.y};
  }
  if (f.box)
    out["box"] = {
        {"origin", coordinates(f.box->origin)}, {"min", coordinates(f.box->lo)}, {"max", coordinates(f.box->hi)}};
  out["cells"] = {{"count", f.cell_count},
                  {"indices", f.cells},
                  {"reported", f.reported},
                  {"true", f.truth},
                  {"false_positives", f.false_positives},
                  {"false_negatives", f.false_negatives}};
  out["lights"] = {{"indices", f.lights},
                   {"names", f.light_names},
                   {"positions", f.light_positions},
                   {"ranges", f.light_ranges},
                   {"spots", f.spot_count},
                   {"spot_axes", f.spot_axes},
                   {"spot_half_angles", f.spot_half_angles}};
  if (f.box_count > 0) {
    out["lights"]["boxes"] = f.box_count;
    out["lights"]["box_half_axes"] = f.box_half_axes;
  }
  if (f.has_pairs) out["pairs"] = {{"lights", f.pair_lights}, {"marks", f.pair_marks}};
  return out;
}

}  // namespace

Json details_to_json(const run::Details& details) {
  Json frames = Json::array();
  for (const run::DetailsFrame& frame : details.frames) frames.push_back(frame_to_json(frame));
  return {{"max_bytes", details.max_bytes},
          {"frames", frames},
          {"left_out",
           {{"frames", details.frames_left_out},
            {"pairs", details.pairs_left_out},
            {"not_on_path", details.frames_not_on_path}}}};
}

}  // namespace clusterbench::report
