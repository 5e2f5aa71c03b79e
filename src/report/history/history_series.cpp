#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <tuple>

#include "core/text.h"
#include "report/history/history.h"
#include "report/history/history_changes.h"

namespace clusterbench::report {
namespace {

using result::Basis;
using result::Better;
using result::Figure;

const Figure* exported_figure(const std::string& name) {
  for (const Figure* figure : export_figures())
    if (figure->exported_as() == name) return figure;
  return nullptr;
}

// Figures of one origin form a series: times need the same machine, instructions the same counter.
std::string origin(const HistoryEntry& entry, const Figure& figure) {
  switch (figure.basis) {
    case Basis::time:
      return (figure.is_of_device ? entry.device : entry.machine) +
             (entry.caches.empty() ? "" : ", " + entry.caches + " caches") +
             (figure.is_of_device || entry.swept.empty() ? "" : ", " + entry.swept + " swept");
    case Basis::instructions:
      return entry.machine + (entry.counter.empty() ? "" : ", " + entry.counter);
    case Basis::count:
    case Basis::derived:
      break;
  }
  return "";
}

// Noise of counts: hardware counters include interrupts; even valgrind's counts depend slightly on addresses.
double counting_noise(const Series& series) {
  if (series.figure->basis != Basis::instructions) return 0.0;
  return series.machine.ends_with(", callgrind") ? 0.001 : 0.01;
}

std::vector<measure::ChangePoint> changes_of(const Series& series, const measure::ChangeRule& rule) {
  if (series.figure->basis == Basis::time) return measure::change_points(series.values, rule);
  return measure::counted_changes(series.values, std::max(rule.min_change, counting_noise(series)));
}

// Whether the results around a change have the same lights or camera path, if known. For counts these are the two
// results beside it; for times, whose changes are detected from many results, all up to the neighbouring changes.
enum class Around { same, others, unknown };
Around digests_around(const Series& series, const std::vector<std::string>& all, const measure::ChangePoint& change) {
  const bool is_counted = change.p == 0.0;
  std::size_t begin = is_counted ? change.index - 1 : 0, end = is_counted ? change.index + 1 : all.size();
  for (const measure::ChangePoint& other : series.changes) {
    if (other.index < change.index) begin = std::max(begin, other.index);
    if (other.index > change.index) end = std::min(end, other.index);
  }
  const std::set<std::string> digests(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                      all.begin() + static_cast<std::ptrdiff_t>(end));
  if (digests.size() <= 1) return Around::same;  // or all are unknown: lines of an older version
  return digests.contains("") ? Around::unknown : Around::others;
}

// "all 140,258", "140,258 to 151,000"; for counts also the range of the values in between.
std::string values_text(const Series& series) {
  const std::vector<double>& values = series.values;
  const bool is_steady = std::ranges::all_of(values, [&](double value) { return value == values.front(); });
  if (is_steady) return (values.size() > 1 ? "all " : "") + figure_text(values.front());
  const auto [least, most] = std::ranges::minmax_element(values);
  const auto is_end = [&](double value) { return value == values.front() || value == values.back(); };
  return figure_text(values.front()) + " to " + figure_text(values.back()) +
         (series.figure->basis == Basis::time || (is_end(*least) && is_end(*most))
              ? ""
              : ", between " + figure_text(*least) + " and " + figure_text(*most));
}

std::string series_text(const Series& series) {
  std::string text =
      series.case_name + "  " + std::string(series.figure->exported_as()) + " (" + std::string(series.figure->unit) +
      ")" + (series.machine.empty() ? "" : "  on " + series.machine) + "\n" +
      (series.settings_since.empty()
           ? ""
           : "  other settings than before, from " + series.settings_since + " on: a series of its own\n") +
      "  " + number_of(series.values.size(), "value") + ", " + values_text(series) + "\n";
  for (const measure::ChangePoint& change : series.changes) {
    char p[48];
    std::snprintf(p, sizeof p, " (p %.1g)", change.p);
    const std::string way = direction_text(series, change);
    text += "  at " + series.commits[change.index] + ": " + figure_text(change.before) + " to " +
            figure_text(change.after) + ", " + change_text(change) + (way.empty() ? "" : ", " + way) +
            (change.p > 0.0 ? p : "") + "\n";
  }
  return text;
}

// " of 0.5 % or more"
std::string least_text(const measure::ChangeRule& rule) {
  char text[48];
  std::snprintf(text, sizeof text, " of %.3g %% or more", 100.0 * rule.min_change);
  return rule.min_change > 0.0 ? text : "";
}

}  // namespace

std::vector<Series> series_of(const std::vector<HistoryEntry>& history, const measure::ChangeRule& rule) {
  std::vector<Series> all;
  std::map<std::tuple<std::string, std::ptrdiff_t, const Figure*, std::string>, std::size_t> index_of;
  std::map<std::string, std::vector<std::string>> settings_of;  // by name, in the order of appearance
  for (const HistoryEntry& entry : history)
    for (const HistoryEntry::Case& history_case : entry.cases) {
      // Lines without settings are assumed to have those of their neighbours.
      std::vector<std::string>& known = settings_of[history_case.name];
      if (!known.empty() && known.back().empty())
        known.back() = history_case.settings;
      else if (known.empty() ||
               (!history_case.settings.empty() && std::ranges::find(known, history_case.settings) == known.end()))
        known.push_back(history_case.settings);
      const auto at = history_case.settings.empty() ? known.end() - 1 : std::ranges::find(known, history_case.settings);
      const auto version = at - known.begin();
      for (const auto& [name, value] : history_case.figures) {
        const Figure* figure = exported_figure(name);
        if (figure == nullptr || figure->basis == Basis::derived) continue;  // in lines of an older version
        const std::string from = origin(entry, *figure);
        const auto [found, is_new] = index_of.try_emplace({history_case.name, version, figure, from}, all.size());
        if (is_new)
          all.push_back({history_case.name,
                         *at,
                         version > 0 ? entry.commit : std::string(),
                         from,
                         figure,
                         {},
                         {},
                         {},
                         {},
                         false,
                         {}});
        const HistoryLights* lights = lights_of_scene(entry, history_case.scene);
        all[found->second].lights.push_back(lights == nullptr ? "" : lights->digest);
        all[found->second].paths.push_back(history_case.path.digest);
        all[found->second].commits.push_back(entry.commit);
        all[found->second].values.push_back(value);
      }
    }
  for (Series& series : all) {
    series.is_too_short =
        series.figure->basis == Basis::time && series.values.size() < measure::least_values(rule.max_p);
    series.changes = changes_of(series, rule);
  }
  return all;
}

std::string direction(const Series& series, const measure::ChangePoint& change) {
  const Figure& figure = *series.figure;
  if (figure.better == Better::neither || digests_around(series, series.lights, change) != Around::same ||
      digests_around(series, series.paths, change) != Around::same)
    return "";
  return (change.after < change.before) == (figure.better == Better::smaller) ? "better" : "worse";
}

std::string direction_text(const Series& series, const measure::ChangePoint& change) {
  if (series.figure->better == Better::neither) return "";
  const Around lights = digests_around(series, series.lights, change),
               paths = digests_around(series, series.paths, change);
  if (lights == Around::others) return "of other lights";
  if (paths == Around::others) return "of another camera path";
  if (lights == Around::unknown) return "perhaps of other lights, which older lines do not tell";
  if (paths == Around::unknown) return "perhaps of another camera path, which older lines do not tell";
  return direction(series, change);
}

std::string change_text(const measure::ChangePoint& change) {
  if (change.before == 0.0) return "from 0";
  char text[48];
  std::snprintf(text, sizeof text, "%+.3g %%", 100.0 * (change.after / change.before - 1.0));
  return text;
}

std::string history_text(const std::vector<Series>& series, std::size_t entries, bool all,
                         const measure::ChangeRule& rule, const std::vector<std::string>& light_changes) {
  std::string text;
  for (const std::string& change : light_changes) text += change + "\n";
  std::size_t changes = 0, too_short = 0;
  for (const Series& case_series : series) {
    changes += case_series.changes.size();
    too_short += case_series.is_too_short ? 1 : 0;
    if (all || !case_series.changes.empty()) text += series_text(case_series);
  }
  std::set<std::pair<std::string, std::string>> renewed;
  for (const Series& case_series : series)
    if (!case_series.settings_since.empty())
      renewed.insert({case_series.settings, case_series.case_name + " from " + case_series.settings_since + " on"});
  for (const auto& [settings, what] : renewed)
    text += "warning: other settings (" + settings + "), not joined with what was before: " + what + "\n";
  text +=
      number_of(entries, "result") + ", " + std::to_string(series.size()) + " series, " + number_of(changes, "change") +
      least_text(rule) +
      (light_changes.empty() ? "" : ", " + number_of(light_changes.size(), "change") + " of levels or their lights") +
      "\n";
  return too_short == 0
             ? text
             : text + std::to_string(too_short) + " series of times are too short to tell changes from noise\n";
}

std::string figure_text(double value) {
  char text[48];
  std::snprintf(text, sizeof text, std::abs(value) < 1e5 ? "%.5g" : "%.0f", value);
  return text;
}

}  // namespace clusterbench::report
