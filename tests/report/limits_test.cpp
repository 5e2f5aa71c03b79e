#include "report/gates/limits.h"
#include "result/figures/case_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "config/schema/documents.h"
#include "places.h"
#include "records.h"
#include "report/exports/metrics.h"
#include "report/gates/baseline_cases.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;
using result::Result;

Json case_with_budget_figures() {
  return Json::parse(R"({"name": "hall/walk/frustum/bounds/packed",
    "timing": {"frame_ns": {"median": 195000.5}, "assign_ns": {"median": 150000}, "convert_ns": {"median": 45000},
               "build_ns": {"median": 1000}, "worst_frame": {"frame": 12, "ns": 250000}},
    "buffers": {"index_entries": {"high_water": 4097}, "bytes": {"high_water": 950000}, "upload_bytes": {"max": 7},
                "scratch_bytes": 8, "overflow": {"dropped_pairs": 3}, "worst_frame": 9, "worst_cell": [1, 2, 3]},
    "occupancy": {"lights_per_cell": {"max": 64}, "pairs": {"max": 4000, "mean": 3500}, "worst_frame": 8, "worst_cell": [4, 5, 6]},
    "error": {"false_negatives": 2, "excess_ratio": 0.5, "undecided": 0, "deepest": {"frame": 7, "cell": [0, 0, 1]}},
    "cost": {"frame_ns": 900000}, "lights": 300, "lights_lit": 290, "lights_seen": 260,
    "lights_in_view": {"max": 250, "worst_frame": 4, "shining_mean": 120.5},
    "count": {"instructions_per_frame": {"assign": 40000, "convert": 2000, "frame": 42000}},
    "shading": {"samples": 500, "missed": 1, "needed": 1000, "lost_irradiance": 0.25, "overshade": 1.5, "worst_frame": {"frame": 3}}})");
}

// Of a result with these cases.
LimitFindings findings_in(const Json& cases, const std::string& rule) {
  const config::LimitRule rules[] = {config::limit_rule(rule, "", "--fail-if")};
  return limit_findings(test::result_of(Json{{"cases", cases}}), rules);
}

LimitFindings findings_of(const std::string& rule, const Json& entry = case_with_budget_figures()) {
  return findings_in(Json::array({entry}), rule);
}

std::string broken_by(const std::string& rule) {
  const Lines lines = findings_of(rule).broken;
  const std::string name = "hall/walk/frustum/bounds/packed: ";
  return lines.empty() ? "kept" : lines.front().substr(lines.front().starts_with(name) ? name.size() : 0);
}

TEST(Limits, what_breaks_one_is_told_with_case_frame_and_cell) {
  const std::pair<const char*, const char*> rows[] = {
      {"frame_us.max > 200", "frame_us.max is 250 (frame 12), and fails with frame_us.max > 200"},
      {"index_entries > 4096", "index_entries is 4097 (frame 9, cell [1,2,3]), and fails with index_entries > 4096"},
      {"unlit > 0", "unlit is 0.001 (random points in the view, frame 3), and fails with unlit > 0"},
      {"dropped>0", "dropped is 3, and fails with dropped > 0"},
      {"missed > 0", "missed is 2 (frame 7, cell [0,0,1]), and fails with missed > 0"},
      {"longest > 63", "longest is 64 (frame 8, cell [4,5,6]), and fails with longest > 63"},
      {"longest > 64", "kept"},
      {"longest >= 64", "longest is 64 (frame 8, cell [4,5,6]), and fails with longest >= 64"},
      {"bytes > 1e6", "kept"},
      {"frame_us > 195", "frame_us is 195.0005, and fails with frame_us > 195"},
      {"lights < 301", "lights is 300, and fails with lights < 301"},
      {"lights < 300", "kept"},
      {"lights_lit < 291", "lights_lit is 290, and fails with lights_lit < 291"},
      {"lights_lit < 290", "kept"},
      {"lights_seen.mean < 121", "lights_seen.mean is 120.5, and fails with lights_seen.mean < 121"},
      {"lights_seen <= 260", "lights_seen is 260, and fails with lights_seen <= 260"},
      {"lights == 300", "lights is 300, and fails with lights == 300"},
      {"lights_in_view 200..240", "lights_in_view is 250 (frame 4), and fails with lights_in_view outside 200..240"},
      {"lights_in_view 200..300", "kept"},
      {"instructions > 41999", "instructions is 42000, and fails with instructions > 41999"},
      {"assign_instructions > 40000", "kept"},
      {"convert_instructions <= 2000", "convert_instructions is 2000, and fails with convert_instructions <= 2000"},
  };
  for (const auto& [rule, line] : rows) EXPECT_EQ(broken_by(rule), line);
  EXPECT_TRUE(findings_of("longest > 63").broken.front().starts_with("hall/walk/frustum/bounds/packed: "));
}

