#pragma once
// Of methods that run on a device (a GPU): what its clock and its driver tell of their work.

#include <cstdint>
#include <string>

namespace clusterbench::assign {

// The time of a device (a GPU) for one frame by its own clock, within the time of the assignment.
struct DeviceSpans {
  double upload_ns = 0.0, run_ns = 0.0, readback_ns = 0.0;
  // Steps of its work that wait for each other, and the bytes of the result that the last of them leave.
  std::uint32_t dispatches = 0;
  std::uint64_t result_bytes = 0;

  DeviceSpans& operator+=(const DeviceSpans& more) {
    upload_ns += more.upload_ns;
    run_ns += more.run_ns;
    readback_ns += more.readback_ns;
    dispatches += more.dispatches;
    result_bytes += more.result_bytes;
    return *this;
  }
};

// How a device does the work of the assigns that follow. A repetition does all of it again, and leaves the same result.
// Times are those of one repetition, in the mean.
struct DeviceRepeats {
  enum class Caches : std::uint8_t {
    as_left,  // everything is done once
    cold,     // memory is filled before each repetition, which brings the lights to the device, too
    warm      // everything is done once before, untimed
  };
  Caches caches = Caches::as_left;
  std::uint32_t upload = 1;  // cold: as often as `run`
  std::uint32_t run = 1, floor = 1, build = 1;
};

// A number that a driver tells of a compiled shader, under its own name: registers, spills, shared memory.
struct ShaderStatistic {
  std::string shader;  // with its mode, if it has one: "cells, mode 1"
  std::string name;    // with the unit of some drivers
  double value = 0.0;

  friend bool operator==(const ShaderStatistic&, const ShaderStatistic&) = default;
};

}  // namespace clusterbench::assign
