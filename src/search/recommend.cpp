#include "search/recommend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <tuple>

#include "assign/contract/method_error.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/text.h"
#include "core/turns.h"
#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "run/case_result.h"
#include "run/cases/path_frames.h"
#include "run/passes/accuracy_pass.h"
#include "run/passes/timing_pass.h"

namespace clusterbench::search {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinite = std::numeric_limits<double>::infinity();

// The first number of a standing's rank.
constexpr double k_first = 0.0, k_equal = 1.0, k_broken = 2.0;

// A frame of a view: index of the camera, and of that camera's frame.
struct FrameOfView {
  std::size_t camera = 0;
  int index = 0;
};

// A small number of candidates on few frames are all measured, so that the ranking by the first frame excludes none.
HalvingRequest halving_of(const View& view, const Request& request) {
  constexpr std::size_t k_few = 256;
  const std::size_t first_frames = view.candidates.size() * view.frames <= k_few ? view.frames : 1;
  HalvingRequest halving{view.candidates.size(), view.frames,         first_frames,
                         request.growth,         request.keep_one_in, request.least};
  for (const Candidate& candidate : view.candidates) halving.apart.push_back(candidate.is_apart);
  return halving;
}

// Grids of the view, on its first camera: they are the same on all.
std::size_t grids_of(const View& view) {
  std::set<std::size_t> grids;
  for (const Candidate& candidate : view.candidates) grids.insert(candidate.grid);
  return grids.size();
}

// On how many frames the planned search counts a candidate, on average.
double frames_of_candidate(const View& view, const Request& request) {
  const Halving planned = planned_halving(view, request);
  std::size_t counted = (planned.finalists.size() + k_most_coarse) * view.frames;
  for (const Rung& rung : planned.rungs) counted += rung.candidates * rung.frames;
  return static_cast<double>(counted) / static_cast<double>(view.candidates.size());
}

// After all frames of the view: a constraint whose figure is unknown is not satisfied.
Verdict verdict_on_all_frames(Verdict verdict) {
  for (const std::size_t constraint : verdict.unknown) {
    const auto place = std::ranges::lower_bound(verdict.broken, constraint);
    verdict.broken_by.insert(verdict.broken_by.begin() + (place - verdict.broken.begin()), k_unknown);
    verdict.broken.insert(place, constraint);
  }
  return verdict;
}

class ViewSearch {
 public:
  ViewSearch(const config::Config& config, run::Plan& plan, View& view, const Request& request,
             const run::Launcher& launcher, const Watch& watch, const SearchCosts& costs)
      : config_(config),
        quick_(quickly_timed(config)),
        plan_(plan),
        view_(view),
        request_(request),
        launcher_(launcher),
        watch_(watch),
        costs_(costs),
        grids_(grids_of(view)) {
    for (const std::size_t camera : view.cameras)
      paths_.push_back(run::path_of(config, plan.scenes[view.scene], camera, view.viewport));
    found_.records.resize(view.candidates.size());
  }

  Found search() {
    plan_progress();
    order_frames();
    Halving halved = halve(
        halving_of(view_, request_),
        [&](std::span<const std::size_t> candidates, std::size_t frames) { return standings(candidates, frames); });
    found_.rungs = std::move(halved.rungs);
    std::vector<std::size_t> chosen = std::move(halved.finalists);
    add_coarse(chosen);
    add_finalists(chosen);
    if (request_.only_grows) add_challengers();
    std::ranges::sort(found_.finalists, {}, &Finalist::candidate);
    count_work();
    found_.is_complete = !watch_.stop;
    return std::move(found_);
  }

 private:
  // The frame with the most pairs first, by the lists of one method; then an order whose every prefix is spread over
  // the paths. A first frame without lights would not distinguish candidates.
  void order_frames() {
    std::vector<FrameOfView> frames;
    for (std::size_t camera = 0; camera < paths_.size(); ++camera)
      for (int index = 0; index < paths_[camera].count(); ++index) frames.push_back({camera, index});
    const std::vector<double> pairs = pairs_of(frames);
    const auto fullest = static_cast<std::size_t>(std::ranges::max_element(pairs) - pairs.begin());
    for (const std::size_t index : spread_order(frames.size(), fullest)) order_.push_back(frames[index]);
  }

