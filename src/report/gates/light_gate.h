#pragma once
// A level that loses its lights must not look like one that became cheaper, nor a camera that no longer looks at them:
// which lights and camera paths two results are of.

#include <string>
#include <vector>

#include "report/gates/limits.h"
#include "result/result.h"

namespace clusterbench::report {

// When a camera's path begins and ends.
struct PathSpan {
  double from_s = 0.0, to_s = 0.0;
};
// "the path of camera walk in level has changed: 0 to 15 s, now 0 to 7.5 s"
std::string path_change_text(const std::string& scene, const std::string& camera, const PathSpan& before,
                             const PathSpan& now);

struct LightGate {
  bool allows_no_lights = false, allows_changed_lights = false;
  const result::Result* base = nullptr;  // null: no baseline
  std::string base_name = {};            // as messages call it
  std::string filter = {};               // what the result's cases were selected by; others of the base are not missed
};

// Scenes without lights or with dark ones alone, cameras that never have one in view that shines, and scenes with other
// lights than the baseline's: broken, or a warning where that is allowed. Broken also what budgets cannot be held
// against: scenes and cameras of which nothing could be measured, and those of the baseline that the result does not
// have. Cameras with another path than the baseline's are a warning.
LimitFindings light_findings(const result::Result& result, const LightGate& gate);

}  // namespace clusterbench::report
