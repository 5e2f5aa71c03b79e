// Cases whose method runs on a device: their times are the device's, and rank nothing but each other.

#include <gtest/gtest.h>

#include <limits>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "report/cases/contender.h"
#include "report/cases/timing_warnings.h"
#include "report/choosing/conclusion.h"
#include "report/comparison_by_hand.h"
#include "report/exports/exports.h"
#include "report/results/merge.h"
#include "report/tables/table.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::case_by_hand;
using testing::compared;
using testing::json_of;
using testing::result_by_hand;

// The cases by hand (9.5 and 3.5 us on the processor), and one on a device that took this long.
run::Result with_device(double run_ns, gpu::DeviceType type = gpu::DeviceType::discrete) {
  run::Result result = result_by_hand();
  result.device.emplace();
  result.device->name = "Card";
  result.device->type = type;
  run::CaseResult on_device = case_by_hand("device", "gpu-cells", 1.0);
  on_device.timing.reset();
  on_device.on_device = true;
  const auto time = [](double ns) {
    return measure::TimeStats{ns, 1.0, ns, ns, {0.998 * ns, 1.002 * ns}, std::vector<double>(31, ns)};
  };
  const auto spans = [&](double ns) {
    return run::DeviceSpanTimes{time(ns), time(100.0), time(200.0), time(500.0), ns / 500.0, {}};
  };
  on_device.device.emplace();
  on_device.device->device = "Card";
  on_device.device->is_software = type == gpu::DeviceType::software;
  on_device.device->frames_timed = 2;
  on_device.device->launches = 5;
  on_device.device->dispatches = 4.0;
  on_device.device->cold = spans(run_ns);
  on_device.device->warm = spans(0.75 * run_ns);
  result.cases.push_back(on_device);
  result.planned_ids.push_back("device");
  return result;
}

std::string conclusion_of(const run::Result& result) {
  return json_of(result)["conclusions"][0]["text"];
}

TEST(DeviceCases, have_no_star_however_fast_they_are) {
  const Json json = json_of(with_device(1.0));
  EXPECT_EQ(json["pareto_front"][0]["ids"].dump(), Json(json_of(result_by_hand())["pareto_front"][0]["ids"]).dump());
  EXPECT_EQ(json["cases"][2]["assigner"]["on_device"], true);
  EXPECT_FALSE(json["cases"][2].contains("timing"));
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
}

TEST(DeviceCases, are_in_a_block_of_their_own_with_times_of_their_own) {
  const std::string table = render_table(test::result_of(json_of(with_device(2000.0))), false);
  const std::size_t own = table.find("frustum 64px"), on_card = table.find("on Card: frustum 64px");
  ASSERT_NE(on_card, std::string::npos) << table;
  EXPECT_LT(own, on_card);
  EXPECT_NE(table.find("device us      ±  x floor  warm  upload  readback", on_card), std::string::npos) << table;
  EXPECT_EQ(table.substr(0, on_card).find("device us"), std::string::npos) << table;
  EXPECT_NE(table.find("    gpu-cells       2.00  0.2 %     4.00  1.50    0.10      0.20"), std::string::npos) << table;
  EXPECT_NE(table.find("from lights to lists, with cold caches (warm: without)"), std::string::npos) << table;
  EXPECT_EQ(table.find("build: of the cells"), std::string::npos) << table;
}

TEST(DeviceCases, tell_how_they_were_measured) {
  run::Result result = with_device(2000.0);
  run::DeviceTimes& times = *result.cases[2].device;
  times.cold->repeats = {.upload = 3, .run = 3, .floor = 4};
  times.build_ns = measure::TimeStats{900.0, 1.0, 900.0, 900.0, {890.0, 910.0}, {900.0}};
  times.builds_per_frame = 1.0;
  times.clock_mhz = {1500.0, 1510.0, 1480.0};
  times.shaders = {{"cells, mode 1", "Register Count", 40.0}};
  result.arithmetic = gpu::Arithmetic{.rounding = gpu::Rounding::either_way, .division_ulp = 1.5};
  const Json json = json_of(result), device = json["cases"][2]["device"];
  EXPECT_EQ(device["caches"], "cold");
  EXPECT_EQ(device["launches"], 5);
  EXPECT_EQ(device["repeats"].dump(), R"({"upload":3,"run":3,"floor":4})");
  EXPECT_EQ(device["warm"]["run_ns"]["median"], 1500.0);
  EXPECT_EQ(device["build_ns"]["median"], 900.0);
  EXPECT_EQ(device["clock_mhz"].dump(), R"({"median":1500,"min":1480,"max":1510,"samples":[1500,1510,1480]})");
  EXPECT_EQ(device["shaders"].dump(), R"([{"shader":"cells, mode 1","name":"Register Count","value":40}])");
  EXPECT_EQ(json["device"]["arithmetic"]["rounding"], "either_way");
  EXPECT_EQ(json["device"]["arithmetic"]["division_ulp"], 1.5);
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
  const std::string table = render_table(test::result_of(json), false);
  EXPECT_NE(table.find("build: of the cells, when the grid changes"), std::string::npos) << table;
  EXPECT_EQ(table.find("warning: the device ran"), std::string::npos) << table;
}

