#pragma once
// What a run hands to further processes of this program: configuration and scenes as it has read them, so that all of
// them measure the same, whatever happens to the files meanwhile, and where the configuration came through a pipe.

#include <optional>
#include <string>

#include "run/cases/sweep.h"

namespace clusterbench::cli {

// A line of JSON. With `scene`, an index in the configuration's list, it is of that one alone. The name of the
// configuration's file goes as an argument beside it, since a name need not be UTF-8.
std::string file_argument(const config::Config& config);
std::string handed_over(const config::Config& config, const run::Plan& plan, std::optional<std::size_t> scene = {});

struct ReceivedRun {
  config::Config config;
  run::Plan plan;
};
// The other side: makes the plan again. Throws Error that names the scene where one is not what it was.
ReceivedRun received_run(const std::string& line, const std::string& file);

}  // namespace clusterbench::cli
