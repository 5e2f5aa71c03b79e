#include "gpu/user_shaders/known_values.h"

#include <algorithm>
#include <cmath>

#include <glm/matrix.hpp>

#include "core/error.h"

namespace clusterbench::gpu {
namespace {

// Depth in clip space is a z + b; a perspective one is divided by -z.
struct ClipDepth {
  double a, b;
};

ClipDepth clip_depth(const view::Projection& projection, const std::string& range) {
  const double n = projection.near_m, f = projection.far_m;
  const bool is_endless = !std::isfinite(f);
  if (projection.orthographic) {
    if (range == "1..0") return {1.0 / (f - n), f / (f - n)};
    if (range == "-1..1") return {-2.0 / (f - n), -(f + n) / (f - n)};
    return {-1.0 / (f - n), -n / (f - n)};
  }
  if (range == "1..0") return is_endless ? ClipDepth{0.0, n} : ClipDepth{n / (f - n), f * n / (f - n)};
  if (range == "-1..1")
    return is_endless ? ClipDepth{-1.0, -2.0 * n} : ClipDepth{(f + n) / (n - f), 2.0 * f * n / (n - f)};
  return is_endless ? ClipDepth{-1.0, -n} : ClipDepth{f / (n - f), f * n / (n - f)};
}

Mat4d projection_matrix(const view::Projection& projection, const result::ShaderCamera& camera) {
  const double width = projection.right - projection.left, height = projection.top - projection.bottom;
  const double middle_x = (projection.right + projection.left) / width,
               middle_y = (projection.top + projection.bottom) / height;
  const ClipDepth depth = clip_depth(projection, camera.depth.value_or("0..1"));
  const double up = camera.clip_y.value_or("up") == "down" ? -1.0 : 1.0;
  Mat4d out(0.0);  // [column][row]
  out[0][0] = 2.0 / width;
  out[1][1] = up * 2.0 / height;
  out[2][2] = depth.a;
  out[3][2] = depth.b;
  const int column = projection.orthographic ? 3 : 2;
  const double sign = projection.orthographic ? -1.0 : 1.0;
  out[column][0] = sign * middle_x;
  out[column][1] = up * sign * middle_y;
  if (projection.orthographic)
    out[3][3] = 1.0;
  else
    out[2][3] = -1.0;
  return out;
}

Mat4d view_matrix(const view::Space& space) {
  Mat4d out(space.rotation);
  const Vec3d moved = -(space.rotation * space.origin);
  out[3] = Vec4d(moved, 1.0);
  return out;
}

Mat4d turned(double sign) {
  Mat4d out(1.0);
  out[2][2] = sign;
  return out;
}

}  // namespace

std::vector<KnownValue> known_values() {
  return {
      {"cells", 1, true, "cells of the grid"},
      {"columns", 1, true, "cells across"},
      {"rows", 1, true, "cells down"},
      {"slices", 1, true, "cells along depth"},
      {"tiles", 1, true, "columns * rows"},
      {"grid_size", 3, true, "columns, rows, slices"},
      {"viewport", 2, true, "width and height of the picture, in pixels"},
      {"viewport_width", 1, true, "in pixels"},
      {"viewport_height", 1, true, "in pixels"},
      {"tile_pixels", 2, true, "width and height of a tile, in pixels; not whole where tiles are counted"},
      {"tile_scale", 2, true, "tile = int(pixel * tile_scale)"},
      {"near", 1, true, "near plane of the camera, in metres"},
      {"far", 1, true, "far plane of the camera, in metres; infinity where it has none"},
      {"first_depth", 1, true, "where the slices begin, in metres"},
      {"last_depth", 1, true, "where they end"},
      {"slice_scale", 1, true,
       "slice = int(log2(depth) * slice_scale + slice_bias), or without log2 where slices are linear"},
      {"slice_bias", 1, true, "see slice_scale"},
      {"slice_boundaries", 0, true, "slices + 1 depths, in metres"},
      {"column_boundaries", 0, true, "columns + 1 planes from the left: x / depth (orthographic: x in metres)"},
      {"row_boundaries", 0, true, "rows + 1 planes from the top: y / depth"},
      {"sides", 4, true, "left, right, bottom, top of the picture at depth 1 (orthographic: in metres)"},
      {"projection", 16, true, "view to clip space"},
      {"inverse_projection", 16, true, "clip to view space"},
      {"world_to_view", 16, false, "view matrix"},
      {"view_to_world", 16, false, "its inverse: the camera's own matrix"},
      {"world_to_clip", 16, false, "projection * world_to_view"},
      {"clip_to_world", 16, false, "its inverse"},
      {"eye", 3, false, "the camera in the world, in metres"},
      {"lights", 1, false, "points and spots of the frame"},
      {"points", 1, false, "point lights, which come first"},
      {"spots", 1, false, "spot lights"},
      {"light_words", 1, false, "ceil(lights / 32)"},
  };
}

std::vector<std::string> number_names(const result::ShaderMethod& method, bool only_of_grid) {
  std::vector<std::string> names;
  for (const KnownValue& value : known_values())
    if (value.numbers == 1 && (value.is_of_grid || !only_of_grid)) names.emplace_back(value.name);
  if (method.parameters)
    for (const result::ShaderParameter& parameter : *method.parameters) names.push_back(parameter.name);
  return names;
}

double depth_sign(const result::ShaderMethod& method) {
  return method.camera && method.camera->forward.value_or("-z") == "+z" ? -1.0 : 1.0;
}

FrameValues::FrameValues(const result::ShaderMethod& method, const assign::Params& params, const view::Frame& frame,
                         const grid::ScreenGrid& grid, const view::LightRanges& lights) {
  const std::uint32_t count = lights.boxes.first;
  values_["lights"] = {static_cast<double>(count)};
  values_["points"] = {static_cast<double>(lights.points.count)};
  values_["spots"] = {static_cast<double>(lights.spots.count)};
  const std::uint32_t words = (count + 31) / 32;
  values_["light_words"] = {static_cast<double>(words)};
  const view::Projection& projection = frame.projection;
  values_["near"] = {projection.near_m};
  values_["far"] = {projection.far_m};
  values_["sides"] = {projection.left, projection.right, projection.bottom, projection.top};
  values_["viewport"] = {static_cast<double>(frame.viewport.x), static_cast<double>(frame.viewport.y)};
  values_["viewport_width"] = {values_["viewport"][0]};
  values_["viewport_height"] = {values_["viewport"][1]};
  add_grid(grid);
  add_matrices(method.camera.value_or(result::ShaderCamera{}), frame);
  if (method.parameters)
    for (const result::ShaderParameter& parameter : *method.parameters)
      values_[parameter.name] = {params.number(parameter.name)};
}

void FrameValues::add_grid(const grid::ScreenGrid& grid) {
  const Vec3i counts = grid.counts();
  const double columns = counts.x, rows = counts.y, slices = counts.z;
  values_["columns"] = {columns};
  values_["rows"] = {rows};
  values_["slices"] = {slices};
  values_["tiles"] = {columns * rows};
  values_["cells"] = {columns * rows * slices};
  values_["grid_size"] = {columns, rows, slices};
  const std::vector<double>& viewport = values_["viewport"];
  const Vec2i pixels = grid.tiles.pixels;
  values_["tile_pixels"] = {pixels.x > 0 ? pixels.x : viewport[0] / columns,
                            pixels.y > 0 ? pixels.y : viewport[1] / rows};
  values_["tile_scale"] = {static_cast<double>(grid.tiles.scale_x), static_cast<double>(grid.tiles.scale_y)};
  const auto all = [](const std::vector<float>& from) { return std::vector<double>(from.begin(), from.end()); };
  values_["slice_boundaries"] = all(grid.slices.boundaries);
  values_["column_boundaries"] = all(grid.tiles.x);
  values_["row_boundaries"] = all(grid.tiles.y);
  values_["first_depth"] = {values_["slice_boundaries"].front()};
  values_["last_depth"] = {values_["slice_boundaries"].back()};
  if (grid.slices.lookup.form == grid::SliceLookup::Form::search) return;
  values_["slice_scale"] = {static_cast<double>(grid.slices.lookup.scale)};
  values_["slice_bias"] = {static_cast<double>(grid.slices.lookup.bias)};
}

void FrameValues::add_matrices(const result::ShaderCamera& camera, const view::Frame& frame) {
  const bool is_by_rows = camera.order.value_or("columns") == "rows";
  const Mat4d turn = turned(camera.forward.value_or("-z") == "+z" ? -1.0 : 1.0);
  const Mat4d projection = projection_matrix(frame.projection, camera) * turn,
              to_view = turn * view_matrix(frame.view_space);
  add_matrix("projection", projection, is_by_rows);
  add_matrix("inverse_projection", glm::inverse(projection), is_by_rows);
  add_matrix("world_to_view", to_view, is_by_rows);
  add_matrix("view_to_world", glm::inverse(to_view), is_by_rows);
  add_matrix("world_to_clip", projection * to_view, is_by_rows);
  add_matrix("clip_to_world", glm::inverse(projection * to_view), is_by_rows);
  const Vec3d& eye = frame.view_space.origin;
  values_["eye"] = {eye.x, eye.y, eye.z};
}

void FrameValues::add_matrix(const char* name, const Mat4d& matrix, bool is_by_rows) {
  std::vector<double>& out = values_[name];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) out.push_back(is_by_rows ? matrix[j][i] : matrix[i][j]);
}

NumberOf FrameValues::number() const {
  return [this](const std::string& name) -> const double* {
    const auto found = values_.find(name);
    return found == values_.end() || found->second.size() != 1 ? nullptr : found->second.data();
  };
}

std::vector<double> FrameValues::numbers(const std::string& is, const std::string& where) const {
  if (const auto found = values_.find(is); found != values_.end()) return found->second;
  if (is.find("slice_scale") != std::string::npos || is.find("slice_bias") != std::string::npos)
    if (!values_.contains("slice_scale"))
      throw Error("", where,
                  "is " + is + ", and the slices of this grid follow no formula; slice_boundaries tells them");
  return {number_of_formula(is, number(), where)};
}

}  // namespace clusterbench::gpu
