#include "report/searches/stress_report.h"

#include <algorithm>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "core/text.h"

namespace clusterbench::report {
namespace {

std::string share_in_percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

std::uint64_t tally(int value) {
  return static_cast<std::uint64_t>(value);
}

result::Nullable<result::LostLight> lost_light(const std::optional<stress::Loss>& loss) {
  if (!loss) return {};
  return result::LostLight{loss->trial, loss->cell, loss->light, loss->depth};
}

result::HardCaseOfMethod case_of_method(const stress::StressCell& cell) {
  return {.hard_case = cell.hard_case,
          .method = cell.method,
          .trials = tally(cell.trials),
          .refused = tally(cell.refused),
          .true_pairs = cell.true_pairs,
          .misses = cell.misses,
          .deepest_miss = lost_light(cell.deepest),
          .extra_pairs = cell.extra_pairs,
          .undecided = cell.undecided,
          .faults = cell.faults};
}

result::RandomFault random_fault(const stress::RandomFault& found) {
  result::RandomFault out{.name = found.name(),
                          .kind = stress::fault_kind_name(found.fault.kind),
                          .grid = grid::kind_name(found.grid),
                          .orthographic = found.orthographic,
                          .light = stress::type_name(found.fault.type),
                          .settings = found.settings,
                          .seeds = found.seeds,
                          .detail = found.fault.detail};
  if (!found.fault.method.empty()) out.method = found.fault.method;
  return out;
}

result::Nullable<result::RandomSettings> random_settings(const std::optional<stress::RandomSearch>& random) {
  if (!random) return {};
  const stress::SettingCounts& counts = random->counts;
  result::RandomSettings out{.first_seed = random->first_seed,
                             .settings = counts.settings,
                             .refused = counts.refused,
                             .points = counts.points,
                             .spots = counts.spots,
                             .boxes = counts.boxes,
                             .pairs = counts.pairs,
                             .true_pairs = counts.true_pairs,
                             .listed_pairs = counts.compared_pairs,
                             .decisions = counts.decisions,
                             .cells_sampled = counts.sampled,
                             .undecided = counts.undecided,
                             .lights_shaded = counts.shaded};
  for (std::size_t kind = 0; kind < counts.by_kind.size(); ++kind)
    out.settings_by_grid.emplace_back(grid::kind_name(static_cast<grid::Kind>(kind)), counts.by_kind[kind]);
  for (int kind = 0; kind < stress::k_fault_kinds; ++kind) {
    std::uint64_t settings = 0;
    for (const stress::RandomFault& found : random->faults)
      if (static_cast<int>(found.fault.kind) == kind) settings += found.settings;
    out.fault_count.emplace_back(stress::fault_kind_name(static_cast<stress::FaultKind>(kind)), settings);
  }
  for (const stress::RandomFault& found : random->faults) out.faults.push_back(random_fault(found));
  return out;
}

std::string in_lines(const stress::RandomFault& found) {
  return found.name() + ": " + found.fault.detail + " (seed " + std::to_string(found.seeds.front()) +
         (found.fault.is_of_device ? "" : ", shrunk") + "; shown by " + number_of(found.settings, "setting") + ")";
}

void print_random(std::ostream& out, const stress::RandomSearch& random) {
  const stress::SettingCounts& counts = random.counts;
  out << "\nRandom settings: " << counts.settings << " (seeds from " << random.first_seed << " on), " << counts.refused
      << " of them refused; " << number_of(counts.points, "point") << ", " << number_of(counts.spots, "spot") << ", "
      << counts.boxes << " boxes"
      << "\n  " << number_of(counts.pairs, "pair") << ", " << counts.true_pairs << " true; " << counts.decisions
      << " decided one by one, " << counts.undecided << " undecided; " << number_of(random.faults.size(), "fault")
      << "\n";
  if (counts.settings > 0 && counts.compared_pairs == 0 && random.faults.empty())
    out << "  nothing was checked of any method: no conservative one takes the grid and the lights of a setting, or "
           "lists "
           "a pair; --random with a larger number draws more\n";
  for (const stress::RandomFault& found : random.faults) out << "  " << in_lines(found) << "\n";
}

const stress::StressMethod& method_of(const stress::StressResult& result, const std::string& label) {
  return *std::find_if(result.methods.begin(), result.methods.end(),
                       [&](const stress::StressMethod& method) { return method.label == label; });
}

// Columns of the matrix: all settings of a conservative assigner share one, each setting of the others has its own.
std::string column_of(const stress::StressMethod& method) {
  return method.assigner->conservative ? method.assigner->name : method.label;
}

std::vector<std::string> columns(const stress::StressResult& result) {
  std::vector<std::string> list;
  for (const stress::StressMethod& method : result.methods)
    if (std::find(list.begin(), list.end(), column_of(method)) == list.end()) list.push_back(column_of(method));
  return list;
}

std::string mark(const stress::StressResult& result, const std::string& hard_case, const std::string& column) {
  std::uint64_t misses = 0;
  int trials = 0, refused = 0;
  bool has_fault = false;
  for (const stress::StressCell& cell : result.cells) {
    if (cell.hard_case != hard_case || column_of(method_of(result, cell.method)) != column) continue;
    misses += cell.misses;
    trials += cell.trials;
    refused += cell.refused;
    has_fault = has_fault || !cell.faults.empty();
  }
  if (trials == 0) return "-";
  if (has_fault) return "FAULT";
  if (misses > 0) return std::to_string(misses);
  return refused == trials ? "refused" : "ok";
}

std::string in_lines(const stress::StressCell& cell) {
  std::string text = cell.hard_case + " " + cell.method + ": " + std::to_string(cell.misses) + " of " +
                     number_of(cell.true_pairs, "pair") + " lost";
  if (cell.deepest)
    text += ", the deepest " + share_in_percent(cell.deepest->depth) + " of its range inside (" + cell.deepest->trial +
            ", cell " + std::to_string(cell.deepest->cell) + ", light " + std::to_string(cell.deepest->light) + ")";
  return text;
}

void print_matrix(std::ostream& out, const stress::StressResult& result) {
  constexpr int k_width = 7;
  const std::vector<std::string> names = columns(result);
  out << "Pairs lost by hard case and method. ok: none; refused: as it should be; -: not taken by the "
         "method; FAULT: its lists are not what it promises\n\n";
  for (std::size_t i = 0; i < names.size(); ++i) out << std::setw(4) << i + 1 << "  " << names[i] << "\n";
  out << "\n    ";
  for (std::size_t i = 0; i < names.size(); ++i) out << std::setw(k_width) << i + 1;
  out << "\n";
  for (const stress::HardCase& hard : result.cases) {
    if (hard.trials == nullptr) continue;
    out << std::left << std::setw(4) << hard.id << std::right;
    for (const std::string& name : names) out << std::setw(k_width) << mark(result, hard.id, name);
    out << "  " << hard.title << "\n";
  }
  std::uint64_t undecided = 0;
  for (const stress::StressCell& cell : result.cells) undecided += cell.undecided;
  out << "\nPairs that the truth left undecided: " << undecided << "\n";
}

// Extra pairs over all cases, in % of the true ones.
void print_extra(std::ostream& out, const stress::StressResult& result) {
  out << "\nExtra pairs over all hard cases, in % of the true ones\n";
  for (const stress::StressMethod& method : result.methods) {
    std::uint64_t extra = 0, whole = 0;
    for (const stress::StressCell& cell : result.cells)
      if (cell.method == method.label) {
        extra += cell.extra_pairs;
        whole += cell.true_pairs;
      }
    if (whole > 0)
      out << "  " << method.label << ": " << share_in_percent(static_cast<double>(extra) / static_cast<double>(whole))
          << "\n";
  }
}

void print_losses(std::ostream& out, const stress::StressResult& result) {
  bool any = false;
  for (const stress::StressCell& cell : result.cells) {
    if (cell.lost()) out << (any ? "" : "\nLosses\n") << "  " << in_lines(cell) << "\n";
    any = any || cell.lost();
  }
}

void print_checks(std::ostream& out, const stress::StressResult& result) {
  out << "\nChecks of the tool\n";
  for (std::size_t i = 0; i < result.cases.size(); ++i)
    for (const stress::ToolCheck& check : result.checks[i])
      out << "  " << std::left << std::setw(4) << result.cases[i].id << std::right
          << (check.passed ? "ok      " : "FAILED  ") << check.what
          << (check.detail.empty() ? "" : " (" + check.detail + ")") << "\n";
}

void print_searches(std::ostream& out, const stress::StressResult& result) {
  if (result.searches.empty()) return;
  out << "\nH31, search for lights that touch a cell and are not listed (margin: the least padding that was found, in "
         "roundoffs of 2^-24)\n";
  for (const stress::SearchResult& search : result.searches) {
    out << "  " << search.method << ": " << search.tries << " tries, ";
    if (search.deepest)
      out << search.misses << " lost, the deepest " << share_in_percent(search.deepest->depth)
          << " of its range inside\n";
    else
      out << "none lost, margin " << search.least_margin << "\n";
    if (!search.fault.empty()) out << "    ended by the device: " << search.fault << "\n";
    if (search.undecided > 0) out << "    " << search.undecided << " more not listed, and undecided\n";
  }
}

}  // namespace

result::Stress stress_document(const stress::StressResult& result, const stress::StressRequest& request) {
  result::Stress out{.schema_version = 1,
                     .kind = "stress",
                     .seed = request.seed,
                     .tries = request.tries,
                     .interrupted = result.interrupted,
                     .random = random_settings(result.random),
                     .failures = stress_failures(result)};
  for (const stress::StressMethod& method : result.methods)
    out.methods.push_back({method.label, method.conservative, method.assigner->exact});
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    result::HardCase& hard_case = out.cases.emplace_back();
    hard_case.id = result.cases[i].id;
    hard_case.title = result.cases[i].title;
    for (const stress::ToolCheck& check : result.checks[i])
      hard_case.checks.push_back({check.what, check.passed, check.detail});
  }
  for (const stress::StressCell& cell : result.cells) out.results.push_back(case_of_method(cell));
  for (const stress::SearchResult& search : result.searches)
    out.searches.push_back({.method = search.method,
                            .tries = search.tries,
                            .misses = search.misses,
                            .undecided = search.undecided,
                            .least_margin_roundoffs = search.least_margin,
                            .deepest_miss = lost_light(search.deepest)});
  return out;
}

