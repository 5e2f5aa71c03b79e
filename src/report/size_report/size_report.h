#pragma once
// The report of `clusterbench size`: allocations (report/sizing/allocation.h) as a table, as code or as JSON.

#include <optional>
#include <string>
#include <vector>

#include "report/sizing/allocation.h"
#include "result/result.h"

namespace clusterbench::report {

struct SizeRequest {
  std::string filter;  // a regular expression (RE2), "" = all: only cases whose name matches
  // All structures with full names. If false: for each scene and grid one structure that loses no light, with a name
  // that does not depend on the method. It is the fastest, or the smallest of those that are not slower for certain by
  // the interval of their ratio, so that noise seldom decides; the smallest without times.
  bool all = false;
  std::string format = "table";   // one of size_formats()
  std::string rounding = "page";  // one of size_roundings()
  // Default: those of the result's configuration.
  std::optional<double> margin = {}, warn_at = {};
  // Prefix of names in code, instead of scene and grid; only for one structure. "": scene and grid.
  std::string name = {};
  AllocationScope scope = {};
  // One of engines_with_settings(): prints its settings, for the cases of the preset of that name. "": buffers.
  std::string engine = {};
  bool has_changed_grid = false;  // with `engine`: another grid than the engine's default, one that it can be set to
};

// A table, C++, shader languages, and JSON for other programs.
std::vector<std::string> size_formats();
// Of an allocation's bytes: whole pages, a power of two, none.
std::vector<std::string> size_roundings();

// The measures that a search should maximise, names of `worst-case --measure`: the one that determines the size of a
// structure's buffers (the longest list if every cell has room for it, else all entries); or for an engine those that
// its settings must have room for.
std::vector<std::string> sized_measures(const std::string& storage, const std::string& engine);

// For each printed structure and camera one case, the viewport with the largest need: the start of searches for worse
// frames.
struct SizedCase {
  std::string structure, name;
  std::vector<std::string> measures;  // that it should be searched for
  std::string grid_case;              // if one camera's grid serves others: the case of that camera
  std::vector<std::string> guests;    // the other cameras
};
std::vector<SizedCase> sized_cases(const result::Result& result, const SizeRequest& request);

// The printed structures without a basis for a size, since no frame had a light in view or in a list and no search
// found any: name and reason.
std::vector<std::string> sized_from_nothing(const result::Result& result, const SizeRequest& request);

// Times of several machines are never compared: without times and conclusions, if it has those of several, so that of
// each grid the smallest structure is shown.
result::Result without_times_of_machines(result::Result result);

// Throws Error if the filter is no regex or matches no case, and for a name that is not valid in any language, that a
// table would not show, or that several structures would have.
std::string size_report(const result::Result& result, const SizeRequest& request);

}  // namespace clusterbench::report
