#include "report/size_report/size_report.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/text.h"
#include "measure/statistics/side_by_side.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/comparing/ratios.h"
#include "report/shader_code/list_code.h"
#include "report/shader_code/lookup_constants.h"
#include "report/shader_code/named_structures.h"
#include "report/shader_code/size_code.h"
#include "report/size_report/engine_settings.h"
#include "report/size_report/size_table.h"
#include "report/sizing/buffer_tail.h"
#include "report/sizing/found_frames.h"
#include "report/sizing/size_words.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

AllocationRules rules_of(const result::Result& result, const SizeRequest& request) {
  AllocationRules rules;
  rules.margin = request.margin.value_or(number_at(result.config, "/allocation/margin").value_or(rules.margin));
  rules.warn_at = request.warn_at.value_or(number_at(result.config, "/allocation/warn_at").value_or(rules.warn_at));
  rules.rounding = request.rounding == "page"           ? Rounding::page
                   : request.rounding == "power-of-two" ? Rounding::power_of_two
                                                        : Rounding::none;
  return rules;
}

// Smaller is better. Methods' own structures come after all lists: the cost of their samples differs.
auto rank(const SizedStructure& structure) {
  bool loses = false, is_own = false;
  for (const result::Case* result_case : structure.cases) {
    loses |= result_case->loses_lights || !result_case->failures.empty();
    is_own |= result_case->storage == "own";
  }
  return std::pair(loses, is_own);
}

// Sum of a frame of each camera.
double time_of(const SizedStructure& structure) {
  double sum = 0.0;
  for (const result::Case* one : structure.cases)
    sum += result::number<&result::Case::timing, &result::Timing::frame_ns, &result::Time::median>(*one).value_or(
        std::numeric_limits<double>::infinity());
  return sum;
}

// Whether frames of some camera are slower than the other's for certain, so that noise does not decide.
bool is_slower(const result::Result& result, const SizedStructure& structure, const SizedStructure& fastest) {
  bool is_known = false;
  for (const result::Case* mine : structure.cases)
    for (const result::Case* other : fastest.cases) {
      if (mine->camera != other->camera) continue;
      const std::optional<measure::Ratio> ratio = ratio_of_cases(result, *mine, *other);
      is_known |= ratio.has_value();
      if (ratio && measure::takes_longer(ratio)) return true;
    }
  return !is_known && time_of(structure) > time_of(fastest);
}

// Of structures of one grid that lose no light the fastest; of those that may be equally fast, the one with the least
// memory, and then a method with SIMD.
const SizedStructure& best_of(const result::Result& result, std::vector<const SizedStructure*> all) {
  const auto least_rank =
      rank(**std::ranges::min_element(all, {}, [](const auto* structure) { return rank(*structure); }));
  std::erase_if(all, [&](const auto* structure) { return rank(*structure) != least_rank; });
  const SizedStructure& fastest =
      **std::ranges::min_element(all, {}, [](const auto* structure) { return time_of(*structure); });
  std::erase_if(all,
                [&](const auto* structure) { return structure != &fastest && is_slower(result, *structure, fastest); });
  return **std::ranges::min_element(all, {}, [](const auto* structure) {
    const int slowness = slowness_of(*structure->cases.front());
    return std::tuple(structure->bytes(), time_of(*structure), slowness != 1, slowness, structure->name);
  });
}

// By the recorded frames only, without findings: searched structures are the printed ones. Of a group's structures
// those that a search was for, with any finding; else the one that the result's conclusion recommends.
std::vector<std::size_t> best_of_groups(const result::Result& result, const std::vector<SizedStructure>& seen,
                                        const std::vector<SizedStructure>& with_finds) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const SizedStructure*>> groups;
  for (const SizedStructure& structure : seen) {
    if (!groups.contains(structure.group)) order.push_back(structure.group);
    groups[structure.group].push_back(&structure);
  }
  const auto index_of = [&](const SizedStructure* structure) {
    return static_cast<std::size_t>(structure - seen.data());
  };
  const auto is_searched = [&](const SizedStructure* structure) {
    return !with_finds[index_of(structure)].searches.empty();
  };
  const auto is_taken = [](const SizedStructure* structure) { return structure->is_taken(); };
  std::vector<std::size_t> best;
  for (const std::string& group : order) {
    std::vector<const SizedStructure*>& all = groups[group];
    if (std::ranges::any_of(all, is_searched))
      std::erase_if(all, [&](const SizedStructure* structure) { return !is_searched(structure); });
    if (std::ranges::any_of(all, is_taken))
      std::erase_if(all, [&](const SizedStructure* structure) { return !is_taken(structure); });
    best.push_back(index_of(&best_of(result, all)));
  }
  return best;
}

