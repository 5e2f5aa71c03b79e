#pragma once
// The names that commands print for a case. Each of them, copied as a whole, selects the case in --filter and before a
// budget's colon.

#include <string>
#include <vector>

#include "core/pattern.h"

namespace clusterbench::run {

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
