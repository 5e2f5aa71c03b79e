// What samples pay for their lights on a device.

#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;
using result::measured;

result::WalkReading walk_record(const WalkReading& walk) {
  result::WalkReading out;
  out.walk = gpu::name_of(walk.walking);
  out.read_ns = time_record(walk.read_ns);
  out.cold_ns = time_record(walk.cold_ns);
  out.exact_ns = time_record(walk.exact_ns);
  if (walk.exact_ratio) {
    out.exact_ratio = measured(walk.exact_ratio->ratio);
    out.exact_ci95 = interval_record(walk.exact_ratio->ci95);
  }
  out.nothing_ratio = measured(walk.nothing_ratio.ratio);
  return out;
}

result::SetReading set_record(const SetReading& set, int frames) {
  const auto samples = static_cast<double>(set.work.samples);
  const auto per_sample = [&](std::uint64_t sum) { return counted(static_cast<double>(sum) / samples); };
  result::SetReading out;
  out.set = measure::name_of(set.set);
  out.samples = counted(samples / frames);
  out.lights = per_sample(set.work.lights);
  if (set.exact_lights) out.exact_lights = per_sample(*set.exact_lights);
  out.reads = per_sample(set.work.reads);
  out.read_bytes = per_sample(set.work.read_bytes);
  out.divergence = counted(set.work.divergence);
  out.differing = set.differing;
  out.write_ns = time_record(set.write_ns);
  out.nothing_ns = time_record(set.nothing_ns);
  for (const WalkReading& walk : set.walks) out.walks.push_back(walk_record(walk));
  return out;
}

}  // namespace

result::Reading reading_record(const ReadingResult& reading) {
  result::Reading out;
  out.device = reading.device;
  out.software = reading.is_software;
  out.frames = static_cast<std::uint64_t>(reading.frames);
  out.structure_bytes = counted(reading.structure_bytes);
  if (reading.exact) out.exact = {reading.exact->storage, counted(reading.exact->bytes)};
  for (const SetReading& set : reading.sets) out.sets.push_back(set_record(set, reading.frames));
  return out;
}

}  // namespace clusterbench::run
