#include "report/sizing/allocation.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "assign/contract/assigner.h"
#include "config/config_scenes.h"
#include "core/error.h"
#include "core/pattern.h"
#include "core/text.h"
#include "report/cases/case_filter.h"
#include "report/cases/json_values.h"

namespace clusterbench::report {
namespace {

constexpr std::uint64_t k_largest_count = std::numeric_limits<std::uint64_t>::max();

// Saturates at 64 bits: a hand-edited result may contain any number.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > k_largest_count / b ? k_largest_count : a * b;
}
std::uint64_t as_count(double value) {
  constexpr double k_end = 18446744073709551616.0;  // 2^64
  return value >= k_end ? k_largest_count : static_cast<std::uint64_t>(value);
}
std::uint64_t up_to_multiple(std::uint64_t value, std::uint64_t step) {
  const std::uint64_t over = value % step;
  return over == 0 || value > k_largest_count - (step - over) ? value : value + (step - over);
}

std::uint64_t rounded_bytes(std::uint64_t bytes, Rounding rounding) {
  constexpr std::uint64_t k_page = 4096, k_largest_power = std::uint64_t{1} << 63;
  if (bytes == 0 || rounding == Rounding::none) return bytes;
  if (rounding == Rounding::page) return up_to_multiple(bytes, k_page);
  std::uint64_t power = 1;
  while (power < bytes && power < k_largest_power) power *= 2;
  return std::max(power, bytes);
}

void allocate(SizedBuffer& buffer, std::uint64_t step, const AllocationRules& rules) {
  const double wanted = std::ceil(static_cast<double>(buffer.mark()) * rules.margin);
  const std::uint64_t whole = up_to_multiple(std::max(buffer.mark(), as_count(wanted)), step);
  const std::uint64_t most = buffer.is_bounded ? std::max(buffer.theoretical_max, buffer.mark()) : k_largest_count;
  const std::uint64_t capacity = std::min(whole, most);
  buffer.bytes = rounded_bytes(times(capacity, buffer.element_bytes), rules.rounding);
  const std::uint64_t fitting = buffer.bytes / buffer.element_bytes / step * step;
  buffer.capacity = std::max(capacity, std::min(fitting, most));
  buffer.warn_above =
      buffer.is_all() ? buffer.capacity : as_count(std::floor(static_cast<double>(buffer.capacity) * rules.warn_at));
}

// A value, and the number of frames with it.
struct Weighed {
  std::uint64_t value, frames;
};

std::uint64_t at_rank(const std::vector<Weighed>& ascending, double share, double frames) {
  const double rank = std::ceil(share * frames);
  double counted = 0.0;
  for (const Weighed& weighed : ascending) {
    counted += static_cast<double>(weighed.frames);
    if (counted >= rank) return weighed.value;
  }
  return ascending.back().value;
}

std::optional<FrameSpread> spread_of(const std::vector<PathNeed>& paths) {
  std::vector<Weighed> all;
  double frames = 0.0;
  FrameSpread spread;
  for (const PathNeed& path : paths) {
    if (path.frames_per_entry != 1 && path.elements.size() > 1) spread.is_exact = false;
    for (const std::uint64_t value : path.elements) {
      all.push_back({value, path.frames_per_entry});
      frames += static_cast<double>(path.frames_per_entry);
    }
  }
  if (all.empty()) return {};
  std::ranges::sort(all, {}, &Weighed::value);
  spread.min = all.front().value;
  spread.max = all.back().value;
  spread.p50 = at_rank(all, 0.5, frames);
  spread.p90 = at_rank(all, 0.9, frames);
  spread.p99 = at_rank(all, 0.99, frames);
  return spread;
}

// Adds another camera's need to that of the earlier ones.
void add(SizedBuffer& buffer, std::uint64_t& step, const CaseBuffer& next) {
  if (buffer.paths.empty() || next.high_water > buffer.high_water) {
    buffer.high_water = next.high_water;
    buffer.worst_camera = next.path.camera;
    buffer.worst_frame = next.worst_frame;
    buffer.worst_cell = next.worst_cell;
    buffer.why_sum = next.why_sum;
    buffer.has_times = next.has_times;
    step = next.step;
  }
  buffer.apart = std::max(buffer.apart, next.apart);
  buffer.theoretical_max = std::max(buffer.theoretical_max, next.theoretical_max);
  buffer.element_bytes = std::max(buffer.element_bytes, next.element_bytes);
  buffer.paths.push_back(next.path);
}

// Cameras drawn in one frame, each with its cases in all viewports; a camera that shares no buffer is alone.
using FrameCameras = std::vector<std::vector<const result::Case*>>;

std::vector<FrameCameras> cameras_by_frame(const SizedStructure& structure) {
  std::vector<FrameCameras> out;
  const auto cases_of = [&](const std::string& camera) {
    std::vector<const result::Case*> cases;
    for (const result::Case* result_case : structure.cases)
      if (result_case->camera == camera) cases.push_back(result_case);
    return cases;
  };
  std::set<std::string> taken(structure.guests.begin(), structure.guests.end());
  for (const std::vector<std::string>& view : structure.views) {
    out.emplace_back();
    for (const std::string& camera : view) {
      out.back().push_back(cases_of(camera));
      taken.insert(camera);
    }
  }
  for (const result::Case* result_case : structure.cases)
    if (taken.insert(result_case->camera).second) out.push_back({cases_of(result_case->camera)});
  return out;
}

std::uint64_t frames_of_group(const FrameCameras& cameras) {
  std::uint64_t most = 0;
  for (const std::vector<const result::Case*>& of_camera : cameras) most = std::max(most, of_camera.front()->frames);
  return most;
}

FrameGroup group_of(const FrameCameras& cameras, const CaseBuffer& needs) {
  FrameGroup group;
  for (const std::vector<const result::Case*>& of_camera : cameras) group.cameras.push_back(of_camera.front()->camera);
  group.frames = frames_of_group(cameras);
  group.high_water = needs.high_water;
  group.spread = spread_of({needs.path});
  return group;
}

// The cameras together, viewport by viewport, and then the largest viewport.
std::vector<CaseBuffer> buffers_of_frame(const FrameCameras& cameras) {
  const std::size_t viewports = cameras.front().size();
  std::vector<std::vector<CaseBuffer>> by_buffer;
  for (std::size_t viewport = 0; viewport < viewports; ++viewport) {
    std::vector<std::vector<CaseBuffer>> of_cameras;
    for (const std::vector<const result::Case*>& cases : cameras)
      of_cameras.push_back(buffers_of(*cases[std::min(viewport, cases.size() - 1)]));
    by_buffer.resize(std::max(by_buffer.size(), of_cameras.front().size()));
    for (std::size_t i = 0; i < of_cameras.front().size(); ++i) {
      std::vector<CaseBuffer> same;
      for (const std::vector<CaseBuffer>& all : of_cameras)
        if (i < all.size()) same.push_back(all[i]);
      by_buffer[i].push_back(in_one_frame(same));
    }
  }
  std::vector<CaseBuffer> out;
  for (const std::vector<CaseBuffer>& same : by_buffer) out.push_back(over_viewports(same));
  return out;
}

std::vector<Growth> growth_of(const std::vector<PathNeed>& paths) {
  std::size_t longest = 0;
  for (const PathNeed& path : paths) {
    if (path.elements.empty() || (path.frames_per_entry > 1 && path.elements.size() > 1)) return {};
    longest = std::max(longest, path.elements.size());
  }
  std::vector<Growth> out;
  if (longest <= 8) return out;
  for (const int every : {8, 4, 2, 1}) {
    std::uint64_t most = 0;
    for (const PathNeed& path : paths)
      for (std::size_t i = 0; i < path.elements.size(); i += static_cast<std::size_t>(every))
        most = std::max(most, path.elements[i]);
    out.push_back({every, most});
  }
  return out;
}

bool follows_surfaces(const result::Case& result_case) {
  const assign::AssignerDescriptor* method = assign::find_assigner(result_case.assigner.name);
  return method != nullptr && (method->needs.depth || method->at_surfaces);
}

// False for cells at fixed places in the world: their lists hold the same lights for every view.
bool follows_view(const result::Case& result_case) {
  return result_case.grid.kind != "world" || result_case.grid.follow;
}

// If other frames can have more lights or cells than the counted ones, these give the maximum.
bool has_bound(const result::Case& result_case) {
  return !result_case.pre_cull && !result_case.react && !follows_surfaces(result_case);
}

// The findings of the searches with one camera, for a buffer.
struct CameraFind {
  std::string camera;
  std::uint64_t elements = 0, most = 0, step = 1;
  std::size_t search = 0;

