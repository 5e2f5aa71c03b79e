#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "config/config.h"
#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "report/results/result_record.h"
#include "run/records/records.h"
#include "run/walk.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

run::Result detailed(const std::string& details, int threads = 1, const std::string& name = "lamp") {
  run::testing::Walk walk(
      R"("grids": [{"tiles": {"pixels": [4, 4]}, "slices": {"count": 32}}], "assigners": ["bounds"], "details": )" +
      details);
  walk.config.threads = threads;
  for (int i = 0; i < 80; ++i) {
    scene::Light& light =
        walk.add_light({8 * std::sin(i * 1.3), 6 * std::sin(i * 2.9), -15 + 14 * std::sin(i * 0.7)}, 1.0 + 0.05 * i);
    light.name = name;
    if (i % 3 == 0) light.type = scene::LightType::spot;
  }
  return walk.run();
}

std::string text(const run::Result& result) {
  return result::to_json(run::record_of(result.cases.at(0)))["details"].dump();
}

TEST(DetailsJson, follows_the_schema) {
  run::Result result = detailed(R"({"frames": [0, 2, 9]})");
  Json json = result::to_json(record_of(result, {}));
  EXPECT_EQ(config::schema_violations(config::result_schema(), json), std::vector<std::string>{});
  const Json& details = json["cases"][0]["details"];
  EXPECT_EQ(details["frames"].size(), 2u);
  EXPECT_EQ(details["left_out"], (Json{{"frames", Json::array()}, {"pairs", Json::array()}, {"not_on_path", {9}}}));
  EXPECT_EQ(details["frames"][1]["camera"]["eye"], (Json{0.0, 0.0, -2.0}));
  EXPECT_EQ(details["frames"][1]["camera"]["far_m"], 64.0);
  result.cases[0].details->frames[0].projection.far_m = std::numeric_limits<double>::infinity();
  json = result::to_json(record_of(result, {}));
  EXPECT_EQ(config::schema_violations(config::result_schema(), json), std::vector<std::string>{});
}

TEST(DetailsJson, a_result_without_details_does_not_speak_of_them) {
  EXPECT_FALSE(run::record_of(detailed("null").cases.at(0)).details.has_value());
}

TEST(DetailsJson, never_has_more_than_max_bytes) {
  const std::size_t whole = text(detailed(R"({"frames": 3})")).size();
  EXPECT_GT(whole, 16'000u) << "so that what follows has something to leave out";
  for (std::size_t max_bytes = 10'000; max_bytes < whole; max_bytes += max_bytes / 3)
    for (const std::string name : {"lamp", "\"\n\t\\ \x01"})
      EXPECT_LE(text(detailed(R"({"frames": 3, "max_bytes": )" + std::to_string(max_bytes) + "}", 1, name)).size(),
                max_bytes);
}

TEST(DetailsJson, is_byte_identical_on_any_number_of_threads) {
  EXPECT_EQ(text(detailed(R"({"frames": 3})", 1)), text(detailed(R"({"frames": 3})", 3)));
}

}  // namespace
}  // namespace clusterbench::report
