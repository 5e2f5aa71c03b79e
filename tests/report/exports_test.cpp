#include "report/exports/exports.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "records.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Two cases: "slow" is brute force, "fast" also has counted instructions, an interval and three rounds.
Json result() {
  run::Result by_hand = testing::result_by_hand();
  testing::add_count(by_hand.cases[1]);
  by_hand.cases[1].timing->frame_ns = {3000.0, 10.0, 2990.0, 3020.0, {2990.0, 3020.0}, {2990.0, 3000.0, 3020.0}};
  by_hand.cases[1].timing->against_first = run::Versus{"brute-force", {0.25, {0.2, 0.5}}};
  return result::to_json(record_of(by_hand, {}));
}

std::string written(const std::string& format, bool all = false) {
  return exported(test::result_of(result()), export_format(format), all);
}

Json json_of(const std::string& format, bool all = false) {
  return Json::parse(written(format, all));
}

std::vector<std::string> violations(const char* schema, const std::string& instance) {
  return config::schema_violations(nlohmann::json::parse(schema), nlohmann::json::parse(instance));
}

TEST(Exports, no_two_figures_are_of_one_number_and_each_interval_stands_beside_its_value) {
  result::Case full;
  int last = 0;
  test::fill_with_numbers(full, [&last] { return ++last; });
  std::map<double, std::string_view> name_of;
  for (const result::Figure* exported : export_figures()) {
    const result::Figure& figure = *exported;
    const std::optional<double> value = figure.recorded(full);
    ASSERT_TRUE(value) << figure.name;
    const std::string_view other = name_of.try_emplace(*value, figure.name).first->second;
    const bool is_inverse = other == "pair_rate" && figure.name == "time_per_pair";
    EXPECT_TRUE(other == figure.name || is_inverse) << figure.name << " is " << other;
    if (figure.interval == nullptr) continue;
    const result::Interval* ends = figure.interval(full);
    ASSERT_NE(ends, nullptr) << figure.name;
    EXPECT_GT((*ends)[0], *value) << figure.name;
    EXPECT_LE((*ends)[0], *value + 4.0) << figure.name;  // the least, the 95th percentile and the like lie between
  }
}

TEST(Exports, an_unknown_format_is_answered_with_the_nearest_one_and_the_list) {
  try {
    export_format("benchr");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("did you mean 'bencher'?"), std::string::npos) << error.message();
    EXPECT_NE(error.message().find("google-benchmark"), std::string::npos) << error.message();
  }
}

TEST(Exports, a_quotient_takes_its_interval_along) {
  const Json entry = result()["cases"][1];
  const std::vector<Measured> figures = measured(test::case_of(entry), false);
  const auto speedup = std::find_if(figures.begin(), figures.end(),
                                    [](const Measured& figure) { return figure.figure->exported_as() == "speedup"; });
  ASSERT_NE(speedup, figures.end());
  EXPECT_EQ(speedup->value, 4.0);
  EXPECT_EQ(speedup->ci95.low, 2.0);
  EXPECT_EQ(speedup->ci95.high, 5.0);
}

TEST(Exports, the_headline_is_part_of_everything) {
  const Json all = result();
  for (const Json& entry : all["cases"])
    EXPECT_LT(measured(test::case_of(entry), false).size(), measured(test::case_of(entry), true).size());
}

TEST(Exports, times_of_several_machines_have_a_column_that_names_them_or_are_refused) {
  result::Result merged = test::result_of(result());
  merged.machines = {{"machine 1", merged.machine, "AVX2", {}}, {"machine 2", merged.machine, "SCALAR", {}}};
  merged.cases[0].machine = "machine 1";
  merged.cases[1].machine = "machine 2";
  const std::string table = exported(merged, export_format("csv"), false);
  EXPECT_NE(table.find(",storage,machine,"), std::string::npos) << table;
  EXPECT_NE(table.find(",packed,machine 2,"), std::string::npos) << table;
  const std::string markdown = exported(merged, export_format("markdown"), false);
  EXPECT_NE(markdown.find(" machine 2 |"), std::string::npos) << markdown;
  EXPECT_EQ(written("csv").find("machine"), std::string::npos);
  for (const char* format : {"google-benchmark", "github-smaller", "github-bigger", "bencher", "lnt"}) {
    std::string said = "accepted";
    try {
      exported(merged, export_format(format), false);
    } catch (const Error& error) {
      said = error.what();
    }
    EXPECT_NE(said.find("/machines: has times of several machines, and " + std::string(format) + " is of one"),
              std::string::npos)
        << said;
  }
}