result::ElementSpread element_spread(const FrameSpread& spread) {
  return {spread.min, spread.p50, spread.p90, spread.p99, spread.max, spread.is_exact};
}

void add_groups(const SizedBuffer& buffer, result::AllocatedBuffer& out) {
  if (!buffer.groups.empty()) out.groups.emplace();
  for (const FrameGroup& group : buffer.groups) {
    result::ViewGroup& added = out.groups->emplace_back();
    added.cameras = group.cameras;
    added.count = group.frames;
    added.high_water = group.high_water;
    if (group.spread) added.frames = element_spread(*group.spread);
  }
  if (!buffer.growth.empty()) out.high_water_of_every.emplace();
  for (const Growth& growth : buffer.growth)
    out.high_water_of_every->push_back({static_cast<std::uint64_t>(growth.every), growth.high_water});
}

result::AllocatedBuffer allocated_buffer(const SizedBuffer& buffer, const std::string& name,
                                         const std::vector<FoundFrame>& searches) {
  result::AllocatedBuffer out{.name = buffer.name,
                              .identifier = name,
                              .element_bytes = buffer.element_bytes,
                              .high_water = buffer.high_water,
                              .theoretical_max = buffer.theoretical_max,
                              .worst = {buffer.worst_camera, buffer.worst_frame, buffer.worst_cell},
                              .found = buffer.found,
                              .is_bounded = buffer.is_bounded,
                              .capacity = buffer.capacity,
                              .warn_above = buffer.warn_above,
                              .bytes = buffer.bytes,
                              .double_buffered_bytes = buffer.double_buffered_bytes(),
                              .beyond_the_path = beyond_the_path(buffer)};
  if (buffer.apart > 0) out.views_apart = buffer.apart;
  if (!buffer.why_sum.empty()) out.views_not_paired = buffer.why_sum;
  if (buffer.spread) out.frames = element_spread(*buffer.spread);
  add_groups(buffer, out);
  if (buffer.found) out.found_by = size_search(searches[buffer.found_by]);
  if (buffer.is_bounded)
    out.never_overflows = result::NeverOverflows{buffer.theoretical_max, buffer.theoretical_max * buffer.element_bytes};
  return out;
}

std::vector<std::string> cameras_of(const std::vector<const result::Case*>& cases) {
  std::vector<std::string> out;
  for (const result::Case* result_case : cases)
    if (std::ranges::find(out, result_case->camera) == out.end()) out.push_back(result_case->camera);
  return out;
}

std::vector<result::GuestCamera> guest_cameras(const SizedStructure& structure) {
  std::vector<result::GuestCamera> out;
  for (const GuestSamples& guest : structure.guest_samples)
    out.push_back({guest.camera, guest.samples, guest.outside, guest.needed, guest.missed, guest.missed_outside,
                   static_cast<std::uint64_t>(guest.worst_frame)});
  return out;
}

void add_notes(const SizedStructure& structure, result::AllocatedStructure& out) {
  if (const FoundFrame* search = structure.main_search()) out.search = size_search(*search);
  if (!structure.choice.empty()) out.choice = structure.choice;
  if (const std::string unseen = nothing_seen_text(structure); !unseen.empty()) out.nothing_seen = unseen;
  if (const std::vector<std::string> notes = grid_notes(structure); !notes.empty()) out.grid_notes = notes;
  if (const std::vector<std::string> notes = limit_notes(structure); !notes.empty()) out.limit_notes = notes;
  if (const std::string why = why_no_reader(structure); !why.empty()) out.no_reader = why;
}

result::AllocatedStructure allocated_structure(const NamedStructure& named) {
  const SizedStructure& structure = named.structure;
  const result::Case& first = *structure.cases.front();
  result::AllocatedStructure out{.name = structure.name,
                                 .identifier = named.name,
                                 .scene = first.scene,
                                 .cameras = cameras_of(structure.cases),
                                 .grid = first.grid.name,
                                 .assigner = first.assigner.label,
                                 .storage = first.storage,
                                 .bytes = structure.bytes(),
                                 .frames = structure.frames()};
  if (!structure.views.empty()) out.views.emplace();
  for (const std::vector<std::string>& view : structure.views) out.views->push_back({view});
  if (!structure.guest_samples.empty()) out.guests = guest_cameras(structure);
  add_notes(structure, out);
  for (const result::Case* result_case : structure.cases)
    out.dropped_pairs += result_case->buffers.overflow.dropped_pairs;
  for (std::size_t i = 0; i < structure.buffers.size(); ++i)
    out.buffers.push_back(allocated_buffer(structure.buffers[i], named.buffers[i], structure.searches));
  for (const NamedLookup& lookup : named.lookups)
    out.lookups.push_back(
        {lookup.name, cameras_of(lookup.cases), lookup_json(lookup_constants(*lookup.cases.front()))});
  return out;
}