  std::uint64_t steps() const { return elements / step; }
};

// If the buffer has the same room in each cell: the number of cells of the searched case; else 1.
std::uint64_t step_of(const FoundFrame& search, const std::string& buffer, const SizedStructure& structure) {
  for (const result::Case* result_case : structure.cases) {
    if (result_case->name != search.case_name) continue;
    for (const CaseBuffer& needs : buffers_of(*result_case))
      if (needs.name == buffer) return std::max<std::uint64_t>(needs.step, 1);
  }
  return 1;
}

// The largest finding of each camera, in the order of the searches.
std::vector<CameraFind> finds_of(SizedBuffer& buffer, const SizedStructure& structure) {
  std::vector<CameraFind> finds;
  for (std::size_t search = 0; search < structure.searches.size(); ++search)
    for (const FoundFrame::Need& need : structure.searches[search].needs) {
      if (need.name != buffer.name) continue;
      const std::string camera = structure.camera_of(structure.searches[search]);
      buffer.element_bytes = std::max(buffer.element_bytes, need.element_bytes);
      auto known = std::ranges::find(finds, camera, &CameraFind::camera);
      if (known == finds.end())
        known = finds.insert(known, {camera, need.elements, need.most,
                                     step_of(structure.searches[search], buffer.name, structure), search});
      if (need.elements > known->elements) known->elements = need.elements, known->search = search;
      known->most = std::max(known->most, need.most);
    }
  return finds;
}

// Cameras drawn in one frame can all be at their own worst places at the same time; one that was not searched counts as
// the worst of the others. If all cells have the same room, it is that of the longest list of all.
void add_finds(SizedBuffer& buffer, const std::vector<CameraFind>& finds, const std::vector<std::string>& cameras) {
  const auto is_of_group = [&](const CameraFind& find) {
    return std::ranges::find(cameras, find.camera) != cameras.end();
  };
  const CameraFind* worst = nullptr;
  std::uint64_t elements = 0, cells = 0, most = 0, searched = 0;
  for (const CameraFind& find : finds) {
    if (!is_of_group(find)) continue;
    if (worst == nullptr || find.steps() > worst->steps()) worst = &find;
    elements += find.elements;
    cells += find.step;
    most = std::max(most, find.most);
    ++searched;
  }
  if (worst == nullptr) return;
  const std::uint64_t others = cameras.size() - searched;
  elements = worst->step > 1 ? times(worst->steps(), cells + times(worst->step, others))
                             : elements + times(worst->elements, others);
  buffer.theoretical_max = std::max(buffer.theoretical_max, times(most, cameras.size()));
  if (buffer.found && elements <= *buffer.found) return;
  buffer.found = elements;
  buffer.found_by = worst->search;
  buffer.found_views = cameras.size();
}

void add_searches(SizedStructure& structure) {
  for (SizedBuffer& buffer : structure.buffers) {
    const std::vector<CameraFind> finds = finds_of(buffer, structure);
    std::vector<std::vector<std::string>> groups = structure.views;
    for (const CameraFind& find : finds)
      if (std::ranges::none_of(structure.views, [&](const std::vector<std::string>& view) {
            return std::ranges::find(view, find.camera) != view.end();
          }))
        groups.push_back({find.camera});
    for (const std::vector<std::string>& group : groups) add_finds(buffer, finds, group);
  }
}

void size_buffers(SizedStructure& structure, const AllocationRules& rules) {
  std::vector<std::uint64_t> steps;
  for (const FrameCameras& cameras : cameras_by_frame(structure))
    for (const CaseBuffer& next : buffers_of_frame(cameras)) {
      auto known = std::ranges::find(structure.buffers, next.name, &SizedBuffer::name);
      if (known == structure.buffers.end()) {
        known = structure.buffers.insert(known, SizedBuffer{});
        known->name = next.name;
        known->element_bytes = next.element_bytes;
        steps.push_back(1);
      }
      add(*known, steps[static_cast<std::size_t>(known - structure.buffers.begin())], next);
      if (!structure.views.empty()) known->groups.push_back(group_of(cameras, next));
    }
  for (SizedBuffer& buffer : structure.buffers)
    if (!buffer.groups.empty())
      std::erase_if(buffer.paths, [&](const PathNeed& path) { return path.camera != buffer.worst_camera; });
  add_searches(structure);
  for (std::size_t i = 0; i < structure.buffers.size(); ++i) {
    SizedBuffer& buffer = structure.buffers[i];
    buffer.depends_on_view =
        std::ranges::any_of(structure.cases, [](const result::Case* one) { return follows_view(*one); });
    buffer.is_bounded = std::ranges::all_of(structure.cases, [](const result::Case* one) { return has_bound(*one); });
    buffer.spread = spread_of(buffer.paths);
    // A need that is equal in all frames is exact for other frames, too.
    if (buffer.spread && buffer.spread->min == buffer.theoretical_max) buffer.is_bounded = true;
    buffer.growth = growth_of(buffer.paths);
    allocate(buffer, steps[i], rules);
  }
}

std::vector<const result::Case*> matching_cases(const std::vector<result::Case>& cases, const std::string& filter) {
  std::vector<const result::Case*> out;
  const Pattern pattern(filter, "--filter");
  for (const result::Case& result_case : cases)
    if (is_selected(pattern, result_case)) out.push_back(&result_case);
  if (out.empty() && !cases.empty())
    throw Error("", "--filter",
                "'" + filter + "' matches none of " + number_of(cases.size(), "case") + pattern_hint(filter) +
                    "; one of them is '" + cases[0].name + "'");
  return out;
}

// A case's name without its camera (and without its viewport, if one allocation serves all), and the scene and grid of
// it. Names of another form stay unchanged.
struct Names {
  std::string structure, group;
};

Names names_of(const result::Case& result_case, bool over_viewports) {
  const run::CaseNames names = names_of_case(result_case);
  const std::string rest = run::name_without_camera(names, !over_viewports);
  if (rest == names.name) return {rest, rest};
  return {names.scene + "/" + rest, names.scene + "/" + rest.substr(0, rest.find('/'))};
}

std::array<int, 2> across_and_down(const result::Counts2& tiles) {
  return {static_cast<int>(tiles[0]), static_cast<int>(tiles[1])};
}

// As `run` reports it.
std::optional<GrownTiles> grown_in_result(const result::Case& result_case) {
  if (!result_case.react || result_case.react->to != "entries") return {};
  const result::Reaction& react = *result_case.react;
  return GrownTiles{result_case.name,
                    react.most,
                    result_case.frames,
                    react.frames.reacted,
                    react.frames.over,
                    as_count(std::max(0.0, react.needed.max)),
                    across_and_down(react.tiles.asked),
                    across_and_down(react.tiles.fewest)};
}

bool has_camera(const SizedStructure& structure, const result::Case& result_case) {
  return std::ranges::any_of(structure.cases, [&](const result::Case* other) {
    return other->camera == result_case.camera && other->viewport == result_case.viewport;
  });
}

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
  return camera == pattern || fnmatch(pattern.c_str(), camera.c_str(), 0) == 0;
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

void set_views(std::vector<SizedStructure>& structures, const AllocationScope& scope) {
  if (!scope.grid_of.empty() && scope.views.empty())
    throw Error("", "--grid-of", "needs --views, which says whose samples are looked up in that camera's grid");
  bool is_owner_known = scope.grid_of.empty();
  for (const std::string& group : scope.views) {
    check_view_names(structures, group);
    bool is_known = false;
    for (SizedStructure& structure : structures) {
      const std::vector<std::string> cameras = cameras_in(structure, group);
      if (cameras.size() < 2) continue;
      is_known = true;
      if (std::ranges::find(cameras, scope.grid_of) == cameras.end()) {
        structure.views.push_back(cameras);
        continue;
      }
      is_owner_known = true;
      share_grid(structure, cameras, scope.grid_of);
    }
    if (is_known || structures.empty()) continue;
    std::vector<std::string> known;
    for (const result::Case* result_case : structures.front().cases) known.push_back(result_case->camera);
    throw Error("", "--views",
                "'" + group + "' names no two cameras of a scene; " + structures.front().name + " has " +
                    joined(known) + "; takes names, as in left,right, and * for any letters" + comma_hint(known));
  }
  if (!is_owner_known && !structures.empty())
    throw Error("", "--grid-of", "'" + scope.grid_of + "' is none of the cameras of --views");
  for (SizedStructure& structure : structures)
    if (!structure.guests.empty()) leave_out_others(structure, scope.views);
}

void set_taken(std::vector<SizedStructure>& structures, const result::Result& result) {
  if (!result.conclusions) return;
  for (const result::Conclusion& conclusion : *result.conclusions)
    for (SizedStructure& structure : structures) {
      const auto takes = [&](const result::Case* one) { return one->id == *conclusion.take; };
      if (conclusion.take && std::ranges::any_of(structure.cases, takes))
        structure.taken_by.push_back(conclusion.camera);
    }
}

// Sets the properties of its scene's lights.
void set_lights(SizedStructure& structure, const result::Scene& scene) {
  const result::SceneLights& lights = scene.lights;
  structure.has_boxes = lights.box > 0;
  structure.lights_of_type = std::max({lights.point, lights.spot, lights.box});
}

}  // namespace

