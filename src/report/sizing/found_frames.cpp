#include "report/sizing/found_frames.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/cases/columns.h"
#include "report/cases/json_values.h"
#include "report/documents/result_file.h"
#include "result/documents/worst_case.h"
#include "result/figures/case_figure.h"
#include "run/cases/case_names.h"
#include "scene/camera_path.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::SearchedCase;

result::WorstCase read_worst_case(const std::string& path) {
  const std::string text = file_text(path);
  refuse_history(path, text);
  const Json json = read_json<Json>(text, path);
  const config::DocumentRow& row = config::row_of(config::Document::worst_case);
  if (config::document_of(json) != config::Document::worst_case)
    throw Error(path, "", "is not what `clusterbench worst-case -o FILE` writes");
  const std::vector<std::string> violations = config::schema_violations(row.schema(), nlohmann::json(json));
  if (!violations.empty())
    throw Error(path, "", "is not valid: " + violations.front() + "; `clusterbench validate` lists all");
  result::WorstCase found = result::from_json<result::WorstCase>(json);
  if (found.frames.empty()) throw Error(path, "", "holds no frame: the search was ended before it tried any");
  return found;
}

// Identifies the searched structure independent of the scene's name and the number of viewports: grid, method, storage,
// packing and cull of lights, as in a case's name.
std::string structure_of(run::CaseNames names) {
  names.name = run::current_name(names.name);
  return run::name_without_camera(names, false);
}

std::string structure_of_searched(const SearchedCase& searched) {
  run::CaseNames names;
  names.name = searched.name;
  names.scene = searched.scene;
  names.camera = searched.camera;
  names.viewport = viewport_text(searched.viewport);
  return structure_of(names);
}

std::string sha256_of_scene(const result::Result& result, const result::Case& result_case) {
  const auto scene = std::ranges::find(result.scenes, result_case.scene, &result::Scene::name);
  return scene == result.scenes.end() ? "" : scene->sha256;
}

// Each once: "[640,360] or [320,180]".
std::string viewports_text(const std::vector<const result::Case*>& cases) {
  std::vector<std::string> all;
  for (const result::Case* one : cases)
    if (const std::string viewport = Json(one->viewport).dump(); std::ranges::find(all, viewport) == all.end())
      all.push_back(viewport);
  return joined(all, " or ");
}

// The cases of its structure, camera and viewport on its scene. If the result has several scenes with these contents,
// those of the same name come first.
std::vector<const result::Case*> matches_of(const std::string& path, const SearchedCase& searched,
                                            const result::Result& result) {
  const std::string& sha256 = searched.sha256;
  const std::string structure = structure_of_searched(searched);
  std::vector<const result::Case*> alike, seen_alike, out;
  for (const result::Case& one : result.cases) {
    const bool is_its_scene = one.scene == searched.scene || sha256_of_scene(result, one) == sha256;
    if (is_its_scene && one.camera == searched.camera && structure_of(names_of_case(one)) == structure)
      alike.push_back(&one);
  }
  if (alike.empty())
    throw Error(path, "/case/name",
                "is '" + searched.name + "', and no case here has its scene, camera, grid, method and storage" +
                    (result.cases.empty() ? "" : "; one of them is '" + result.cases[0].name + "'"));
  for (const result::Case* one : alike)
    if (one->viewport == searched.viewport) seen_alike.push_back(one);
  if (seen_alike.empty())
    throw Error(path, "/case/viewport",
                "is " + Json(searched.viewport).dump() + ", and here it is " + viewports_text(alike) +
                    "; search with the same --viewport");
  for (const result::Case* one : seen_alike)
    if (sha256_of_scene(result, *one) == sha256) out.push_back(one);
  if (out.empty()) throw Error(path, "/case/sha256", "is of another version of the scene; search again");
  std::stable_partition(out.begin(), out.end(), [&](const result::Case* one) { return one->scene == searched.scene; });
  return out;
}

// A key of the configuration's request for the scene; none if scenes differ in it and the result does not record whose
// it is.
std::optional<Json> asked_of_scene(const result::Result& result, std::size_t scene, const char* key) {
  const Json* in_config = value_at(result.config, "/scenes");
  const Json scenes = in_config == nullptr ? Json::array() : *in_config;
  if (scenes.size() == result.scenes.size()) return scenes[scene].value(key, Json());
  std::optional<Json> asked;
  for (const Json& request : scenes) {
    const Json next = request.value(key, Json());
    if (asked && *asked != next) return {};
    asked = next;
  }
  return asked;
}