TEST(DeviceCases, of_a_device_whose_clock_moves_are_doubted) {
  run::Result result = with_device(2000.0);
  result.cases[2].device->clock_mhz = {1500.0, 1410.0, 1500.0};
  const std::string table = render_table(test::result_of(json_of(result)), false);
  EXPECT_NE(table.find("warning: the device ran at 1410 to 1500 MHz while "), std::string::npos) << table;
}

TEST(DeviceCases, without_an_interval_or_with_a_wide_one_are_doubted_unless_they_are_of_software) {
  const auto warnings_with = [](double low, double high, gpu::DeviceType type = gpu::DeviceType::discrete) {
    run::Result result = with_device(2000.0, type);
    result.cases[2].device->cold->run_ns.ci95 = {low, high};
    return timing_warnings(test::result_of(json_of(result)));
  };
  EXPECT_EQ(warnings_with(1900.0, 2150.0).find("on the device"), std::string::npos);
  EXPECT_NE(warnings_with(1500.0, 2500.0)
                .find("warning: 1 of 1 time on the device with intervals wider than ±10 %, the widest -25/+25 %: "
                      "hall/walk/frustum 64px/gpu-cells/packed; leave the device to this run, or try --launches 20"),
            std::string::npos)
      << warnings_with(1500.0, 2500.0);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(warnings_with(unknown, unknown).find("warning: 1 of 1 time on the device without an interval: "),
            std::string::npos)
      << warnings_with(unknown, unknown);
  const std::string of_software = warnings_with(unknown, unknown, gpu::DeviceType::software);
  EXPECT_EQ(of_software.find("on the device"), std::string::npos) << of_software;
  EXPECT_NE(of_software.find("warning: times on Card are a processor's and no GPU's"), std::string::npos)
      << of_software;
}

TEST(DeviceCases, of_software_are_in_the_order_of_the_configuration) {
  const auto table_with = [](gpu::DeviceType type) {
    run::Result result = with_device(2000.0, type);
    run::CaseResult faster = case_by_hand("faster", "gpu-group", 1.0);
    faster.timing.reset();
    faster.on_device = true;
    faster.device = result.cases[2].device;
    faster.device->cold->run_ns.median = 1000.0;
    result.cases.push_back(faster);
    result.planned_ids.push_back("faster");
    return render_table(test::result_of(json_of(result)), false);
  };
  const std::string sorted = table_with(gpu::DeviceType::discrete), in_order = table_with(gpu::DeviceType::software);
  EXPECT_LT(sorted.find("gpu-group "), sorted.find("gpu-cells ")) << sorted;
  EXPECT_GT(in_order.find("gpu-group "), in_order.find("gpu-cells ")) << in_order;
  EXPECT_NE(in_order.find("on Card (software, not sorted by time): frustum 64px"), std::string::npos) << in_order;
}

TEST(DeviceCases, of_older_versions_are_read) {
  Json json = json_of(with_device(2000.0));
  for (const char* late : {"software", "caches", "launches", "repeats", "warm"}) json["cases"][2]["device"].erase(late);
  const result::Result read = test::result_of(json);
  EXPECT_FALSE(read.cases[2].device->caches);
  EXPECT_EQ(read.cases[2].device->run_ns.median, 2000.0);
  EXPECT_EQ(config::schema_violations(config::result_schema(), nlohmann::json::parse(json.dump())),
            std::vector<std::string>{});
}

