#pragma once
// The identity of a case: the same in every run and on every machine.

#include <string>

#include "run/cases/case_plan.h"
#include "run/cases/scene_data.h"

namespace clusterbench::run {

// Short hashes of all settings that change the counts of a case; timing and threads do not.
struct CaseIdentity {
  std::string id;        // includes the scene's contents
  std::string settings;  // excludes them: stable while a level changes
};
CaseIdentity identity_of(const config::Config& config, const SceneData& data, const CasePlan& plan);

}  // namespace clusterbench::run
