#pragma once
// What identifies a case: the same in every run and on every machine.

#include <string>

#include "run/cases/sweep.h"

namespace clusterbench::run {

// Short hashes of all settings that change what a case counts; timing and threads do not.
struct CaseIdentity {
  std::string id;        // and of the scene's contents
  std::string settings;  // without: stable while a level changes
};
CaseIdentity identity_of(const config::Config& config, const SceneData& data, const CasePlan& plan);

}  // namespace clusterbench::run