TEST(DeviceCases, are_told_of_after_the_conclusion_on_the_processor) {
  const std::string text = conclusion_of(with_device(2000.0)), without = conclusion_of(result_by_hand());
  EXPECT_TRUE(text.starts_with(without)) << text;
  EXPECT_NE(
      text.find("On Card: frustum 64px/gpu-cells/packed makes its lists fastest, in 2.00 us by its clock, 4.0 times"),
      std::string::npos)
      << text;
}

TEST(DeviceCases, of_software_rank_nothing) {
  const std::string text = conclusion_of(with_device(2000.0, gpu::DeviceType::software));
  EXPECT_NE(text.find("On Card: its times rank nothing"), std::string::npos) << text;
  EXPECT_EQ(text.find("fastest, in"), std::string::npos) << text;
}

run::CaseResult on_device(const run::Result& result, const char* method, double run_ns) {
  run::CaseResult out = case_by_hand(method, method, 1.0);
  out.timing.reset();
  out.on_device = true;
  out.device = result.cases[2].device;
  measure::TimeStats& time = out.device->cold->run_ns;
  time.median = run_ns;
  time.ci95 = {0.9 * run_ns, 1.1 * run_ns};
  return out;
}

TEST(DeviceCases, that_are_not_told_from_the_fastest_are_named_before_the_first_that_is_slower) {
  run::Result result = with_device(2000.0);
  for (const auto& [method, run_ns] :
       {std::pair{"gpu-group", 2100.0}, std::pair{"gpu-mask", 9000.0}, std::pair{"gpu-refined", 2150.0}}) {
    result.cases.push_back(on_device(result, method, run_ns));
    result.planned_ids.emplace_back(method);
  }
  const std::string text = conclusion_of(result);
  EXPECT_NE(text.find("frustum 64px/gpu-cells/packed makes its lists fastest"), std::string::npos) << text;
  EXPECT_NE(text.find("; frustum 64px/gpu-group/packed, frustum 64px/gpu-refined/packed are not known to be slower; "
                      "frustum 64px/gpu-mask/packed takes 4.50 times as long"),
            std::string::npos)
      << text;
}

TEST(DeviceCases, with_lights_of_visible_surfaces_hide_no_reason_of_the_others) {
  run::Result result = with_device(2000.0);
  result.cases.push_back(on_device(result, "gpu-tiled", 2100.0));
  result.planned_ids.emplace_back("gpu-tiled");
  result.cases.erase(result.cases.begin(), result.cases.begin() + 2);
  const std::string text = conclusion_of(result);
  EXPECT_NE(text.find("nothing to take of methods that run on the processor"), std::string::npos) << text;
  EXPECT_EQ(text.find("these methods light visible surfaces"), std::string::npos) << text;
}

TEST(DeviceCases, alone_leave_nothing_to_take_on_the_processor) {
  run::Result result = with_device(2000.0);
  result.cases.erase(result.cases.begin(), result.cases.begin() + 2);
  const std::string text = conclusion_of(result);
  EXPECT_NE(text.find("nothing to take of methods that run on the processor"), std::string::npos) << text;
  EXPECT_NE(text.find("On Card: "), std::string::npos) << text;
}

constexpr const char* k_not_compared =
    "times of methods on a device are not compared: the base ran on Card with cold caches, the new result on Other "
    "card "
    "with cold caches";

TEST(DeviceCases, are_compared_by_the_devices_times_on_the_same_device_alone) {
  const Json base = json_of(with_device(2000.0)), next = json_of(with_device(2400.0));
  EXPECT_EQ(compared(base, next, 0.02)["cases"][2]["hint"], "longer");
  Json elsewhere = next;
  elsewhere["cases"][2]["device"]["device"] = "Other card";
  Json warm = next;
  warm["cases"][2]["device"]["caches"] = "warm";
  EXPECT_FALSE(compared(base, warm, 0.02)["cases"][2].contains("hint"));
  const Json comparison = compared(base, elsewhere, 0.02);
  EXPECT_FALSE(comparison["cases"][2].contains("hint"));
  EXPECT_TRUE(testing::holds(comparison["warnings"], k_not_compared)) << comparison["warnings"];
  EXPECT_EQ(comparison["cases"][0]["hint"], "none") << "times of the processor are compared all the same";
}

TEST(DeviceCases, on_another_device_are_named_beside_those_on_the_same_one) {
  Json base = json_of(with_device(2000.0));
  base["cases"].push_back(base["cases"][2]);
  base["cases"][3]["id"] = "device 2";
  base["cases"][3]["name"] = "second";
  Json next = base;
  next["cases"][3]["device"]["device"] = "Other card";
  const Json comparison = compared(base, next, 0.02);
  EXPECT_TRUE(comparison["cases"][2].contains("hint"));
  EXPECT_FALSE(comparison["cases"][3].contains("hint"));
  EXPECT_TRUE(testing::holds(comparison["warnings"], k_not_compared)) << comparison["warnings"];
}

