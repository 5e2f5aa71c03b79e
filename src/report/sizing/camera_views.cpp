#include "report/sizing/camera_views.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "core/wildcards.h"

namespace clusterbench::report {
namespace {

std::vector<std::string> between_commas(const std::string& list) {
  std::vector<std::string> parts(1);
  for (const char c : list)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

bool is_named_by(const std::string& pattern, const std::string& camera) {
  return camera == pattern || matches_wildcards(pattern, camera);
}

// The cameras of a structure that a group names, in the order of the cases.
std::vector<std::string> cameras_in(const SizedStructure& structure, const std::string& group) {
  std::vector<std::string> out;
  const std::vector<std::string> patterns = between_commas(group);
  for (const result::Case* result_case : structure.cases) {
    const std::string& camera = result_case->camera;
    const bool is_named =
        std::ranges::any_of(patterns, [&](const std::string& pattern) { return is_named_by(pattern, camera); });
    if (is_named && std::ranges::find(out, camera) == out.end()) out.push_back(camera);
  }
  return out;
}

// All cameras except the owner use the owner's grid.
void share_grid(SizedStructure& structure, const std::vector<std::string>& cameras, const std::string& owner) {
  for (const std::string& camera : cameras)
    if (camera != owner) structure.guests.push_back(camera);
}

// The allocation is for one camera's grid: a camera that no group names is drawn separately, and is left out.
void leave_out_others(SizedStructure& structure, const std::vector<std::string>& groups) {
  std::set<std::string> named;
  for (const std::string& group : groups)
    for (const std::string& camera : cameras_in(structure, group)) named.insert(camera);
  for (const std::string& camera : cameras_in(structure, "*"))
    if (!named.contains(camera)) structure.left_out.push_back(camera);
  std::erase_if(structure.cases, [&](const result::Case* one) { return !named.contains(one->camera); });
}

// How to name a camera whose name contains a comma.
std::string comma_hint(const std::vector<std::string>& cameras) {
  for (const std::string& camera : cameras) {
    std::string pattern = camera;
    std::ranges::replace(pattern, ',', '?');
    if (pattern != camera)
      return "; a comma ends a name: write ? for that of '" + camera + "', as in '" + pattern + "'";
  }
  return "";
}

// A hint for a group that names two eyes that the scene does not have.
std::string eyes_hint(const std::string& group) {
  const std::vector<std::string> names = between_commas(group);
  const bool has_eye =
      std::ranges::find(names, "left") != names.end() || std::ranges::find(names, "right") != names.end();
  return has_eye ? "; `clusterbench scene views LEVEL --eyes 0.064 -o eyes.glb` adds left and right" : "";
}

// Each name between commas must be a camera's of some scene.
void check_view_names(const std::vector<SizedStructure>& structures, const std::string& group) {
  std::vector<std::string> known, unknown;
  for (const SizedStructure& structure : structures)
    for (const std::string& camera : cameras_in(structure, "*"))
      if (std::ranges::find(known, camera) == known.end()) known.push_back(camera);
  for (const std::string& pattern : between_commas(group))
    if (std::ranges::none_of(known, [&](const std::string& camera) { return is_named_by(pattern, camera); }))
      unknown.push_back("'" + pattern + "'");
  if (unknown.empty() || known.empty()) return;
  throw Error("", "--views",
              joined(unknown) + (unknown.size() == 1 ? " matches no camera" : " match no camera") + "; there are " +
                  joined(known) + "; takes names, as in left,right, and * for any letters" + comma_hint(known) +
                  eyes_hint(group));
}

}  // namespace

void set_views(std::vector<SizedStructure>& structures, const std::vector<std::string>& views,
               const std::string& grid_of) {
  if (!grid_of.empty() && views.empty())
    throw Error("", "--grid-of", "needs --views, which says whose samples are looked up in that camera's grid");
  bool is_owner_known = grid_of.empty();
  for (const std::string& group : views) {
    check_view_names(structures, group);
    bool is_known = false;
    for (SizedStructure& structure : structures) {
      const std::vector<std::string> cameras = cameras_in(structure, group);
      if (cameras.size() < 2) continue;
      is_known = true;
      if (std::ranges::find(cameras, grid_of) == cameras.end()) {
        structure.views.push_back(cameras);
        continue;
      }
      is_owner_known = true;
      share_grid(structure, cameras, grid_of);
    }
    if (is_known || structures.empty()) continue;
    std::vector<std::string> known;
    for (const result::Case* result_case : structures.front().cases) known.push_back(result_case->camera);
    throw Error("", "--views",
                "'" + group + "' names no two cameras of a scene; " + structures.front().name + " has " +
                    joined(known) + "; takes names, as in left,right, and * for any letters" + comma_hint(known));
  }
  if (!is_owner_known && !structures.empty())
    throw Error("", "--grid-of", "'" + grid_of + "' is none of the cameras of --views");
  for (SizedStructure& structure : structures)
    if (!structure.guests.empty()) leave_out_others(structure, views);
}

}  // namespace clusterbench::report
