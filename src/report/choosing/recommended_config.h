#pragma once
// The choice of `recommend` as a configuration.

#include <nlohmann/json.hpp>
#include <string>

#include "config/config.h"
#include "report/choosing/question.h"
#include "result/documents/recommendation.h"

namespace clusterbench::report {

// What `run` measures the choice with, and the first `runners_up` behind it: they are of one product of grids,
// assigners and storages, and so more cases may come with them. `file`: where it will lie. Throws Error if there is no
// choice.
nlohmann::ordered_json recommended_config(const config::Config& config, const search::View& view,
                                          const result::Answer& answer, const Question& question, int runners_up,
                                          const std::string& file);

}  // namespace clusterbench::report
