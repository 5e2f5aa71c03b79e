#include "report/size.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

#include "core/error.h"
#include "core/text.h"
#include "measure/side_by_side.h"
#include "report/buffer_tail.h"
#include "report/engine_settings.h"
#include "report/found_frames.h"
#include "report/json_values.h"
#include "report/list_code.h"
#include "report/lookup_constants.h"
#include "report/named_structures.h"
#include "report/ratios.h"
#include "report/size_code.h"
#include "report/size_table.h"
#include "report/size_words.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

AllocationRules rules_of(const Json& result, const SizeRequest& request) {
  AllocationRules rules;
  rules.margin = request.margin.value_or(number_at(result, "/config/allocation/margin").value_or(rules.margin));
  rules.warn_at = request.warn_at.value_or(number_at(result, "/config/allocation/warn_at").value_or(rules.warn_at));
  rules.rounding = request.rounding == "page"           ? Rounding::page
                   : request.rounding == "power-of-two" ? Rounding::power_of_two
                                                        : Rounding::none;
  return rules;
}

// Smaller is better. Structures of a method's own come after all lists: what samples pay for them differs.
auto rank(const SizedStructure& structure) {
  bool loses = false, is_own = false;
  for (const Json* result_case : structure.cases) {
    loses |= (*result_case)["loses_lights"].get<bool>() || !(*result_case)["failures"].empty();
    is_own |= (*result_case)["storage"] == "own";
  }
  return std::pair(loses, is_own);
}

// Of a frame of each camera together.
double time_of(const SizedStructure& structure) {
  double sum = 0.0;
  for (const Json* result_case : structure.cases)
    sum += number_at(*result_case, "/timing/frame_ns/median").value_or(std::numeric_limits<double>::infinity());
  return sum;
}

// Whether frames of some camera take longer than the other's: as far as is known, lest noise decides.
bool is_slower(const Json& result, const SizedStructure& structure, const SizedStructure& fastest) {
  bool is_known = false;
  for (const Json* mine : structure.cases)
    for (const Json* other : fastest.cases) {
      if ((*mine)["camera"] != (*other)["camera"]) continue;
      const std::optional<measure::Ratio> ratio = ratio_of_cases(result, *mine, *other);
      is_known |= ratio.has_value();
      if (ratio && measure::takes_longer(ratio)) return true;
    }
  return !is_known && time_of(structure) > time_of(fastest);
}

// Of structures of one grid that lose no light the fastest; of those that may be as fast, the one with the least
// memory.
const SizedStructure& best_of(const Json& result, std::vector<const SizedStructure*> all) {
  const auto least_rank =
      rank(**std::ranges::min_element(all, {}, [](const auto* structure) { return rank(*structure); }));
  std::erase_if(all, [&](const auto* structure) { return rank(*structure) != least_rank; });
  const SizedStructure& fastest =
      **std::ranges::min_element(all, {}, [](const auto* structure) { return time_of(*structure); });
  std::erase_if(all,
                [&](const auto* structure) { return structure != &fastest && is_slower(result, *structure, fastest); });
  return **std::ranges::min_element(all, {}, [](const auto* structure) {
    return std::tuple(structure->bytes(), time_of(*structure), structure->name);
  });
}

std::vector<SizedStructure> best_of_groups(const Json& result, const std::vector<SizedStructure>& all) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<const SizedStructure*>> groups;
  for (const SizedStructure& structure : all) {
    if (!groups.contains(structure.group)) order.push_back(structure.group);
    groups[structure.group].push_back(&structure);
  }
  std::vector<SizedStructure> best;
  for (const std::string& group : order) best.push_back(best_of(result, groups[group]));
  return best;
}

Json spread_json(const FrameSpread& spread) {
  return {{"min", spread.min}, {"p50", spread.p50}, {"p90", spread.p90},
          {"p99", spread.p99}, {"max", spread.max}, {"is_exact", spread.is_exact}};
}

