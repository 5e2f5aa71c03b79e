#include "os/surroundings.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "core/text.h"
#include "os/environment.h"

namespace clusterbench::os {
namespace {

std::vector<std::string> sorted_variables() {
  std::vector<std::string> all = environment_variables();
  std::ranges::sort(all);
  return all;
}

// "HOME, LANG, PATH and 9 more": of those that are not the same in both.
std::string different_names(const std::vector<std::string>& before, const std::vector<std::string>& now) {
  constexpr std::size_t k_most = 3;
  std::vector<std::string> different;
  std::ranges::set_symmetric_difference(before, now, std::back_inserter(different));
  std::set<std::string> names;
  for (const std::string& one : different) names.insert(one.substr(0, one.find('=')));
  const std::vector<std::string> first(names.begin(), std::next(names.begin(), std::min(k_most, names.size())));
  return joined(first) + (names.size() > k_most ? " and " + std::to_string(names.size() - k_most) + " more" : "");
}

}  // namespace

Surroundings::Surroundings() : before_(parts()), variables_(sorted_variables()) {}

std::vector<std::string> Surroundings::changes() const {
  std::vector<std::string> all;
  const std::vector<Part> now = parts();
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i].value != before_[i].value) all.push_back(now[i].name + (now[i].is_shown ? ", to " + now[i].value : ""));
  if (const std::vector<std::string> variables = sorted_variables(); variables != variables_)
    all.push_back("the environment (" + different_names(variables_, variables) + ")");
  return all;
}

}  // namespace clusterbench::os
