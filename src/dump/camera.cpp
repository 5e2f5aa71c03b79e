#include "dump/camera.h"

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "core/error.h"
#include "geom/shapes/domain.h"

namespace clusterbench::dump {
namespace {

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

// The matrix of p' = M p; column c, row r: m[c][r].
Mat4d matrix_of(const std::vector<double>& numbers, bool is_by_rows) {
  Mat4d m(1.0);
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
  return is_by_rows ? glm::transpose(m) : m;
}

// By how much the three axes differ from unit and orthogonal ones.
double distance_from_rigid(const Mat3d& m) {
  const Mat3d product = glm::transpose(m) * m;
  double most = 0.0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) most = std::max(most, std::abs(product[c][r] - (c == r ? 1.0 : 0.0)));
  return std::isfinite(most) ? most : std::numeric_limits<double>::infinity();
}

bool is_affine(const Mat4d& m) {
  return std::abs(m[0][3]) + std::abs(m[1][3]) + std::abs(m[2][3]) < 1e-6 && std::abs(m[3][3] - 1.0) < 1e-6;
}

constexpr double k_rigid = 1e-3;  // of single-precision matrices after many rotations

bool is_camera(const Mat4d& m) {
  return is_affine(m) && distance_from_rigid(Mat3d(m)) <= k_rigid;
}

void check_view_matrix(const Mat4d& m, const std::string& pointer, bool is_by_rows) {
  if (is_camera(m)) return;
  std::string problem;
  if (!is_affine(m)) {
    problem = "has the last row (" + short_number(m[0][3]) + ", " + short_number(m[1][3]) + ", " +
              short_number(m[2][3]) + ", " + short_number(m[3][3]) + "); allowed: (0, 0, 0, 1)";
  } else {
    const Mat3d turn(m);
    const double lengths[] = {glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])};
    const double volume = std::abs(glm::determinant(turn));
    problem = volume <= 1e-9 * lengths[0] * lengths[1] * lengths[2] || volume == 0.0
                  ? "is singular: its axes lie in one plane"
                  : "has axes of lengths " + short_number(lengths[0]) + ", " + short_number(lengths[1]) + ", " +
                        short_number(lengths[2]) + "; allowed: orthogonal axes of length 1, without scale or shear";
  }
  if (is_camera(glm::transpose(m)))
    problem += std::string("; with camera.order '") + (is_by_rows ? "columns" : "rows") + "' it is a camera's";
  throw Error("", pointer, problem);
}

// The rotation and the eye of a view matrix.
view::Space space_of_matrix(const result::DumpCamera& camera, bool is_by_rows) {
  if (camera.world_to_view && camera.view_to_world)
    throw Error("", "/camera/view_to_world", "stands beside world_to_view; allowed: one of the two");
  const bool is_inverse = camera.view_to_world.has_value();
  const std::string pointer = is_inverse ? "/camera/view_to_world" : "/camera/world_to_view";
  const Mat4d m = matrix_of(is_inverse ? *camera.view_to_world : *camera.world_to_view, is_by_rows);
  check_view_matrix(m, pointer, is_by_rows);
  const Mat3d turn(m);
  // The transposed one is the inverse to the bit where the numbers are those of doubles.
  constexpr double k_of_doubles = 1e-12;
  const Mat3d back = distance_from_rigid(turn) < k_of_doubles ? glm::transpose(turn) : glm::inverse(turn);
  const Vec3d moved(m[3]);
  view::Space space;
  space.rotation = is_inverse ? back : turn;
  space.origin = is_inverse ? moved : -(back * moved);
  for (int i = 0; i < 3; ++i)
    if (!geom::is_in_domain(space.origin[i])) throw Error("", pointer, "puts the eye farther away than 1e15 m");
  return space;
}

struct ClipRange {
  double near, far;
};

ClipRange clip_range(const std::string& depth) {
  if (depth == "-1..1") return {-1.0, 1.0};
  if (depth == "1..0") return {1.0, 0.0};
  return {0.0, 1.0};
}

