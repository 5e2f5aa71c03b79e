#pragma once
// What a configuration asks for to happen to lights before a method gets them.

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace clusterbench::cull {

// Lights whose ball (a spot's: around its cone) lies outside of one of the camera's six planes are removed, whatever
// depths the grid's slices have, and those of range 0: what is left is in view (grid/lights_in_view.h), up to the
// padding.
struct FrustumStep {
  friend bool operator==(const FrustumStep&, const FrustumStep&) = default;
};

// Lights whose ball begins farther from the eye go to a list of distant lights, which are drawn and not shaded (Just
// Cause 3: as sprites).
struct DistanceStep {
  double distance_m = 0.0;

  friend bool operator==(const DistanceStep&, const DistanceStep&) = default;
};

// Lights that reach no space that is seen from the eye's view cell are removed (cull/visible_sets.h).
struct VisibleSetStep {
  double view_cell_m = 4.0, voxel_m = 2.0;  // edges of the cubes that eyes and lights are looked up in
  int rays = 4096;                          // per view cell

  friend bool operator==(const VisibleSetStep&, const VisibleSetStep&) = default;
};

// Of the lights that the steps before it leave, at most so many are kept; the others are lost. So an engine with room
// for a number of lights does. Behind a FrustumStep the limit is one of lights in view.
struct MostStep {
  // Which ones are kept. first: in the order of the lists' indices, points before spots. nearest: by the distance of
  // the eye to the light's position. shallowest: by the depth of that position, all behind the eye alike (Filament).
  enum class Keep : std::uint8_t { first, nearest, shallowest };

  int lights = 256;
  Keep keep = Keep::first;
  bool per_type = false;  // so many points and so many spots (Godot)

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