result::Size size_document(const std::vector<NamedStructure>& structures, std::size_t all, const SizeRequest& request,
                           const AllocationRules& rules) {
  result::Size out{.size_version = 1,
                   .margin = rules.margin,
                   .warn_at = rules.warn_at,
                   .rounding = request.rounding,
                   .structures_in_all = all};
  std::vector<const SizedStructure*> all_structures;
  for (const NamedStructure& named : structures) all_structures.push_back(&named.structure);
  for (const NamedStructure& named : structures) {
    out.structures.push_back(allocated_structure(named));
    if (!request.engine.empty())
      out.structures.back().settings =
          engine_settings_of({request.engine, request.has_changed_grid, rules}, named.structure, all_structures);
  }
  return out;
}

// The criterion of the choice of a structure.
std::string best_words(const result::Result& result) {
  const bool has_times =
      std::ranges::any_of(result.cases, [](const result::Case& one) { return one.timing.has_value(); });
  return has_times ? "the fastest structure that loses no light, or of those that may be as fast the smallest"
                   : "the smallest structure that loses no light";
}

std::string remark(const result::Result& result, const std::vector<SizedStructure>& shown, std::size_t all) {
  if (shown.size() == all) return "";
  const bool has_taken = std::ranges::any_of(shown, &SizedStructure::is_taken);
  const bool has_searched = std::ranges::any_of(shown, [](const auto& one) { return !one.searches.empty(); });
  return "Of each grid " + std::string(has_searched ? "what a search was for, else " : "") +
         (has_taken ? "what the conclusion of the result takes, else " : "") + best_words(result) + ". --all has all " +
         std::to_string(all) + ".";
}

std::string method_of(const SizedStructure& structure) {
  const result::Case& first = *structure.cases.front();
  return first.assigner.label + "/" + first.storage;
}

// "frustum 16x9 x 24 exponential/exact-fast/packed": a name that --filter accepts.
std::string name_in_scene(const SizedStructure& structure) {
  const std::string scene = structure.cases.front()->scene + "/";
  return structure.name.starts_with(scene) ? structure.name.substr(scene.size()) : structure.name;
}

// States that the result's conclusion recommends it, and for which cameras if it serves others, too.
std::string taken_text(const SizedStructure& structure) {
  const bool serves_others = std::ranges::any_of(structure.cases, [&](const result::Case* one) {
    return std::ranges::find(structure.taken_by, one->camera) == structure.taken_by.end();
  });
  return std::string("taken by the conclusion of the result") +
         (serves_others
              ? (structure.taken_by.size() == 1 ? " for camera " : " for cameras ") + joined(structure.taken_by)
              : std::string());
}

// States that the result's conclusion recommends another method, and its name here; "" if it does not.
std::string other_method_text(const result::Result& result, const SizedStructure& chosen,
                              const std::vector<SizedStructure>& all) {
  const auto is_of_its_scene = [&](const SizedStructure& one) {
    return one.is_taken() && one.cases.front()->scene == chosen.cases.front()->scene;
  };
  const auto taken = std::ranges::find_if(all, is_of_its_scene);
  if (taken == all.end() || method_of(*taken) == method_of(chosen) || chosen.cases.front()->preset) return "";
  const auto same = std::ranges::find_if(
      all, [&](const SizedStructure& one) { return one.group == chosen.group && method_of(one) == method_of(*taken); });
  return "the conclusion of the result takes another method, " + name_in_scene(*taken) + "; this is " +
         (chosen.searches.empty() ? "of its grid " + best_words(result) : "what a search was for") +
         (same == all.end() ? "" : "; that method here: --filter '" + name_in_scene(*same) + "'");
}

std::vector<SizedStructure> chosen_structures(const result::Result& result, const SizeRequest& request,
                                              std::size_t& count) {
  const AllocationRules rules = rules_of(result, request);
  std::vector<SizedStructure> all = sized_structures(result, request.filter, rules, request.scope);
  count = all.size();
  for (SizedStructure& structure : all)
    if (structure.is_taken()) structure.choice = taken_text(structure);
  if (request.all) return all;
  AllocationScope seen = request.scope;
  seen.found.clear();
  std::vector<SizedStructure> chosen;
  for (const std::size_t index : best_of_groups(result, sized_structures(result, request.filter, rules, seen), all)) {
    chosen.push_back(all[index]);
    if (!chosen.back().is_taken()) chosen.back().choice = other_method_text(result, all[index], all);
  }
  std::stable_partition(chosen.begin(), chosen.end(), [](const SizedStructure& one) { return one.is_taken(); });
  return chosen;
}

