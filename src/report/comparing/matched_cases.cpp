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

// How many matches have a part on one side only, by the part's name, in the order of a case's fields.
class PartsOfOne {
 public:
  void add(const Match& match) { add_fields(result::type_of<Case>(), &match.base, &match.next, ""); }

  std::vector<PartOfOne> found() const {
    std::vector<PartOfOne> out;
    for (const auto& [name, count] : counts_) {
      if (count.base > 0) out.push_back({name, "base", count.base});
      if (count.next > 0) out.push_back({name, "new", count.next});
    }
    return out;
  }

 private:
  struct Count {
    std::size_t base = 0, next = 0;
  };

  // Single values that a case may not have come with a part, or are those of other versions.
  static bool is_part(const result::Type& type) {
    using enum result::Kind;
    return type.kind == object || type.kind == list || type.kind == by_name;
  }

  Count& count_of(const std::string& name) {
    const auto found = std::ranges::find(counts_, name, &std::pair<std::string, Count>::first);
    return found != counts_.end() ? found->second : counts_.emplace_back(name, Count{}).second;
  }

  // Of the records below, only sets of samples are parts of their own: others, such as the deepest miss, are absent
  // where there is nothing to record.
  void add_fields(const result::Type& type, const void* base, const void* next, const std::string& prefix) {
    for (const result::Field& field : type.fields) {
      if (field.optional == nullptr || !is_part(*field.type)) continue;
      const void *in_base = field.in(base), *in_next = field.in(next);
      if ((in_base == nullptr) != (in_next == nullptr))
        ++(in_base == nullptr ? count_of(prefix + field.name).next : count_of(prefix + field.name).base);
      else if (in_base != nullptr && field.type == &result::type_of<result::SampleSets>())
        add_fields(*field.type, in_base, in_next, field.name + ".");
    }
  }

  std::vector<std::pair<std::string, Count>> counts_;
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
  PartsOfOne parts;
  for (const Match& match : matches) parts.add(match);
  return parts.found();
}

}  // namespace clusterbench::report
