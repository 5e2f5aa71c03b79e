#include "run/cases/case_names.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "assign/contract/assigner.h"
#include "core/text.h"

namespace clusterbench::run {
namespace {

// "a/own/half" with another word for "own". Only the parts after the fourth (the method) are searched, since scene,
// camera and grid can have any name. `other_of` gets the method.
template <class OtherOf>
std::string with_part(const std::string& name, const std::string& part, const OtherOf& other_of) {
  std::string method;
  std::size_t begin = 0;
  for (int before = 0; begin != std::string::npos; ++before) {
    const std::size_t end = name.find('/', begin);
    const std::string own = name.substr(begin, end == std::string::npos ? end : end - begin);
    if (before >= 4 && own == part)
      return name.substr(0, begin) + other_of(method) + (end == std::string::npos ? "" : name.substr(end));
    method = own.substr(0, own.find('('));
    begin = end == std::string::npos ? end : end + 1;
  }
  return name;
}

// Further names besides the case's name. Users see them after printable().
std::vector<std::string> other_names(const CaseNames& names) {
  std::vector<std::string> all{names.id, names.grid + ", camera " + names.camera + ", " + names.viewport};
  for (const bool with_viewport : {true, false}) {
    const std::string rest = name_without_camera(names, with_viewport);
    if (rest == names.name) continue;
    const std::string group = rest.substr(0, rest.find('/'));
    for (const std::string& part : {rest, group}) {
      all.push_back(part);
      all.push_back(names.scene + "/" + part);
      all.push_back(names.scene + "/" + names.camera + "/" + part);
    }
  }
  const std::string storage = names.storage == k_own_structure
                                  ? own_structure_name(names.method.substr(0, names.method.find_first_of(" (")))
                                  : names.storage;
  for (const std::string& method :
       {names.method, names.method + " / " + storage, names.method + " / " + names.storage}) {
    all.push_back(method);
    all.push_back(method + ", " + names.grid);
    all.push_back(names.grid + " / " + method);
  }
  return all;
}

// Renamed method options: old and new spelling within the method's part of a name.
constexpr std::pair<const char*, const char*> k_choices[] = {{"(spot=ball", "(spot=sphere"},
                                                             {"(flaw=flat-cap-ball", "(flaw=flat-cap-sphere"}};

// The method follows scene, camera and grid, which can have any name. Returns the end if there are fewer parts.
std::size_t begin_of_method(const std::string& name) {
  std::size_t method = 0;
  for (int before = 0; before < 3; ++before) {
    const std::size_t end = name.find('/', method);
    if (end == std::string::npos) return name.size();
    method = end + 1;
  }
  return method;
}

void replace_first(std::string& name, std::size_t begin, const std::string& text, const std::string& other) {
  if (const std::size_t at = name.find(text, begin); at != std::string::npos) name.replace(at, text.size(), other);
}

std::string with_former_choices(std::string name) {
  for (const auto& [former, current] : k_choices) replace_first(name, begin_of_method(name), current, former);
  return name;
}

// All former names: options and structures were renamed at different times.
std::vector<CaseNames> names_over_time(const CaseNames& names) {
  const auto own = [](const std::string&) { return std::string(k_own_structure); };
  const auto no_lists = [](const std::string&) { return std::string(k_no_lists); };
  CaseNames former = names;
  former.name = with_former_choices(names.name);
  for (const auto& [was, is] : k_choices) replace_first(former.method, 0, is, was);
  std::vector<CaseNames> all;
  for (const CaseNames& choice : {names, former})
    for (const std::string& name :
         // from before tiles' lists had a name of their own
         {choice.name, with_part(choice.name, k_own_lists, no_lists),
          with_part(with_part(choice.name, k_no_lists, own), k_own_lists, own)}) {
      all.push_back(choice);
      all.back().name = name;
    }
  return all;
}

}  // namespace

const char* own_structure_name(const std::string& assigner) {
  const assign::AssignerDescriptor* known = assign::find_assigner(assigner);
  return known != nullptr && known->own_lists ? k_own_lists : k_no_lists;
}

std::string name_part(std::string text) {
  for (char& c : text)
    if (c == '/' || std::iscntrl(static_cast<unsigned char>(c)) != 0) c = '_';
  return printable(text);
}

std::string UniqueNames::add(const std::string& name) {
  if (used_.insert(name).second) return name;
  std::uint64_t& number = next_.try_emplace(name, 2).first->second;
  for (;;)
    if (std::string candidate = name + "-" + std::to_string(number++); used_.insert(candidate).second) return candidate;
}

std::string no_match_text(const std::string& filter, std::size_t cases, const std::string& example) {
  return "'" + filter + "' matches none of " + number_of(cases, "case") + pattern_hint(filter) +
         (example.empty() ? "" : "; one of them is '" + example + "'");
}

std::string current_name(std::string name) {
  for (const auto& [former, current] : k_choices) replace_first(name, begin_of_method(name), former, current);
  const auto own = [](const std::string& method) { return std::string(own_structure_name(method)); };
  return with_part(with_part(name, k_own_structure, own), k_no_lists, own);
}

std::string current_method(std::string label) {
  for (const auto& [former, current] : k_choices) replace_first(label, 0, former, current);
  return label;
}

std::string name_without_camera(const CaseNames& names, bool with_viewport) {
  const std::string prefix = names.scene + "/" + names.camera + "/", viewport = names.viewport + " ";
  if (!names.name.starts_with(prefix)) return names.name;
  std::string rest = names.name.substr(prefix.size());
  if (!with_viewport && rest.starts_with(viewport)) rest.erase(0, viewport.size());
  return rest;
}

bool is_selected(const Pattern& pattern, const CaseNames& names) {
  const auto is_other = [&](const std::string& name) { return pattern.is(name) || pattern.is(printable(name)); };
  return pattern.is_literally_in(printable(names.name)) ||
         std::ranges::any_of(names_over_time(names), [&](const CaseNames& once) {
           return pattern.is_in(once.name) || std::ranges::any_of(other_names(once), is_other);
         });
}

}  // namespace clusterbench::run
