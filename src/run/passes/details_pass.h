#pragma once
// Chosen frames once more, cell by cell, for readers who want details.

#include <optional>

#include "core/stop.h"
#include "run/findings/packed_details.h"
#include "run/passes/accuracy_pass.h"

namespace clusterbench::run {

// One per case of the group, none for methods without cells; empty if stopped before the end. Config::details is set.
// `counted` has each method's worst frame and the case's grid.
std::vector<std::optional<Details>> details_pass(const config::Config& config, const GroupPlan& group,
                                                 const PathFrames& path, const scene::Scene& scene,
                                                 const AccuracyResult& counted, const Stop& stop);

}  // namespace clusterbench::run
