#pragma once
// Comparisons of results made by hand, as JSON.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "records.h"
#include "report/comparing/compare.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"

namespace clusterbench::report::testing {

using Json = nlohmann::ordered_json;

inline Json json_of(const run::Result& result) {
  return result::to_json(record_of(judged(result), {}));
}

// 31 samples with a median's interval of +-0.2 % around `ns`.
inline void set_time(run::CaseResult& case_result, double ns) {
  case_result.timing->frame_ns = {ns, 1.0, ns, ns, {0.998 * ns, 1.002 * ns}, std::vector<double>(31, ns)};
}

inline run::Result with_times(double slow_ns, double fast_ns) {
  run::Result result = result_by_hand();
  set_time(result.cases[0], slow_ns);
  set_time(result.cases[1], fast_ns);
  return result;
}

// Every comparison is checked against its schema.
inline Json compared(const Json& base, const Json& next, double threshold, const CompareOptions& options = {}) {
  Json comparison = result::to_json(compare_results(test::result_of(base), test::result_of(next), threshold, options));
  const Json violations = config::schema_violations(config::row_of(config::Document::comparison).schema(),
                                                    nlohmann::json::parse(comparison.dump()));
  EXPECT_TRUE(violations.empty()) << violations.dump(1) << comparison.dump(1);
  return comparison;
}

// A comparison is written and read back before its text and exit code are made.
inline result::Comparison read(const Json& comparison) {
  return result::from_json<result::Comparison>(comparison);
}
inline ExitCode outcome(const Json& comparison, bool is_strict) {
  return report::outcome(read(comparison), is_strict);
}
inline std::string comparison_text(const Json& comparison) {
  return report::comparison_text(read(comparison));
}
inline std::string comparison_markdown(const Json& comparison) {
  return report::comparison_markdown(read(comparison));
}

inline std::string verdict_of(const Json& comparison, std::size_t place) {
  return comparison["cases"][place].value("verdict", "none");
}

inline constexpr CompareOptions k_gate_separate{.gates_separate = true};

inline bool holds(const Json& lines, const std::string& part) {
  return lines.dump().find(part) != std::string::npos;
}

// Three launches of two rounds each, in which the new program takes `percent` more, give or take 0.1 %.
inline Json paired(double percent) {
  Json launches = Json::array();
  for (const double noise : {-0.1, 0.0, 0.1}) {
    const double next_ns = 1000.0 * (1.0 + (percent + noise) / 100.0);
    launches.push_back({{"base_ns", {1000.0, 2000.0}}, {"new_ns", {next_ns, 2.0 * next_ns}}});
  }
  return {{"launches", launches}, {"base_ns", 1500.0}, {"new_ns", 1500.0}, {"ratio", 1.0}, {"ci95", {1.0, 1.0}}};
}

inline Json measured_beside(const Json& base, double percent) {
  Json next = json_of(with_times(9000, 3000));
  next["tool"]["git_sha"] = "def";
  next["baseline"]["tool"] = base["tool"];
  for (Json& entry : next["cases"]) entry["timing"]["baseline"] = paired(percent);
  return next;
}

}  // namespace clusterbench::report::testing
