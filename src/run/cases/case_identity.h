#pragma once
// The identity of a case: the same in every run and on every machine.

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "run/cases/case_plan.h"
#include "run/cases/scene_data.h"

namespace clusterbench::run {

// Short hashes of all settings that change the counts of a case; timing and threads do not.
struct CaseIdentity {
  std::string id;        // includes the scene's contents
  std::string settings;  // excludes them: stable while a level changes
};

// The identities of the cases of a configuration, which must outlive it. What cases share becomes text once.
class CaseIdentities {
 public:
  explicit CaseIdentities(const config::Config& config);
  CaseIdentity of(const SceneData& data, const CasePlan& plan);

 private:
  struct SceneTexts {
    std::string with_contents, without;
  };

  const SceneTexts& scene(const SceneData& data, std::size_t index);
  const std::string& grid(std::size_t index);
  const std::string& assigner(std::size_t index);
  const std::string& storage(std::optional<std::size_t> index);

  const config::Config& config_;
  std::map<std::string, std::string> common_;  // JSON texts of what all cases have, by key
  std::map<std::size_t, SceneTexts> scenes_;   // this and the following: by index, made when they are needed
  std::map<std::size_t, std::string> grids_, assigners_;
  std::map<std::optional<std::size_t>, std::string> storages_;
};

}  // namespace clusterbench::run