Json buffer_json(const SizedBuffer& buffer, const std::string& name, const std::vector<FoundFrame>& searches) {
  Json worst{{"camera", buffer.worst_camera}, {"frame", buffer.worst_frame}};
  if (!buffer.worst_cell.is_null()) worst["cell"] = buffer.worst_cell;
  Json out{{"name", buffer.name},
           {"identifier", name},
           {"element_bytes", buffer.element_bytes},
           {"high_water", buffer.high_water},
           {"theoretical_max", buffer.theoretical_max},
           {"worst", worst}};
  if (buffer.apart > 0) out["views_apart"] = buffer.apart;
  if (buffer.spread) out["frames"] = spread_json(*buffer.spread);
  for (const FrameGroup& group : buffer.groups)
    out["groups"].push_back({{"cameras", group.cameras},
                             {"count", group.frames},
                             {"high_water", group.high_water},
                             {"frames", group.spread ? spread_json(*group.spread) : Json()}});
  for (const Growth& growth : buffer.growth)
    out["high_water_of_every"].push_back({{"every", growth.every}, {"high_water", growth.high_water}});
  if (buffer.found) out.update({{"found", *buffer.found}, {"found_by", search_json(searches[buffer.found_by])}});
  out["is_bounded"] = buffer.is_bounded;
  if (buffer.is_bounded)
    out["never_overflows"] = {{"elements", buffer.theoretical_max},
                              {"bytes", buffer.theoretical_max * buffer.element_bytes}};
  out["capacity"] = buffer.capacity;
  out["warn_above"] = buffer.warn_above;
  out["bytes"] = buffer.bytes;
  out["double_buffered_bytes"] = buffer.double_buffered_bytes();
  if (const Json tail = tail_json(buffer); !tail.is_null()) out["beyond_the_path"] = tail;
  return out;
}

Json cameras_of(const std::vector<const Json*>& cases) {
  Json out = Json::array();
  for (const Json* result_case : cases)
    if (std::ranges::find(out, (*result_case)["camera"]) == out.end()) out.push_back((*result_case)["camera"]);
  return out;
}

Json structure_json(const NamedStructure& named, const std::string& engine, const AllocationRules& rules) {
  const SizedStructure& structure = named.structure;
  const Json& first = *structure.cases.front();
  Json out{{"name", structure.name},        {"identifier", named.name},
           {"scene", first["scene"]},       {"cameras", cameras_of(structure.cases)},
           {"grid", first["grid"]["name"]}, {"assigner", first["assigner"]["label"]},
           {"storage", first["storage"]},   {"bytes", structure.bytes()},
           {"frames", structure.frames()}};
  for (const std::vector<std::string>& view : structure.views) out["views"].push_back(view);
  for (const GuestSamples& guest : structure.guest_samples)
    out["guests"].push_back({{"camera", guest.camera},
                             {"samples", guest.samples},
                             {"outside", guest.outside},
                             {"needed", guest.needed},
                             {"missed", guest.missed},
                             {"missed_outside", guest.missed_outside},
                             {"worst_frame", guest.worst_frame}});
  if (const FoundFrame* search = structure.main_search()) out["search"] = search_json(*search);
  const std::string unseen = nothing_seen_text(structure);
  out["nothing_seen"] = unseen.empty() ? Json() : Json(unseen);
  std::uint64_t dropped = 0;
  for (const Json* result_case : structure.cases)
    dropped += (*result_case)["buffers"]["overflow"]["dropped_pairs"].get<std::uint64_t>();
  out["dropped_pairs"] = dropped;
  if (const std::vector<std::string> notes = grid_notes(structure); !notes.empty()) out["grid_notes"] = notes;
  if (const std::vector<std::string> notes = limit_notes(structure); !notes.empty()) out["limit_notes"] = notes;
  if (const std::string why = why_no_reader(structure); !why.empty()) out["no_reader"] = why;
  out["buffers"] = Json::array();
  for (std::size_t i = 0; i < structure.buffers.size(); ++i)
    out["buffers"].push_back(buffer_json(structure.buffers[i], named.buffers[i], structure.searches));
  if (!engine.empty()) out["settings"] = engine_settings_json(engine, structure, rules);
  out["lookups"] = Json::array();
  for (const NamedLookup& lookup : named.lookups)
    out["lookups"].push_back({{"identifier", lookup.name},
                              {"cameras", cameras_of(lookup.cases)},
                              {"constants", lookup_json(lookup_constants(*lookup.cases.front()))}});
  return out;
}

std::string size_json(const std::vector<NamedStructure>& structures, std::size_t all, const SizeRequest& request,
                      const AllocationRules& rules) {
  Json out{{"size_version", k_size_version}, {"margin", rules.margin},   {"warn_at", rules.warn_at},
           {"rounding", request.rounding},   {"structures_in_all", all}, {"structures", Json::array()}};
  for (const NamedStructure& named : structures)
    out["structures"].push_back(structure_json(named, request.engine, rules));
  return out.dump(1) + "\n";
}