  std::vector<double> pairs_of(std::span<const FrameOfView> frames) {
    std::vector<double> pairs(frames.size(), 0.0);
    if (view_.candidates.empty()) return pairs;
    config::Config counting = config_;
    counting.threads = 1;
    counting.accuracy.check = false;
    counting.sample_sets.clear();
    counting.lookup.reset();
    const Candidate& probe = view_.candidates.front();
    begin_stage("the lights of " + number_of(frames.size(), "frame"), frames.size(),
                costs_.candidate_ns * static_cast<double>(frames.size()));
    const std::size_t first_candidate = 0;
    each_apart(std::span(&first_candidate, 1), frames.size(), [&](std::size_t i, int) {
      report_done();
      pairs[i] = pairs_of(counting, probe, frames[i]);
    });
    found_.work.measurements += frames.size();
    return pairs;
  }

  double pairs_of(const config::Config& counting, const Candidate& candidate, const FrameOfView& frame) const {
    const run::GroupPlan group = group_of({&candidate, 1}, frame.camera);
    const run::AccuracyResult found = counted(counting, group, paths_[frame.camera].only({frame.index}));
    if (!found.is_complete) return 0.0;
    return found.methods[0].has_cells ? found.methods[0].occupancy.pairs.max
                                      : static_cast<double>(found.structures[0].buffers.index_entries.high_water);
  }

  // Calls work(i, threads) for 0 <= i < count: at the same time, each with its own number of threads, if none of the
  // candidates runs elsewhere; else one after the other.
  template <class Work>
  void each_apart(std::span<const std::size_t> candidates, std::size_t count, const Work& work) {
    const bool is_alone = std::ranges::any_of(candidates, [&](std::size_t candidate) {
      return runs_elsewhere(config_, group_of({&view_.candidates[candidate], 1}, 0));
    });
    ThreadPool pool(is_alone ? 1 : config_.threads);
    each_in_order(pool, count, [&](std::size_t i) {
      if (!watch_.stop) work(i, is_near_end(i, count, pool) ? config_.threads : 1);
    });
  }

  // The cases of candidates of one grid on one of the view's cameras.
  run::GroupPlan group_of(std::span<const Candidate> candidates, std::size_t camera) const {
    run::GroupPlan group{view_.scene, view_.cameras[camera], view_.viewport, candidates.front().grid, {}};
    for (const Candidate& candidate : candidates) group.cases.push_back(*candidate.cases[camera]);
    return group;
  }

  void add_work(const Candidate& candidate, std::uint64_t cells, std::size_t frames) {
    const std::lock_guard lock(sharing_);
    view_.candidates[static_cast<std::size_t>(&candidate - view_.candidates.data())].cells = cells;
    found_.work.measurements += frames;
  }

  double lights() const { return static_cast<double>(plan_.scenes[view_.scene].scene.lights.size()); }

  // Its errors name the group's first case, but for those of devices and plug-ins, which name the method.
  run::AccuracyResult counted(const config::Config& config, const run::GroupPlan& group,
                              const run::PathFrames& path) const {
    try {
      return accuracy_pass(
          config, plan_.scenes[view_.scene], group, path, [](int) {}, watch_.stop);
    } catch (const gpu::DeviceError&) {
      throw;
    } catch (const assign::MethodError&) {
      throw;
    } catch (const Error& error) {
      throw error_at(group, error);
    }
  }

  // The counts of candidates of one grid on one camera.
  struct CountedCamera {
    run::GroupPlan group;
    run::PathFrames path;
    run::AccuracyResult counted;
  };

