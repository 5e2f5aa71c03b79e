#pragma once
// Shadow maps that several spots share: lights that sit together and point alike, as the headlights of a car, in one
// map whose frustum holds them all (Persson, SIGGRAPH 2015). Lights are cheap, maps are not.

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
  double most_growth = 1.5;       // volume of the frustum over that of the largest member's own
};

// A square frustum: the pyramid from its apex along its axis, slope times as wide to each side as deep, between two
// depths.
//
// It holds the sphere-capped cones of its members: with A the largest of (angle to the axis + half-angle), all
// directions of all members lie in the cone of half-angle A around the axis. The apex is moved back along the axis
// until that cone from there holds every member's own apex; a convex cone that holds a point holds all that lies from
// this point in one of its directions. The square pyramid holds the round cone, and the depths are those of the
// members' nearest and farthest points along the axis.
struct SharedFrustum {
  Vec3d apex{0.0}, axis{0.0, 0.0, -1.0};
  double slope = 0.0, near_m = 0.0, far_m = 0.0;
  std::vector<std::uint32_t> members;  // indices of lights, ascending

  double solid_angle_sr() const;
  double volume_m3() const;
};

// No map is wider: beyond, a spot has a cube or none, and shares nothing.
inline constexpr double k_widest_frustum_rad = 1.3962634015954636;  // 80 degrees to each side

// A spot's own, or one around several. None if it would be too wide, or a member has no end.
std::optional<SharedFrustum> frustum_around(std::span<const scene::WorldLight> lights,
                                            std::span<const std::uint32_t> spots);

// Each spot in one frustum, of which most have one member. From each spot by itself the two groups are joined, again
// and again, whose frustum grows least over the sum of theirs, as far as the limits go; ties by the lowest indices.
// Spots that no frustum holds are left out. Ascending by the first member.
std::vector<SharedFrustum> shared_frusta(std::span<const scene::WorldLight> lights,
                                         std::span<const std::uint32_t> spots, const SharingLimits& limits);

// Over frames.
struct MeanMost {
  double sum = 0.0, most = 0.0;
  std::uint64_t count = 0;

  void add(double value);
  double mean() const;  // NaN without any
};
struct SharingCounts {
  MeanMost points, spots;  // in view, per frame
  MeanMost maps;           // that the spots need if they share, per frame
  MeanMost shared;         // of those, with more than one member
  std::uint64_t most_members = 0;
  // Of frusta with more than one member, in all frames: over the largest of the members' own, and over their sum.
  MeanMost volume_over_largest, volume_over_sum, angle_over_largest, angle_over_sum;

  double saved() const;  // share of the spots' maps; NaN without spots
};
// The frame's lights that may be in view (grid/lights_in_view.h).
void add_frame(SharingCounts& counts, const view::Frame& frame, const SharingLimits& limits);

}  // namespace clusterbench::measure
