#pragma once
// What samples pay for their lights: the time of a device that looks up each sample's cell, walks its lights and adds
// their attenuations, by the device's clock.

#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/device/span_length.h"
#include "gpu/reading/reading_structure.h"

namespace clusterbench::gpu {

// Why the device of this process cannot read: there is none, or it lacks a clock or arithmetic over subgroups. "" if it
// can.
std::string reading_obstacle();

struct ReadingTask {
  ReadingStructure* structure = nullptr;  // also where only its lookup is run
  Walking walking = Walking::by_lane;
  ReadingOutput output = ReadingOutput::lights;
};

// The words that the invocations write, two each for a check and one each otherwise. Not timed. `given`: with the cells
// of ReadingSamples::give_cells().
std::vector<std::uint32_t> results_of(const ReadingTask& task, ReadingSamples& samples, bool given = false);

struct ReadingPlan {
  int rounds = 9;
  // Filled before each cold reading, so that no cache holds what it reads. Less on software devices, whose caches are
  // the processor's.
  std::uint64_t flushed_bytes = k_flushed_bytes, flushed_bytes_of_software = k_flushed_bytes_of_software;
  const std::atomic<bool>* stop = nullptr;  // once true, the rounds until then are returned
  double longest_submit_ns =
      k_longest_submit_ns;  // devices are asked to do no more at a time, if they can do one reading in it
};

// Times of one task, of one reading each; none without a clock.
struct ReadingTimes {
  std::vector<double> warm_ns, cold_ns;  // one for each round, in their order
  std::uint32_t repeats = 1;             // readings in one warm span; a cold one has one
  double least_span_ns = 0.0;            // what warm spans were to last at least
  bool is_software = false;              // a processor's times, and no GPU's

  double warm_median_ns() const;
  double cold_median_ns() const;
};

// The tasks take turns: in each round each is read cold and warm, in as few submissions as the plan allows, and another
// one comes first.
std::vector<ReadingTimes> read_in_turns(std::span<const ReadingTask> tasks, ReadingSamples& samples,
                                        const ReadingPlan& plan = {});

}  // namespace clusterbench::gpu