std::uint64_t SizedStructure::frames() const {
  std::uint64_t all = 0;
  for (const FrameCameras& cameras : cameras_by_frame(*this)) all += frames_of_group(cameras);
  return all;
}

std::uint64_t SizedStructure::frames_of(const SizedBuffer& buffer) const {
  const auto made_mark = [&](const FrameGroup& needs) { return joined(needs.cameras, "+") == buffer.worst_camera; };
  const auto found = std::ranges::find_if(buffer.groups, made_mark);
  return found == buffer.groups.end() ? frames() : found->frames;
}

const FoundFrame* SizedStructure::search_for(const std::string& measure) const {
  const FoundFrame* best = nullptr;
  for (const FoundFrame& found : searches) {
    if (found.measure != measure) continue;
    const bool is_better = best == nullptr || (found.refusal.empty() && !best->refusal.empty()) ||
                           (found.refusal.empty() && found.value > best->value);
    if (is_better) best = &found;
  }
  return best;
}

const FoundFrame* SizedStructure::main_search() const {
  const auto buffer = std::ranges::find_if(buffers, [](const SizedBuffer& one) { return one.found.has_value(); });
  if (buffer != buffers.end()) return &searches[buffer->found_by];
  return searches.empty() ? nullptr : &searches.front();
}

