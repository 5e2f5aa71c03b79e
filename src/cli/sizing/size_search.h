#pragma once
// `size --worst-case`: searches for worse frames of the printed structures.

#include <optional>
#include <string>
#include <vector>

#include "cli/options/search_options.h"
#include "cli/sizing/size_counting.h"
#include "report/size_report/size_report.h"

namespace clusterbench::cli {

// Text for print_planned_counting(): the planned searches and their estimated duration, from some frames of all cases,
// since the printed ones are not known yet. "" if nothing can be searched.
std::string planned_search_text(const SizePlan& plan, const report::SizeRequest& request, const SearchFlags& flags);

// Searches each case for the frames that need most of its buffers, or of an engine's settings; a case that cannot be
// searched gets the reason. All searches share --seconds. nullopt if stopped.
std::optional<std::vector<report::FoundFrame>> search_sized(const SizeCounts& counts,
                                                            const std::vector<report::SizedCase>& cases,
                                                            const SearchFlags& flags, bool quiet);

// Lights missed at samples of cameras without a grid of their own, if --grid-of names the camera whose grid they use.
// nullopt if stopped.
std::optional<std::vector<report::GuestSamples>> samples_of_guests(const SizeCounts& counts,
                                                                   const std::vector<report::SizedCase>& cases,
                                                                   bool quiet);

}  // namespace clusterbench::cli
