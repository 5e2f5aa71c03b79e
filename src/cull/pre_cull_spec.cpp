#include "cull/pre_cull_spec.h"

#include <algorithm>
#include <cstdio>

namespace clusterbench::cull {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

struct Label {
  std::string operator()(const FrustumStep&) const { return "frustum"; }
  std::string operator()(const DistanceStep& step) const { return "distance(" + number(step.distance_m) + ")"; }
  std::string operator()(const VisibleSetStep& step) const {
    return "visible-set(" + number(step.view_cell_m) + "," + number(step.voxel_m) + "," + std::to_string(step.rays) +
           ")";
  }
  std::string operator()(const MostStep& step) const {
    return "most(" + std::to_string(step.lights) + "," + name_of(step.keep) + (step.per_type ? ",type)" : ")");
  }
};

}  // namespace

std::span<const StepSummary> step_summaries() {
  static constexpr StepSummary k_rows[] = {
      {"frustum",
       "lights whose sphere (a spot's: around its cone) lies outside of one of the camera's six planes are removed, "
       "and those of range 0; what is left is in view. Loses nothing that a point in view needs, and no pair of "
       "frustum and distance grids whose slices end with the camera's near and far plane",
       "all engines"},
      {"distance_m",
       "lights that begin farther from the eye are distant ones: drawn, not shaded; loses nothing where no cell "
       "reaches "
       "farther",
       "Just Cause 3: Persson 2015"},
      {"visible_set",
       "lights that reach no space seen from the eye's view cell are removed; by sampled rays, NOT conservative; needs "
       "triangles",
       "Airey, Rohlf and Brooks 1990; by rays: Wonka et al. 2006"},
      {"most",
       "at most so many lights are kept, the others are lost: the first ones, or those nearest to the eye; NOT "
       "conservative in frames with more",
       "engines with room for a number of lights (see the presets)"},
  };
  return k_rows;
}

const char* name_of(MostStep::Keep keep) {
  constexpr const char* k_names[] = {"first", "nearest", "shallowest"};
  return k_names[static_cast<int>(keep)];
}

std::string label_of(const Step& step) {
  return std::visit(Label{}, step);
}

bool PreCullSpec::needs_triangles() const {
  return std::ranges::any_of(steps, [](const Step& step) { return std::holds_alternative<VisibleSetStep>(step); });
}

std::string PreCullSpec::label() const {
  std::string text;
  for (const Step& step : steps) text += (text.empty() ? "" : "+") + label_of(step);
  return text.empty() ? "none" : text;
}

}  // namespace clusterbench::cull
