// Light meshes and the shell of the conservative rasterizer, held against points of the lights and against a polygon
// clipper.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "assign/contract.h"
#include "assign/dense_check.h"
#include "assign/raster/light_mesh.h"
#include "assign/raster/tile_depths.h"

namespace clusterbench::assign::testing {
namespace {

constexpr double k_spot_angles[] = {0.0, 1e-4, 0.2, 0.6, M_PI / 4, 1.2, 1.55, M_PI / 2};

std::array<Vec3d, 3> corners_of(const LightMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  return {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]};
}

// How far in front of the triangle's plane; none for slivers, whose planes follow from roundoffs.
double in_front(const std::array<Vec3d, 3>& corners, const Vec3d& point) {
  const Vec3d normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  const double longest = std::max(glm::length(corners[1] - corners[0]), glm::length(corners[2] - corners[0]));
  return length > 1e-3 * longest * longest ? glm::dot(normal, point - corners[0]) / length : -1e300;
}

double farthest_in_front(const LightMesh& mesh, const Vec3d& point) {
  double farthest = -1e300;
  for (const auto& triangle : mesh.topology->triangles)
    farthest = std::max(farthest, in_front(corners_of(mesh, triangle), point));
  return farthest;
}

double volume_of_mesh(const LightMesh& mesh) {
  double sum = 0.0;
  for (const auto& triangle : mesh.topology->triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    sum += glm::dot(a - mesh.vertices[0], glm::cross(b - mesh.vertices[0], c - mesh.vertices[0])) / 6.0;
  }
  return sum;
}

SpotShape random_spot(Random& random, double half_angle) {
  const double range = random.log_between(0.1, 50);
  const double margin = random.unit() < 0.3 ? 0.0 : range * random.log_between(1e-7, 0.3);
  return {{random.between(-20, 20), random.between(-20, 20), random.between(-5, 60)},
          random.direction(),
          range,
          half_angle,
          margin};
}

Vec3d point_of(const SpotShape& spot, Random& random) {
  const Vec3d at = point_in(spot_light(spot.apex, spot.range, spot.axis, spot.half_angle_rad), random);
  return at + (random.unit() < 0.5 ? 1.0 : random.unit()) * spot.margin * random.direction();
}

TEST(LightMeshes, are_closed) {
  const LightMeshes meshes;
  LightMesh mesh;
  Random random(1);
  for (int level = 0; level < k_mesh_levels; ++level)
    for (const double angle : k_spot_angles) {
      if (angle == 0.0)
        meshes.enclose_ball({1, 2, 3}, 4.0, level, mesh);
      else
        meshes.enclose_spot(random_spot(random, angle), level, mesh);
      const MeshTopology& topology = *mesh.topology;
      ASSERT_EQ(mesh.vertices.size(), topology.vertices);
      EXPECT_EQ(topology.edges.size(), topology.triangles.size() * 3 / 2);
      EXPECT_EQ(topology.vertices + topology.triangles.size(), topology.edges.size() + 2) << "Euler's formula";
      std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
      for (const auto& [a, b, c] : topology.triangles)
        for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
          EXPECT_TRUE(directed.insert(side).second) << "neighbours run an edge in opposite directions";
      for (const MeshEdge& edge : topology.edges) {
        EXPECT_TRUE(directed.contains({edge.a, edge.b}) && directed.contains({edge.b, edge.a}));
        EXPECT_NE(edge.sides[0], edge.sides[1]);
      }
      EXPECT_GT(volume_of_mesh(mesh), 0.0) << "triangles face outward";
    }
}

TEST(LightMeshes, enclose_balls_and_are_tighter_level_by_level) {
  const LightMeshes meshes;
  LightMesh mesh;
  Random random(2);
  double before = 10.0;
  for (int level = 0; level < k_mesh_levels; ++level) {
    const Vec3d center{3, -2, 10};
    meshes.enclose_ball(center, 7.0, level, mesh);
    for (int i = 0; i < 2000; ++i)
      ASSERT_LE(farthest_in_front(mesh, center + 7.0 * random.direction()), 1e-13) << level;
    for (const auto& triangle : mesh.topology->triangles)
      for (const Vec3d& corner : corners_of(mesh, triangle))
        ASSERT_LE(glm::length(corner - center), 7.0 * meshes.ball_scale(level) * (1 + 1e-14));
    const double volume = volume_of_mesh(mesh) / (4.0 / 3.0 * M_PI * 343.0);
    EXPECT_LT(volume - 1.0, 0.5 * (before - 1.0));
    before = volume;
    RecordProperty("ball_" + std::to_string(level), std::to_string(volume));
  }
}

TEST(LightMeshes, enclose_spots_and_what_is_within_their_margin) {
  const LightMeshes meshes;
  LightMesh mesh;
  Random random(3);
  for (int level = 0; level < k_mesh_levels; ++level)
    for (const double angle : k_spot_angles)
      for (int turn = 0; turn < 20; ++turn) {
        const SpotShape spot = random_spot(random, angle);
        meshes.enclose_spot(spot, level, mesh);
        for (int i = 0; i < 50; ++i)
          ASSERT_LE(farthest_in_front(mesh, point_of(spot, random)), 1e-12 * (glm::length(spot.apex) + spot.range))
              << "level " << level << ", angle " << angle << ", margin " << spot.margin / spot.range;
      }
}

// What docs/methods.md says of the meshes' sizes.
TEST(LightMeshes, are_as_much_larger_than_their_lights_as_documented) {
  const LightMeshes meshes;
  LightMesh mesh;
  constexpr std::size_t k_triangles[] = {20, 80, 320, 1280};
  constexpr double k_ball_scales[] = {1.2584, 1.0705, 1.0181, 1.0045};
  constexpr double k_ball_volumes[] = {1.21, 1.07, 1.02, 1.005}, k_largest_spots[] = {1.37, 1.11, 1.03, 1.006};
  for (std::size_t level = 0; level < k_mesh_levels; ++level) {
    meshes.enclose_ball({0, 0, 0}, 1.0, static_cast<int>(level), mesh);
    EXPECT_EQ(mesh.topology->triangles.size(), k_triangles[level]);
    EXPECT_NEAR(meshes.ball_scale(static_cast<int>(level)), k_ball_scales[level], 0.00005);
    EXPECT_NEAR(volume_of_mesh(mesh) / (4.0 / 3.0 * M_PI), k_ball_volumes[level], 0.005);
    double largest = 0.0;
    for (const double degrees : {10.0, 30.0, 45.0, 60.0, 90.0}) {
      const double angle = degrees * M_PI / 180;
      meshes.enclose_spot({{0, 0, 0}, {0, 0, 1}, 1.0, angle, 0.0}, static_cast<int>(level), mesh);
      largest = std::max(largest, volume_of_mesh(mesh) / (2.0 / 3.0 * M_PI * (1 - std::cos(angle))));
    }
    EXPECT_NEAR(largest, k_largest_spots[level], 0.005);
  }
}

// The part of a polygon where the function is not negative (Sutherland and Hodgman).
template <class Function>
std::vector<Vec3d> clipped(const std::vector<Vec3d>& polygon, Function&& function) {
  std::vector<Vec3d> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3d& a = polygon[i];
    const Vec3d& b = polygon[(i + 1) % polygon.size()];
    const double at_a = function(a), at_b = function(b);
    if (at_a >= 0) out.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) out.push_back(glm::mix(a, b, at_a / (at_a - at_b)));
  }
  return out;
}