bool is_near(double a, double b, double size) {
  constexpr double k_single = 0x1p-20;  // a result's grid is in single precision
  return std::abs(a - b) <= k_single * size;
}

bool is_same_angle(const Json& a, const Json& b) {
  if (!a.is_string() || !b.is_string()) return a == b;
  const auto left = scene::field_of_view(a.get<std::string>()), right = scene::field_of_view(b.get<std::string>());
  return left && right && left->is_horizontal == right->is_horizontal &&
         std::abs(left->angle_rad - right->angle_rad) < 1e-9;
}

// Slices whose cells have a fixed shape end with the one that contains the requested end.
bool ends_at(const result::Slices& slices, double end_m) {
  const std::size_t count = slices.boundaries.size();
  if (count < 2) return false;
  const double last_m = slices.boundaries.back();
  return is_near(end_m, last_m, last_m) ||
         (slices.scheme.starts_with("cubical") && end_m > slices.boundaries[count - 2] && end_m < last_m);
}

// "" if the grid ends at the same place as that of the search, or follows frames.
std::string other_end(const result::SearchedGridEnd& searched, const result::Grid& grid) {
  if (const std::optional<double>& end_m = searched.slices_m;
      end_m && grid.slices && !grid.slices->boundaries.empty()) {
    const double here_m = grid.slices->boundaries.back();
    return ends_at(*grid.slices, *end_m)
               ? ""
               : text("is %.6g m", *end_m) + text(", and the grid here ends at %.6g m", here_m);
  }
  if (!searched.bounds_m || !grid.bounds || !grid.origin) return "";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = (*grid.origin)[axis], lo = searched.bounds_m->min[axis], hi = searched.bounds_m->max[axis];
    if (!is_near(lo, origin + grid.bounds->min[axis], hi - lo) ||
        !is_near(hi, origin + grid.bounds->max[axis], hi - lo))
      return "is another box than that of the grid here";
  }
  return "";
}

void check_settings(const std::string& path, const result::SearchedSettings& searched, const result::Result& result,
                    std::size_t scene, const result::Case& match) {
  const Json settings = result::to_json(searched);
  const auto differs = [&](const std::string& key, const Json& here) {
    throw Error(path, "/case/settings/" + key,
                "is " + settings.value(key, Json()).dump() + ", and here it is " + here.dump() +
                    "; search with the same settings");
  };
  if (const auto fov = asked_of_scene(result, scene, "fov"); fov && !is_same_angle(settings["fov"], *fov))
    differs("fov", *fov);
  const std::pair<const char*, Json> plain[] = {{"camera_fit", "contain"}, {"boxes", false}, {"far", nullptr}};
  for (const auto& [key, default_value] : plain)
    if (auto asked = asked_of_scene(result, scene, key)) {
      const Json here = asked->is_null() ? default_value : *asked;
      if (settings.value(key, default_value) != here) differs(key, here);
    }
  const Json rule = result::to_json(result.scenes[scene].range_rule);
  for (const char* key : {"cutoff_lux", "max_range"})
    if (settings["range_rule"][key] != rule[key])
      differs("range_rule", {{"cutoff_lux", rule["cutoff_lux"]}, {"max_range", rule["max_range"]}});
  const std::string other = searched.grid_end ? other_end(*searched.grid_end, match.grid) : "";
  if (!other.empty())
    throw Error(path, "/case/settings/grid_end",
                other +
                    ": it follows from the lights of the recorded path; fix it for both, as with --set "
                    "'grids.*.slices.far=METRES' (of boxes, bounds), and search again");
}

void check_settings(const std::string& path, const SearchedCase& searched, const result::Result& result,
                    const result::Case& match) {
  if (!searched.settings) return;
  for (std::size_t i = 0; i < result.scenes.size(); ++i)
    if (result.scenes[i].name == match.scene) check_settings(path, *searched.settings, result, i, match);
}

// The searched case: of several similar ones the first with its settings.
const result::Case& searched_case(const std::string& path, const SearchedCase& searched, const result::Result& result) {
  const std::vector<const result::Case*> matches = matches_of(path, searched, result);
  for (const result::Case* match : matches) {
    try {
      check_settings(path, searched, result, *match);
      return *match;
    } catch (const Error&) {
      if (match == matches.back()) throw;
    }
  }
  return *matches.front();
}

