#pragma once
// Two programs measured side by side on the same cases: rounds in alternating order, over several starts of both.
// docs/comparing.md says why.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/statistics/time_change.h"
#include "run/cases/sweep.h"

namespace clusterbench::run {

// One frame's lists, for comparison.
struct ListDigest {
  std::uint64_t pairs = 0;
  std::string sha256;
  friend bool operator==(const ListDigest&, const ListDigest&) = default;
};

struct FrameLists {
  Vec3i cells{0, 0, 0};                            // of the grid; samples x 1 x 1 of a method without cells
  std::vector<std::vector<std::uint32_t>> lights;  // of each cell
};

// A program that lists and measures the cases of one configuration: this one (served_cases.h), or another one at the
// other end of a pipe. Throws Error where it cannot.
class Program {
 public:
  virtual ~Program() = default;

  virtual std::vector<std::string> case_ids() = 0;
  // Of all frames of the case's path.
  virtual std::vector<ListDigest> list_digests(const std::string& id) = 0;
  virtual FrameLists frame_lists(const std::string& id, int frame) = 0;
  // Measures one round. Cases that follow each other in the plan should be asked for one after the other: a change of
  // grid makes all frames anew.
  virtual double assign_ns(const std::string& id) = 0;
};

// Where the lists of both first differ.
struct ListsDiffer {
  int frames = 0, frame = 0;  // how many differ; the first of them
  Vec3i cell{0, 0, 0};
  std::uint32_t light = 0;
  bool is_only_in_new = false;                   // or only in the base
  std::uint64_t base_pairs = 0, next_pairs = 0;  // over all frames
};

// One start of both programs.
struct PairedLaunch {
  std::vector<double> base_ns, next_ns;  // of each round
};

struct PairedCase {
  std::vector<PairedLaunch> launches;
  std::optional<ListsDiffer> lists_differ;

  // new / base, over the launches.
  measure::Change change() const;
};

// Each method is measured in `launches` launches, and in further ones until half of its interval (measure::half_width)
// is `enough` or less, or `most_launches` are done. What the interval lies around does not matter: who stops when
// the verdict pleases will be pleased too often.
struct PairedRequest {
  int launches = 10, most_launches = 10;
  double enough = 0.01;
  int rounds = 4;  // of each launch
};

struct PairedStart {
  std::function<std::unique_ptr<Program>()> base, next;
};

struct PairedRound {
  int launch = 0;
  double share = 0.0;  // of the work that is certain to be done: nothing in further launches
};
using OnPairedRound = std::function<void(const PairedRound&)>;

// By id, the plan's cases that both programs have; cases of one method share their rounds. Which program starts, and
// which measures first, alternates from launch to launch, round to round and method to method. Lists are compared in
// the first launch, before anything is measured. `on_round` is told of each round of a group before it begins.
std::map<std::string, PairedCase> measure_paired(const Plan& plan, const PairedRequest& request,
                                                 const PairedStart& start, const OnPairedRound& on_round);

}  // namespace clusterbench::run
