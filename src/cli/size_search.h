#pragma once
// `size --worst-case`: worse frames of the structures that are printed.

#include <optional>
#include <string>
#include <vector>

#include "cli/search_options.h"
#include "cli/size_counting.h"
#include "report/size.h"

namespace clusterbench::cli {

// Searches each case for the frame that needs most of its buffers; one that cannot be searched has the reason. Nothing
// once it is to stop.
std::optional<std::vector<report::FoundFrame>> search_sized(const SizeCounts& counts,
                                                            const std::vector<report::SizedCase>& cases,
                                                            const SearchFlags& flags, bool quiet);

// What samples of cameras lack that have no grid of their own, where --grid-of names one that serves them. Nothing once
// it is to stop.
std::optional<std::vector<report::GuestSamples>> samples_of_guests(const SizeCounts& counts,
                                                                   const std::vector<report::SizedCase>& cases,
                                                                   bool quiet);

}  // namespace clusterbench::cli