// By the solid angle of all triangles (Van Oosterom and Strackee 1983): a whole turn from within, none from outside.
bool holds_eye(const LightMesh& mesh) {
  double angle = 0.0;
  for (const auto& triangle : mesh.topology->triangles) {
    const auto [a, b, c] = corners_of(mesh, triangle);
    const double x = glm::length(a), y = glm::length(b), z = glm::length(c);
    angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y);
  }
  return angle > 2.0 * M_PI;
}

// The depths of the mesh in a tile: those of its triangles, clipped at the tile's four planes, and the eye's.
Extent clipped_depths(const LightMesh& mesh, const grid::Tiles& tiles, int column, int row) {
  const bool orthographic = tiles.orthographic;
  const auto at = [orthographic](double plane, const Vec3d& p) { return orthographic ? plane : plane * p.z; };
  const double x0 = tiles.x[static_cast<std::size_t>(column)], x1 = tiles.x[static_cast<std::size_t>(column) + 1];
  const double y0 = tiles.y_min(row), y1 = tiles.y_max(row);
  Extent depths;
  for (const auto& triangle : mesh.topology->triangles) {
    const auto corners = corners_of(mesh, triangle);
    std::vector<Vec3d> polygon(corners.begin(), corners.end());
    polygon = clipped(polygon, [&](const Vec3d& p) { return p.x - at(x0, p); });
    polygon = clipped(polygon, [&](const Vec3d& p) { return at(x1, p) - p.x; });
    polygon = clipped(polygon, [&](const Vec3d& p) { return p.y - at(y0, p); });
    polygon = clipped(polygon, [&](const Vec3d& p) { return at(y1, p) - p.y; });
    for (const Vec3d& p : polygon) depths.add(p.z, p.z);
  }
  if (!orthographic && holds_eye(mesh)) depths.add(0.0, 0.0);
  return depths;
}

struct ShellCheck {
  int tiles = 0, covered = 0, eye_within = 0;

