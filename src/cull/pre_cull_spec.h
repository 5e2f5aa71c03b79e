#pragma once
// The configuration of culls before a method gets its lights.

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace clusterbench::cull {

// Removes lights whose ball (a spot's: around its cone) lies outside of one of the camera's six planes, independent of
// the grid's slices, and those of range 0: the rest is in view (grid/lights_in_view.h), up to the padding.
struct FrustumStep {
  friend bool operator==(const FrustumStep&, const FrustumStep&) = default;
};

// Moves lights whose ball begins farther from the eye to a list of distant lights, which are drawn and not shaded (Just
// Cause 3: as sprites).
struct DistanceStep {
  double distance_m = 0.0;

  friend bool operator==(const DistanceStep&, const DistanceStep&) = default;
};

// Removes lights that reach no space that is visible from the eye's view cell (cull/visible_sets.h).
struct VisibleSetStep {
  double view_cell_m = 4.0, voxel_m = 2.0;  // edges of the cubes for eyes and for lights
  int rays = 4096;                          // per view cell

  friend bool operator==(const VisibleSetStep&, const VisibleSetStep&) = default;
};

// Keeps at most this many of the lights that the previous steps keep; the others are lost, as in an engine with room
// for a number of lights. After a FrustumStep the limit applies to lights in view.
struct MostStep {
  // Which ones are kept. first: in the order of the lists' indices, points before spots. nearest: by the distance of
  // the eye to the light's position. shallowest: by the depth of that position, all behind the eye alike (Filament).
  enum class Keep : std::uint8_t { first, nearest, shallowest };

  int lights = 256;
  Keep keep = Keep::first;
  bool per_type = false;  // the limit holds for points and for spots separately (Godot)

  friend bool operator==(const MostStep&, const MostStep&) = default;
};
inline constexpr MostStep::Keep k_keeps[] = {MostStep::Keep::first, MostStep::Keep::nearest,
                                             MostStep::Keep::shallowest};
// "first", "nearest", "shallowest"
const char* name_of(MostStep::Keep keep);

// Each kind of step, for people.
struct StepSummary {
  const char *name, *summary, *source;
};
std::span<const StepSummary> step_summaries();

using Step = std::variant<FrustumStep, DistanceStep, VisibleSetStep, MostStep>;

// "frustum", "distance(100)", "visible-set(4,2,4096)", "most(256,first)", "most(512,first,type)": numbers in the order
// of the members.
std::string label_of(const Step& step);

// Steps in their order; none: methods get all lights.
struct PreCullSpec {
  std::vector<Step> steps;

  bool is_none() const { return steps.empty(); }
  bool needs_triangles() const;
  std::string label() const;  // "none", "frustum+distance(100)"

  friend bool operator==(const PreCullSpec&, const PreCullSpec&) = default;
};

}  // namespace clusterbench::cull