  // Counts some candidates of one grid on some frames, camera by camera with some of these frames. Several threads may
  // call it.
  std::vector<CountedCamera> counted(std::span<const std::size_t> candidates, std::span<const FrameOfView> frames,
                                     int threads) const {
    config::Config config = config_;
    config.threads = threads;
    std::vector<Candidate> some;
    for (const std::size_t candidate : candidates) some.push_back(view_.candidates[candidate]);
    std::vector<CountedCamera> cameras;
    for (std::size_t camera = 0; camera < paths_.size(); ++camera) {
      std::vector<int> indices;
      for (const FrameOfView& frame : frames)
        if (frame.camera == camera) indices.push_back(frame.index);
      if (indices.empty()) continue;
      std::ranges::sort(indices);
      CountedCamera& now =
          cameras.emplace_back(CountedCamera{group_of(some, camera), paths_[camera].only(indices), {}});
      const BudgetShare share(lists_, run::most_list_bytes(config, now.group, now.path), watch_.stop);
      now.counted = counted(config, now.group, now.path);
    }
    return cameras;
  }

  // The cases of the candidates, one per counted camera, with quick times if they are wanted.
  std::vector<std::vector<run::CaseResult>> measured(std::span<const std::size_t> candidates,
                                                     const std::vector<CountedCamera>& cameras, bool is_timed) {
    std::vector<std::vector<run::CaseResult>> cases(candidates.size());
    for (const auto& [group, path, counted] : cameras) {
      if (!counted.is_complete) return {};
      const std::vector<run::TimingResult> times =
          is_timed ? quick_times(group, path) : std::vector<run::TimingResult>{};
      if (watch_.stop) return {};
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        cases[i].push_back(case_result(config_, plan_, group.cases[i], path.count(), counted, i));
        if (!times.empty()) cases[i].back().timing = times[i];
        add_work(view_.candidates[candidates[i]], counted.last_grid.cell_count(),
                 static_cast<std::size_t>(path.count()));
      }
    }
    return cases;
  }

  // Counts candidates on some frames, grid by grid, and calls use(candidates, cases) for those of each grid: on several
  // threads, but what is timed runs alone, after all counting.
  template <class Use>
  void measure_grids(std::span<const std::size_t> candidates, std::span<const FrameOfView> frames, bool is_timed,
                     const Use& use) {
    std::vector<std::vector<std::size_t>> grids;
    for (auto& [grid, some] : by_grid(candidates)) grids.push_back(std::move(some));
    std::vector<std::vector<CountedCamera>> counts(grids.size());
    const auto finish = [&](std::size_t i) {
      std::vector<std::vector<run::CaseResult>> cases = measured(grids[i], std::exchange(counts[i], {}), is_timed);
      if (!watch_.stop) use(grids[i], std::move(cases));
    };
    each_apart(candidates, grids.size(), [&](std::size_t i, int threads) {
      counts[i] = counted(grids[i], frames, threads);
      if (!is_timed) finish(i);
      report_done(grids[i].size());
    });
    if (is_timed)
      for (std::size_t i = 0; i < grids.size() && !watch_.stop; ++i) finish(i);
  }

  std::vector<run::TimingResult> quick_times(const run::GroupPlan& group, const run::PathFrames& path) const {
    const run::LaunchRequest launch{0, quick_.timing.rounds, {}, {}, k_quick_warm_rounds};
    const run::GroupSamples samples = measure_launch(
        quick_, group, path, launch, [](int) {}, watch_.stop);
    if (samples.methods.empty()) return {};
    return timing_results(quick_, group, std::span(&samples, 1));
  }

  // Groups candidates by their grids, in the order of the grids.
  std::map<std::size_t, std::vector<std::size_t>> by_grid(std::span<const std::size_t> candidates) const {
    std::map<std::size_t, std::vector<std::size_t>> grids;
    for (const std::size_t candidate : candidates) grids[view_.candidates[candidate].grid].push_back(candidate);
    return grids;
  }

  Verdict verdict_of(std::span<const run::CaseResult> cases, std::size_t frames) const {
    const Verdict verdict = request_.evaluate(cases);
    return frames == view_.frames ? verdict_on_all_frames(verdict) : verdict;
  }

  // Records the results of candidates on the first frames of the order.
  void record(std::span<const std::size_t> candidates, std::size_t frames) {
    begin_stage(number_of(frames, "frame") + ": " + number_of(candidates.size(), "candidate"), candidates.size(),
                costs_.rung_ns(candidates.size(), grids_, frames));
    measure_grids(candidates, std::span(order_).first(frames), request_.is_timed,
                  [&](std::span<const std::size_t> some, const std::vector<std::vector<run::CaseResult>>& cases) {
                    for (std::size_t i = 0; i < some.size(); ++i)
                      found_.records[some[i]] = {frames, verdict_of(cases[i], frames), k_unknown};
                  });
    if (watch_.stop) return;
    for (const bool is_apart : {false, true}) compare_with_best(frames, is_apart);
  }

