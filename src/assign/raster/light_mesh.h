#pragma once
// Low-poly meshes that enclose lights, for a conservative rasterizer (Örtegren and Persson 2016): a ball is a
// subdivided icosahedron, a spot is a sphere-capped cone turned around its axis in steps.
//
// In double precision. A mesh circumscribes its light, so no face cuts into it, and it is larger than the light;
// docs/methods.md lists by how much.

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

// A spot: all points within `range` of the apex whose direction makes an angle of at most half_angle_rad, 0 to 90
// degrees, with the axis (unit length up to roundoffs); and all points within `margin` of these.
struct SpotShape {
  Vec3d apex, axis;
  double range, half_angle_rad, margin;
};

// Levels of detail, from coarse to fine: balls of 20, 80, 320 and 1280 triangles, spots of 6, 9, 18 and 36 sectors.
inline constexpr int k_mesh_levels = 4;

class LightMeshes {
 public:
  LightMeshes();

  // The distance of the mesh's farthest vertex, relative to the ball's radius.
  double ball_scale(int level) const { return balls_[static_cast<std::size_t>(level)].scale; }
  // Makes the mesh around a ball. Keeps the memory of `out`.
  void enclose_ball(Vec3d center, double radius, int level, LightMesh& out) const;
  // Makes the mesh around a spot; if the spot is not much larger than its margin, around the ball of range + margin.
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
    std::vector<Vec3d> directions;  // of the sectors: 0, cosine, sine; lengthened so that they enclose the circle
    std::vector<MeshTopology> by_steps;
  };

  std::array<BallMesh, k_mesh_levels> balls_;
  std::array<SpotMeshes, k_mesh_levels> spots_;
};

}  // namespace clusterbench::assign