[[noreturn]] void refuse_projection(const std::string& problem) {
  throw Error("", "/camera/projection", problem);
}

// With m(row, column): x' = m00 x + m02 z + m03, w = m32 z + m33, and z = `forward` * depth.
view::Projection projection_of_matrix(Mat4d m, const result::DumpCamera& camera, double forward) {
  const auto at = [&m](int row, int column) { return m[column][row]; };
  view::Projection out;
  out.orthographic = std::abs(at(3, 2)) < 1e-9 && at(3, 3) != 0.0;
  const double w = out.orthographic ? at(3, 3) : at(3, 2);
  if (w == 0.0) refuse_projection("has a last row of zeros, so it projects nothing");
  if (std::abs(at(3, 0)) + std::abs(at(3, 1)) > 1e-6 * std::abs(w) || (!out.orthographic && at(3, 3) != 0.0))
    refuse_projection("has the last row (" + short_number(at(3, 0)) + ", " + short_number(at(3, 1)) + ", " +
                      short_number(at(3, 2)) + ", " + short_number(at(3, 3)) +
                      "); allowed: (0, 0, 1, 0), (0, 0, -1, 0) or (0, 0, 0, 1)");
  if (!out.orthographic && w * forward < 0.0)
    refuse_projection(std::string("divides by ") + (forward < 0.0 ? "z" : "-z") +
                      ": it is of a camera that looks along " + (forward < 0.0 ? "+z" : "-z") + " (camera.forward)");
  m /= std::abs(w);
  const double skew = std::abs(at(0, 1)) + std::abs(at(1, 0)) + std::abs(at(2, 0)) + std::abs(at(2, 1));
  if (!(std::abs(at(0, 0)) > 0.0) || !(std::abs(at(1, 1)) > 0.0) || skew > 1e-6 * std::abs(at(0, 0)))
    refuse_projection(
        "is singular or skewed: numbers (0, 0) and (1, 1) are not 0 in a projection, (0, 1) and (1, 0) are");
  // x' of a slope (perspective) or of metres (orthographic) is scale * x + shift.
  const auto ends = [&](int axis, double sign) {
    const double scale = sign * at(axis, axis), shift = sign * (out.orthographic ? at(axis, 3) : forward * at(axis, 2));
    return ClipRange{(-1.0 - shift) / scale, (1.0 - shift) / scale};
  };
  const ClipRange x = ends(0, 1.0), y = ends(1, camera.clip_y.value_or("up") == "down" ? -1.0 : 1.0);
  out.left = x.near, out.right = x.far, out.bottom = y.near, out.top = y.far;
  if (!(out.left < out.right)) refuse_projection("mirrors the picture: number (0, 0) is below 0");
  if (!(out.bottom < out.top)) refuse_projection("turns the picture upside down (camera.clip_y)");
  const ClipRange clip = clip_range(camera.depth.value_or("0..1"));
  const auto depth_of = [&](double value) {
    const double slope = forward * at(2, 2), shift = at(2, 3);
    if (out.orthographic) return slope == 0.0 ? std::numeric_limits<double>::quiet_NaN() : (value - shift) / slope;
    return std::abs(value - slope) < 1e-12 ? std::numeric_limits<double>::infinity() : shift / (value - slope);
  };
  out.near_m = depth_of(clip.near);
  out.far_m = depth_of(clip.far);
  // Rounding puts an infinite far plane behind the eye.
  if (!out.orthographic && (out.far_m < 0.0 || out.far_m > 1e12)) out.far_m = std::numeric_limits<double>::infinity();
  return out;
}

view::Projection projection_of_sides(const result::DumpCamera& camera) {
  view::Projection out;
  const result::Sides& sides = *camera.sides;
  out.orthographic = camera.orthographic.value_or(false);
  out.left = sides[0], out.right = sides[1], out.bottom = sides[2], out.top = sides[3];
  if (!(out.left < out.right) || !(out.bottom < out.top))
    throw Error("", "/camera/sides", "are not left, right, bottom, top: allowed are left < right and bottom < top");
  if (!camera.near_m) throw Error("", "/camera/near_m", "is missing: with sides the near plane is given");
  if (!camera.far_m) throw Error("", "/camera/far_m", "is missing: with sides the far plane is given (null: none)");
  return out;
}

