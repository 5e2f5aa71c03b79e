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

// How long it searches, and its seed.
// `only_with`: a flag that they are refused without.
void add_effort_options(Command& command, SearchFlags& flags, const Option* only_with = nullptr);
// What it may choose: where the camera stands, and lights that are added or moved.
void add_space_options(Command& command, SearchFlags& flags, const Option* only_with = nullptr);

// Throws Error that names the flag.
search::WorstCaseRequest search_request(const SearchFlags& flags, const config::Config& config);

// Tells how far a search is, or one of several, number `search` of them from 0. `progress` outlives it.
search::WorstCaseListener search_listener(ProgressLine& progress, std::size_t search = 0, std::size_t searches = 1);

}  // namespace clusterbench::cli
