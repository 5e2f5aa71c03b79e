#pragma once
// What `worst-case` found, as JSON and as text.

#include <nlohmann/json.hpp>
#include <string>

#include "search/worst_case.h"

namespace clusterbench::report {

// The searched case, and the written files.
struct WorstCaseFacts {
  const config::Config& config;
  const run::Plan& plan;
  const run::CasePlan& case_plan;
  const search::WorstCaseRequest& request;
  std::string scene_file, config_file;  // "": not written
};

nlohmann::ordered_json worst_case_to_json(const search::WorstCase& found, const WorstCaseFacts& facts);
std::string worst_case_text(const search::WorstCase& found, const WorstCaseFacts& facts);

}  // namespace clusterbench::report
