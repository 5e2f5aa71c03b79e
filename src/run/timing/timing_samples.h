#pragma once
// Samples of a group from one process, before any statistics. Several processes measure the same group
// (passes/timing_pass.h has the reasons); cli/processes/launches.h carries their samples between them.

#include <cstdint>
#include <vector>

namespace clusterbench::run {

// Disturbances during a measurement, as reported by Linux.
struct Disturbance {
  double seconds = 0.0;         // duration of the measurement
  double others_s = 0.0;        // processor time of other programs of this machine meanwhile
  double stolen_s = 0.0;        // processor time of other guests of the host
  std::uint64_t throttled = 0;  // number of times that a processor slowed down because it was too hot
};

using EachFrame = std::vector<double>;  // one time per frame

// Times of one storage that is made from a method's lists.
struct StoreSamples {
  std::vector<double> warm_ns;                  // of each round: per frame
  std::vector<EachFrame> warm_each, cold_each;  // of each round
  int warm_passes = 0;                          // over the frames, in one of warm_ns
};

struct MethodSamples {
  std::vector<int> frames;      // of the path: those of the mean, then the one with most pairs if it is not among them
  std::size_t mean_frames = 0;  // number of frames in the means
  std::vector<std::uint64_t> pairs;  // of each frame; empty without cells
  double builds_per_frame = 0.0;
  std::vector<double> build_ns, warm_ns, floor_ns;  // of each round: per build, per frame, per frame
  std::vector<EachFrame> warm_each, cold_each;      // of each round; warm_each only without cold_each
  int warm_passes = 0;                              // over the frames, in one of warm_ns
  std::vector<StoreSamples> stores;                 // in the order of the method's cases; empty if nothing is converted
  // Times of the pre-cull, of each round, as in warm_ns and the others; empty without one.
  std::vector<double> cull_warm_ns = {};
  std::vector<EachFrame> cull_warm_each = {}, cull_cold_each = {};
};

struct GroupSamples {
  // In the order of methods_of(); for a grid that follows the needs of frames, followed by the same methods in the grid
  // that does not.
  std::vector<MethodSamples> methods;
  Disturbance disturbance = {};
  // For a grid that follows, of each round: finding the needed span and making the grid, per frame.
  std::vector<double> follow_ns = {};
};

}  // namespace clusterbench::run
