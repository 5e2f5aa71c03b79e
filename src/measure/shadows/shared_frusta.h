#pragma once
// Shadow maps shared by several spots: lights close together with similar directions, such as the headlights of a car,
// use one map whose frustum contains them all (Persson, SIGGRAPH 2015). Lights are cheap, maps are not.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geom/shapes/vec.h"
#include "scene/scene.h"
#include "view/frame.h"

namespace clusterbench::measure {

// Which spots may share a map.
struct SharingLimits {
  double most_apart_m = 2.0;      // between any two apexes
  double most_turned_rad = 0.26;  // between any two axes
  double most_growth = 1.5;       // volume of the frustum over that of the largest member's own frustum
};

// A square frustum: the pyramid from its apex along its axis, `slope` times as wide to each side as deep, between two
// depths.
//
// It contains the sphere-capped cones of its members: with A the maximum of (angle to the axis + half-angle), all
// directions of all members are in the cone of half-angle A around the axis. The apex is moved back along the axis
// until that cone contains every member's own apex; a convex cone that contains a point contains all points reached
// from it in one of the cone's directions. The square pyramid contains the round cone, and the depths are those of the
// members' nearest and farthest points along the axis.
struct SharedFrustum {
  Vec3d apex{0.0}, axis{0.0, 0.0, -1.0};
  double slope = 0.0, near_m = 0.0, far_m = 0.0;
  std::vector<std::uint32_t> members;  // indices of lights, ascending

  double solid_angle_sr() const;
  double volume_m3() const;
};

// No map is wider: a wider spot has a cube map or none, and shares no map.
inline constexpr double k_widest_frustum_rad = 1.3962634015954636;  // 80 degrees to each side

// A spot's own frustum, or one around several spots. None if it would be too wide, or a member has an infinite range.
std::optional<SharedFrustum> frustum_around(std::span<const scene::WorldLight> lights,
                                            std::span<const std::uint32_t> spots);

// Each spot in one frustum; most frusta have one member. Greedy: starts with single spots, and joins the two groups
// with the smallest ratio of the joined volume to the sum of both, as long as the limits allow; ties by the lowest
// indices. Spots too wide for any frustum are left out. Ascending by the first member.
std::vector<SharedFrustum> shared_frusta(std::span<const scene::WorldLight> lights,
                                         std::span<const std::uint32_t> spots, const SharingLimits& limits);

// Over frames.
struct MeanMost {
  double sum = 0.0, most = 0.0;
  std::uint64_t count = 0;

  void add(double value);
  double mean() const;  // NaN without frames
};
struct SharingCounts {
  MeanMost points, spots;  // in view, per frame
  MeanMost maps;           // maps that the spots need with sharing, per frame
  MeanMost shared;         // of those, maps with more than one member
  std::uint64_t most_members = 0;
  // Of frusta with more than one member, in all frames: relative to the largest of the members' own, and to their sum.
  MeanMost volume_over_largest, volume_over_sum, angle_over_largest, angle_over_sum;

  double saved() const;  // share of the spots' maps; NaN without spots
};
// Adds the frame's lights that may be in view (grid/lights_in_view.h).
void add_frame(SharingCounts& counts, const view::Frame& frame, const SharingLimits& limits);

}  // namespace clusterbench::measure