TEST(Exports, a_case_without_its_name_is_named_by_its_place) {
  Json broken = result();
  broken["cases"][1].erase("name");
  try {
    exported(test::result_of(broken), export_format("csv"), false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/cases/1/name");
  }
}

TEST(Bencher, fits_its_published_schema) {
  constexpr const char* k_schema = R"({"type": "object", "minProperties": 2, "additionalProperties": {"type": "object",
    "minProperties": 1, "additionalProperties": {"type": "object", "required": ["value"], "additionalProperties": false,
    "properties": {"value": {"type": "number"}, "lower_value": {"type": "number"}, "upper_value": {"type": "number"}}}}})";
  for (const bool all : {false, true})
    EXPECT_EQ(violations(k_schema, written("bencher", all)), std::vector<std::string>{});
  const Json latency = json_of("bencher")["hall/walk/frustum 64px/aabb/packed"]["latency"];
  EXPECT_EQ(latency, Json({{"value", 3000.0}, {"lower_value", 2990.0}, {"upper_value", 3020.0}}));
}

TEST(GithubAction, both_lists_fit_what_the_action_reads) {
  constexpr const char* k_schema = R"({"type": "array", "minItems": 1, "items": {"type": "object",
    "required": ["name", "unit", "value"], "additionalProperties": false, "properties": {"name": {"type": "string"},
    "unit": {"type": "string"}, "value": {"type": "number"}, "range": {"type": "string"}, "extra": {"type": "string"}}}})";
  for (const char* format : {"github-smaller", "github-bigger"})
    for (const bool all : {false, true})
      EXPECT_EQ(violations(k_schema, written(format, all)), std::vector<std::string>{}) << format;
}

TEST(GithubAction, each_list_holds_only_what_is_better_its_way) {
  const std::string smaller = written("github-smaller", true), bigger = written("github-bigger", true);
  EXPECT_NE(smaller.find("aabb/packed assign_time"), std::string::npos);
  EXPECT_EQ(smaller.find("speedup"), std::string::npos);
  EXPECT_NE(bigger.find("aabb/packed speedup"), std::string::npos);
  EXPECT_EQ(bigger.find("assign_time"), std::string::npos);
  EXPECT_EQ(smaller.find("pairs_mean"), std::string::npos);  // neither
  EXPECT_EQ(json_of("github-smaller")[6]["range"], Json()) << "of a figure without interval";
}

TEST(Lnt, fits_the_documented_report_format_2) {
  constexpr const char* k_schema = R"({"type": "object", "required": ["format_version", "machine", "run", "tests"],
    "additionalProperties": false, "properties": {"format_version": {"const": "2"},
    "machine": {"type": "object", "required": ["name"], "additionalProperties": {"type": "string"}},
    "run": {"type": "object", "required": ["llvm_project_revision"], "additionalProperties": {"type": "string"}},
    "tests": {"type": "array", "minItems": 2, "items": {"type": "object", "required": ["name"], "properties":
      {"name": {"type": "string"}}, "additionalProperties": {"anyOf": [{"type": "number"}, {"type": "string"},
      {"type": "array", "items": {"type": "number"}}]}}}}})";
  for (const bool all : {false, true}) EXPECT_EQ(violations(k_schema, written("lnt", all)), std::vector<std::string>{});
}

TEST(Lnt, the_headline_is_in_seconds_and_bytes_as_its_test_suite_has_them) {
  const Json test = json_of("lnt")["tests"][1];
  ASSERT_EQ(test["execution_time"].size(), 3U);
  EXPECT_DOUBLE_EQ(test["execution_time"][0], 2.99e-6);
  EXPECT_EQ(test["mem_bytes"], 232.0);
  EXPECT_EQ(test.size(), 3U);
}

// Fields of a row by the heading's names. For texts without quotes.
std::map<std::string, std::string> csv_row(const std::string& text, int row) {
  std::istringstream lines(text);
  std::string heading, line;
  std::getline(lines, heading);
  for (int i = 0; i <= row; ++i) std::getline(lines, line);
  std::map<std::string, std::string> fields;
  std::istringstream names(heading), values(line + ",");
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
    fields[name] = value;
  return fields;
}

TEST(Csv, the_parts_of_a_name_are_columns_and_the_heading_has_units) {
  const auto fast = csv_row(written("csv", true), 1);
  const std::pair<const char*, const char*> rows[] = {
      {"scene", "hall"},        {"camera", "walk"},        {"viewport", "1920x1080"},
      {"grid", "frustum 64px"}, {"assigner", "aabb"},      {"precision", "float32"},
      {"storage", "packed"},    {"frame_time_ns", "3000"}, {"frame_time_ns_low", "2990"},
      {"list_bytes", "232"}};
  for (const auto& [column, value] : rows) {
    ASSERT_TRUE(fast.contains(column)) << written("csv", true);
    EXPECT_EQ(fast.at(column), value) << column;
  }
  for (const char* column : {"overshade", "build_time_ns", "time_per_pair_ns", "pair_rate_pairs_per_s", "missed_pairs"})
    EXPECT_TRUE(fast.contains(column)) << column;
}

TEST(Csv, the_columns_are_the_same_whatever_was_measured) {
  run::Result bare = testing::result_by_hand();
  for (run::CaseResult& case_result : bare.cases) {
    case_result.timing.reset();
    case_result.error.reset();
    case_result.shading.reset();
  }
  const auto heading = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  const std::string of_bare = exported(record_of(bare, {}), export_format("csv"), false);
  EXPECT_EQ(heading(of_bare), heading(written("csv")));
  const auto fields = csv_row(of_bare, 1);
  EXPECT_EQ(fields.at("list_bytes"), "232");
  for (const char* column : {"assign_time_ns", "assign_time_ns_high", "excess_ratio", "overshade"})
    EXPECT_EQ(fields.at(column), "") << column;
}

