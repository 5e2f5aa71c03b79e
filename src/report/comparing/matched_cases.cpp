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

// Parts are fields with fields or elements of their own; single values that a case may not have are of older versions.
bool is_part(const result::Field& field) {
  using enum result::Kind;
  return field.is_optional && (field.type->kind == object || field.type->kind == list || field.type->kind == by_name);
}

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
  for (const result::Field& field : result::type_of<Case>().fields) {
    if (!is_part(field)) continue;
    std::size_t base = 0, next = 0;
    for (const Match& match : matches) {
      const bool is_in_base = field.get(&match.base) != nullptr, is_in_next = field.get(&match.next) != nullptr;
      base += is_in_base && !is_in_next ? 1 : 0;
      next += is_in_next && !is_in_base ? 1 : 0;
    }
    if (base > 0) out.push_back({field.name, "base", base});
    if (next > 0) out.push_back({field.name, "new", next});
  }
  return out;
}

}  // namespace clusterbench::report
