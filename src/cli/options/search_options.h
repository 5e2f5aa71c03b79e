#pragma once
// The flags of a search for the worst frame, which `worst-case` and `size` share.

#include <string>
#include <vector>

#include "cli/command_line/command.h"
#include "cli/output/progress_line.h"
#include "config/config.h"
#include "search/worst_case.h"

namespace clusterbench::cli {

struct SearchFlags {
  search::WorstCaseRequest request;
  std::string within;              // "X0,Y0,Z0,X1,Y1,Z1"
  std::vector<std::string> added;  // "4x10"
};

// Flags for the effort of a search, and its seed. `only_with`: a flag without which they are rejected.
void add_effort_options(Command& command, SearchFlags& flags, const Option* only_with = nullptr);
// Flags for the search space: places of the camera, and lights that are added or moved.
void add_space_options(Command& command, SearchFlags& flags, const Option* only_with = nullptr);

// Throws Error that names the flag.
search::WorstCaseRequest search_request(const SearchFlags& flags, const config::Config& config);

// Shows the progress of a search, or of search number `search` (from 0) of several. `progress` must outlive it.
search::WorstCaseListener search_listener(ProgressLine& progress, std::size_t search = 0, std::size_t searches = 1);

}  // namespace clusterbench::cli