std::string remark(const Json& result, std::size_t shown, std::size_t all) {
  if (shown == all) return "";
  const bool has_times = std::ranges::any_of(result["cases"], [](const Json& one) { return one.contains("timing"); });
  const std::string best = has_times
                               ? "the fastest structure that loses no light; of those that may be as fast, the smallest"
                               : "the smallest structure that loses no light";
  return "Of each grid " + best + ". --all has all " + std::to_string(all) + ".";
}

std::vector<SizedStructure> chosen_structures(const Json& result, const SizeRequest& request, std::size_t& count) {
  std::vector<SizedStructure> all = sized_structures(result, request.filter, rules_of(result, request), request.scope);
  count = all.size();
  return request.all ? std::move(all) : best_of_groups(result, all);
}

// Its first buffer whose need is not the same in all frames says it.
const Json& case_of_mark(const SizedStructure& structure) {
  for (const SizedBuffer& buffer : structure.buffers)
    for (const Json* result_case : structure.cases)
      if (!buffer.is_all() && buffer.worst_camera == (*result_case)["camera"]) return *result_case;
  return *structure.cases.front();
}

// Those of the engine's preset.
void keep_engine(std::vector<SizedStructure>& structures, const std::string& engine) {
  std::erase_if(structures, [&](const SizedStructure& structure) {
    const Json& first = *structure.cases.front();
    return !first.contains("preset") || first["preset"] != engine;
  });
  if (structures.empty())
    throw Error("", "--engine",
                "no case is of the preset '" + engine + "'; measure it: clusterbench size LEVEL --engine " + engine);
}

// Those that are printed.
std::vector<SizedStructure> printed_structures(const Json& result, const SizeRequest& request, std::size_t& count) {
  std::vector<SizedStructure> chosen = chosen_structures(result, request, count);
  if (!request.engine.empty() && !request.has_own_grid) keep_engine(chosen, request.engine);
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
  return {storage.starts_with("fixed") ? "longest" : "entries"};
}

std::vector<SizedCase> sized_cases(const Json& result, const SizeRequest& request) {
  std::size_t count = 0;
  std::vector<SizedCase> out;
  for (const SizedStructure& structure : chosen_structures(result, request, count)) {
    const Json& of_mark = case_of_mark(structure);
    out.push_back({structure.name, of_mark["name"].get<std::string>(),
                   sized_measures(of_mark["storage"].get<std::string>(), request.engine), "", structure.guests});
    for (const Json* result_case : structure.cases)
      if ((*result_case)["camera"] == request.scope.grid_of && out.back().grid_case.empty())
        out.back().grid_case = (*result_case)["name"].get<std::string>();
  }
  return out;
}

std::vector<std::string> sized_from_nothing(const Json& result, const SizeRequest& request) {
  std::size_t count = 0;
  std::vector<std::string> out;
  for (const SizedStructure& structure : printed_structures(result, request, count))
    if (is_sized_from_nothing(structure)) out.push_back(structure.name + ": " + nothing_seen_text(structure));
  return out;
}

std::string size_report(const Json& result, const SizeRequest& request) {
  const AllocationRules rules = rules_of(result, request);
  if (!request.name.empty() && request.format == "table")
    throw Error("", "--name", "names what is printed as code, and a table has no names; give --format, too");
  std::size_t count = 0;
  std::vector<SizedStructure> chosen = printed_structures(result, request, count);
  if (!request.engine.empty() && request.format == "table") return engine_settings_text(request.engine, chosen, rules);
  const std::vector<NamedStructure> named = request.name.empty() ? named_structures(std::move(chosen), request.all)
                                                                 : named_structures(std::move(chosen), request.name);
  if (request.format == "json") return size_json(named, count, request, rules);
  const std::string left_out = remark(result, named.size(), count);
  if (request.format == "cpp") return size_code(SizeLanguage::cpp, named, left_out, rules);
  if (request.format == "hlsl") return size_code(SizeLanguage::hlsl, named, left_out, rules);
  if (request.format == "glsl") return size_code(SizeLanguage::glsl, named, left_out, rules);
  return size_table(named, left_out, rules);
}

}  // namespace clusterbench::report
