#pragma once
// `clusterbench stress`: every assigner on every hard case, held against the truth.

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "assign/assigner.h"
#include "run/stress/hard_cases.h"

namespace clusterbench::run {

// An assigner with one choice of its parameters.
struct StressMethod {
  std::string label;  // "sphere-refinement(spot=ball)"
  const assign::AssignerRow* row = nullptr;
  assign::Params params;
  bool conservative = true;
};
// Every assigner with its defaults and with every other choice.
std::vector<StressMethod> stress_methods();

struct StressRequest {
  std::uint64_t seed = 1;
  std::uint64_t tries = 20'000;  // of the search, per method; 0 = no search
  double seconds = 0.0;          // of the search, per method; 0 = as many as the tries take
  std::regex cases{".*"}, methods{".*"};
  int threads = 1;
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
  int trials = 0, refused = 0;      // refused: as it should be
  std::vector<std::string> faults;  // a refusal that did not come, an unexpected one, lists that are not lists
  std::uint64_t true_pairs = 0, misses = 0, extra_pairs = 0, undecided = 0;
  std::optional<Loss> deepest;

  bool lost() const { return misses > 0; }
};

// What the search found for one method.
struct SearchResult {
  std::string method;
  std::uint64_t tries = 0, misses = 0;
  double least_margin =
      0.0;  // of the padding: roundings that the nearest light could be moved away and still be listed
  std::optional<Loss> deepest;
};

struct StressResult {
  std::vector<StressMethod> methods;
  std::vector<HardCase> cases;                 // those asked for
  std::vector<std::vector<ToolCheck>> checks;  // per case
  std::vector<StressCell> cells;               // per case and method, where the method takes a grid of the case
  std::vector<SearchResult> searches;          // H31
};

struct StressListener {
  std::function<void(const std::string& doing, double done, double whole)> on_progress;
};

StressResult run_stress(const StressRequest& request, const StressListener& listener, const std::atomic<bool>& stop);

// H31 for one method: hill-climbs lights, lenses and grids towards a light that touches a cell and is not listed.
SearchResult search_for_losses(const StressMethod& method, const StressRequest& request,
                               const std::function<void(std::uint64_t tries)>& on_progress,
                               const std::atomic<bool>& stop);

// Writes NAME.gltf and NAME.json into a folder, which `run NAME.json` then reproduces. Throws Error.
void write_replay(const std::filesystem::path& folder, const std::string& name, const Loss& loss,
                  const StressMethod& method);

}  // namespace clusterbench::run
