#pragma once
// Two programs measured side by side on the same cases: rounds in alternating order, over several starts of both. The
// reasons are in docs/comparing.md.

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/statistics/time_change.h"
#include "run/cases/plan.h"

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
// other end of a pipe. Throws Error on failure.
class Program {
 public:
  virtual ~Program() = default;

  virtual std::vector<std::string> case_ids() = 0;
  // One digest per frame of the case's path.
  virtual std::vector<ListDigest> list_digests(const std::string& id) = 0;
  virtual FrameLists frame_lists(const std::string& id, int frame) = 0;
  // Measures one round. Request cases in the order of the plan: a change of grid makes all frames again.
  virtual double assign_ns(const std::string& id) = 0;
};

// The first difference between the lists of both programs.
struct ListsDiffer {
  int frames = 0, frame = 0;  // number of frames that differ; the first of them
  Vec3i cell{0, 0, 0};
  std::uint32_t light = 0;
  bool is_only_in_new = false;                   // else only in the base
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

// Each method is measured in `launches` launches, then in further ones until half of its interval (measure::half_width)
// is at most `enough`, or `most_launches` are done. The rule ignores the centre of the interval: stopping at a welcome
// verdict would find welcome verdicts too often.
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
  double share = 0.0;  // of this round in the work of the first `launches` launches; 0 in further ones
};
using OnPairedRound = std::function<void(const PairedRound&)>;

// Measures the plan's cases that both programs have; returns them by id. Cases of one method share their rounds. The
// program that starts first, and the one that measures first, alternate from launch to launch, round to round and
// method to method. Lists are compared in the first launch, before anything is measured. `on_round` is called before
// each round of a group.
std::map<std::string, PairedCase> measure_paired(const Plan& plan, const PairedRequest& request,
                                                 const PairedStart& start, const OnPairedRound& on_round);

}  // namespace clusterbench::run
