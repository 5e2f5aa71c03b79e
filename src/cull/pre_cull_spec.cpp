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
};

}  // namespace

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
