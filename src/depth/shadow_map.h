#pragma once
// The surfaces that a light sees: for each direction the distance of the first opaque surface, as in a shadow map, and
// a pyramid of greatest distances over it. A cell that begins beyond the greatest distance of all texels that it covers
// is wholly in shadow (Persson, SIGGRAPH 2015, an idea for future work).

#include <array>
#include <cstdint>
#include <vector>

#include "depth/ray_caster.h"
#include "scene/scene.h"

namespace clusterbench::depth {

// How the distance of a texel is found. Rays go through the texels' corners.
//   proven   Triangles are shown to cover the whole texel, and the distance is the greatest of any of their points in
//            it; a texel with a possible gap has none, and counts as unlimited. No point that the light reaches is
//            called hidden, except through gaps, and along edges, narrower than k_narrowest_gap.
//   sampled  The greatest of the distances at the texel's four corners, unlimited if a ray meets nothing. Correct if,
//            for every distance, the directions in which light gets farther are a union of squares that are one texel
//            wide; this is not checked.
enum class TexelBound : std::uint8_t { proven, sampled };
const char* name_of(TexelBound bound);  // "proven", "sampled"

// In radians, or parts of the distance: gaps that meshes leave open where they only just meet.
inline constexpr double k_narrowest_gap = 1e-6;

struct ShadowMapRequest {
  int resolution = 64;  // texels along each side of a face
  TexelBound bound = TexelBound::proven;
  double near_m = 0.0;  // surfaces nearer to the light cast no shadow: lamps are inside their shades

  friend bool operator==(const ShadowMapRequest&, const ShadowMapRequest&) = default;
};

// For one light at one time. A point has six faces, the sides of a cube. A spot of up to k_widest_spot_rad has one, the
// square around its cone; a wider one has those of the cube that its cone reaches.
class ShadowMap {
 public:
  static constexpr double k_widest_spot_rad = 1.0471975511965976;  // 60 degrees to each side

  // Casts the rays; the caster is posed. Throws Error beyond the limit on memory.
  ShadowMap(const RayCaster& caster, const scene::WorldLight& light, const ShadowMapRequest& request);
  // Makes the coarser levels. Call it once, after the constructor.
  void reduce();

  // Whether every point of a convex body with these corners is in shadow, or outside the light's cone. Corners are
  // numbered as those of a box, relative to the light along the world's axes; `nearest_m` is at most the distance of
  // any point of the body. `bias_m`: distance behind a surface at which a point still counts as lit.
  bool hides(const std::array<Vec3d, 8>& corners, double nearest_m, double bias_m) const;

  std::size_t face_count() const { return faces_.size(); }
  // The distance of a texel on the finest level, rounded up; +inf: unlimited; 0: no light goes there.
  float texel(std::size_t face, int x, int y) const;
  // Lit texels of the finest level, over all faces.
  struct TexelCounts {
    std::uint64_t texels = 0, unlimited = 0;
  };
  TexelCounts texel_counts() const;
  std::size_t bytes() const;  // of all levels
  // The largest possible size of a light's map.
  static std::uint64_t most_bytes(const ShadowMapRequest& request);

 private:
  struct Level {
    int size = 0;  // texels along a side
    std::vector<float> farthest;
  };
  struct Face {
    Vec3d right, up, forward;  // of unit length
    std::vector<Level> levels;
  };
  struct Rectangle {
    double left, right, bottom, top;  // slopes
  };

  void cast(const RayCaster& caster, Face& face);
  float farthest(const Face& face, const Rectangle& covered) const;

  scene::WorldLight light_;
  ShadowMapRequest request_;
  double slope_ = 1.0;  // of the sides of all faces
  std::vector<Face> faces_;
};

}  // namespace clusterbench::depth
