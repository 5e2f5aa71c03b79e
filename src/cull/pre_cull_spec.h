#pragma once
// What a configuration asks for to happen to lights before a method gets them.

#include <span>
#include <string>
#include <variant>
#include <vector>

namespace clusterbench::cull {

// Lights whose ball (a spot's: around its cone) lies outside of one of the view's planes are removed.
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

// Each kind of step, for people.
struct StepSummary {
  const char *name, *summary, *source;
};
std::span<const StepSummary> step_summaries();

using Step = std::variant<FrustumStep, DistanceStep, VisibleSetStep>;

// "frustum", "distance(100)", "visible-set(4,2,4096)": numbers in the order of the members.
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