TEST(Limits, times_are_in_microseconds_what_they_are_in_nanoseconds) {
  for (int ns = 1; ns < 5000; ns += 7) {
    const Json entry{{"name", "a"}, {"timing", {{"frame_ns", {{"median", ns}}}}}};
    char budget[48];
    std::snprintf(budget, sizeof budget, "%d.%03d", ns / 1000, ns % 1000);
    EXPECT_EQ(findings_of("frame_us > " + std::string(budget), entry).broken.size(), 0u) << ns;
    EXPECT_EQ(findings_of("frame_us == " + std::string(budget), entry).broken.size(), 1u) << ns;
  }
}

TEST(Limits, what_is_less_than_a_tenth_below_is_a_warning) {
  const auto near = [](const std::string& rule) { return findings_of(rule).near; };
  EXPECT_EQ(near("bytes > 1e6"), (Lines{"hall/walk/frustum/bounds/packed: bytes is 950000 (frame 9, cell [1,2,3]), "
                                        "near the budget bytes > 1000000"}));
  EXPECT_EQ(near("bytes > 1.1e6"), Lines{});
  EXPECT_EQ(near("longest > 64").size(), 1u);
  EXPECT_EQ(near("longest >= 64"), Lines{}) << "it is broken";
  EXPECT_EQ(near("undecided > 0"), Lines{});
}

// A gate that is never held must not look like one that was passed.
TEST(Limits, what_no_case_has_fails) {
  Json bare{{"name", "a"}};
  EXPECT_EQ(findings_of("frame_us > 200", bare).broken,
            (Lines{"'frame_us > 200' could not be checked: no case has frame_us (--no-timing or "
                   "timing.measure: false leaves times out; methods on a device have those called device_...)"}));
  bare["shading"] = {{"missed", 0}, {"needed", 0}};
  EXPECT_EQ(findings_of("unlit > 0", bare).broken.size(), 1u) << "a share of nothing";
  bare["shading"] = {{"missed", 9}, {"needed", 200}, {"overshade", nullptr}};
  EXPECT_EQ(
      findings_of("overshade > 2", bare).broken,
      (Lines{"'overshade > 2' could not be checked: no case has overshade (there is none where more than 0.1 % of "
             "the lights are unlit or fewer than 100 reach the samples; shading.samples: 0 leaves them out, and "
             "methods of visible surfaces have none)"}));
}