std::string SizedStructure::camera_of(const FoundFrame& found) const {
  for (const result::Case* result_case : cases)
    if (result_case->name == found.case_name) return result_case->camera;
  return "";
}

std::size_t SizedStructure::searched_cameras() const {
  std::set<std::string> cameras;
  for (const FoundFrame& found : searches)
    if (found.refusal.empty()) cameras.insert(camera_of(found));
  return cameras.size();
}

bool SizedStructure::is_searched() const {
  return std::ranges::any_of(searches, [](const FoundFrame& found) { return found.refusal.empty(); });
}

std::string SizedStructure::sought_measure() const {
  return measure_of_buffers(cases.front()->storage);
}

bool SizedStructure::is_sought() const {
  return std::ranges::find(searches, sought_measure(), &FoundFrame::measure) != searches.end();
}

std::string measure_of_buffers(const std::string& storage) {
  return storage.starts_with("fixed") ? "longest" : "entries";
}

std::uint64_t SizedBuffer::double_buffered_bytes() const {
  return times(2, bytes);
}

std::uint64_t SizedStructure::bytes() const {
  std::uint64_t sum = 0;
  for (const SizedBuffer& buffer : buffers)
    sum = buffer.bytes > k_largest_count - sum ? k_largest_count : sum + buffer.bytes;
  return sum;
}

