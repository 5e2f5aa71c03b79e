#pragma once
// Low-poly meshes that enclose lights, as a conservative rasterizer draws them (Örtegren and Persson 2016): a ball is a
// subdivided icosahedron, a spot a sphere-capped cone turned around its axis in steps.
//
// In double precision. A mesh circumscribes its light, so that no face cuts into it, and is larger than the light:
// docs/methods.md says how much.

#include <array>
#include <cstdint>
#include <vector>

#include "geom/shapes/vec.h"

namespace clusterbench::assign {

struct MeshEdge {
  std::uint32_t a, b;                  // vertices
  std::array<std::uint32_t, 2> sides;  // the triangles on both sides
};

// Closed; from outside the corners of a triangle run counter-clockwise.
struct MeshTopology {
  std::uint32_t vertices = 0;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<MeshEdge> edges;
};

// Metres; x to the right, y up, z the depth (so z points away from the eye). `topology` belongs to the LightMeshes.
struct LightMesh {
  const MeshTopology* topology = nullptr;
  std::vector<Vec3d> vertices;
};

// A spot: all points within `range` of the apex that the axis (unit length but for roundoffs) makes no larger angle
// with than half_angle_rad, 0 to 90 degrees; and all points within `margin` of these.
struct SpotShape {
  Vec3d apex, axis;
  double range, half_angle_rad, margin;
};

// Levels of detail, from coarse to fine: balls of 20, 80, 320 and 1280 triangles, spots of 6, 9, 18 and 36 sectors.
inline constexpr int k_mesh_levels = 4;

class LightMeshes {
 public:
  LightMeshes();

  // How many times as large as the ball the mesh's farthest vertex is.
  double ball_scale(int level) const { return balls_[static_cast<std::size_t>(level)].scale; }
  // The mesh around a ball. Keeps the memory of `out`.
  void enclose_ball(Vec3d center, double radius, int level, LightMesh& out) const;
  // The mesh around a spot; where the spot is not much larger than its margin, around the ball of range + margin.
  void enclose_spot(const SpotShape& spot, int level, LightMesh& out) const;

 private:
  struct BallMesh {
    MeshTopology topology;
    std::vector<Vec3d> vertices;  // for radius 1
    double scale = 1.0;
  };
  // The k-th has k + 1 rings, between the two ends of the axis.
  struct SpotMeshes {
    std::uint32_t sectors = 0;
    double widest_step_rad = 0.0;   // of the cap, between two rings
    std::vector<Vec3d> directions;  // of the sectors: 0, cosine, sine; as far out as encloses the circle
    std::vector<MeshTopology> by_steps;
  };

  std::array<BallMesh, k_mesh_levels> balls_;
  std::array<SpotMeshes, k_mesh_levels> spots_;
};

}  // namespace clusterbench::assign
