#pragma once
// A case of a configuration, and the group of cases that is measured together.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "config/config.h"
#include "core/error.h"

namespace clusterbench::run {

// The choices within a group that change the answers: indices in the configuration's lists, and the form of the answer.
struct Method {
  std::size_t assigner = 0, precision = 0;
  assign::Answer answer = assign::Answer::lists;
  std::size_t pre_cull = 0;

  friend bool operator==(const Method&, const Method&) = default;
};

// One case by its indices in the configuration's lists. The camera path is an index in the scene's paths.
struct CasePlan {
  // "scene/camera/grid/assigner/storage" (the grid's part includes the viewport if there are several, and the preset),
  // then the pre-cull if there is one, and the precision if it is not float32.
  std::string name;
  std::string id;  // short hash of the identity of the case: stable over runs and machines
  std::size_t scene, camera, viewport, grid, assigner;
  std::optional<std::size_t> storage;  // none: the assigner's own structure
  std::size_t precision = 0;
  // The same hash without the scene's contents: stable while a level changes.
  std::string settings = {};
  std::string preset = {};  // "" for the configuration's own clusterings
  std::size_t pre_cull = 0;
  // The number of cells of its grid if it is too large for a comparison with the truth (accuracy.most_pairs): then
  // samples decide. 0: the cells are compared. The same for all cases of a group.
  std::uint64_t cells_not_compared = 0;

  Method method() const {
    return {assigner, precision, storage ? assign::Answer::lists : assign::Answer::structure, pre_cull};
  }
};

// Cases of one scene, camera, viewport and grid: measured together, in interleaved rounds.
struct GroupPlan {
  std::size_t scene, camera, viewport, grid;
  std::vector<CasePlan> cases;
  std::uint64_t cells = 0;  // of its grid in the first frame
};

// Whether the cases' lists are compared with the truth, cell by cell.
bool compares_cells(const config::Config& config, const GroupPlan& group);
// The distinct methods of a group's cases, in order of first use.
std::vector<Method> methods_of(const GroupPlan& group);
// A method of a group as the label of its calls (os/call_notes.h).
std::uint64_t label_of(const Method& method);
const assign::AssignerDescriptor& method_of(const config::Config& config, const CasePlan& case_plan);
// Whether methods of the group run on a device, which serves one at a time, or in code of others, whose calls are told
// apart by their order (os/call_notes.h).
bool runs_elsewhere(const config::Config& config, const GroupPlan& group);
// A case's method, ready to be built.
assign::AssignerRun start_method(const config::Config& config, const Method& method);

// The error with the case at whose measuring it was thrown: the group's first.
Error error_at(const GroupPlan& group, const Error& error);

// The display name of a case's storage.
std::string storage_label(const config::Config& config, const CasePlan& case_plan);
// The display name of the lights that a method gets: " half after frustum"; "" for all lights in float32.
std::string lights_label(const config::Config& config, const Method& method);
// The assigner's label, which of its answers it is if it has two, and lights_label().
std::string method_label(const config::Config& config, const Method& method);

}  // namespace clusterbench::run
