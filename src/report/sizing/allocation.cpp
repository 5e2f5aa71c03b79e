#include "report/sizing/allocation.h"

#include <algorithm>
#include <iterator>

#include "config/config_scenes.h"
#include "core/error.h"
#include "core/pattern.h"
#include "report/cases/case_filter.h"
#include "report/cases/json_values.h"
#include "report/sizing/camera_views.h"
#include "report/sizing/counts.h"

namespace clusterbench::report {
namespace {

std::vector<const result::Case*> matching_cases(const std::vector<result::Case>& cases, const std::string& filter) {
  std::vector<const result::Case*> out;
  const Pattern pattern(filter, "--filter");
  for (const result::Case& result_case : cases)
    if (is_selected(pattern, result_case)) out.push_back(&result_case);
  if (out.empty() && !cases.empty())
    throw Error("", "--filter", run::no_match_text(filter, cases.size(), cases.front().name));
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

// In the order of their first cases, with their names and cases alone.
std::vector<SizedStructure> structures_of(const std::vector<const result::Case*>& cases, bool over_viewports) {
  std::vector<SizedStructure> out;
  for (const result::Case* result_case : cases) {
    const Names names = names_of(*result_case, over_viewports);
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
  return out;
}

// Sets the properties of its grid, its path and its scene's lights.
void set_properties(SizedStructure& structure, const result::Result& result) {
  structure.has_grid_cells = !follows_surfaces(*structure.cases.front());
  if (const result::Json* jitter = value_at(result.config, "/jitter"))
    structure.jitters = config::jitter_of(nlohmann::json(*jitter)).size();
  for (const result::Scene& scene : result.scenes) {
    if (scene.name != structure.cases.front()->scene) continue;
    structure.has_boxes = scene.lights.box > 0;
    structure.lights_of_type = std::max({scene.lights.point, scene.lights.spot, scene.lights.box});
  }
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

// Sets the facts of the scope that belong to a case of the structure.
void set_findings(SizedStructure& structure, const AllocationScope& scope) {
  const auto is_mine = [&](const auto& fact) {
    return std::ranges::any_of(structure.cases, [&](const result::Case* one) { return one->name == fact.case_name; });
  };
  std::ranges::copy_if(scope.guests, std::back_inserter(structure.guest_samples), is_mine);
  std::ranges::copy_if(scope.found, std::back_inserter(structure.searches), is_mine);
  std::ranges::copy_if(scope.grown, std::back_inserter(structure.grown), is_mine);
  for (const result::Case* result_case : structure.cases)
    if (const std::optional<GrownTiles> grown = grown_in_result(*result_case)) structure.grown.push_back(*grown);
}

}  // namespace

std::vector<SizedStructure> sized_structures(const result::Result& result, const std::string& filter,
                                             const AllocationRules& rules, const AllocationScope& scope) {
  std::vector<SizedStructure> out = structures_of(matching_cases(result.cases, filter), scope.over_viewports);
  for (SizedStructure& structure : out) set_properties(structure, result);
  set_taken(out, result);
  set_views(out, scope.views, scope.grid_of);
  for (SizedStructure& structure : out) {
    set_findings(structure, scope);
    size_buffers(structure, rules);
  }
  return out;
}

}  // namespace clusterbench::report
