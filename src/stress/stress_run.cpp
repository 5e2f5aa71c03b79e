#include "stress/stress_run.h"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <numeric>

#include "assign/contract/method_error.h"
#include "config/config.h"
#include "core/clock.h"
#include "core/error.h"
#include "core/work_in_order.h"
#include "gpu/device/device.h"
#include "measure/truth/list_errors.h"
#include "os/call_notes.h"
#include "stress/lost_light_search.h"

namespace clusterbench::stress {
namespace {

// A trial, prepared for all methods.
struct Prepared {
  view::Frame frame;
  grid::Grid grid;
  measure::Truth truth;
  std::string refusal;  // why there is no grid
};

Prepared prepared(const Trial& trial, int threads) {
  Prepared out;
  try {
    out.frame = frame_of(trial);
    out.grid = grid_of(trial, out.frame);
  } catch (const Error& error) {
    out.refusal = error.what();
    return out;
  }
  out.truth = measure::find_truth(out.frame, out.grid, threads);
  return out;
}

void add_lists(StressCell& cell, const StressMethod& method, const Trial& trial, const Prepared& at) {
  assign::AssignerRun run = method.start();
  run.build(at.grid);
  const view::LightArrays lights = view::lights_in(at.frame, grid::space_of(at.grid, at.frame));
  const depth::DepthImage depths = depths_for(*method.assigner, at.frame);
  const assign::FrameInput input = input_of(at.frame, lights, depths);
  run.assign(input);
  const assign::Lists lists = run.cell_lists();
  run.assign(input);
  const assign::Lists* filled = run.filled_lists();
  if (!assign::lists_fault(filled ? *filled : lists, lists.cell_count(), lights).empty())
    return cell.faults.push_back(trial.label + ": what it gave are no lists");
  if (lists != run.cell_lists()) cell.faults.push_back(trial.label + ": the same frame gave other lists");
  measure::ErrorCounts counts;
  if (run.has_occupied_cells()) {
    const grid::OccupiedCells cells = run.structure()->occupied_cells();
    measure::add_frame(counts, at.frame, cells, measure::find_truth(at.frame, at.grid, cells, 1), lists);
  } else {
    measure::add_frame(counts, at.frame, at.grid, at.truth, lists);
  }
  cell.true_pairs += counts.true_pairs;
  cell.misses += counts.false_negatives;
  cell.extra_pairs += counts.false_positives;
  cell.undecided += counts.undecided;
  if (!counts.deepest || (cell.deepest && cell.deepest->depth >= counts.deepest->depth)) return;
  cell.deepest = Loss{trial.label, counts.deepest->cell, counts.deepest->light, counts.deepest->depth, trial};
}

void add_trial(StressCell& cell, const StressMethod& method, const Trial& trial, const Prepared& at) {
  if (at.refusal.empty() && !fits(method, at.grid)) return;
  ++cell.trials;
  if (!at.refusal.empty()) {
    ++cell.refused;
    if (!trial.is_refused) cell.faults.push_back(trial.label + ": refused: " + at.refusal);
    return;
  }
  if (trial.is_refused) return cell.faults.push_back(trial.label + ": should have been refused");
  os::note_setting("--cases '^" + cell.hard_case + "$', method " + method.label + ", " + trial.label);
  try {
    add_lists(cell, method, trial, at);
  } catch (const gpu::DeviceError& error) {
    gpu::close_device();
    cell.is_ended = true;
    cell.faults.push_back(trial.label + ": " + error.message() + "; no further trial of this case");
  } catch (const assign::MethodError& error) {
    cell.faults.push_back(trial.label + ": " + error.message());
  }
}

// Work on methods, time and again.
class MethodRounds {
 public:
  MethodRounds(int threads, const std::vector<StressMethod>& methods)
      : pool_(threads), methods_(methods), last_ns_(methods.size(), 0.0) {}