TEST(Csv, commas_quotes_and_line_ends_in_names_stay_in_their_field) {
  Json named = result();
  named["cases"][0]["name"] = "a, \"b\"\nc";
  const std::string text = exported(test::result_of(named), export_format("csv"), false);
  EXPECT_NE(text.find("slow,\"a, \"\"b\"\"\nc\",hall,walk,"), std::string::npos) << text;
}

TEST(Csv, names_that_begin_like_a_formula_are_text_and_numbers_stay_numbers) {
  for (const std::string begin : {"=", "+", "-", "@", "\t", "\r"}) {
    Json named = result();
    named["cases"][0]["name"] = begin + "1+2";
    const std::string text = exported(test::result_of(named), export_format("csv"), false);
    EXPECT_NE(text.find("'" + begin + "1+2"), std::string::npos) << text;
    EXPECT_EQ(text.find("'slow"), std::string::npos) << text;
  }
  Json quoted = result();
  quoted["cases"][0]["name"] = "=HYPERLINK(\"a\",1)";
  const std::string text = exported(test::result_of(quoted), export_format("csv"), false);
  EXPECT_NE(text.find("slow,\"'=HYPERLINK(\"\"a\"\",1)\",hall,walk,"), std::string::npos) << text;
}

TEST(Markdown, viewport_and_precision_are_columns_only_where_they_differ) {
  Json two = result();
  EXPECT_TRUE(exported(test::result_of(two), export_format("markdown"), false)
                  .starts_with("| scene | camera | grid | assigner | storage |"));
  two["cases"][0]["viewport"] = {640, 360};
  const std::string text = exported(test::result_of(two), export_format("markdown"), false);
  EXPECT_TRUE(text.starts_with("| scene | camera | viewport | grid | assigner | storage |")) << text;
  EXPECT_NE(text.find("\n| hall | walk | 640x360 | frustum 64px | brute-force | packed |"), std::string::npos) << text;
}

TEST(Markdown, every_row_has_the_columns_of_the_heading) {
  Json named = result();
  named["cases"][0]["scene"] = "a|b\n<c>";
  std::istringstream lines(exported(test::result_of(named), export_format("markdown"), true));
  std::string line;
  std::getline(lines, line);
  const auto bars = [](const std::string& text) {
    int count = 0;
    for (std::size_t at = 0; at < text.size(); ++at) count += text[at] == '|' && (at == 0 || text[at - 1] != '\\');
    return count;
  };
  const int columns = bars(line);
  EXPECT_GT(columns, 20);
  int rows = 0;
  for (; std::getline(lines, line); ++rows) EXPECT_EQ(bars(line), columns) << line;
  EXPECT_EQ(rows, 3);
}

TEST(GoogleBenchmark, a_result_without_times_says_what_to_do) {
  run::Result counted = testing::result_by_hand();
  for (run::CaseResult& case_result : counted.cases) case_result.timing.reset();
  try {
    exported(record_of(counted, {}), export_format("google-benchmark"), false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("--no-timing"), std::string::npos) << error.message();
  }
}

// Google Benchmark's own tool (Debian: libbenchmark-tools, which needs python3-scipy).
TEST(GoogleBenchmark, its_compare_py_finds_the_slower_case) {
  const fs::path tool = "/usr/share/benchmark/compare.py";
  if (!fs::exists(tool) || std::system("/usr/bin/python3 -c 'import scipy, numpy' 2>/dev/null") != 0)
    GTEST_SKIP() << "compare.py or its scipy is missing: apt-get install libbenchmark-tools python3-scipy";
  const fs::path folder = fs::temp_directory_path() / ("clusterbench_compare_" + std::to_string(getpid()));
  fs::create_directories(folder);
  Json twice = result();
  for (Json& sample : twice["cases"][1]["timing"]["frame_ns"]["samples"]) sample = 2.0 * sample.get<double>();
  std::ofstream(folder / "base.json") << written("google-benchmark");
  std::ofstream(folder / "new.json") << exported(test::result_of(twice), export_format("google-benchmark"), false);
  const std::string in = folder.string() + "/";
  const std::string command = "/usr/bin/python3 " + tool.string() + " --no-color benchmarks " + in + "base.json " + in +
                              "new.json > " + in + "out 2> " + in + "err";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const auto text = [&](const char* name) {
    std::ifstream file(folder / name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(text("err"), "");
  const std::string out = text("out");
  EXPECT_TRUE(std::regex_search(out, std::regex("aabb/packed +\\+1\\.0000 +\\+1\\.0000 +2990 +5980"))) << out;
  EXPECT_NE(out.find("aabb/packed_pvalue"), std::string::npos) << out;
  fs::remove_all(folder);
}

}  // namespace
}  // namespace clusterbench::report
