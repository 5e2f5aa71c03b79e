#pragma once
// The report of `clusterbench size`: what to allocate (report/sizing/allocation.h), as a table, as code or as JSON.

#include <optional>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/result.h"

namespace clusterbench::report {

struct SizeRequest {
  std::string filter;  // a regular expression as RE2 has them, "" = all: only cases whose name matches
  // Every structure, and names in full. Without: of each scene and grid one structure that loses no light, and names
  // that stay if that becomes another method's. It is the fastest, or of those that the interval of their ratio does
  // not call slower the smallest, so that noise seldom decides; the smallest where nothing was timed.
  bool all = false;
  std::string format = "table";   // one of size_formats()
  std::string rounding = "page";  // one of size_roundings()
  // Without: as the result's configuration has them.
  std::optional<double> margin = {}, warn_at = {};
  // What names in code begin with in place of scene and grid; only for one structure. "": those.
  std::string name = {};
  AllocationScope scope = {};
  // Of engines_with_settings(): settings are printed, of the cases of the preset of that name. "": buffers.
  std::string engine = {};
  bool has_changed_grid = false;  // with it: another grid than the engine's own, one that it can be set to
};

// A table, C++, the languages of shaders, and for other programs JSON.
std::vector<std::string> size_formats();
// Of an allocation's bytes: whole pages, a power of two, none.
std::vector<std::string> size_roundings();

// What a search has to make large, by its name in `worst-case --measure`: what makes the buffers of a structure large,
// which is the longest list where every cell has room for it and all entries else; or of an engine what its settings
// have to have room for.
std::vector<std::string> sized_measures(const std::string& storage, const std::string& engine);

// Of each structure that is printed, a case of each camera, of several viewports the one that needs most: where
// searches for worse frames are to begin.
struct SizedCase {
  std::string structure, name;
  std::vector<std::string> measures;  // for which it is to be searched
  std::string grid_case;              // where one camera's grid serves others: the case of that camera
  std::vector<std::string> guests;    // those others
};
std::vector<SizedCase> sized_cases(const result::Result& result, const SizeRequest& request);

// Of the structures that are printed those whose sizes are of nothing, since no frame had a light in view or in a list
// and no search found any: name and reason.
std::vector<std::string> sized_from_nothing(const result::Result& result, const SizeRequest& request);

// Throws Error if the filter is no regex or matches no case, and for a name that no language takes, that a table would
// not show, or that more than one structure would have.
std::string size_report(const result::Result& result, const SizeRequest& request);

}  // namespace clusterbench::report