constexpr const char* k_not_compared =
    "an earlier version wrote it, without the field of view, the range rule and the end of the grid: whether they "
    "are those of the case here is not known; search again";

// The recorded worst frame of the figure is not the finding's frame.
template <class Figure>
void raise_figure(Figure& figure, std::uint64_t found, std::uint64_t& worst_frame) {
  if (!(static_cast<double>(found) > static_cast<double>(figure))) return;
  figure = static_cast<Figure>(found);
  worst_frame = result::k_found_frame;
}

void raise_measure(result::Case& result_case, const std::string& measure, std::uint64_t found) {
  result::Buffers& buffers = result_case.buffers;
  if (measure == "entries") raise_figure(buffers.index_entries.high_water, found, buffers.worst_frame);
  if (std::optional<result::Occupancy>& lists = result_case.occupancy; lists && measure == "longest")
    raise_figure(lists->lights_per_cell.max, found, lists->worst_frame);
  if (std::optional<result::LightsInView>& lights = result_case.lights_in_view; lights && measure == "lights")
    raise_figure(lights->max, found, lights->worst_frame);
}

// Structures whose size depends on their contents; "fixed" and "linked" have a fixed size.
bool has_bytes_of_needs(const result::Buffers& buffers) {
  double needs = 0.0;
  if (buffers.each)
    for (const result::Buffer& buffer : *buffers.each)
      needs += static_cast<double>(buffer.high_water) * static_cast<double>(buffer.element_bytes);
  return static_cast<double>(buffers.bytes.high_water) == needs;
}

void raise_to_find(result::Case& result_case, const FoundFrame& found) {
  raise_measure(result_case, found.measure, found.value);
  if (!has_bytes_of_needs(result_case.buffers)) return;
  std::uint64_t bytes = 0;
  for (const FoundFrame::Need& need : found.needs) bytes += need.elements * need.element_bytes;
  raise_figure(result_case.buffers.bytes.high_water, bytes, result_case.buffers.worst_frame);
}

}  // namespace

FoundFrame read_found(const std::string& path, const result::Result& result) {
  const result::WorstCase read = read_worst_case(path);
  const result::WorstFrame& worst = read.frames.front();
  FoundFrame out;
  out.case_name = searched_case(path, read.searched, result).name;
  if (!read.searched.settings) out.not_compared = k_not_compared;
  out.measure = read.measure.name;
  out.value = static_cast<std::uint64_t>(std::max(0.0, worst.value.get<double>()));
  out.evaluations = static_cast<int>(read.evaluations + (read.random ? read.random->frames : 0));
  out.seed = read.seed;
  out.space_flags = read.space.flags.value_or("");
  out.eye_m.assign(worst.eye_m.begin(), worst.eye_m.end());
  out.direction.assign(worst.direction.begin(), worst.direction.end());
  out.lights = read.space.lights + read.space.added_ranges_m.size();
  if (read.lights_in_view) {
    out.lights_in_view = read.lights_in_view->all;
    out.dark_in_view = read.lights_in_view->dark;
  }
  if (!read.buffers)
    throw Error(path, "/buffers", "is missing: an earlier version wrote the file, without what each buffer needs");
  for (std::size_t i = 0; i < read.buffers->size(); ++i) {
    const result::NeededBuffer& need = (*read.buffers)[i];
    if (!need.element_bytes)
      throw Error(path, "/buffers/" + std::to_string(i) + "/element_bytes",
                  "is missing: an earlier version wrote the file, and nothing says how wide the indices of its lights "
                  "are; search again");
    out.needs.push_back({need.name, need.elements, need.theoretical_max, *need.element_bytes});
  }
  return out;
}

result::Result with_finds(result::Result result, const std::vector<FoundFrame>& found) {
  for (result::Case& result_case : result.cases)
    for (const FoundFrame& frame : found)
      if (frame.refusal.empty() && frame.case_name == result_case.name) raise_to_find(result_case, frame);
  return result;
}

result::SizeSearch size_search(const FoundFrame& found) {
  result::SizeSearch out{.searched = found.case_name, .measure = found.measure};
  if (!found.refusal.empty()) {
    out.refusal = found.refusal;
  } else {
    out.evaluations = static_cast<std::uint64_t>(found.evaluations);
    out.seed = found.seed;
    out.flags = found.space_flags;
    out.eye_m = found.eye_m;
  }
  if (!found.direction.empty()) out.direction = found.direction;
  return out;
}

}  // namespace clusterbench::report