  void check(const LightMesh& mesh, const grid::Grid& grid, TileDepths& shell, const std::string& what) {
    const Vec3i cells = grid.cells();
    const CellBox all{{0, 0, 0}, cells - 1};
    double size = 0.0;
    for (const Vec3d& vertex : mesh.vertices) size = std::max(size, glm::length(vertex));
    std::vector<Extent> exact;
    shell.find(mesh, Coverage::exact, all);
    for (int row = 0; row < cells.y; ++row)
      for (int column = 0; column < cells.x; ++column) {
        const Extent expected = clipped_depths(mesh, grid.screen().tiles, column, row);
        const Extent& found = exact.emplace_back(shell.of(column, row));
        ++tiles;
        covered += expected.empty() ? 0 : 1;
        ASSERT_EQ(found.empty(), expected.empty()) << what << ", tile " << column << ", " << row;
        if (found.empty()) continue;
        ASSERT_NEAR(found.lo, expected.lo, 1e-10 * size) << what << ", tile " << column << ", " << row;
        ASSERT_NEAR(found.hi, expected.hi, 1e-10 * size) << what << ", tile " << column << ", " << row;
      }
    shell.find(mesh, Coverage::triangle, all);
    for (int row = 0, tile = 0; row < cells.y; ++row)
      for (int column = 0; column < cells.x; ++column, ++tile) {
        const Extent& whole = shell.of(column, row);
        const Extent& part = exact[static_cast<std::size_t>(tile)];
        ASSERT_EQ(whole.empty(), part.empty());
        ASSERT_TRUE(part.empty() || (whole.lo <= part.lo && whole.hi >= part.hi));
      }
  }
};

TEST(TileDepths, are_those_of_the_mesh_clipped_at_the_tiles_sides) {
  const LightMeshes meshes;
  LightMesh mesh;
  TileDepths shell;
  ShellCheck checks;
  Random random(4);
  for (const Setting& setting : settings_for(*find_assigner("bounds"), 1)) {
    shell.build(setting.grid.screen());
    for (int turn = 0; turn < 160; ++turn) {
      const int level = turn % 3;
      // Small beside a tile, as large as some, around the eye, behind it.
      const double depth = turn % 8 == 7 ? random.between(-20, 0) : random.log_between(0.5, 100);
      const Vec3d center{random.between(-1, 1) * (std::fabs(depth) + 1), random.between(-0.6, 0.6) * std::fabs(depth),
                         depth};
      const double range = random.log_between(0.01, 40);
      if (turn % 2 == 0)
        meshes.enclose_ball(center, range, level, mesh);
      else
        meshes.enclose_spot({center, random.direction(), range, k_spot_angles[turn / 2 % 8], 1e-6 * range}, level,
                            mesh);
      checks.check(mesh, setting.grid, shell, setting.name + ", mesh " + std::to_string(turn));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(checks.covered, checks.tiles / 50) << checks.tiles;
}

// The planes of slivers must not say that the eye is outside.
TEST(TileDepths, begin_at_the_eye_where_it_is_in_the_light) {
  const LightMeshes meshes;
  LightMesh mesh;
  TileDepths shell;
  Random random(5);
  for (const Setting& setting : settings_for(*find_assigner("bounds"), 1)) {
    if (setting.grid.screen().tiles.orthographic) continue;
    shell.build(setting.grid.screen());
    for (const double angle : {0.5, 1.2, 1.5, 1.55, 1.57, M_PI / 2})
      for (int turn = 0; turn < 200; ++turn) {
        SpotShape spot{{0, 0, 0}, random.direction(), 10.0, angle, 1e-6};
        spot.apex = -point_in(spot_light({0, 0, 0}, 9.9, spot.axis, 0.999 * angle), random);
        meshes.enclose_spot(spot, turn % k_mesh_levels, mesh);
        shell.find(mesh, Coverage::exact, {{0, 0, 0}, setting.grid.cells() - 1});
        ASSERT_EQ(shell.of(0, 0).lo <= 0.0, true) << angle << ", " << turn;
      }
  }
}

TEST(ConservativeRaster, loses_no_true_pair_with_any_level_and_coverage) {
  for (const std::uint64_t seed : {1u, 5u})
    for (const Setting& setting : settings_for(*find_assigner("exact"), seed)) {
      const Lists exact = lists_by("exact", setting.frame, setting.grid);
      for (const char* level : {"screen", "0", "1", "2", "3"}) {
        const auto with = [&](const char* coverage) {
          return lists_by("conservative-raster", setting.frame, setting.grid,
                          {{"level", std::string(level)}, {"coverage", std::string(coverage)}});
        };
        const Lists in_tile = with("exact");
        EXPECT_TRUE(contained(exact, in_tile)) << setting.name << ", " << level;
        EXPECT_TRUE(contained(in_tile, with("triangle"))) << setting.name << ", " << level;
      }
    }
}

TEST(ConservativeRaster, takes_the_coarsest_level_that_stands_off_by_no_more_than_is_asked) {
  for (const Setting& setting : settings_for(*find_assigner("exact"), 2)) {
    const auto with = [&](const char* level, double excess) {
      return lists_by("conservative-raster", setting.frame, setting.grid,
                      {{"level", std::string(level)}, {"excess", excess}});
    };
    EXPECT_EQ(with("screen", 1000.0), with("0", 0.0)) << setting.name;
    EXPECT_EQ(with("screen", 0.0), with("3", 0.0)) << setting.name;
    EXPECT_LT(with("screen", 0.25).pair_count(), with("0", 0.0).pair_count()) << setting.name;
  }
}

}  // namespace
}  // namespace clusterbench::assign::testing
