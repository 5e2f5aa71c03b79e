// The text of `recommend` for users (recommend_report.h).

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/cases/json_values.h"
#include "report/cases/sample_sets.h"
#include "report/choosing/answer_conclusion.h"
#include "report/choosing/recommend_report.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

std::string within_text(double within) {
  return text("%.4g", 100.0 * within) + " %";
}

// "frustum/exact-fast/packed": one line of the table of candidates.
// `is_first`: nothing is better.
Cells candidate_row(const std::string& mark, const Json& record, const std::string& objective, bool is_first = false) {
  std::string distance;
  if (const Json& by = record["by_choice"]; by.is_number() && mark != "*" && !is_first) {
    distance = text("%+.1f %%", 100.0 * (by.get<double>() - 1.0));
    if (record.contains("ci95") && record["ci95"][0].is_number())
      distance += text(" (%+.1f", 100.0 * (record["ci95"][0].get<double>() - 1.0)) +
                  text(" to %+.1f)", 100.0 * (record["ci95"][1].get<double>() - 1.0));
  }
  const auto figure = [&](const std::string& name) {
    const std::optional<double> value = number_at(record, "/figures/" + name);
    return value ? amount_text(*value) : std::string("-");
  };
  return {mark,
          shown(record["name"].get<std::string>()),
          figure(objective),
          distance,
          std::to_string(record["cells"].get<std::uint64_t>()),
          figure("bytes"),
          figure("longest"),
          figure("read_bytes"),
          text_of(number_at(record, "/overshade"), "%.2f")};
}

