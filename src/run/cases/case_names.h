#pragma once
// The names that commands print for a case. Each of them, copied whole, selects it in --filter and before a budget's
// colon.

#include <string>
#include <vector>

#include "core/pattern.h"

namespace clusterbench::run {

struct CaseNames {
  std::string name;  // "street/walk/1920x1080 frustum 64px/exact-fast/packed"
  std::string id;    // its hash
  std::string scene, camera;
  std::string viewport;  // "1920x1080", which names have where there are several
  std::string grid;
  std::string method;  // as tables have it: with the preset, how lights are packed and what culls them
  std::string storage;
};

// A name of an earlier version as it is now: "street/walk/frustum/bvh/own" had a structure that is no lists,
// "street/walk/frustum/aabb(spot=ball)/packed" a choice of another name.
std::string current_name(std::string name);

// The same of a method alone, "aabb(spot=ball)".
std::string current_method(std::string label);

// What follows scene and camera: "1920x1080 frustum 64px/exact-fast/packed"; without the viewport where it is not
// wanted. Names that are not made like that are taken as they are.
std::string name_without_camera(const CaseNames& names, bool with_viewport);

// By a part of the case's name (also as earlier versions had it), as a regular expression of it, or by the whole of any
// other name that is printed: of the structure that all cameras share (`size`), of a row or a block of a table, the id.
bool is_selected(const Pattern& pattern, const CaseNames& names);

}  // namespace clusterbench::run
