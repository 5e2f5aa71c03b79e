#pragma once
// The findings of `worst-case`, as a document and as text.

#include <string>

#include "result/documents/worst_case.h"
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

result::WorstCase worst_case_document(const search::WorstCase& found, const WorstCaseFacts& facts);
std::string worst_case_text(const search::WorstCase& found, const WorstCaseFacts& facts);

}  // namespace clusterbench::report