// However many lights a cell has, such lists are no longer than their room.
TEST(Limits, of_the_longest_list_are_not_held_by_lists_that_a_method_has_cut) {
  Json cut = case_with_budget_figures();  // whose lists are no longer than 64, and 3 pairs are dropped
  EXPECT_EQ(findings_of("longest > 64", cut).broken, Lines{}) << "counted before a storage drops any";
  cut["storage"] = run::k_own_structure;
  EXPECT_EQ(findings_of("longest > 64", cut).broken,
            (Lines{"'longest > 64' could not be checked for hall/walk/frustum/bounds/packed: its lists end at 64 since "
                   "the method itself dropped 3 pairs; hold dropped, and see `clusterbench size`"}));
  EXPECT_EQ(findings_of("longest > 63", cut).broken.size(), 1u);
  EXPECT_EQ(findings_of("longest < 10", cut).broken, Lines{}) << "long enough as it is";
  ASSERT_EQ(findings_of("longest < 70", cut).broken.size(), 1u);
  EXPECT_NE(findings_of("longest < 70", cut).broken[0].find("could not be checked"), std::string::npos);
  const Result base = test::result_of(Json{{"cases", Json::array({cut})}});
  const BaselineCases cases(base, base, "", "base.json");
  const config::LimitRule rules[] = {config::limit_rule("longest > +3 %", "", "--fail-if")};
  ASSERT_EQ(limit_findings(base, rules, &cases).broken.size(), 1u);
  EXPECT_NE(limit_findings(base, rules, &cases).broken[0].find("could not be checked"), std::string::npos);
  cut["buffers"]["overflow"]["dropped_pairs"] = 0;
  EXPECT_EQ(findings_of("longest > 64", cut).broken, Lines{});
}

// Lists that lack lights are short; their overshade would pass any budget.
TEST(Limits, the_overshade_of_samples_that_lack_lights_is_none) {
  Json lacking = case_with_budget_figures();
  lacking["samples"]["opaque"] = {{"missed", 412}, {"needed", 1000}, {"overshade", nullptr}, {"unlit", 0.412}};
  lacking["cost"] = {{"overshade", nullptr}, {"lit", false}, {"sets", {{"opaque", Json::object()}}}};
  EXPECT_EQ(findings_of("overshade > 3", lacking).broken.size(), 1u);
  lacking["cost"]["overshade"] = 1.25;  // as older results have it
  EXPECT_EQ(findings_of("overshade > 3", lacking).broken.size(), 1u);
  lacking["cost"]["lit"] = true;
  EXPECT_EQ(findings_of("overshade > 3", lacking).broken, Lines{});
}

TEST(Limits, samples_that_need_no_light_say_nothing_of_lost_irradiance) {
  Json unseen = case_with_budget_figures();
  unseen["samples"]["opaque"] = {{"samples", 0}, {"missed", 0}, {"needed", 0}, {"lost_irradiance", 0}};
  EXPECT_EQ(findings_of("opaque.lost_irradiance > 0", unseen).broken.size(), 1u);
  EXPECT_EQ(findings_of("lost_irradiance > 0", unseen).broken.size(), 1u) << "they rank it";
}

// A camera whose surfaces have lost all of their lights is what the budget is for.
TEST(Limits, samples_that_no_light_reaches_need_none) {
  Json unlit = case_with_budget_figures();
  unlit["samples"]["opaque"] = {{"samples", 440}, {"missed", 0}, {"needed", 0}, {"lost_irradiance", 0}};
  EXPECT_EQ(findings_of("opaque.needed < 0.5", unlit).broken.size(), 1u);
  EXPECT_EQ(findings_of("opaque.needed == 0", unlit).broken.size(), 1u);
  EXPECT_EQ(findings_of("opaque.needed > 0.5", unlit).broken, Lines{});
  unlit["cost"] = {{"sets", {{"opaque", Json::object()}, {"fog", Json::object()}}}, {"lit", true}};
  unlit["samples"]["fog"] = {{"samples", 100}, {"missed", 0}, {"needed", 900}, {"lost_irradiance", 0}};
  EXPECT_EQ(findings_of("needed < 0.5", unlit).broken.size(), 1u) << "fog does not make up for surfaces";
  EXPECT_EQ(findings_of("needed < 10", unlit).broken.size(), 2u);
  Json lit = case_with_budget_figures();
  lit["samples"]["opaque"] = {{"samples", 440}, {"missed", 0}, {"needed", 476}, {"lost_irradiance", 0}};
  EXPECT_EQ(findings_of("opaque.needed < 0.5", lit).broken, Lines{});
}

