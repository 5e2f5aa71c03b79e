// Times and instructions.

#include <algorithm>

#include "run/records/parts.h"

namespace clusterbench::run {

using result::measured;

result::Interval interval_record(const measure::Interval& interval) {
  return {{measured(interval.low), measured(interval.high)}};
}

result::Time time_record(const measure::TimeStats& stats) {
  result::Time out{measured(stats.median), measured(stats.mad),         measured(stats.min),
                   measured(stats.p95),    interval_record(stats.ci95), {}};
  for (const double sample : stats.samples) out.samples.push_back(measured(sample));
  return out;
}

std::optional<result::Time> time_record(const std::optional<measure::TimeStats>& stats) {
  return stats ? std::optional(time_record(*stats)) : std::nullopt;
}

namespace {

result::Disturbed disturbed_record(const Disturbance& disturbance) {
  const auto cores = [&](double busy_s) {
    return measured(disturbance.seconds > 0.0 ? busy_s / disturbance.seconds : 0.0);
  };
  return {cores(disturbance.others_s), cores(disturbance.stolen_s), static_cast<std::uint64_t>(disturbance.throttled)};
}

result::DeviceRepeats repeats_record(const assign::DeviceRepeats& repeats) {
  return {repeats.upload, repeats.run, repeats.floor};
}

std::uint64_t instructions(const std::optional<Counted>& part) {
  return part ? part->instructions : 0;
}

}  // namespace

result::Timing timing_record(const TimingResult& t) {
  result::Timing out;
  out.frames_timed = static_cast<std::uint64_t>(t.frames_timed);
  out.caches = t.is_cold ? "cold" : "warm";
  out.session = t.session;
  out.launches = static_cast<std::uint64_t>(t.launches);
  out.frame_ns = time_record(t.frame_ns);
  out.worst_frame = {static_cast<std::uint64_t>(t.worst.frame), measured(t.worst.ns), interval_record(t.worst.ci95),
                     t.worst.pairs};
  if (t.pairs_mean) out.pairs = {result::counted(*t.pairs_mean), t.pairs_max};
  out.builds_per_frame = t.builds_per_frame;
  out.build_ns = time_record(t.build_ns);
  out.assign_ns = time_record(t.assign_ns);
  out.convert_ns = time_record(t.convert_ns);
  out.pre_cull_ns = time_record(t.pre_cull_ns);
  if (t.warm)
    out.warm = {time_record(t.warm->frame_ns), time_record(t.warm->assign_ns), time_record(t.warm->convert_ns),
                time_record(t.warm->pre_cull_ns)};
  out.passes_per_sample = {static_cast<std::uint64_t>(t.warm_assign_passes), t.warm_convert_passes};
  out.ns_per_pair = measured(t.ns_per_pair);
  out.write_floor_ns = measured(t.write_floor_ns);
  out.floor_ratio = measured(t.floor_ratio);
  if (t.against_first)
    out.against_first = {t.against_first->assigner, measured(t.against_first->ratio.ratio),
                         interval_record(t.against_first->ratio.ci95)};
  if (t.fit)
    out.fit = {time_record(t.fit->follow_ns), time_record(t.fit->unfitted_ns), measured(t.fit->ratio.ratio),
               interval_record(t.fit->ratio.ci95)};
  if (!t.shadow_culls.empty()) out.shadow_cull = shadow_times_record(t.shadow_culls);
  out.disturbed = disturbed_record(t.disturbance);
  return out;
}

result::DeviceTimes device_record(const DeviceTimes& t) {
  result::DeviceTimes out;
  out.device = t.device;
  out.software = t.is_software;
  out.frames_timed = static_cast<std::uint64_t>(t.frames_timed);
  out.caches = t.is_cold() ? "cold" : "warm";
  out.launches = static_cast<std::uint64_t>(t.launches);
  const DeviceSpanTimes& first = t.first();
  out.run_ns = time_record(first.run_ns);
  out.upload_ns = time_record(first.upload_ns);
  out.readback_ns = time_record(first.readback_ns);
  out.dispatches = result::counted(t.dispatches);
  out.floor_ns = time_record(first.floor_ns);
  out.floor_ratio = measured(first.floor_ratio);
  out.repeats = repeats_record(first.repeats);
  if (t.is_cold())
    out.warm = {time_record(t.warm.run_ns), time_record(t.warm.upload_ns), time_record(t.warm.floor_ns),
                measured(t.warm.floor_ratio), repeats_record(t.warm.repeats)};
  out.build_ns = time_record(t.build_ns);
  if (t.build_ns) out.builds_per_frame = t.builds_per_frame;
  if (!t.clock_mhz.empty()) {
    const measure::TimeStats clock = measure::time_stats(t.clock_mhz, 0);
    out.clock_mhz = {measured(clock.median), measured(clock.min), measured(std::ranges::max(t.clock_mhz)), {}};
    for (const double mhz : t.clock_mhz) out.clock_mhz->samples.push_back(measured(mhz));
  }
  if (t.shaders.empty()) return out;
  out.shaders.emplace();
  for (const assign::ShaderStatistic& told : t.shaders)
    out.shaders->push_back({told.shader, told.name, result::counted(told.value)});
  return out;
}

result::Count count_record(const CountResult& c) {
  const auto per_frame = [&](std::uint64_t all) { return static_cast<double>(all) / c.frames; };
  result::Count out{.source = c.source,
                    .simd_target = c.simd_target,
                    .frames = static_cast<std::uint64_t>(c.frames),
                    .instructions_per_build = c.build.instructions};
  result::PerFrame& instructions_of = out.instructions_per_frame;
  instructions_of.assign = per_frame(c.assign.instructions);
  if (c.convert) instructions_of.convert = per_frame(c.convert->instructions);
  if (c.pre_cull) instructions_of.pre_cull = per_frame(c.pre_cull->instructions);
  instructions_of.frame = per_frame(c.assign.instructions + instructions(c.convert) + instructions(c.pre_cull));
  if (!c.assign.cycles || (c.convert && !c.convert->cycles)) return out;
  out.cycles_per_frame.emplace().assign = per_frame(*c.assign.cycles);
  if (c.convert) out.cycles_per_frame->convert = per_frame(*c.convert->cycles);
  return out;
}

}  // namespace clusterbench::run