  // For all candidates whose last measurement was on this number of frames, and so on the same frames.
  void compare_with_best(std::size_t frames, bool is_apart) {
    const auto is_compared = [&](std::size_t candidate) {
      return found_.records[candidate].frames == frames && view_.candidates[candidate].is_apart == is_apart;
    };
    double best = k_infinite;
    for (std::size_t candidate = 0; candidate < found_.records.size(); ++candidate)
      if (const Verdict& verdict = found_.records[candidate].verdict; is_compared(candidate) && verdict.broken.empty())
        best = std::fmin(best, verdict.objective);
    if (best == k_infinite) return;
    for (std::size_t candidate = 0; candidate < found_.records.size(); ++candidate) {
      if (!is_compared(candidate)) continue;
      Record& record = found_.records[candidate];
      record.by_best = record.verdict.objective == best ? 1.0 : record.verdict.objective / best;
    }
  }

  // A candidate that breaks a constraint so far comes after all that do not: further frames can change it.
  std::vector<Standing> standings(std::span<const std::size_t> candidates, std::size_t frames) {
    record(candidates, frames);
    std::vector<Standing> all;
    for (const std::size_t index : candidates) {
      const Verdict& verdict = found_.records[index].verdict;
      const double objective = std::isnan(verdict.objective) ? k_infinite : verdict.objective;
      all.push_back({watch_.stop || verdict.is_final,
                     {verdict.broken.empty() ? k_first : k_broken, objective, verdict.bytes,
                      static_cast<double>(view_.candidates[index].cells)}});
    }
    const auto is_apart = [&](std::size_t i) { return view_.candidates[candidates[i]].is_apart; };
    put_back_equals(all, [&](std::size_t i) {
      return std::pair(is_apart(i), static_cast<double>(view_.candidates[candidates[i]].grid));
    });
    put_back_equals(all, [&](std::size_t i) { return std::pair(is_apart(i), -1.0 - all[i].rank[2]); });
    return all;
  }