  // Calls work(i) for each method: for several at the same time, and first for those that took longest in the last
  // round, so that no thread waits long for the last one; then for those on a device, one after the other, since one
  // that fails is closed before the next, and so for those of plug-ins, so that it is known which of them crashed. If
  // some throw, this throws what the first method of them has thrown.
  template <class Work>
  void each(const Work& work) {
    std::vector<std::size_t> order(methods_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto first_elsewhere =
        std::stable_partition(order.begin(), order.end(), [&](std::size_t i) { return !runs_elsewhere(i); });
    std::stable_sort(order.begin(), first_elsewhere,
                     [&](std::size_t a, std::size_t b) { return last_ns_[a] > last_ns_[b]; });
    std::vector<std::exception_ptr> failures(methods_.size());
    const auto try_work = [&](std::size_t i) {
      const double start = wall_ns();
      try {
        work(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
      last_ns_[i] = wall_ns() - start;
    };
    each_in_order(pool_, static_cast<std::size_t>(first_elsewhere - order.begin()),
                  [&](std::size_t place) { try_work(order[place]); });
    std::for_each(first_elsewhere, order.end(), try_work);
    for (const std::exception_ptr& failure : failures)
      if (failure) std::rethrow_exception(failure);
  }

 private:
  bool runs_elsewhere(std::size_t i) const {
    return methods_[i].assigner->on_device || !methods_[i].assigner->plugin.empty();
  }

  ThreadPool pool_;
  const std::vector<StressMethod>& methods_;
  std::vector<double> last_ns_;
};

std::vector<StressCell> run_case(const HardCase& hard, const std::vector<StressMethod>& methods, MethodRounds& rounds,
                                 const StressRequest& request, const std::atomic<bool>& stop) {
  std::vector<StressCell> cells;
  for (const StressMethod& method : methods) {
    cells.emplace_back();
    cells.back().hard_case = hard.id;
    cells.back().method = method.label;
  }
  const std::vector<Trial> trials = hard.trials == nullptr ? std::vector<Trial>{} : hard.trials(request.seed);
  for (const Trial& trial : trials) {
    if (stop) break;
    const bool is_wanted =
        std::any_of(methods.begin(), methods.end(), [&](const auto& m) { return supports_trial(m, trial); });
    if (!is_wanted) continue;
    const Prepared at = prepared(trial, request.threads);
    const auto try_method = [&](std::size_t i) {
      if (supports_trial(methods[i], trial) && !cells[i].is_ended) add_trial(cells[i], methods[i], trial, at);
    };
    rounds.each(try_method);
  }
  std::erase_if(cells, [](const StressCell& cell) { return cell.trials == 0; });
  return cells;
}

// One search per method; all advance together, so that one that ends early has searched all about as far.
std::vector<SearchResult> run_searches(const std::vector<StressMethod>& methods, MethodRounds& rounds,
                                       const StressRequest& request,
                                       const std::function<void(const std::string& method, double done)>& on_tries,
                                       const std::atomic<bool>& stop) {
  std::vector<std::unique_ptr<LostLightSearch>> searches(methods.size());
  for (std::size_t i = 0; i < methods.size(); ++i)
    if (!methods[i].assigner->needs.depth)  // it moves lights against the grid's cells
      searches[i] = lost_light_search(methods[i], request);
  const auto is_over = [](const auto& search) { return search == nullptr || search->is_over(); };
  std::mutex telling;
  std::vector<double> done;
  for (const auto& search : searches) done.push_back(search == nullptr ? 1.0 : 0.0);
  const auto climb = [&](std::size_t i) {
    if (stop || is_over(searches[i])) return;
    searches[i]->climb(stop);
    if (methods[i].assigner->on_device && searches[i]->has_failed()) gpu::close_device();
    const std::lock_guard lock(telling);
    done[i] = searches[i]->done();
    on_tries(methods[i].label, std::accumulate(done.begin(), done.end(), 0.0));
  };
  while (!stop && !std::ranges::all_of(searches, is_over)) rounds.each(climb);
  std::vector<SearchResult> results;
  for (const auto& search : searches)
    if (search != nullptr) results.push_back(search->result());
  return results;
}

std::string label_of(const assign::AssignerDescriptor& assigner, const assign::Params& params) {
  return config::MethodRequest{assigner.name, params}.label();
}

// With its defaults and with every other choice.
std::vector<assign::Params> choices_of(const assign::AssignerDescriptor& assigner) {
  std::vector<assign::Params> choices{assign::Params(assigner.params)};
  for (const assign::ParamSpec& spec : assigner.params)
    for (const std::string& choice : spec.choices)
      if (assign::ParamValue(choice) != spec.default_value)
        choices.emplace_back(assigner.params, std::map<std::string, assign::ParamValue>{{spec.name, choice}});
  return choices;
}

// In each form that has cells; a method on a device is started for that.
void add_forms(const assign::AssignerDescriptor& assigner, const assign::Params& params,
               std::vector<StressMethod>& methods) {
  const bool conservative = assign::is_conservative(assigner, params);
  for (const assign::Answer answer : assign::answers_with_cells(assigner, params))
    methods.push_back({label_of(assigner, params), &assigner, params, conservative, answer});
}

// Adds those that run on a device, if it is asked for, by itself or by their names, and they can do so here.
void add_device_methods(const StressRequest& request, StressResult& result) {
  const bool is_of_names = !request.methods.is_in("");
  std::string others;
  for (const assign::AssignerDescriptor* assigner : assign::assigner_descriptors()) {
    if (!assigner->on_device) continue;
    if (!request.takes_device && !is_of_names) {
      others += (others.empty() ? "" : ", ") + assigner->name;
      continue;
    }
    std::vector<assign::Params> choices = choices_of(*assigner);
    std::erase_if(choices, [&](const auto& params) { return !request.methods.is_in(label_of(*assigner, params)); });
    if (choices.empty()) continue;
    if (const std::string reason = assign::unavailability(*assigner, choices.front()); !reason.empty()) {
      result.left_out.push_back(assigner->name + ": " + reason);
      continue;
    }
    for (const assign::Params& params : choices) add_forms(*assigner, params, result.methods);
  }
  if (!others.empty()) result.left_out.push_back(others + ": run on a device, and none is named");
}

// Throws Error with the reason if a pattern of names is of none but methods that cannot run.
void choose_methods(const StressRequest& request, StressResult& result) {
  result.methods = stress_methods();
  std::erase_if(result.methods, [&](const StressMethod& method) { return !request.methods.is_in(method.label); });
  add_device_methods(request, result);
  if (result.methods.empty() && !result.left_out.empty()) throw Error("", "--methods", result.left_out.front());
}

}  // namespace

std::vector<StressMethod> stress_methods() {
  std::vector<StressMethod> methods;
  for (const assign::AssignerDescriptor* assigner : checked_methods())
    for (const assign::Params& params : choices_of(*assigner)) add_forms(*assigner, params, methods);
  return methods;
}

StressResult run_stress(const StressRequest& request, const StressListener& listener, const std::atomic<bool>& stop) {
  StressResult result;
  choose_methods(request, result);
  if (listener.on_left_out)
    for (const std::string& reason : result.left_out) listener.on_left_out(reason);
  for (const HardCase& hard : hard_cases())
    if (request.cases.is_all_of(hard.id)) result.cases.push_back(hard);
  const bool searches = request.tries > 0 && request.cases.is_all_of("H31");
  const double parts = static_cast<double>(result.cases.size() + (searches ? result.methods.size() : 0));
  const double whole = parts + static_cast<double>(request.random);
  const auto report_progress = [&](const std::string& doing, double done) {
    if (listener.on_progress) listener.on_progress(doing, done, whole);
  };
  MethodRounds rounds(request.threads, result.methods);
  double done = 0.0;
  for (const HardCase& hard : result.cases) {
    if (stop) break;
    report_progress(std::string(hard.id) + " " + hard.title, done++);
    std::vector<ToolCheck> checks = hard.checks == nullptr ? std::vector<ToolCheck>{} : hard.checks(request.seed);
    const std::vector<StressCell> cells = run_case(hard, result.methods, rounds, request, stop);
    if (stop) break;  // the case is incomplete
    result.checks.push_back(std::move(checks));
    result.cells.insert(result.cells.end(), cells.begin(), cells.end());
  }
  result.cases.resize(result.checks.size());
  if (searches && !stop) {
    const auto on_tries = [&](const std::string& method, double methods_done) {
      report_progress("H31 " + method, done + methods_done);
    };
    result.searches = run_searches(result.methods, rounds, request, on_tries, stop);
    std::erase_if(result.searches,
                  [](const SearchResult& search) { return search.tries == 0 && search.fault.empty(); });
  }
  if (request.random > 0 && !stop) {
    const auto on_settings = [&](std::uint64_t settings, const std::string& doing) {
      report_progress(doing, parts + static_cast<double>(settings));
    };
    result.random = search_at_random(result.methods, request, on_settings, stop);
  }
  result.interrupted = stop;
  return result;
}

}  // namespace clusterbench::stress
