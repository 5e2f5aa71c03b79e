#pragma once
// `size --worst-case`: worse frames of the structures that are printed.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/search_options.h"
#include "cli/sizing/size_counting.h"
#include "report/sizing/size.h"

namespace clusterbench::cli {

// What will be searched and about how long that takes, for tell_of_size(): by some frames of the cases, of which it is
// not yet known which will be printed. "" where nothing can be.
std::string told_of_search(const SizePlan& plan, const report::SizeRequest& request, const SearchFlags& flags);

// Searches each case for the frames that need most of its buffers, or of an engine's settings; one that cannot be
// searched has the reason. --seconds is shared by all. Nothing once it is to stop.
std::optional<std::vector<report::FoundFrame>> search_sized(const SizeCounts& counts,
                                                            const std::vector<report::SizedCase>& cases,
                                                            const SearchFlags& flags, bool quiet);

// What samples of cameras lack that have no grid of their own, where --grid-of names one that serves them. Nothing once
// it is to stop.
std::optional<std::vector<report::GuestSamples>> samples_of_guests(const SizeCounts& counts,
                                                                   const std::vector<report::SizedCase>& cases,
                                                                   bool quiet);

}  // namespace clusterbench::cli