// Times are compared within rounds, so that their ratio is known better than either of them.
std::string worse_by_line(const Json& answer) {
  for (const Json& record : answer["runners_up"])
    if (record.contains("ci95") && record["ci95"][0].is_number())
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

// Where nothing satisfies them all: what would have to be given up of each constraint that was asked for.
std::string nearest_text(const Json& answer) {
  std::string out = "no candidate satisfies all constraints\n";
  for (const Json& row : answer["constraints"]) {
    const Json& nearest = row["nearest"];
    if (row["given"] == false || nearest.is_null()) continue;
    out += "nearest to " + row["constraint"].get<std::string>() +
           " of those that it rejects: " + amount_text(nearest["figure"].get<double>()) + " on " +
           number_of(nearest["frames"].get<std::uint64_t>(), "frame") + ", " +
           shown(nearest["name"].get<std::string>()) + "\n";
  }
  return out;
}

std::string excluded_text(const Json& answer, const Json& objective) {
  const auto figure = objective["figure"].get<std::string>();
  const std::string its = figure.ends_with("_cost_us") ? "its cost" : "its " + figure;
  std::vector<Cells> rows{
      {" ", "constraint", "rejects", "only by this rule", "best rejected", its + " ÷ best accepted", "on frames"}};
  for (const Json& row : answer["constraints"]) {
    if (row["excluded"] == 0 && row["given"] == false) continue;
    const Json& best = row["best"];
    rows.push_back({" ", row["constraint"], row["excluded"].dump(), row["alone"].dump(),
                    best.is_null() ? "-" : shown(best["name"].get<std::string>()),
                    best.is_null() ? "-" : text_of(number_at(best, "/by_best"), "%.3g x"),
                    best.is_null() ? "-" : best["frames"].dump()});
  }
  return rows.size() > 1 ? table_of(rows) : "";
}

std::vector<std::string> answer_sets(const Json& answer) {
  return answer.value("samples", Json::array()).get<std::vector<std::string>>();
}

// "read": bytes of the structure that a sample reads.
Cells candidate_headings(const Json& answer, const std::string& figure) {
  const bool is_column = figure == "bytes" || figure == "longest" || figure == "overshade";
  const std::string of_sets = heading_of_sets(answer_sets(answer));
  return {" ",        "candidate",      is_column ? "objective" : figure,
          "worse by", "cells",          "bytes",
          "longest",  "read" + of_sets, "overshade" + of_sets};
}

// What the headings mean.
std::string sets_line(const Json& answer) {
  const std::vector<std::string> sets = answer_sets(answer);
  if (sets.empty()) return "";
  const std::string heading = heading_of_sets(sets);
  return heading.substr(2, heading.size() - 3) + ": samples of " + result::words_of_sets(sets) +
         (sets.size() > 1 ? ", by the weights of the key `cost`" : "") + "; read: bytes that one reads\n";
}

// Never beside the others: what their search costs on a GPU is a model's.
std::string searched_text(const Json& answer, const std::string& figure) {
  const Json searched = answer.value("searched", Json::array());
  if (searched.empty()) return "";
  std::vector<Cells> rows{candidate_headings(answer, figure)};
  for (const Json& record : searched)
    rows.push_back(candidate_row(" ", record, figure, answer["choice"].is_null() && &record == &searched.front()));
  return "structures that samples search, priced by the model (key cost: ns_per_read, read_gb_per_s), which no GPU has "
         "confirmed:\n" +
         table_of(rows);
}

std::string answer_text(const Json& answer, const Json& objective) {
  std::string out = shown(answer["scene"].get<std::string>()) + ", " +
                    viewport_text(answer["viewport"].get<result::Counts2>()) + ", " +
                    number_of(answer["frames"].get<std::uint64_t>(), "frame") + ": " +
                    number_of(answer["candidates"].get<std::uint64_t>(), "candidate") + "\n";
  const auto figure = objective["figure"].get<std::string>();
  const std::string unseen = text_of_nothing_seen(answer);
  if (!unseen.empty()) {
    out += unseen + "\n";
  } else if (answer["choice"].is_null()) {
    out += nearest_text(answer);
  } else {
    std::vector<Cells> rows{candidate_headings(answer, figure)};
    rows.push_back(candidate_row("*", answer["choice"], figure));
    for (const Json& runner_up : answer["runners_up"]) rows.push_back(candidate_row(" ", runner_up, figure));
    out += table_of(rows) + worse_by_line(answer);
    if (std::ranges::any_of(rows, [](const Cells& row) { return row.back() == "-" || row[row.size() - 2] == "-"; }))
      out += "-: a camera has no such samples, or too few that need a light\n";
    const Json& coarsest = answer["coarsest"];
    out += "coarsest grid within " + within_text(answer["within"].get<double>()) + " of the best: " +
           (coarsest.is_null() ? "the choice itself"
                               : shown(coarsest["name"].get<std::string>()) + ", " + coarsest["cells"].dump() +
                                     " cells, " + figure + " " + amount_text(coarsest["objective"].get<double>())) +
           "\n";
  }
  out += searched_text(answer, figure);
  if (unseen.empty()) out += sets_line(answer);
  if (unseen.empty()) out += excluded_text(answer, objective);
  const Json& work = answer["work"];
  out += "measured " + work["evaluations"].dump() + " of " + work["all_evaluations"].dump() +
         " pairs of a candidate and a frame (" + text("%.3g", 100.0 * work["evaluations_share"].get<double>()) +
         " %), " + text("%.3g", 100.0 * work["tests_share"].get<double>()) + " % of all lights x cells";
  if (const Json measurements = work.value("measurements", work["evaluations"]); measurements > work["evaluations"])
    out += "; " + measurements.dump() + " measurements, since a stage measures the frames of the one before again";
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

std::string recommendation_text(const Json& recommendation, const std::string& next) {
  const Json& objective = recommendation["objective"];
  std::string out =
      "least " + objective["figure"].get<std::string>() + ": " + objective["meaning"].get<std::string>() + "\n";
  for (const Json& answer : recommendation["answers"]) out += "\n" + answer_text(answer, objective);
  out += "\n";
  for (const Json& answer : recommendation["answers"])
    for (const Json& doubt : answer.value("timing_doubts", Json::array()))
      out += "warning: " + doubt.get<std::string>() + "\n";
  out += next;
  for (const Json& answer : recommendation["answers"])
    out += "conclusion: " + answer_conclusion(answer, objective) + "\n";
  return out;
}

}  // namespace clusterbench::report