void print_stress(std::ostream& out, const stress::StressResult& result) {
  if (!result.cases.empty()) {
    print_matrix(out, result);
    print_losses(out, result);
    print_extra(out, result);
    print_checks(out, result);
  }
  print_searches(out, result);
  if (result.random) print_random(out, *result.random);
}

std::vector<std::string> stress_failures(const stress::StressResult& result) {
  std::vector<std::string> failures;
  for (const stress::StressCell& cell : result.cells) {
    for (const std::string& fault : cell.faults) failures.push_back(cell.hard_case + " " + cell.method + ": " + fault);
    const stress::StressMethod& method = method_of(result, cell.method);
    if (method.conservative && cell.lost()) failures.push_back(in_lines(cell));
    if (method.assigner->exact && cell.extra_pairs > 0)
      failures.push_back(cell.hard_case + " " + cell.method + ": exact, but " + number_of(cell.extra_pairs, "pair") +
                         " too many");
  }
  for (std::size_t i = 0; i < result.cases.size(); ++i)
    for (const stress::ToolCheck& check : result.checks[i])
      if (!check.passed) failures.push_back(std::string(result.cases[i].id) + ": " + check.what);
  for (const stress::SearchResult& search : result.searches)
    if (search.deepest && method_of(result, search.method).conservative)
      failures.push_back("H31 " + search.method + ": " + number_of(search.misses, "light") + " lost, the deepest " +
                         share_in_percent(search.deepest->depth) + " of its range inside");
  for (const stress::SearchResult& search : result.searches)
    if (!search.fault.empty()) failures.push_back("H31 " + search.method + ": " + search.fault);
  for (const stress::SearchResult& search : result.searches)
    if (search.undecided > 0 && method_of(result, search.method).conservative)
      failures.push_back("H31 " + search.method + ": " + number_of(search.undecided, "light") +
                         " not listed, and undecided");
  if (result.random)
    for (const stress::RandomFault& found : result.random->faults)  // undecided pairs are reported, but are no error
      if (found.fault.kind != stress::FaultKind::undecided) failures.push_back("random " + in_lines(found));
  return failures;
}

}  // namespace clusterbench::report
