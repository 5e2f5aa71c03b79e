// How work is repeated for its times: as often as asked for, with the same lists. What a device tells of its
// arithmetic, its clock and its shaders. No test asserts a time.

#include "gpu/device/span_length.h"
#include "gpu/device_test.h"
#include "gpu/methods/arithmetic_probe.h"
#include "gpu/methods/clock_probe.h"
#include "gpu/methods/frame_arguments.h"
#include "gpu/methods/repeated_work.h"
#include "gpu/reference_lists.h"
#if __has_include(<vulkan/vulkan_core.h>)
#include "gpu/vulkan/shader_statistics.h"
#endif

namespace clusterbench::gpu {
namespace {

using assign::AssignerDescriptor;
using assign::DeviceRepeats;
using assign::testing::Setting;
using Caches = DeviceRepeats::Caches;

class DeviceMeasuring : public testing::DeviceTest {};

TEST(ColdSpans, are_as_many_as_last_long_enough_and_fit_in_a_submission) {
  EXPECT_EQ(cold_repeats_for(50'000.0, 1.0, 0), 1u);
  EXPECT_EQ(cold_repeats_for(5'000.0, 1.0, 0), 4u);
  EXPECT_EQ(cold_repeats_for(100.0, 1.0, 0), 20u);                 // as many marks as there are
  EXPECT_EQ(cold_repeats_for(2'000.0, 1.0, k_flushed_bytes), 7u);  // 13 ms to fill each time
  EXPECT_EQ(cold_repeats_for(1e9, 1e6, k_flushed_bytes), 1u);
}

// --- Repetition ---

struct Recorded {
  int uploads = 0, runs = 0;
  assign::DeviceSpans spans;
  double upload_ns = 0.0, run_ns = 0.0;  // of all repetitions, by their marks
};

Recorded recorded(const DeviceRepeats& repeats) {
  Recorded out;
  device().reserve_flushed();
  Buffers buffers(device());
  buffers.reserve(Binding::lists, 1024, "lists");
  Commands commands(device(), buffers);
  RepeatedWork work(commands, repeats);
  work.record(
      [&] {
        ++out.uploads;
        commands.barrier();
      },
      [&] {
        ++out.runs;
        commands.fill(Binding::lists, 1, 1024);
        commands.barrier();
        commands.fill(Binding::lists, 2, 1024);
      });
  commands.run();
  out.spans = work.spans();
  if (repeats.caches == Caches::warm) {
    out.upload_ns = commands.ns_between(0, 1);
    out.run_ns = commands.ns_between(2, 3);
    return out;
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(out.runs); ++i) {
    out.upload_ns += commands.ns_between(3 * i, 3 * i + 1);
    out.run_ns += commands.ns_between(3 * i + 1, 3 * i + 2);
  }
  return out;
}

TEST_F(DeviceMeasuring, come_from_work_that_is_repeated_as_often_as_asked_for) {
  const Recorded once = recorded({}), cold = recorded({Caches::cold, 9, 3}), warm = recorded({Caches::warm, 5, 2});
  EXPECT_EQ(once.uploads, 1);
  EXPECT_EQ(once.runs, 1);
  EXPECT_EQ(cold.uploads, 3);
  EXPECT_EQ(cold.runs, 3);
  EXPECT_EQ(warm.uploads, 1 + 5) << "once untimed";
  EXPECT_EQ(warm.runs, 1 + 2);
  EXPECT_DOUBLE_EQ(once.spans.run_ns, once.run_ns);
  EXPECT_DOUBLE_EQ(cold.spans.upload_ns * 3, cold.upload_ns);
  EXPECT_DOUBLE_EQ(cold.spans.run_ns * 3, cold.run_ns);
  EXPECT_DOUBLE_EQ(warm.spans.upload_ns * 5, warm.upload_ns);
  EXPECT_DOUBLE_EQ(warm.spans.run_ns * 2, warm.run_ns);
  for (const Recorded& one : {once, cold, warm}) {
    EXPECT_EQ(one.spans.dispatches, 2u) << "of one repetition";
    EXPECT_GE(one.spans.upload_ns, 0.0);
    EXPECT_TRUE(one.spans.run_ns > 0.0 || device().facts().timestamp_bits == 0);
  }
}

assign::Lists lists_after(const AssignerDescriptor& row, const Setting& setting, const DeviceRepeats& repeats,
                          std::uint32_t* steps = nullptr, const assign::Params* chosen = nullptr) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  const assign::Params params = chosen != nullptr ? *chosen : assign::Params(row.params);
  if (row.make) {
    const auto method = row.make(params);
    method->build(setting.grid, assign::kinds_of(lights));
    method->repeat_on_device(repeats);
    assign::Lists lists;
    method->assign(setting.input(lights), lists);
    if (steps != nullptr) *steps = method->device_spans()->dispatches;
    EXPECT_GE(method->device_floor_ns(), 0.0);
    EXPECT_FALSE(method->device_build_ns()) << "cells of the host";
    return lists;
  }
  const auto method = row.make_own(params);
  method->build(setting.grid, assign::kinds_of(lights));
  method->repeat_on_device(repeats);
  const auto structure = method->make_structure();
  method->assign(setting.input(lights), *structure);
  if (steps != nullptr) *steps = method->device_spans()->dispatches;
  EXPECT_GE(method->device_floor_ns(), 0.0);
  assign::Lists lists;
  structure->expand(lists);
  return lists;
}

TEST_F(DeviceMeasuring, of_repeated_work_come_with_the_lists_of_work_that_is_done_once) {
  std::uint32_t methods = 0;
  for (const AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->on_device) continue;
    ++methods;
    const Setting setting = testing::thinned(assign::testing::settings_for(*row, 5).front(), 4, 0);
    std::uint32_t once_steps = 0, steps = 0;
    const assign::Lists once = lists_after(*row, setting, {}, &once_steps);
    EXPECT_GT(once.pair_count(), 0u) << row->name;
    for (const DeviceRepeats& repeats :
         {DeviceRepeats{Caches::warm, 3, 4, 2, 2}, DeviceRepeats{Caches::cold, 3, 3, 2, 2}}) {
      const assign::Lists again = lists_after(*row, setting, repeats, &steps);
      EXPECT_EQ(testing::first_difference(again, once), "") << row->name;
      EXPECT_EQ(steps, once_steps) << row->name;
    }
  }
  EXPECT_EQ(methods, 7u);
}

TEST_F(DeviceMeasuring, of_occupied_tiles_alone_repeat_what_a_queue_does_once) {
  const AssignerDescriptor& row = *assign::find_assigner("gpu-tiled");
  const Setting setting = testing::thinned(assign::testing::settings_for(row, 5).front(), 4, 0);
  const assign::Params occupied(row.params, {{"tiles", std::string("occupied")}});
  std::uint32_t steps_of_all = 0, steps = 0;
  const assign::Lists all = lists_after(row, setting, {}, &steps_of_all);
  for (const DeviceRepeats& repeats :
       {DeviceRepeats{}, DeviceRepeats{Caches::warm, 3, 4, 2, 2}, DeviceRepeats{Caches::cold, 3, 3, 2, 2}}) {
    EXPECT_EQ(testing::first_difference(lists_after(row, setting, repeats, &steps, &occupied), all), "");
    EXPECT_EQ(steps, steps_of_all) << "in a row";
  }
}

// --- Building ---

TEST_F(DeviceMeasuring, of_a_build_are_there_where_the_device_builds_and_leave_the_same_cells) {
  for (const AssignerDescriptor* row : testing::list_methods()) {
    const Setting setting = testing::thinned(assign::testing::settings_for(*row, 5).front(), 4, 0);
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    const auto method = row->make(assign::Params(row->params, {{"cells", std::string("device")}}));
    method->build(setting.grid, assign::kinds_of(lights));
    assign::Lists before, after;
    method->assign(setting.input(lights), before);
    for (const Caches caches : {Caches::as_left, Caches::cold, Caches::warm}) {
      method->repeat_on_device({caches, 1, 1, 1, 3});
      const std::optional<double> ns = method->device_build_ns();
      ASSERT_TRUE(ns) << row->name;
      EXPECT_TRUE(*ns > 0.0 || device().facts().timestamp_bits == 0) << row->name;
    }
    method->repeat_on_device({});
    method->assign(setting.input(lights), after);
    EXPECT_EQ(testing::first_difference(after, before), "") << row->name;
  }
}

// --- Arithmetic ---

TEST_F(DeviceMeasuring, rest_on_arithmetic_that_a_probe_has_looked_at) {
  const Arithmetic found = arithmetic_of_device();
  const DeviceFacts& facts = device().facts();
  EXPECT_EQ(contradiction(found, facts), "");
  EXPECT_FALSE(found.contracts);
  EXPECT_FALSE(found.reorders);
  EXPECT_TRUE(found.rounding == Rounding::to_nearest || !facts.rounds_to_nearest);
  // What Vulkan allows.
  EXPECT_LE(found.division_ulp, 2.5);
  EXPECT_LE(found.sqrt_ulp, 4.5);
  EXPECT_LE(found.log2_ulp, 3.0);
  EXPECT_LE(found.log2_error, 0x1p-21);
  EXPECT_GE(found.division_ulp, 0.4) << "of thousands of quotients some are rounded";
}

TEST_F(DeviceMeasuring, would_not_rest_on_arithmetic_that_a_driver_has_changed) {
  const DeviceFacts& facts = device().facts();
  const Arithmetic contracted = probed_arithmetic(device(), ProbeMode::contracted),
                   reordered = probed_arithmetic(device(), ProbeMode::reordered),
                   rounded_off = probed_arithmetic(device(), ProbeMode::rounded_off);
  EXPECT_TRUE(contracted.contracts);
  EXPECT_FALSE(contracted.reorders);
  EXPECT_EQ(contradiction(contracted, facts),
            facts.name +
                " rounds a product and a sum in one step, which shaders forbid, so that the lists of its "
                "methods could lose lights (a probe of its arithmetic)");
  EXPECT_TRUE(reordered.reorders);
  EXPECT_FALSE(reordered.contracts);
  EXPECT_NE(contradiction(reordered, facts).find("changes the order of sums"), std::string::npos);
  EXPECT_EQ(rounded_off.rounding, Rounding::wrong);
  EXPECT_NE(contradiction(rounded_off, facts), "");
}

TEST(ProbedArithmetic, that_rounds_either_way_contradicts_only_devices_that_said_they_round_to_nearest) {
  Arithmetic found;
  found.rounding = Rounding::either_way;
  found.flushes_denormals = true;
  found.division_ulp = 100.0;
  DeviceFacts card;
  card.name = "Card";
  card.rounds_to_nearest = false;
  EXPECT_EQ(contradiction(found, card), "");
  card.rounds_to_nearest = true;
  EXPECT_EQ(contradiction(found, card),
            "Card was asked to round to nearest and does not, so that the lists of its methods could lose lights (a "
            "probe of its arithmetic)");
}

// --- What the device tells ---

// Drivers on the processor may be interrupted while they count.
TEST_F(DeviceMeasuring, have_a_clock_where_shaders_can_count) {
  ClockProbe probe(device());
  const bool can_tell = device().facts().has_shader_clock && device().facts().timestamp_bits > 0;
  int told = 0;
  for (int i = 0; i < 30; ++i) {
    const std::optional<double> mhz = probe.mhz();
    told += mhz ? 1 : 0;
    EXPECT_TRUE(!mhz || *mhz > 0.0);
  }
  EXPECT_EQ(told > 0, can_tell);
}

TEST_F(DeviceMeasuring, have_statistics_of_shaders_where_the_driver_tells_them) {
  for (const AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->on_device || !row->make) continue;
    const std::vector<assign::ShaderStatistic> told = row->make(assign::Params(row->params))->shader_statistics();
    EXPECT_EQ(told.empty(), !device().facts().tells_shader_statistics) << row->name;
  }
}

#if __has_include(<vulkan/vulkan_core.h>)
VkPipelineExecutableStatisticKHR told(const char* name, VkPipelineExecutableStatisticFormatKHR format,
                                      VkPipelineExecutableStatisticValueKHR value) {
  VkPipelineExecutableStatisticKHR out{};
  std::snprintf(out.name, sizeof out.name, "%s", name);
  out.format = format;
  out.value = value;
  return out;
}

TEST(ShaderStatistics, are_those_of_registers_spills_and_memory_in_any_format) {
  VkPipelineExecutableStatisticValueKHR u64{}, i64{}, f64{}, yes{};
  u64.u64 = 40;
  i64.i64 = -1;
  f64.f64 = 1.5;
  yes.b32 = VK_TRUE;
  const std::vector<VkPipelineExecutableStatisticKHR> all{
      told("Register Count", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR, u64),
      told("Binary Size", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR, u64),
      told("Spilled SGPRs", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR, i64),
      told("LDS size", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR, f64),
      told("Uses scratch", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR, yes),
      told("Spill count", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR, u64),
      told("Instruction count", VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR, u64)};
  std::vector<assign::ShaderStatistic> found;
  add_statistics(all, "cells", found);
  EXPECT_EQ(found, (std::vector<assign::ShaderStatistic>{{"cells", "Register Count", 40.0},
                                                         {"cells", "Spilled SGPRs", -1.0},
                                                         {"cells", "LDS size", 1.5},
                                                         {"cells", "Uses scratch", 1.0},
                                                         {"cells", "Spill count", 40.0}}));
}
#endif

}  // namespace
}  // namespace clusterbench::gpu
