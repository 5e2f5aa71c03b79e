// The text of `recommend` for users (recommend_report.h).

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/choosing/answer_conclusion.h"
#include "report/choosing/recommend_report.h"

namespace clusterbench::report {
namespace {

using result::Answer;
using result::Candidate;
using result::Objective;

std::string within_text(double within) {
  return text("%.4g", 100.0 * within) + " %";
}

bool has_known_interval(const Candidate& record) {
  return record.ci95 && std::isfinite((*record.ci95)[0]);
}

// "frustum/exact-fast/packed": one line of the table of candidates.
// `is_first`: no other one is better.
Cells candidate_row(const std::string& mark, const Candidate& record, const std::string& objective,
                    bool is_first = false) {
  std::string distance;
  if (std::isfinite(record.by_choice) && mark != "*" && !is_first) {
    distance = text("%+.1f %%", 100.0 * (record.by_choice - 1.0));
    if (has_known_interval(record))
      distance +=
          text(" (%+.1f", 100.0 * ((*record.ci95)[0] - 1.0)) + text(" to %+.1f)", 100.0 * ((*record.ci95)[1] - 1.0));
  }
  const auto figure = [&](const std::string& name) {
    const std::optional<double> value = candidate_figure(record, name);
    return value ? amount_text(*value) : std::string("-");
  };
  return {mark,
          shown(record.name),
          figure(objective),
          distance,
          std::to_string(record.cells),
          figure("bytes"),
          figure("longest"),
          figure("read_bytes"),
          std::isfinite(record.overshade) ? text("%.2f", record.overshade) : "-"};
}

// Times are compared within rounds, so their ratio is more precise than either of them.
std::string worse_by_line(const Answer& answer) {
  for (const Candidate& record : answer.runners_up)
    if (has_known_interval(record))
      return "worse by: than *, median and 95 % interval of ratios measured side by side; not the quotient of the two "
             "figures\n";
  return "";
}

std::string table_of(const std::vector<Cells>& rows) {
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string out;
  for (const Cells& row : rows) out += aligned(row, widths);
  return out;
}

// If no candidate satisfies all constraints: how far each given constraint would have to be relaxed.
std::string nearest_text(const Answer& answer) {
  std::string out = "no candidate satisfies all constraints\n";
  for (const result::ConstraintOfAnswer& row : answer.constraints)
    if (row.given && row.nearest)
      out += "nearest to " + row.constraint + " of those that it rejects: " + amount_text(row.nearest->figure) +
             " on " + number_of(row.nearest->frames, "frame") + ", " + shown(row.nearest->name) + "\n";
  return out;
}

std::string excluded_text(const Answer& answer, const Objective& objective) {
  const std::string& figure = objective.figure;
  const std::string its = figure.ends_with("_cost_us") ? "its cost" : "its " + figure;
  std::vector<Cells> rows{
      {" ", "constraint", "rejects", "only by this rule", "best rejected", its + " ÷ best accepted", "on frames"}};
  for (const result::ConstraintOfAnswer& row : answer.constraints) {
    if (row.excluded == 0 && !row.given) continue;
    const auto& best = row.best;
    rows.push_back({" ", row.constraint, std::to_string(row.excluded), std::to_string(row.alone),
                    best ? shown(best->name) : "-",
                    best && std::isfinite(best->by_best) ? text("%.3g x", best->by_best) : "-",
                    best ? std::to_string(best->frames) : "-"});
  }
  return rows.size() > 1 ? table_of(rows) : "";
}

// "read": bytes of the structure that a sample reads.
Cells candidate_headings(const Answer& answer, const std::string& figure) {
  const bool is_column = figure == "bytes" || figure == "longest" || figure == "overshade";
  const std::string of_sets = heading_of_sets(answer.samples);
  return {" ",        "candidate",      is_column ? "objective" : figure,
          "worse by", "cells",          "bytes",
          "longest",  "read" + of_sets, "overshade" + of_sets};
}

// The meaning of the headings.
std::string sets_line(const Answer& answer) {
  const std::vector<std::string>& sets = answer.samples;
  if (sets.empty()) return "";
  const std::string heading = heading_of_sets(sets);
  return heading.substr(2, heading.size() - 3) + ": samples of " + result::words_of_sets(sets) +
         (sets.size() > 1 ? ", by the weights of the key `cost`" : "") + "; read: bytes that one reads\n";
}

// Separate from the others: only the model gives the cost of their search on a GPU.
std::string searched_text(const Answer& answer, const std::string& figure) {
  if (answer.searched.empty()) return "";
  std::vector<Cells> rows{candidate_headings(answer, figure)};
  for (const Candidate& record : answer.searched)
    rows.push_back(candidate_row(" ", record, figure, !answer.choice && &record == &answer.searched.front()));
  return "structures that samples search, priced by the model (key cost: ns_per_read, read_gb_per_s), which no GPU has "
         "confirmed:\n" +
         table_of(rows);
}

std::string answer_text(const Answer& answer, const Objective& objective) {
  std::string out = shown(answer.scene) + ", " + viewport_text(answer.viewport) + ", " +
                    number_of(answer.frames, "frame") + ": " + number_of(answer.candidates, "candidate") + "\n";
  const std::string& figure = objective.figure;
  const std::string unseen = text_of_nothing_seen(answer);
  if (!unseen.empty()) {
    out += unseen + "\n";
  } else if (!answer.choice) {
    out += nearest_text(answer);
  } else {
    std::vector<Cells> rows{candidate_headings(answer, figure)};
    rows.push_back(candidate_row("*", *answer.choice, figure));
    for (const Candidate& runner_up : answer.runners_up) rows.push_back(candidate_row(" ", runner_up, figure));
    out += table_of(rows) + worse_by_line(answer);
    if (std::ranges::any_of(rows, [](const Cells& row) { return row.back() == "-" || row[row.size() - 2] == "-"; }))
      out += "-: a camera has no such samples, or too few that need a light\n";
    const auto& coarsest = answer.coarsest;
    out += "coarsest grid within " + within_text(answer.within) + " of the best: " +
           (coarsest ? shown(coarsest->name) + ", " + std::to_string(coarsest->cells) + " cells, " + figure + " " +
                           amount_text(coarsest->objective)
                     : "the choice itself") +
           "\n";
  }
  out += searched_text(answer, figure);
  if (unseen.empty()) out += sets_line(answer);
  if (unseen.empty()) out += excluded_text(answer, objective);
  const result::SearchWork& work = answer.work;
  out += "measured " + std::to_string(work.evaluations) + " of " + std::to_string(work.all_evaluations) +
         " pairs of a candidate and a frame (" + text("%.3g", 100.0 * work.evaluations_share) + " %), " +
         text("%.3g", 100.0 * work.tests_share) + " % of all lights x cells";
  if (work.measurements > work.evaluations)
    out += "; " + std::to_string(work.measurements) +
           " measurements, since a stage measures the frames of the one before again";
  out += "\n";
  return out;
}

}  // namespace

std::string unfinished_text(const search::View& view, const search::Found& found, const Question& question) {
  std::vector<std::size_t> order;
  std::size_t measured = 0;
  for (std::size_t i = 0; i < found.records.size(); ++i) {
    measured += found.records[i].frames > 0 ? 1 : 0;
    if (found.records[i].frames > 0 && found.records[i].verdict.broken.empty()) order.push_back(i);
  }
  std::string out = "stopped: " + std::to_string(measured) + " of " + number_of(view.candidates.size(), "candidate") +
                    " had been measured, none of them to the end of the search";
  if (order.empty()) return out + ", and none that satisfies the constraints\n";
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const search::Record &record = found.records[a], &other = found.records[b];
    return record.frames != other.frames ? record.frames > other.frames
                                         : record.verdict.objective < other.verdict.objective;
  });
  order.resize(std::min(order.size(), static_cast<std::size_t>(question.runners_up) + 1));
  std::vector<Cells> rows{{" ", "best so far", std::string(question.objective->name), "on frames"}};
  for (const std::size_t i : order) {
    const search::Record& record = found.records[i];
    rows.push_back(
        {" ", shown(view.candidates[i].name), amount_text(record.verdict.objective), std::to_string(record.frames)});
  }
  return out + "\n" + table_of(rows);
}

std::string recommendation_text(const result::Recommendation& recommendation, const std::string& next) {
  const Objective& objective = recommendation.objective;
  std::string out = "least " + objective.figure + ": " + objective.meaning + "\n";
  for (const Answer& answer : recommendation.answers) out += "\n" + answer_text(answer, objective);
  out += "\n";
  for (const Answer& answer : recommendation.answers)
    for (const std::string& doubt : answer.timing_doubts) out += "warning: " + doubt + "\n";
  out += next;
  for (const Answer& answer : recommendation.answers)
    out += "conclusion: " + answer_conclusion(answer, objective) + "\n";
  return out;
}

}  // namespace clusterbench::report