std::vector<SizedStructure> sized_structures(const result::Result& result, const std::string& filter,
                                             const AllocationRules& rules, const AllocationScope& scope) {
  std::vector<SizedStructure> out;
  for (const result::Case* result_case : matching_cases(result.cases, filter)) {
    const Names names = names_of(*result_case, scope.over_viewports);
    // The same camera again belongs to another structure with the same name.
    auto known = std::ranges::find_if(out, [&](const SizedStructure& sized) {
      return sized.name == names.structure && !has_camera(sized, *result_case);
    });
    if (known == out.end()) {
      known = out.insert(known, SizedStructure{});
      known->name = names.structure;
      known->group = names.group;
    }
    known->cases.push_back(result_case);
  }
  for (SizedStructure& structure : out) {
    structure.has_grid_cells = !follows_surfaces(*structure.cases.front());
    if (const result::Json* jitter = value_at(result.config, "/jitter"))
      structure.jitters = config::jitter_of(nlohmann::json(*jitter)).size();
    for (const result::Scene& scene : result.scenes)
      if (scene.name == structure.cases.front()->scene) set_lights(structure, scene);
  }
  set_taken(out, result);
  set_views(out, scope);
  for (SizedStructure& structure : out) {
    const auto is_mine = [&](const auto& told) {
      return std::ranges::any_of(structure.cases, [&](const result::Case* one) { return one->name == told.case_name; });
    };
    std::ranges::copy_if(scope.guests, std::back_inserter(structure.guest_samples), is_mine);
    std::ranges::copy_if(scope.found, std::back_inserter(structure.searches), is_mine);
    std::ranges::copy_if(scope.grown, std::back_inserter(structure.grown), is_mine);
    for (const result::Case* result_case : structure.cases)
      if (const std::optional<GrownTiles> grown = grown_in_result(*result_case)) structure.grown.push_back(*grown);
  }
  for (SizedStructure& structure : out) size_buffers(structure, rules);
  return out;
}

}  // namespace clusterbench::report
