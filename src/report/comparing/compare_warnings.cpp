#include "report/comparing/compare_warnings.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/comparing/comparability.h"

namespace clusterbench::report {
namespace {

using result::Comparison;
using result::Json;
using result::PartOfOne;
using result::RenamedCase;
using result::Result;

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t k_most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(k_most, names.size()); ++i) text += (i == 0 ? "" : ", ") + shown(names[i]);
  return names.size() > k_most ? text + " and " + std::to_string(names.size() - k_most) + " more" : text;
}

constexpr const char* k_separate_hints =
    "two runs of one program can differ several-fold; hints only, which fail nothing: to gate on times of the "
    "processor use `run --baseline-binary`, on a noisy machine `run --count`";
constexpr const char* k_separate_verdicts =
    "--gate-separate: two runs of one program can differ several-fold, and intervals know nothing of that; on a busy "
    "machine every second comparison of a program with itself failed";

// The names that only one side has, without cases of the same name on both sides, which are reported separately with
// the difference.
std::vector<std::string> without_renamed(std::vector<std::string> names, const std::vector<RenamedCase>& renamed) {
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::find(renamed, name, &RenamedCase::name) != renamed.end();
  });
  return names;
}

// Of these names those of cases on a device, and the others.
std::pair<std::vector<std::string>, std::vector<std::string>> on_device_and_others(
    const Result& result, const std::vector<std::string>& names) {
  std::set<std::string> device_names;
  for (const result::Case& one : result.cases)
    if (runs_on_device(one)) device_names.insert(one.name);
  std::vector<std::string> on_device, others;
  for (const std::string& name : names) (device_names.contains(name) ? on_device : others).push_back(name);
  return {on_device, others};
}

// With the caches of its times.
std::string device_name(const result::Case& one) {
  return shown(one.device->device) + (one.device->caches ? " with " + *one.device->caches + " caches" : "");
}

std::string joined_names(const std::set<std::string>& names) {
  return joined(std::vector<std::string>(names.begin(), names.end()));
}

// Of cases that both have, with their caches: on which devices the base ran, and on which others the new result did.
std::pair<std::set<std::string>, std::set<std::string>> other_devices(const Result& base, const Result& next) {
  std::map<std::string, std::string> of_base;
  for (const result::Case& one : base.cases)
    if (one.device) of_base[one.id] = device_name(one);
  std::pair<std::set<std::string>, std::set<std::string>> out;
  for (const result::Case& one : next.cases) {
    const auto found = of_base.find(one.id);
    if (!one.device || found == of_base.end() || found->second == device_name(one)) continue;
    out.first.insert(found->second);
    out.second.insert(device_name(one));
  }
  return out;
}

}  // namespace

std::vector<std::string> warnings_of(const Result& base, const Result& next, const Comparison& comparison,
                                     bool is_beside, const std::vector<std::string>& forced, bool gates_separate) {
  std::vector<std::string> warnings;
  for (const std::string& obstacle : forced) warnings.push_back("compared all the same: " + obstacle);
  const auto& [instructions, times] = comparison.left_out;
  if (instructions) warnings.push_back("instructions are not compared: " + joined(*instructions, "; "));
  if (times) warnings.push_back("times are not compared: " + joined(*times, "; "));
  if (comparison.data == "separate" && comparison.summary.methods_timed != 0)
    warnings.emplace_back(gates_separate ? k_separate_verdicts : k_separate_hints);
  if (!comparison.cases.empty()) {
    const std::vector<std::string> margin = differing_margin(base, next), prices = differing_prices(base, next);
    if (!margin.empty())
      warnings.push_back(joined(margin) + ", another setting: what is recommended follows it and is not compared");
    if (!prices.empty())
      warnings.push_back(joined(prices) + ", another setting: modelled costs follow it and are not compared");
  }
  if (const auto [before, now] = other_devices(base, next); !before.empty())
    warnings.push_back("times of methods on a device are not compared: the base ran on " + joined_names(before) +
                       ", the new result on " + joined_names(now));
  const std::vector<std::string> only_in_base = without_renamed(comparison.only_in_base, comparison.renamed),
                                 new_names = without_renamed(comparison.only_in_new, comparison.renamed);
  const auto [on_device, only_in_new] =
      is_beside ? on_device_and_others(next, new_names) : std::pair(std::vector<std::string>(), new_names);
  if (!on_device.empty())
    warnings.push_back("methods on a device are not measured side by side, not compared: " + listed(on_device));
  if (!only_in_base.empty()) warnings.push_back("only in the base, not compared: " + listed(only_in_base));
  if (!only_in_new.empty())
    warnings.push_back(std::string(is_beside ? "the other program does not have them, not compared: "
                                             : "only in the new result, not compared: ") +
                       listed(only_in_new));
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const RenamedCase& renamed_case : comparison.renamed)
    by_reason[joined(renamed_case.differs_in)].push_back(renamed_case.name);
  for (const auto& [reason, names] : by_reason)
    warnings.push_back("of one name, but not the same, so not compared: they differ in " + reason + ": " +
                       listed(names));
  for (const PartOfOne& part : comparison.not_compared)
    warnings.push_back(part.part + " is not compared in " + number_of(part.cases, "case") + ": only the " +
                       (part.only_in == "base" ? "base" : "new result") + " has it");
  if (is_beside)
    warnings.emplace_back(
        "times and lists of both programs were compared; bytes, samples and whatever else is counted were not: that "
        "takes a result of the other program");
  return warnings;
}

}  // namespace clusterbench::report