TEST(Limits, what_some_cases_have_is_held_there_and_the_others_are_named) {
  const Json cases = Json::array({Json{{"name", "a"}}, case_with_budget_figures(), Json{{"name", "c"}}});
  const LimitFindings findings = findings_in(cases, "pairs > 9000");
  EXPECT_EQ(findings.broken, Lines{});
  EXPECT_EQ(findings.unchecked, (Lines{"'pairs > 9000' was not checked for 2 cases without pairs (structures without "
                                       "cells have none): a ..."}));
}

TEST(Limits, a_frames_time_is_never_made_of_its_parts) {
  Json entry = case_with_budget_figures();
  entry["timing"]["frame_ns"]["median"] = nullptr;
  ASSERT_EQ(findings_of("frame_us > 1", entry).broken.size(), 1u);
  EXPECT_NE(findings_of("frame_us > 1", entry).broken[0].find("could not be checked"), std::string::npos)
      << "medians of parts do not add up to the median of the frame";
}

TEST(Limits, before_a_colon_name_cases_and_what_they_match_has_to_have_the_figure) {
  const Json cases = Json::array({Json{{"name", "a/own"}}, case_with_budget_figures()});
  const auto of = [&](const std::string& rule) { return findings_in(cases, rule); };
  EXPECT_EQ(of("bounds: longest > 63").broken.size(), 1u);
  EXPECT_EQ(of("bounds: longest > 64").broken, Lines{});
  EXPECT_EQ(of("bounds: longest > 64").unchecked, Lines{});
  EXPECT_EQ(
      of("own: longest > 64").broken,
      (Lines{"'own: longest > 64' could not be checked: no case has longest (structures without cells have none)"}));
  EXPECT_EQ(of("own|bounds: longest > 64").broken.size(), 1u) << "one of them has none";
  EXPECT_EQ(of("bonds: longest > 64").broken,
            (Lines{"'bonds: longest > 64' could not be checked: its 'bonds' matches no case's name; there are: a/own, "
                   "hall/walk/frustum/bounds/packed"}));
}

TEST(Limits, of_a_case_by_its_name_as_it_is_printed_are_held_against_it) {
  const std::string name =
      "hall/walk/filament: frustum 16px/sphere-refinement(spot=cone-sphere,columns=nearest)/a+b(2)";
  Json entry = case_with_budget_figures();
  entry["name"] = name;
  for (const std::string& cases : {name, name.substr(10)}) {
    const LimitFindings findings = findings_of(cases + ": longest > 63", entry);
    ASSERT_EQ(findings.broken.size(), 1u);
    EXPECT_TRUE(findings.broken[0].starts_with(name + ": longest is 64")) << findings.broken[0];
  }
  EXPECT_EQ(findings_of("refinement(spot=cone): longest > 63", entry).broken,
            (Lines{"'refinement(spot=cone): longest > 63' could not be checked: its 'refinement(spot=cone)' matches no "
                   "case's name, neither as it stands nor as a regular expression, in which \\ makes ( ) plain "
                   "characters; there are: " +
                   name}));
}

TEST(Limits, of_a_result_without_cases_fail) {
  EXPECT_EQ(findings_in(Json::array(), "longest > 64").broken,
            (Lines{"'longest > 64' could not be checked: there is no case"}));
}

TEST(Limits, older_results_without_a_frames_instructions_have_their_sum) {
  Json entry = case_with_budget_figures();
  entry["count"]["instructions_per_frame"].erase("frame");
  EXPECT_EQ(result::figure_of(test::case_of(entry), "instructions"), 42000.0);
}

// The rows of docs/results.md on the names of a figure: its cells without marks.
std::vector<std::vector<std::string>> documented_names() {
  std::ifstream in(test::source_dir() + "/docs/results.md");
  std::vector<std::vector<std::string>> rows;
  bool is_table = false;
  for (std::string line; std::getline(in, line);) {
    is_table = line.starts_with("| figure | in the table |") || (is_table && line.starts_with("|"));
    if (!is_table || !line.starts_with("| ")) continue;
    std::vector<std::string> cells;
    std::istringstream words(line.substr(1));
    for (std::string cell; std::getline(words, cell, '|');) {
      const std::size_t begin = cell.find('`'), end = cell.find('`', begin + 1);
      cells.push_back(begin == std::string::npos ? "" : cell.substr(begin + 1, end - begin - 1));
    }
    rows.push_back(cells);
  }
  rows.erase(rows.begin());
  return rows;
}

