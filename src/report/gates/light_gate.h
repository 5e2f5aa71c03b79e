#pragma once
// Detects a level that loses lights, or a camera that no longer sees them, which would look like a lower cost: compares
// lights and camera paths of two results.

#include <string>
#include <vector>

#include "report/gates/limits.h"
#include "result/result.h"

namespace clusterbench::report {

// Start and end of a camera's path.
struct PathSpan {
  double from_s = 0.0, to_s = 0.0;
};
// "the path of camera walk in level has changed: 0 to 15 s, now 0 to 7.5 s"
std::string path_change_text(const std::string& scene, const std::string& camera, const PathSpan& before,
                             const PathSpan& now);

struct LightGate {
  bool allows_no_lights = false, allows_changed_lights = false;
  const result::Result* base = nullptr;  // null: no baseline
  std::string base_name = {};            // its name in messages
  std::string filter = {};  // the filter of the result's cases; other cases of the base are not reported as gone
};

// Reports scenes without lights or with dark ones only, cameras that never see a shining light, and scenes whose lights
// differ from the baseline's: broken, or a warning if that is allowed. Also broken if budgets have no case to apply to:
// scenes and cameras without any measured case, those of the baseline that the result does not have, and cases of the
// baseline that were left out here since they cannot be measured. A camera path that differs from the baseline's is a
// warning.
LimitFindings light_findings(const result::Result& result, const LightGate& gate);

}  // namespace clusterbench::report