// Which key leaves planes that are none. `own`: before near_m and far_m stood in their place.
std::string place_of_planes(const view::Projection& own, const result::DumpCamera& camera) {
  const bool own_near = own.orthographic ? std::isfinite(own.near_m) : own.near_m > 0.0 && std::isfinite(own.near_m);
  if (!camera.sides && !camera.near_m && !own_near) return "/camera/projection";
  if (camera.near_m && !own.orthographic && !(*camera.near_m > 0.0)) return "/camera/near_m";
  if (camera.far_m) return "/camera/far_m";
  return camera.near_m && (camera.sides || own.near_m < own.far_m) ? "/camera/near_m" : "/camera/projection";
}

// `own`: as above.
void check_projection(const view::Projection& projection, const view::Projection& own,
                      const result::DumpCamera& camera) {
  const double widest = std::max(
      {std::abs(projection.left), std::abs(projection.right), std::abs(projection.bottom), std::abs(projection.top)});
  if (!(widest <= (projection.orthographic ? geom::k_farthest_m : geom::k_steepest_slope)))
    throw Error("", camera.sides ? "/camera/sides" : "/camera/projection",
                "shows more than 89.9994 degrees to one side, or more than 1e15 m");
  const bool has_near = projection.orthographic ? std::isfinite(projection.near_m) : projection.near_m > 0.0;
  if (has_near && projection.near_m < projection.far_m && (!projection.orthographic || std::isfinite(projection.far_m)))
    return;
  const std::string place = place_of_planes(own, camera);
  const bool is_own = place == "/camera/projection";
  const view::Projection& told = is_own ? own : projection;
  const std::string near = short_number(told.near_m) + " m", far = short_number(told.far_m) + " m; allowed: ",
                    allowed = projection.orthographic ? "near_m below far_m" : "near_m above 0 and below far_m";
  if (is_own)
    throw Error("", place,
                "gives a near plane at " + near + " and a far plane at " + far + allowed + ", here or in their place");
  throw Error("", place, "leaves the near plane at " + near + " and the far plane at " + far + allowed);
}

}  // namespace

bool has_matrices(const result::DumpCamera& camera) {
  return !camera.scene.has_value();
}

Camera bare_camera_of(const result::DumpCamera& camera, bool lights_in_view_space) {
  const bool is_by_rows = camera.order.value_or("columns") == "rows";
  const double forward = camera.forward.value_or("-z") == "+z" ? 1.0 : -1.0;
  Camera out;
  if (lights_in_view_space) {
    out.is_world_mirrored = forward > 0.0;
  } else if (!camera.world_to_view && !camera.view_to_world) {
    throw Error("", "/camera/world_to_view",
                "is missing: name it, view_to_world, a scene, or lights in view space (lights.space)");
  } else {
    out.view_space = space_of_matrix(camera, is_by_rows);
    if (forward > 0.0)
      for (int c = 0; c < 3; ++c) out.view_space.rotation[c].z = -out.view_space.rotation[c].z;
    out.is_world_mirrored = glm::determinant(out.view_space.rotation) < 0.0;
    if (out.is_world_mirrored) {
      out.view_space.rotation[2] = -out.view_space.rotation[2];
      out.view_space.origin.z = -out.view_space.origin.z;
    }
  }
  if (camera.projection.has_value() == camera.sides.has_value())
    throw Error("", "/camera/projection", "or sides: name one of the two");
  out.projection = camera.sides ? projection_of_sides(camera)
                                : projection_of_matrix(matrix_of(*camera.projection, is_by_rows), camera, forward);
  const view::Projection own = out.projection;
  if (camera.near_m) out.projection.near_m = *camera.near_m;
  if (camera.far_m) out.projection.far_m = camera.far_m->value_or(std::numeric_limits<double>::infinity());
  check_projection(out.projection, own, camera);
  return out;
}

}  // namespace clusterbench::dump
