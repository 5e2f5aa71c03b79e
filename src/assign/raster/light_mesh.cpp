#include "assign/raster/light_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace clusterbench::assign {
namespace {

constexpr double k_pi = std::numbers::pi;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Derives the edges from triangles; each edge of a closed mesh has two triangles.
MeshTopology topology_of(std::uint32_t vertices, Triangles triangles) {
  MeshTopology out;
  out.vertices = vertices;
  out.triangles = std::move(triangles);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found;
  for (std::uint32_t triangle = 0; triangle < out.triangles.size(); ++triangle)
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = out.triangles[triangle][corner], b = out.triangles[triangle][(corner + 1) % 3];
      const auto [at, is_new] = found.try_emplace({std::min(a, b), std::max(a, b)}, triangle);
      if (!is_new) out.edges.push_back({a, b, {at->second, triangle}});
    }
  return out;
}

struct Solid {
  std::vector<Vec3d> vertices;
  Triangles triangles;
};

Solid icosahedron() {
  const double g = std::numbers::phi;
  Solid solid{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Vec3d& vertex : solid.vertices) vertex = glm::normalize(vertex);
  return solid;
}

// Splits each triangle into four, with vertices on the unit sphere.
Solid subdivided(const Solid& coarse) {
  Solid fine{coarse.vertices, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(fine.vertices.size()));
    if (is_new) fine.vertices.push_back(glm::normalize(coarse.vertices[a] + coarse.vertices[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.triangles.insert(fine.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

// The least distance of the face planes of a solid around the origin.
double least_plane_distance(const Solid& solid) {
  double least = 1.0;
  for (const auto& [a, b, c] : solid.triangles) {
    const Vec3d normal =
        glm::normalize(glm::cross(solid.vertices[b] - solid.vertices[a], solid.vertices[c] - solid.vertices[a]));
    least = std::min(least, glm::dot(normal, solid.vertices[a]));
  }
  return least;
}

// Vertex 0 is the end of the axis behind the apex, then ring after ring, then the end ahead.
MeshTopology turned(std::uint32_t sectors, std::uint32_t rings) {
  Triangles triangles;
  const std::uint32_t last = 1 + rings * sectors;
  const auto vertex = [sectors](std::uint32_t ring, std::uint32_t sector) {
    return 1 + ring * sectors + sector % sectors;
  };
  for (std::uint32_t sector = 0; sector < sectors; ++sector) {
    triangles.push_back({0, vertex(0, sector + 1), vertex(0, sector)});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      const std::uint32_t a = vertex(ring, sector), b = vertex(ring, sector + 1);
      const std::uint32_t c = vertex(ring + 1, sector), d = vertex(ring + 1, sector + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({c, b, d});
    }
    triangles.push_back({last, vertex(rings - 1, sector), vertex(rings - 1, sector + 1)});
  }
  return topology_of(last + 1, std::move(triangles));
}

// If margin / (range + margin) is larger, the ball is used for the spot. So the cap ends at most at 90° +
// asin(k_largest_margin).
constexpr double k_largest_margin = 0.25;
constexpr double k_widest_cap_rad = 0.5 * k_pi + 0.2527;

// A cap of n steps has n tangents to its circle: the first ahead, each of the others a step further, the last half a
// step before the cap's end.
std::uint32_t steps_for(double cap_rad, double widest_step_rad) {
  return std::max(1u, static_cast<std::uint32_t>(std::ceil(cap_rad / widest_step_rad + 0.5)));
}

struct Frame3 {
  Vec3d axis, u, v;  // right-handed, unit length
};

Frame3 frame_around(const Vec3d& direction) {
  const Vec3d axis = glm::normalize(direction);
  const Vec3d size = glm::abs(axis);
  const Vec3d helper = size.x <= size.y && size.x <= size.z ? Vec3d{1, 0, 0}
                       : size.y <= size.z                   ? Vec3d{0, 1, 0}
                                                            : Vec3d{0, 0, 1};
  const Vec3d u = glm::normalize(glm::cross(helper, axis));
  return {axis, u, glm::cross(axis, u)};
}

// A point of the spot's outline: its coordinates along and across the axis.
struct Outline {
  double along, beside;
};

}  // namespace

LightMeshes::LightMeshes() {
  Solid solid = icosahedron();
  for (BallMesh& ball : balls_) {
    // Both are correct to a few double roundoffs.
    ball.scale = (1.0 + 0x1p-48) / least_plane_distance(solid);
    ball.topology = topology_of(static_cast<std::uint32_t>(solid.vertices.size()), solid.triangles);
    ball.vertices = solid.vertices;
    for (Vec3d& vertex : ball.vertices) vertex *= ball.scale;
    solid = subdivided(solid);
  }
  // As fine as the balls: half of a sector and half of a step are at most the angle that a ball's triangles cover.
  constexpr std::array<std::uint32_t, k_mesh_levels> k_sectors{6, 9, 18, 36};
  for (std::size_t level = 0; level < spots_.size(); ++level) {
    SpotMeshes& spot = spots_[level];
    spot.sectors = k_sectors[level];
    const double half_sector = k_pi / spot.sectors;
    spot.widest_step_rad = 2.0 * half_sector;
    for (std::uint32_t sector = 0; sector < spot.sectors; ++sector) {
      const double turn = 2.0 * half_sector * sector, out = (1.0 + 0x1p-48) / std::cos(half_sector);
      spot.directions.push_back({0.0, out * std::cos(turn), out * std::sin(turn)});
    }
    const std::uint32_t most = steps_for(k_widest_cap_rad, spot.widest_step_rad);
    for (std::uint32_t steps = 0; steps <= most; ++steps) spot.by_steps.push_back(turned(spot.sectors, steps + 1));
  }
}

void LightMeshes::enclose_ball(Vec3d center, double radius, int level, LightMesh& out) const {
  const BallMesh& ball = balls_[static_cast<std::size_t>(level)];
  out.topology = &ball.topology;
  out.vertices.clear();
  for (const Vec3d& vertex : ball.vertices) out.vertices.push_back(center + radius * vertex);
}

// The outline is that of {within the margin of the cone's side} ∩ {no more than the margin behind the apex} ∩ {within
// range + margin of the apex}; for the last one, a chain of tangents replaces the circle. Turned in sectors it
// encloses: each section across the axis is a polygon around a circle.
void LightMeshes::enclose_spot(const SpotShape& spot, int level, LightMesh& out) const {
  const double radius = spot.range + spot.margin, share = spot.margin / radius;
  if (!(share <= k_largest_margin)) return enclose_ball(spot.apex, radius, level, out);
  const SpotMeshes& meshes = spots_[static_cast<std::size_t>(level)];
  const double angle = spot.half_angle_rad, sine = std::sin(angle), cosine = std::max(0.0, std::cos(angle));
  // Here the circle of range + margin meets the side that is moved out by the margin.
  const double cap = angle + std::asin(share);
  const std::uint32_t steps = steps_for(cap, meshes.widest_step_rad);
  const double step = cap / (steps - 0.5);
  out.topology = &meshes.by_steps[steps];
  out.vertices.clear();

  const Frame3 frame = frame_around(spot.axis);
  const auto add_end = [&](double along) { out.vertices.push_back(spot.apex + along * frame.axis); };
  const auto add_ring = [&](const Outline& at) {
    for (const Vec3d& out_of_axis : meshes.directions)
      out.vertices.push_back(spot.apex + at.along * frame.axis + (at.beside * out_of_axis.y) * frame.u +
                             (at.beside * out_of_axis.z) * frame.v);
  };
  add_end(-spot.margin);
  add_ring({-spot.margin, spot.margin * cosine / (1.0 + sine)});
  const double last_tangent = cap - 0.5 * step, to_tangent = angle - last_tangent;
  const double side = (radius + spot.margin * std::sin(to_tangent)) / std::cos(to_tangent);
  add_ring({side * cosine - spot.margin * sine, side * sine + spot.margin * cosine});
  const double corner = radius / std::cos(0.5 * step);
  for (std::uint32_t at = steps - 1; at > 0; --at) {
    const double turn = (at - 0.5) * step;
    add_ring({corner * std::cos(turn), corner * std::sin(turn)});
  }
  add_end(radius);
}

}  // namespace clusterbench::assign