TEST(Limits, the_table_of_names_in_the_documents_is_that_of_budgets_results_and_exports) {
  const auto rows = documented_names();
  for (const result::Figure& figure : result::figures()) {
    const bool has_several_names = figure.exported_as() != figure.name;
    EXPECT_TRUE(!has_several_names || std::ranges::any_of(rows, [&](const auto& row) {
      return row.at(2) == figure.name;
    })) << figure.name;
  }
  for (const auto& row : rows) {
    std::string pointer = "/" + row.at(3);
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    Json entry{{"name", "a"}};
    entry[Json::json_pointer(pointer)] = 1e6;
    if (row[2] == "unlit") entry["shading"]["missed"] = 1e6;
    if (result::is_at_samples(row[2]))
      entry["shading"][row[2] == "needed" ? "samples" : "needed"] = 1.0;  // its divisor
    const std::vector<std::string> broken = findings_of(row[2] + " > 500", entry).broken;
    ASSERT_EQ(broken.size(), 1u) << row[2];
    EXPECT_EQ(broken[0].find("could not be checked"), std::string::npos) << row[2] << " is not at " << pointer;
    const std::vector<Measured> exported = measured(test::case_of(entry), true);
    EXPECT_TRUE(std::ranges::any_of(
        exported, [&](const Measured& one) { return one.figure->exported_as() == row[4] && one.value == 1e6; }))
        << row[4] << " is not " << pointer;
  }
}

// A case of all parts whose numbers are all 1.
result::Case full_case() {
  result::Case full;
  test::fill_with_numbers(full, [] { return 1; });
  return full;
}

TEST(Limits, every_figure_is_a_budget_that_a_case_of_all_parts_has) {
  result::Result result;
  result.cases.push_back(full_case());
  result.cases[0].cost->lit = true;
  result.cases[0].cost->sets = {};
  for (const result::Figure& figure : result::figures()) {
    const config::LimitRule rules[] = {config::limit_rule(std::string(figure.name) + " >= 0", "", "--fail-if")};
    const std::vector<std::string> broken = limit_findings(result, rules).broken;
    ASSERT_EQ(broken.size(), 1u) << figure.name;
    EXPECT_EQ(broken.front().find("could not"), std::string::npos) << broken.front();
  }
}

// A budget in percent of one set is never held against another one.
TEST(Limits, a_change_is_of_the_same_samples_or_could_not_be_checked) {
  result::Result base;
  base.cases.push_back(
      test::case_of(Json::parse(R"({"id": "a", "name": "hall/walk/frustum/bounds/packed", "scene": "hall",
    "camera": "walk", "viewport": [8, 8], "grid": {"name": "frustum"}, "assigner": {"name": "bounds", "label": "bounds"},
    "storage": "packed", "shading": {"missed": 1, "needed": 1000}})")));
  result::Result now = base;
  now.cases[0].samples.emplace().opaque = result::SampleSet{.needed = 100, .missed = 1};
  const BaselineCases baseline(base, now, "", "base.json");
  const auto broken = [&](const std::string& text) {
    const config::LimitRule rules[] = {config::limit_rule(text, "", "--fail-if")};
    return limit_findings(now, rules, &baseline).broken;
  };
  EXPECT_EQ(
      broken("unlit > +5 %"),
      (Lines{"'unlit > +5 %' could not be checked for hall/walk/frustum/bounds/packed: unlit is at samples of opaque "
             "here and of volume in base.json; name one set, as in 'volume.unlit'"}));
  EXPECT_EQ(broken("volume.unlit > +5 %"), Lines{});
}

}  // namespace
}  // namespace clusterbench::report
