#pragma once
// Names of cases: their parts, the current form of names of earlier versions, and the selection of a case by a text.
// Each name that commands print for a case, copied as a whole, selects the case in --filter and before a budget's
// colon.

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/pattern.h"

namespace clusterbench::run {

// The name in place of a storage's if an assigner has a structure of its own.
inline constexpr const char* k_own_structure = "own";
// Its forms in names of cases.
inline constexpr const char *k_no_lists = "no lists", *k_own_lists = "own lists";
// Display name of an assigner's own structure: "own lists" (of tiles, for example) or "no lists".
const char* own_structure_name(const std::string& assigner);

// A part of a case's name, without the slashes that separate parts and without control characters of a terminal.
std::string name_part(std::string text);
// Names that are different: a name in use gets the smallest unused suffix "-2", "-3" ...
class UniqueNames {
 public:
  std::string add(const std::string& name);

 private:
  std::set<std::string> used_;
  std::map<std::string, std::uint64_t> next_;  // the first suffix that may be unused, of names that were in use
};

// The message that a filter selects none of `cases` cases; `example`: one of their names, "" if there are none.
std::string no_match_text(const std::string& filter, std::size_t cases, const std::string& example);

struct CaseNames {
  std::string name;  // "street/walk/1920x1080 frustum 64px/exact-fast/packed"
  std::string id;    // its hash
  std::string scene, camera;
  std::string viewport;  // "1920x1080"; part of the names if there are several viewports
  std::string grid;
  std::string method;  // as in tables: with the preset, the packing of the lights and the pre-cull
  std::string storage;
};

// Converts a name of an earlier version to the current one: "street/walk/frustum/bvh/own" had a structure without
// lists, "street/walk/frustum/aabb(spot=ball)/packed" an option that was renamed.
std::string current_name(std::string name);

// The same for a method alone, "aabb(spot=ball)".
std::string current_method(std::string label);

// The part after scene and camera: "1920x1080 frustum 64px/exact-fast/packed", without the viewport if `with_viewport`
// is false. Names of any other form are returned unchanged.
std::string name_without_camera(const CaseNames& names, bool with_viewport);

// True if the pattern matches a part of the case's name (also in the form of earlier versions), as a regular
// expression, or the whole of any other printed name: the structure that all cameras share (`size`), a row or block of
// a table, the id.
bool is_selected(const Pattern& pattern, const CaseNames& names);

}  // namespace clusterbench::run
