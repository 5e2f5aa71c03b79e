#pragma once
// The input that a run sends to further processes of this program: configuration and scenes as the run has read them.
// So all processes measure the same, even if the files change meanwhile or the configuration came through a pipe.

#include <optional>
#include <string>

#include "run/cases/plan.h"

namespace clusterbench::cli {

// The handover is a line of JSON. With `scene`, an index in the configuration's list, it contains only that scene. The
// name of the configuration's file is passed as a separate argument, since a name need not be UTF-8.
std::string file_argument(const config::Config& config);
std::string handover_line(const config::Config& config, const run::Plan& plan, std::optional<std::size_t> scene = {});

struct ReceivedRun {
  config::Config config;
  run::Plan plan;
};
// The receiving side: makes the plan again. Throws Error that names a scene whose contents have changed.
ReceivedRun received_run(const std::string& line, const std::string& file);

}  // namespace clusterbench::cli