// An interval between few launches is wide for its error: Student's t has its tails, and 2 degrees of freedom are
// not 30.
TEST(DeviceCases, with_intervals_between_launches_are_compared_by_as_many_degrees_of_freedom) {
  const auto p_of = [](std::uint64_t launches) {
    run::Result base = with_device(2000.0), next = with_device(2060.0);  // 3 % more, each with an interval of +-1 %
    for (run::Result* one : {&base, &next}) {
      one->cases[2].device->launches = static_cast<int>(launches);
      measure::TimeStats& time = one->cases[2].device->cold->run_ns;
      time.ci95 = {0.99 * time.median, 1.01 * time.median};
    }
    const Json comparison = compared(json_of(base), json_of(next), 0.01, {.gates_separate = true});
    return comparison["cases"][2]["p_corrected"].get<double>() / comparison["summary"]["methods_timed"].get<double>();
  };
  // Two-sided tails of ln(1.03) / (sqrt(2) * 0.01 / quantile), integrated elsewhere: t = 8.993, 5.803 and 4.096.
  EXPECT_NEAR(p_of(3), 0.012141, 1e-5);
  EXPECT_NEAR(p_of(5), 0.0043866, 1e-5);
  EXPECT_NEAR(p_of(1), 0.00029276, 1e-6);
}

TEST(DeviceCases, keep_their_device_in_a_merged_result_unless_there_are_several) {
  run::Result on_processor = result_by_hand(), on_device = with_device(2000.0), on_other = with_device(2000.0);
  on_device.cases.erase(on_device.cases.begin(), on_device.cases.begin() + 2);
  on_other.cases = {on_device.cases[0]};
  on_other.cases[0].id = "other";
  on_other.planned_ids = {"other"};
  on_other.device->name = "Other card";
  const NamedPart first{"a.json", test::result_of(json_of(on_processor))},
      second{"b.json", test::result_of(json_of(on_device))}, third{"c.json", test::result_of(json_of(on_other))};
  EXPECT_EQ(merged({first, second}).device->name, "Card");
  EXPECT_FALSE(merged({first, second, third}).device);
}

TEST(DeviceCases, name_their_device_in_tables_for_other_programs) {
  const auto exported_as = [](const char* format, const run::Result& result) {
    return exported(test::result_of(json_of(result)), export_format(format), false);
  };
  const run::Result on_card = with_device(2000.0), on_software = with_device(2000.0, gpu::DeviceType::software);
  EXPECT_NE(exported_as("csv", on_card).find(",storage,device,"), std::string::npos);
  EXPECT_NE(exported_as("csv", on_card).find(",packed,Card,"), std::string::npos) << exported_as("csv", on_card);
  EXPECT_NE(exported_as("csv", on_software).find(",packed,Card (software),"), std::string::npos);
  EXPECT_NE(exported_as("markdown", on_software).find(" Card (software) |"), std::string::npos);
  EXPECT_EQ(exported_as("csv", result_by_hand()).find(",device"), std::string::npos);
}

TEST(DeviceCases, of_software_are_told_from_those_of_a_card_in_a_merged_result) {
  run::Result on_card = with_device(2000.0), on_software = with_device(2000.0, gpu::DeviceType::software);
  on_card.cases.erase(on_card.cases.begin(), on_card.cases.begin() + 2);
  on_software.cases = {on_software.cases[2]};
  on_software.cases[0].id = "soft";
  on_software.cases[0].device->device = on_software.device->name = "Processor";
  on_software.planned_ids = {"soft"};
  const result::Result all =
      merged({{"a.json", test::result_of(json_of(on_card))}, {"b.json", test::result_of(json_of(on_software))}});
  const std::string table = render_table(all, false);
  EXPECT_NE(table.find("on Card: frustum 64px"), std::string::npos) << table;
  EXPECT_NE(table.find("on Processor (software, not sorted by time): frustum 64px"), std::string::npos) << table;
  EXPECT_NE(table.find("warning: times on Processor are a processor's and no GPU's"), std::string::npos) << table;
}

}  // namespace
}  // namespace clusterbench::report
