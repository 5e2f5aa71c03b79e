#pragma once
// Which grid, method and light structure is best for a scene by an objective, under constraints: successive halving
// over the frames of all its cameras (halving.h), then all frames for the few that are left. What figures mean is the
// caller's (Judge).

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "run/runner.h"
#include "search/halving.h"
#include "search/search_cost.h"

namespace clusterbench::search {

// A grid with a method and what keeps its lists: one case on each camera of a scene, in one viewport.
struct Candidate {
  std::string name;  // the case's, without scene and camera
  std::size_t grid = 0;
  std::uint64_t cells = 0;                  // of the grid, once it was looked at
  std::vector<const run::CasePlan*> cases;  // in the order of the cameras
  // Samples search its structure, which is priced by a model only: it competes with its like, and is never the choice
  // while there are others.
  bool is_apart = false;
};

// One question: a scene in a viewport, with all its cameras.
struct View {
  std::size_t scene = 0, viewport = 0;
  std::vector<std::size_t> cameras;
  std::vector<std::size_t> blind;  // cameras that are left out: no light that shines is in view in any of their frames
  std::size_t frames = 0;          // of all cameras together
  std::vector<Candidate> candidates;  // by grid, what is known of methods without times, and name
  std::size_t incomplete = 0;         // left out, since not every camera can have their grid
};
// Refers to the plan.
std::vector<View> views_of(const config::Config& config, const run::Plan& plan);

// What a candidate's cases say, one for each camera with a frame among those that were measured.
struct Verdict {
  double objective = 0.0;           // smaller is better; NaN: the cases do not have it
  double bytes = 0.0;               // decides between equals
  std::vector<std::size_t> broken;  // constraints, ascending
  bool is_final = false;            // one of them stays broken whatever further frames bring
  std::vector<double> broken_by{};  // the figure that breaks each of `broken`; NaN: the cases do not have it
};
using Judge = std::function<Verdict(std::span<const run::CaseResult> cases)>;

struct Request {
  Judge judge;
  bool is_timed = false;    // the judge needs times
  bool only_grows = false;  // the objective on some frames is never more than on all of them
  double within = 0.05;     // of the best: how much worse a coarser grid may be
  std::size_t growth = 4, keep_one_in = 24, least = 6;  // of HalvingRequest
};

// What was found of a candidate where it was last measured.
struct Record {
  std::size_t frames = 0;
  Verdict verdict;
  // Objective / that of the best on the same frames that breaks nothing and is apart as this one is, or is not; NaN:
  // there is none.
  double by_best = 0.0;
};

// Work, beside that of measuring every candidate on every frame. A candidate on a frame counts once, as often as it was
// measured there.
struct Work {
  std::uint64_t measurements = 0;                      // as often as it was, and to order the frames
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
  std::size_t challengers = 0;      // of them, those that halving had dropped and that could still have been better
  Work work;
  bool is_complete = false;  // false: stopped
};

struct Watch {
  std::function<void(const run::Progress&)> on_progress;
  const std::atomic<bool>& stop;
  std::function<void(const std::string&)> on_stage = {};  // "4 frames: 113 candidates", as it begins
};

// The most that halving measures, as far as that is known before anything is: its rungs, and how many finalists on all
// frames. Coarse grids that are about as good and challengers come on top.
Halving planned_halving(const View& view, const Request& request);

// About how long a view's search takes, and how long it can take by that at most. `plan` is as it was afterwards.
SearchCosts estimated_costs(const config::Config& config, run::Plan& plan, const View& view);
double estimated_s(const SearchCosts& costs, const View& view, const Request& request);

// `costs`: for the progress that is told. Sets the cells of the view's candidates. Finalists that are timed are so by
// `launcher` (run/runner.h). Throws Error as run_plan() does. `plan` is as it was afterwards. What was found before a
// stop is in `records`.
Found search_view(const config::Config& config, run::Plan& plan, View& view, const Request& request,
                  const run::Launcher& launcher, const Watch& watch, const SearchCosts& costs = {});

}  // namespace clusterbench::search
