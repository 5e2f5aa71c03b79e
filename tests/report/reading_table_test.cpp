// What samples pay on a device: the table, sums of a frame, prices of the cost model.

#include "report/tables/reading_table.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "report/comparison_by_hand.h"
#include "report/results/measured_prices.h"
#include "report/tables/warnings.h"
#include "result/figures/case_figure.h"

namespace clusterbench::report {
namespace {

using testing::result_by_hand;

measure::TimeStats rounds_of(double ns) {
  return {ns, 1.0, ns, ns, {0.99 * ns, 1.01 * ns}, std::vector<double>(9, ns)};
}

run::WalkReading walk_of(gpu::Walking walking, double read_ns, double exact_ns) {
  run::WalkReading walk;
  walk.walking = walking;
  walk.read_ns = rounds_of(read_ns);
  walk.cold_ns = rounds_of(2.0 * read_ns);
  walk.exact_ns = rounds_of(exact_ns);
  walk.exact_ratio = measure::Ratio{read_ns / exact_ns, {0.99 * read_ns / exact_ns, 1.01 * read_ns / exact_ns}};
  walk.nothing_ratio = {read_ns / 1000.0, {}};
  return walk;
}

run::ReadingResult reading_of(double read_ns, double exact_ns, bool is_software = false) {
  run::SetReading set;
  set.work = {2000, 8000, 10000, 20000, 1.5};
  set.write_ns = rounds_of(500.0);
  set.nothing_ns = rounds_of(1000.0);
  set.walks = {walk_of(gpu::Walking::by_lane, read_ns, exact_ns),
               walk_of(gpu::Walking::by_light, read_ns + 1.0, exact_ns)};
  return {"Card, driver 1",
          is_software,
          2,
          4096.0,
          measure::SampleSet::opaque,
          gpu::Walking::by_lane,
          run::ReadingResult::ExactLists{"packed", 2048.0},
          {set}};
}

// The cases by hand, whose second is read faster.
run::Result read_result(bool is_software = false) {
  run::Result result = result_by_hand();
  result.cases[0].reading = reading_of(9000.0, 6000.0, is_software);
  result.cases[1].reading = reading_of(6300.0, 6000.0, is_software);
  return result;
}

std::string table_of(const run::Result& result) {
  return reading_table(test::result_of(testing::json_of(result)));
}

std::size_t line_with(const std::string& table, const std::string& start) {
  const std::size_t at = table.find(start);
  EXPECT_NE(at, std::string::npos) << start << " in\n" << table;
  return at;
}

TEST(ReadingTable, has_the_cheapest_reading_of_each_walk_first) {
  const run::Result result = read_result();
  const std::string table = table_of(result);
  EXPECT_NE(table.find("reading on Card, driver 1: hall\n"), std::string::npos) << table;
  const std::string slow = result.cases[0].assigner_label + " / packed  ",
                    fast = result.cases[1].assigner_label + " / packed  ";
  const std::size_t first = line_with(table, fast), second = line_with(table, slow);
  EXPECT_LT(first, second) << table;
  EXPECT_NE(table.find("lane     9.00  1.0 %     1.50       9.00     18.0    4.00   5.00   4096"), std::string::npos)
      << table;
  EXPECT_LT(second, table.find("  light  ")) << table;
}

TEST(ReadingTable, is_by_the_time_of_a_frame_where_all_have_it) {
  run::Result result = read_result();
  result.config["reading"] = {{"async", 0.0}};
  result.config["cost"] = {{"upload_gb_per_s", 15.75}};
  result.cases[0].timing->frame_ns.median = 100.0;
  result.cases[1].timing->frame_ns.median = 50'000.0;
  const std::string table = table_of(result);
  EXPECT_LT(line_with(table, result.cases[0].assigner_label + " / packed  "),
            line_with(table, result.cases[1].assigner_label + " / packed  "));
  EXPECT_NE(table.find("Cheapest with its assignment and upload: " + result.cases[0].assigner_label + " / packed, 9.1"),
            std::string::npos)
      << table;
}

// A sixteenth of the pixels takes a sixteenth of the time, and the assignment all of its own.
TEST(ReadingTable, of_a_part_of_the_pixels_has_no_frame) {
  run::Result result = read_result();
  result.config["reading"] = {{"async", 0.0}, {"divisor", 4}};
  result.config["cost"] = {{"upload_gb_per_s", 15.75}};
  const Json json = testing::json_of(result);
  EXPECT_FALSE(json["cases"][0]["reading"].contains("frame_ns"));
  const std::string table = reading_table(test::result_of(json));
  EXPECT_EQ(table.find("Cheapest"), std::string::npos) << table;
  EXPECT_NE(table.find("Samples of a part of the pixels (reading.divisor)"), std::string::npos) << table;
  result.config["reading"]["divisor"] = 1;
  EXPECT_TRUE(testing::json_of(result)["cases"][0]["reading"].contains("frame_ns"));
}

// The device has made packed lists.
TEST(ReadingTable, of_lists_of_a_device_in_another_storage_has_no_frame_and_ranks_below) {
  run::Result result = read_result();
  result.config["reading"] = {{"async", 0.0}};
  result.config["cost"] = {{"upload_gb_per_s", 15.75}};
  run::CaseResult& on_device = result.cases[1];
  on_device.timing.reset();
  on_device.on_device = true;
  on_device.device.emplace();
  const auto time = rounds_of(100.0);
  on_device.device->warm = {time, time, time, time, 1.0, {}};
  EXPECT_NE(table_of(result).find("Cheapest with its assignment and upload: " + on_device.assigner_label),
            std::string::npos);
  on_device.storage_label = "bitfield";
  const std::string table = table_of(result);
  EXPECT_NE(table.find("Cheapest with its assignment and upload: " + result.cases[0].assigner_label), std::string::npos)
      << table;
  EXPECT_NE(table.find("No frame where lists of the device are in another storage"), std::string::npos) << table;
  EXPECT_LT(line_with(table, result.cases[0].assigner_label + " / packed  "),
            line_with(table, on_device.assigner_label + " / bitfield  "));
}

TEST(ReadingTable, says_what_exact_lists_would_save_at_most) {
  const std::string table = table_of(read_result());
  EXPECT_NE(table.find("would save a frame at most 3.06 us of reading, those of " +
                       result_by_hand().cases[0].assigner_label + " / packed (x 1.49 to 1.51)"),
            std::string::npos)
      << table;
  run::Result tight = read_result();
  tight.cases[0].reading = reading_of(6030.0, 6000.0);  // 1.005, and its interval holds 1
  tight.cases[1].reading = reading_of(5900.0, 6000.0);
  EXPECT_NE(table_of(tight).find("would save a frame at most 0.09 us"), std::string::npos) << table_of(tight);
  tight.cases[0].reading = reading_of(5800.0, 6000.0);
  EXPECT_NE(table_of(tight).find("would be read no faster than any of these lists"), std::string::npos);
  for (run::CaseResult& one : tight.cases) one.reading->sets[0].walks[0].exact_ratio->ci95 = {};
  EXPECT_NE(table_of(tight).find("is not known: an interval takes 6 rounds"), std::string::npos);
}

TEST(ReadingTable, compares_nothing_with_lists_that_lack_lights) {
  run::Result result = read_result();
  result.config["reading"] = {{"async", 0.0}};
  result.config["cost"] = {{"upload_gb_per_s", 15.75}};
  result.cases[1].buffers.dropped_pairs = 5;  // read faster
  const std::string table = table_of(result);
  EXPECT_NE(table.find("! " + result.cases[1].assigner_label), std::string::npos) << table;
  EXPECT_LT(line_with(table, result.cases[0].assigner_label + " / packed  "),
            line_with(table, result.cases[1].assigner_label + " / packed  "));
  EXPECT_NE(table.find("Cheapest with its assignment and upload: " + result.cases[0].assigner_label), std::string::npos)
      << table;
  EXPECT_NE(table.find("!: lacks lights"), std::string::npos) << table;
  result.cases[0].storage_label = "own";  // 1.5 times the exact lists in another storage
  EXPECT_EQ(table_of(result).find("would save"), std::string::npos) << table_of(result);
}

TEST(ReadingTable, has_the_figures_of_the_set_and_walk_that_are_named_first) {
  run::Result result = read_result();
  result.cases[0].reading->walking = gpu::Walking::by_light;
  result.cases[1].reading->walking = gpu::Walking::by_cell;  // not read so
  const result::Result record = test::result_of(testing::json_of(result));
  EXPECT_EQ(result::figure_of(record.cases[0], "reading_us"), 9.001);
  EXPECT_EQ(result::figure_of(record.cases[1], "reading_us"), std::nullopt);
}

TEST(ReadingTable, marks_times_of_software_and_ranks_nothing_by_them) {
  const run::Result result = read_result(true);
  const std::string table = table_of(result);
  EXPECT_NE(table.find("these times are a processor's and no GPU's"), std::string::npos) << table;
  EXPECT_EQ(table.find("would save"), std::string::npos) << table;
  EXPECT_LT(line_with(table, result.cases[0].assigner_label + " / packed  "),
            line_with(table, result.cases[1].assigner_label + " / packed  "))
      << "the order of the plan";
}

TEST(ReadingTable, warns_of_lights_that_a_device_walked_wrongly) {
  run::Result result = read_result();
  result.cases[1].reading->sets[0].differing = 7;
  EXPECT_NE(table_of(result).find("7 walks met other lights"), std::string::npos);
}

TEST(ReadingTable, is_missing_without_readings_and_a_warning_tells_the_reason) {
  run::Result result = result_by_hand();
  const auto warnings = [&] { return warnings_text(test::result_of(testing::json_of(result))); };
  EXPECT_EQ(table_of(result), "");
  EXPECT_EQ(warnings().find("not read on a device"), std::string::npos);
  for (run::CaseResult& one : result.cases) one.unread = "there is no Vulkan driver";
  EXPECT_EQ(table_of(result), "");
  EXPECT_NE(warnings().find("warning: not read on a device: 2 cases: there is no Vulkan driver\n"), std::string::npos);
  result.cases[1].reading = read_result().cases[1].reading;
  result.cases[1].unread = "";
  EXPECT_NE(warnings().find("not read on a device: 1 case: there is"), std::string::npos);
}

// --- Prices ---

// Readings of two sets with these prices.
run::Result priced(double ns_per_light, double ns_per_read, double gb_per_s) {
  run::Result result = read_result();
  std::uint64_t seed = 3;
  for (run::CaseResult& one : result.cases) {
    one.reading->sets.resize(2, one.reading->sets[0]);
    one.reading->sets[1].set = measure::SampleSet::fog;
    for (run::SetReading& set : one.reading->sets) {
      seed = seed * 29 % 101;
      set.work = {2000, 2000 * seed, 2000 * (7 + seed * seed % 13), 2000 * 8 * (1 + seed % 5),
                  1.0 + static_cast<double>(seed % 3)};
      const double ns = set.work.divergence * (static_cast<double>(set.work.lights) * ns_per_light +
                                               static_cast<double>(set.work.reads) * ns_per_read +
                                               static_cast<double>(set.work.read_bytes) / gb_per_s);
      set.walks[0].read_ns.median = set.nothing_ns.median + ns / 2;  // of one of two frames
    }
  }
  return result;
}

MeasuredPrices prices_of(const run::Result& result) {
  return measured_prices(test::result_of(testing::json_of(result)), "readings.json");
}

std::string refusal_of(const run::Result& result) {
  try {
    prices_of(result);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(MeasuredPrices, are_those_that_the_readings_were_made_of) {
  const MeasuredPrices prices = prices_of(priced(0.02, 0.005, 1500.0));
  EXPECT_NEAR(prices.ns_per_light, 0.02, 1e-5);
  EXPECT_NEAR(prices.ns_per_read, 0.005, 1e-5);
  EXPECT_NEAR(prices.read_gb_per_s, 1500.0, 10.0);
  EXPECT_EQ(prices.readings, 4u);
  EXPECT_NE(prices.text().find("cost by 4 readings on Card, driver 1: a light 0.02 ns"), std::string::npos)
      << prices.text();
}

TEST(MeasuredPrices, are_refused_with_what_is_missing) {
  EXPECT_NE(refusal_of(result_by_hand()).find("has no readings; --set 'reading={}'"), std::string::npos);
  EXPECT_NE(refusal_of(read_result(true)).find("computes on the processor"), std::string::npos);
  run::Result wrong = priced(0.02, 0.005, 1500.0);
  wrong.cases[0].reading->sets[0].differing = 1;
  EXPECT_NE(refusal_of(wrong).find("was read wrongly"), std::string::npos);
  run::Result noise = priced(0.02, 0.005, 1500.0);
  for (run::CaseResult& one : noise.cases)
    for (std::size_t i = 0; i < 2; ++i) {  // the same work, and 30 times as long
      one.reading->sets.push_back(one.reading->sets[i]);
      one.reading->sets.back().walks[0].read_ns.median *= 30.0;
    }
  EXPECT_NE(refusal_of(noise).find("do not explain its readings"), std::string::npos) << refusal_of(noise);
  EXPECT_NE(refusal_of(read_result()).find("do not tell the prices apart"), std::string::npos);
  run::Result two = priced(0.02, 0.005, 1500.0);
  two.cases[1].reading->device = "Another card, driver 2";
  EXPECT_NE(refusal_of(two).find("2 devices (Another card, driver 2, Card, driver 1)"), std::string::npos)
      << refusal_of(two);
  run::Result no_lane = priced(0.02, 0.005, 1500.0);
  for (run::CaseResult& one : no_lane.cases)
    for (run::SetReading& set : one.reading->sets) set.walks.erase(set.walks.begin());
  EXPECT_NE(refusal_of(no_lane).find("no readings with the walk `lane`"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::report