// For each camera with its own grid, the viewport with the largest need.
std::vector<const result::Case*> cases_to_search(const SizedStructure& structure) {
  const auto entries_of = [](const result::Case& one) { return one.buffers.index_entries.high_water; };
  std::vector<const result::Case*> all;
  for (const result::Case* result_case : structure.cases) {
    if (structure.is_guest(result_case->camera)) continue;
    const auto known = std::ranges::find(all, result_case->camera, &result::Case::camera);
    if (known == all.end())
      all.push_back(result_case);
    else if (entries_of(*result_case) > entries_of(**known))
      *known = result_case;
  }
  return all;
}

// Keeps those of the engine's preset.
void keep_engine(std::vector<SizedStructure>& structures, const std::string& engine) {
  std::erase_if(structures, [&](const SizedStructure& structure) { return structure.cases.front()->preset != engine; });
  if (structures.empty())
    throw Error("", "--engine",
                "no case is of the preset '" + engine + "'; measure it: clusterbench size LEVEL --engine " + engine);
}

// The structures to print.
std::vector<SizedStructure> printed_structures(const result::Result& result, const SizeRequest& request,
                                               std::size_t& count) {
  std::vector<SizedStructure> chosen = chosen_structures(result, request, count);
  if (!request.engine.empty()) keep_engine(chosen, request.engine);
  return chosen;
}

}  // namespace

std::vector<std::string> size_formats() {
  return {"table", "cpp", "hlsl", "glsl", "json"};
}

std::vector<std::string> size_roundings() {
  return {"page", "power-of-two", "none"};
}

std::vector<std::string> sized_measures(const std::string& storage, const std::string& engine) {
  if (!engine.empty()) return measures_of_engine(engine);
  return {measure_of_buffers(storage)};
}

std::vector<SizedCase> sized_cases(const result::Result& result, const SizeRequest& request) {
  std::size_t count = 0;
  std::vector<SizedCase> out;
  for (const SizedStructure& structure : printed_structures(result, request, count))
    for (const result::Case* result_case : cases_to_search(structure)) {
      out.push_back({structure.name, result_case->name, sized_measures(result_case->storage, request.engine), "", {}});
      if (result_case->camera != request.scope.grid_of) continue;
      out.back().grid_case = out.back().name;
      out.back().guests = structure.guests;
    }
  return out;
}

std::vector<std::string> sized_from_nothing(const result::Result& result, const SizeRequest& request) {
  std::size_t count = 0;
  std::vector<std::string> out;
  for (const SizedStructure& structure : printed_structures(result, request, count))
    if (is_sized_from_nothing(structure)) out.push_back(structure.name + ": " + nothing_seen_text(structure));
  return out;
}

result::Result without_times_of_machines(result::Result result) {
  if (!result.machines) return result;
  for (result::Case& one : result.cases) one.timing.reset();
  result.conclusions.emplace();
  return result;
}

std::string size_report(const result::Result& result, const SizeRequest& request) {
  const AllocationRules rules = rules_of(result, request);
  if (!request.name.empty() && request.format == "table")
    throw Error("", "--name", "names what is printed as code, and a table has no names; give --format, too");
  std::size_t count = 0;
  std::vector<SizedStructure> chosen = printed_structures(result, request, count);
  if (!request.engine.empty() && request.format == "table") {
    std::vector<const SizedStructure*> all;
    for (const SizedStructure& structure : chosen) all.push_back(&structure);
    return engine_settings_text({request.engine, request.has_changed_grid, rules}, all);
  }
  const std::string left_out = remark(result, chosen, count);
  const LookupsOf lookups =
      request.format == "hlsl" || request.format == "glsl" ? LookupsOf::all_viewports : LookupsOf::each_viewport;
  const std::vector<NamedStructure> named = request.name.empty()
                                                ? named_structures(std::move(chosen), request.all, lookups)
                                                : named_structures(std::move(chosen), request.name, lookups);
  if (request.format == "json") return result::to_json(size_document(named, count, request, rules)).dump(1) + "\n";
  if (request.format == "cpp") return size_code(SizeLanguage::cpp, named, left_out, rules);
  if (request.format == "hlsl") return size_code(SizeLanguage::hlsl, named, left_out, rules);
  if (request.format == "glsl") return size_code(SizeLanguage::glsl, named, left_out, rules);
  return size_table(named, left_out, rules);
}

}  // namespace clusterbench::report
