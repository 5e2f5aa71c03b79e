#pragma once
// `clusterbench stress`: every assigner on every hard case, checked against the truth.

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "core/pattern.h"
#include "stress/hard_cases.h"
#include "stress/random_search.h"

namespace clusterbench::stress {

// An assigner with one choice of its parameters, in a form with lists per cell.
struct StressMethod {
  std::string label;  // "sphere-refinement(spot=sphere)"
  const assign::AssignerDescriptor* assigner = nullptr;
  assign::Params params;
  bool conservative = true;
  assign::Answer answer = assign::Answer::lists;

  assign::AssignerRun start() const { return {*assigner, params, answer}; }
};
// Every assigner on the processor that has cells, with its defaults and with every other choice.
std::vector<StressMethod> stress_methods();
// The label of the method whose lists a fast one's must equal; empty if it is no SIMD variant.
std::string reference_of(const std::string& label);
bool supports_trial(const StressMethod& method, const Trial& trial);
// Whether it can run on this grid of a trial that it supports.
bool fits(const StressMethod& method, const grid::Grid& grid);

struct StressRequest {
  std::uint64_t seed = 1;
  std::uint64_t tries = 20'000;  // of the search, per method; 0 = no search
  double seconds = 0.0;          // of the search, per method, and of random settings; 0 = no limit
  std::uint64_t random = 0;      // random settings to check, with the seeds from `seed` on
  Pattern cases, methods;
  bool takes_device = false;  // methods that run on the device of the process; without it only those that are named
  int threads = 1;            // results do not depend on it
};

// A miss that `run` can reproduce.
struct Loss {
  std::string trial;
  std::uint32_t cell = 0, light = 0;
  double depth = 0.0;  // 1 - d/r
  Trial scene;
};

struct StressCell {
  std::string hard_case, method;
  int trials = 0, refused = 0;      // refused: as expected
  std::vector<std::string> faults;  // a missing refusal, an unexpected one, lists that are not lists, a failed device
  bool is_ended = false;            // by the device
  std::uint64_t true_pairs = 0, misses = 0, extra_pairs = 0, undecided = 0;
  std::optional<Loss> deepest;

  bool lost() const { return misses > 0; }
};

// The result of the search for one method.
struct SearchResult {
  std::string method;
  std::uint64_t tries = 0, misses = 0;
  std::uint64_t undecided = 0;  // not listed, and neither proven nor refuted to be in the cell
  double least_margin =
      0.0;  // of the padding: roundoffs by which the nearest light could be moved away and still be listed
  std::optional<Loss> deepest;
  std::string fault;  // why the method or its device ended it before its time
};

struct StressResult {
  std::vector<StressMethod> methods;
  std::vector<std::string> left_out;           // methods on a device, each with the reason
  std::vector<HardCase> cases;                 // the selected ones
  std::vector<std::vector<ToolCheck>> checks;  // per case
  std::vector<StressCell> cells;               // per case and method, if the method supports a grid of the case
  std::vector<SearchResult> searches;          // H31
  std::optional<RandomSearch> random;
  bool interrupted = false;  // then the above is incomplete
};

struct StressListener {
  std::function<void(const std::string& doing, double done, double whole)> on_progress;
  std::function<void(const std::string& reason)> on_left_out;  // before all work: methods that are not run
};

// On `stop` it ends with the cases, searches and settings done so far.
StressResult run_stress(const StressRequest& request, const StressListener& listener, const std::atomic<bool>& stop);

// Checks random settings, each with a seed of its own, and shrinks the faults. The result does not depend on the number
// of threads, unless the time limit ends it.
RandomSearch search_at_random(std::span<const StressMethod> methods, const StressRequest& request,
                              const std::function<void(std::uint64_t settings, const std::string& doing)>& on_progress,
                              const std::atomic<bool>& stop);

// Writes NAME.gltf and NAME.json into a folder, which `run NAME.json` then reproduces. Throws Error.
void write_replay(const std::filesystem::path& folder, const std::string& name, const Loss& loss,
                  const StressMethod& method);
// The same for a setting and all methods that support its grid.
void write_replay(const std::filesystem::path& folder, const std::string& name, const Trial& trial,
                  std::span<const StressMethod> methods);

}  // namespace clusterbench::stress
