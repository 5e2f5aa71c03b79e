#include "report/comparing/matched_cases.h"

#include <algorithm>
#include <map>

#include "report/comparing/case_settings.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::PartOfOne;
using result::RenamedCase;
using result::Result;

// A part that cases may not have.
struct Part {
  const char* name;
  bool (*is_in)(const Case& result_case);
};
template <auto Member>
bool has(const Case& result_case) {
  return (result_case.*Member).has_value();
}
constexpr Part k_parts[] = {
    {"occupancy", has<&Case::occupancy>}, {"error", has<&Case::error>},       {"shading", has<&Case::shading>},
    {"samples", has<&Case::samples>},     {"lookup", has<&Case::lookup>},     {"stability", has<&Case::stability>},
    {"precision", has<&Case::precision>}, {"pre_cull", has<&Case::pre_cull>}, {"fit", has<&Case::fit>},
    {"react", has<&Case::react>},         {"fallback", has<&Case::fallback>}, {"shadows", has<&Case::shadows>},
    {"timing", has<&Case::timing>},       {"count", has<&Case::count>},
};

}  // namespace

std::vector<Match> matches_of(const Result& base, const Result& next) {
  std::map<std::string, const Case*> by_id;
  for (const Case& result_case : base.cases) by_id[result_case.id] = &result_case;
  std::vector<Match> matches;
  for (const Case& result_case : next.cases)
    if (const auto found = by_id.find(result_case.id); found != by_id.end())
      matches.push_back({*found->second, result_case});
  return matches;
}

std::vector<const Case*> missing_from(const Result& other, const Result& result) {
  std::vector<const Case*> missing;
  for (const Case& result_case : result.cases)
    if (std::ranges::find(other.cases, result_case.id, &Case::id) == other.cases.end()) missing.push_back(&result_case);
  return missing;
}

std::vector<RenamedCase> renamed_cases(const Result& base, const std::vector<const Case*>& only_in_base,
                                       const Result& next, const std::vector<const Case*>& only_in_new) {
  std::vector<RenamedCase> out;
  for (const Case* base_case : only_in_base)
    for (const Case* next_case : only_in_new)
      if (base_case->name == next_case->name)
        out.push_back({base_case->name, differing_settings(base, *base_case, next, *next_case)});
  return out;
}

std::vector<PartOfOne> parts_of_one(const std::vector<Match>& matches) {
  std::vector<PartOfOne> out;
  for (const Part& part : k_parts) {
    std::size_t base = 0, next = 0;
    for (const Match& match : matches) {
      base += part.is_in(match.base) && !part.is_in(match.next) ? 1 : 0;
      next += part.is_in(match.next) && !part.is_in(match.base) ? 1 : 0;
    }
    if (base > 0) out.push_back({part.name, "base", base});
    if (next > 0) out.push_back({part.name, "new", next});
  }
  return out;
}

}  // namespace clusterbench::report
