#pragma once
// Which grid, method and light structure is best for a scene by an objective, under constraints: successive halving
// over the frames of all its cameras (halving.h), then all frames for the remaining few. The caller evaluates the
// figures (Evaluate).

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "run/runner.h"
#include "search/halving.h"
#include "search/search_cost.h"
#include "search/views.h"

namespace clusterbench::search {

// The evaluation of a candidate's cases, one for each camera with a measured frame.
struct Verdict {
  double objective = 0.0;           // smaller is better; NaN: the cases do not have it
  double bytes = 0.0;               // decides between equals
  std::vector<std::size_t> broken;  // constraints, ascending
  bool is_final = false;            // the candidate stays rejected with any further frames
  std::vector<double> broken_by{};  // the figure that breaks each of `broken`; NaN: the cases do not have it
  // Constraints on figures that these frames do not have, ascending; broken if no frame of the view has them.
  std::vector<std::size_t> unknown{};
};
// Several threads may call it at the same time.
using Evaluate = std::function<Verdict(std::span<const run::CaseResult> cases)>;

struct Request {
  Evaluate evaluate;
  bool is_timed = false;    // the objective or a constraint needs times
  bool only_grows = false;  // the objective on some frames is never more than on all of them
  double within = 0.05;     // of the best: tolerance for a coarser grid
  std::size_t growth = 4, keep_one_in = 24, least = 6;  // of HalvingRequest
};

// The result of a candidate's last measurement.
struct Record {
  std::size_t frames = 0;
  Verdict verdict;
  // Objective / that of the best candidate of the same kind (separate or not) on the same frames that breaks nothing;
  // NaN: there is none.
  double by_best = 0.0;
};

// Work, compared with measuring every candidate on every frame. A candidate on a frame counts once, even if it is
// measured there several times.
struct Work {
  std::uint64_t measurements = 0;                      // including repetitions, and those that order the frames
  std::uint64_t evaluations = 0, all_evaluations = 0;  // a candidate on a frame
  double tests = 0.0, all_tests = 0.0;                 // lights x cells of those
};

struct Finalist {
  std::size_t candidate = 0;
  std::vector<run::CaseResult> cases;  // on all frames
};

struct Found {
  std::vector<Rung> rungs;
  std::vector<Record> records;      // of each candidate
  std::vector<Finalist> finalists;  // in the order of the candidates
  std::size_t challengers = 0;      // finalists that halving had dropped and that could still have been better
  Work work;
  bool is_complete = false;  // false: stopped
};

struct Watch {
  std::function<void(const run::Progress&)> on_progress;
  const std::atomic<bool>& stop;
  std::function<void(const std::string&)> on_stage = {};  // "4 frames: 113 candidates", at its beginning
};

// Upper bound of the measurements by halving, as far as it is known in advance: its rungs, and the number of finalists
// on all frames. Coarse grids that are about as good and challengers are additional.
Halving planned_halving(const View& view, const Request& request);

// Estimated costs of a view's search, from which its duration and an upper bound follow. `plan` is unchanged
// afterwards.
SearchCosts estimated_costs(const config::Config& config, run::Plan& plan, const View& view, const Request& request);
double estimated_s(const SearchCosts& costs, const View& view, const Request& request);

// `costs`: for the displayed progress. Sets the cells of the view's candidates. Finalists are timed by `launcher`
// (run/runner.h). Throws Error as run_plan() does. `plan` is unchanged afterwards. After a stop, `records` has the
// results so far.
Found search_view(const config::Config& config, run::Plan& plan, View& view, const Request& request,
                  const run::Launcher& launcher, const Watch& watch, const SearchCosts& costs = {});

}  // namespace clusterbench::search