  // Moves duplicates to the end: of standings with equal key and objective only the best-ranked one keeps its place.
  // They are lists of one grid in different storages, or a structure that depends on its grids only by name.
  template <class KeyOf>
  static void put_back_equals(std::vector<Standing>& all, const KeyOf& key_of_standing) {
    std::map<std::pair<std::pair<bool, double>, double>, std::size_t> first;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].rank[0] != k_first) continue;
      const auto [equal, is_new] = first.try_emplace({key_of_standing(i), all[i].rank[1]}, i);
      if (is_new) continue;
      const bool is_smaller = all[i].rank < all[equal->second].rank;
      all[is_smaller ? equal->second : i].rank[0] = k_equal;
      if (is_smaller) equal->second = i;
    }
  }

  // Adds the best candidate of each of the coarsest grids that are about as good as the best one on the frames so far:
  // only all frames can confirm it.
  void add_coarse(std::vector<std::size_t>& chosen) const {
    std::map<std::pair<std::uint64_t, std::size_t>, std::size_t> best;  // by cells and grid
    for (std::size_t i = 0; i < view_.candidates.size(); ++i) {
      const Record& record = found_.records[i];
      const Candidate& candidate = view_.candidates[i];
      if (!record.verdict.broken.empty() || !(record.by_best <= 1.0 + request_.within) || candidate.is_apart) continue;
      const auto [place, is_new] = best.try_emplace({candidate.cells, candidate.grid}, i);
      if (!is_new && rank_of(record) < rank_of(found_.records[place->second])) place->second = i;
    }
    std::size_t count = 0;
    for (const auto& [grid, candidate] : best) {
      if (count++ == k_most_coarse) break;
      if (std::ranges::find(chosen, candidate) == chosen.end()) chosen.push_back(candidate);
    }
  }

  static std::tuple<double, double> rank_of(const Record& record) { return {record.by_best, record.verdict.bytes}; }

  void add_finalists(std::vector<std::size_t> candidates) {
    std::ranges::sort(candidates);
    begin_stage("all " + number_of(view_.frames, "frame") + ": " + number_of(candidates.size(), "candidate"),
                candidates.size(), costs_.last_ns(candidates.size(), grids_, view_.frames));
    progress_.cost_total = before_stage_ns_ + stage_ns_;  // no further stage is planned
    report_progress(0);
    std::vector<Finalist> finalists = request_.is_timed ? timed_finalists(candidates) : counted_finalists(candidates);
    if (watch_.stop) return;
    for (Finalist& finalist : finalists) {
      found_.records[finalist.candidate] = {view_.frames, verdict_of(finalist.cases, view_.frames), k_unknown};
      found_.finalists.push_back(std::move(finalist));
    }
  }

  std::vector<Finalist> counted_finalists(std::span<const std::size_t> candidates) {
    std::vector<Finalist> finalists;
    measure_grids(candidates, order_, false,
                  [&](std::span<const std::size_t> some, std::vector<std::vector<run::CaseResult>> cases) {
                    const std::lock_guard lock(sharing_);
                    for (std::size_t i = 0; i < some.size(); ++i) finalists.push_back({some[i], std::move(cases[i])});
                  });
    return watch_.stop ? std::vector<Finalist>{} : std::move(finalists);
  }

  // Measured as in `run`: interleaved, in several launches.
  std::vector<Finalist> timed_finalists(std::span<const std::size_t> candidates) {
    std::vector<run::GroupPlan> groups;
    for (const auto& [grid, some] : by_grid(candidates)) {
      std::vector<Candidate> of_grid;
      for (const std::size_t candidate : some) of_grid.push_back(view_.candidates[candidate]);
      for (std::size_t camera = 0; camera < paths_.size(); ++camera) groups.push_back(group_of(of_grid, camera));
    }
    std::swap(plan_.groups, groups);
    run::Listener listener;
    listener.on_progress = [&](const run::Progress& now) {
      report_progress(now.cases_done / std::max<std::size_t>(1, view_.cameras.size()), now.cost_done / now.cost_total);
    };
    const run::Result result = run_plan(config_, plan_, {}, listener, watch_.stop, {}, launcher_);
    std::swap(plan_.groups, groups);
    if (watch_.stop) return {};
    std::vector<Finalist> finalists;
    for (const std::size_t index : candidates) {
      const Candidate& candidate = view_.candidates[index];
      Finalist& finalist = finalists.emplace_back(Finalist{index, {}});
      for (const run::CasePlan* plan : candidate.cases)
        finalist.cases.push_back(*std::ranges::find(result.cases, plan->id, &run::CaseResult::id));
      add_work(candidate, candidate.cells, view_.frames);
    }
    return finalists;
  }

  double best_objective() const {
    double best = k_infinite;
    for (const Finalist& finalist : found_.finalists)
      if (const Verdict& verdict = found_.records[finalist.candidate].verdict;
          verdict.broken.empty() && !view_.candidates[finalist.candidate].is_apart)
        best = std::fmin(best, verdict.objective);
    return best;
  }

  // A dropped candidate with an objective below the best one's may still be better: an objective that only grows
  // excludes it once it has grown beyond.
  void add_challengers() {
    std::vector<std::size_t> challengers;
    const double best = best_objective();
    const auto may_win = [&](std::size_t candidate) {
      const Verdict& verdict = found_.records[candidate].verdict;
      return !verdict.is_final && verdict.objective < best && !view_.candidates[candidate].is_apart;
    };
    for (std::size_t i = 0; i < view_.candidates.size(); ++i)
      if (found_.records[i].frames < view_.frames && may_win(i)) challengers.push_back(i);
    for (std::size_t frames = request_.growth; frames < view_.frames; frames *= request_.growth) {
      if (challengers.empty() || watch_.stop) return;
      std::vector<std::size_t> behind;
      std::ranges::copy_if(challengers, std::back_inserter(behind),
                           [&](std::size_t i) { return found_.records[i].frames < frames; });
      record(behind, frames);
      std::erase_if(challengers, [&](std::size_t i) { return !may_win(i); });
    }
    if (challengers.empty() || watch_.stop) return;
    found_.challengers = challengers.size();
    add_finalists(challengers);
  }

  // Each stage begins with the frames of the previous one, so a candidate's last stage contains all frames on which it
  // was measured.
  void count_work() {
    for (std::size_t i = 0; i < view_.candidates.size(); ++i) {
      const double tests_of_frame = static_cast<double>(view_.candidates[i].cells) * lights();
      found_.work.evaluations += found_.records[i].frames;
      found_.work.tests += static_cast<double>(found_.records[i].frames) * tests_of_frame;
      found_.work.all_evaluations += view_.frames;
      found_.work.all_tests += static_cast<double>(view_.frames) * tests_of_frame;
    }
  }

  void plan_progress() {
    progress_.cost_total = costs_.candidate_ns * static_cast<double>(view_.frames) +
                           planned_ns(costs_, planned_halving(view_, request_), grids_, view_.frames);
  }

  // `ns`: its planned cost.
  void begin_stage(const std::string& stage, std::size_t total, double ns) {
    progress_.doing = plan_.scenes[view_.scene].scene.name + ": " + stage;
    progress_.cases_done = 0;
    progress_.cases_total = total;
    before_stage_ns_ += stage_ns_;
    stage_ns_ = ns;
    if (watch_.on_stage && !watch_.stop) watch_.on_stage(progress_.doing);
  }
  // So many more of the stage's candidates are counted: on any thread.
  void report_done(std::size_t more = 1) {
    const std::lock_guard lock(sharing_);
    report_progress(progress_.cases_done + more);
  }
  // `done` of the stage's candidates.
  void report_progress(std::size_t done) {
    report_progress(done, static_cast<double>(done) / static_cast<double>(progress_.cases_total));
  }
  void report_progress(std::size_t done, double share_of_stage) {
    progress_.cases_done = done;
    if (!watch_.on_progress) return;
    progress_.cost_done = before_stage_ns_ + stage_ns_ * share_of_stage;
    progress_.cost_total = std::max(progress_.cost_total, before_stage_ns_ + stage_ns_);
    watch_.on_progress(progress_);
  }

  const config::Config& config_;
  const config::Config quick_;
  run::Plan& plan_;
  View& view_;
  const Request& request_;
  const run::Launcher& launcher_;
  const Watch& watch_;
  const SearchCosts& costs_;
  std::size_t grids_;
  std::vector<run::PathFrames> paths_;  // of the cameras, whole
  std::vector<FrameOfView> order_;
  Found found_;
  mutable Budget lists_{static_cast<double>(memory_limit())};  // of grids that are counted at the same time, in bytes
  std::mutex sharing_;                                         // what threads add to: finalists, work and progress
  run::Progress progress_;
  double before_stage_ns_ = 0.0, stage_ns_ = 0.0;
};

}  // namespace

Halving planned_halving(const View& view, const Request& request) {
  return halve(halving_of(view, request), [](std::span<const std::size_t> candidates, std::size_t) {
    return std::vector<Standing>(candidates.size());
  });
}

SearchCosts estimated_costs(const config::Config& config, run::Plan& plan, const View& view, const Request& request) {
  if (view.candidates.empty()) return {};
  std::vector<run::GroupPlan> groups;
  for (const run::GroupPlan& group : plan.groups)
    if (group.scene == view.scene && group.viewport == view.viewport &&
        std::ranges::find(view.cameras, group.camera) != view.cameras.end())
      groups.push_back(group);
  return sampled_costs(config, plan, groups,
                       frames_of_candidate(view, request) / static_cast<double>(view.cameras.size()));
}

double estimated_s(const SearchCosts& costs, const View& view, const Request& request) {
  return 1e-9 * planned_ns(costs, planned_halving(view, request), grids_of(view), view.frames);
}

Found search_view(const config::Config& config, run::Plan& plan, View& view, const Request& request,
                  const run::Launcher& launcher, const Watch& watch, const SearchCosts& costs) {
  return ViewSearch(config, plan, view, request, launcher, watch, costs).search();
}

}  // namespace clusterbench::search
