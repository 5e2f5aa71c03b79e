#pragma once
// What one process measures of a group, before anything is computed from it. Several processes measure the same
// (passes/timing_pass.h says why); cli/processes/launches.h carries their samples between them.

#include <cstdint>
#include <vector>

namespace clusterbench::run {

// What else went on while something was measured, as Linux tells it.
struct Disturbance {
  double seconds = 0.0;         // how long it was measured
  double others_s = 0.0;        // processor time that other programs of this machine took meanwhile
  double stolen_s = 0.0;        // and other guests of the host
  std::uint64_t throttled = 0;  // times that a processor slowed down because it was too hot
};

using EachFrame = std::vector<double>;  // one time per frame

// Times of one storage that is made from a method's lists.
struct StoreSamples {
  std::vector<double> warm_ns;                  // of each round: per frame
  std::vector<EachFrame> warm_each, cold_each;  // of each round
  int warm_passes = 0;                          // over the frames, in one of warm_ns
};

struct MethodSamples {
  std::vector<int> frames;           // of the path: those of the mean, and then the one with most pairs if it is none
  std::size_t mean_frames = 0;       // so many of them are in the means
  std::vector<std::uint64_t> pairs;  // of each; empty without cells
  double builds_per_frame = 0.0;
  std::vector<double> build_ns, warm_ns, floor_ns;  // of each round: per build, per frame, per frame
  std::vector<EachFrame> warm_each, cold_each;      // of each round; the first only without the second
  int warm_passes = 0;                              // over the frames, in one of warm_ns
  std::vector<StoreSamples> stores;  // in the order of the method's cases; empty where nothing is converted
  // By a device's own clock, of each round: per frame. Empty where nothing runs on one.
  std::vector<double> upload_ns, run_ns, readback_ns;
  // What culls lights before, of each round, as warm_ns and the others; empty where nothing does.
  std::vector<double> cull_warm_ns = {};
  std::vector<EachFrame> cull_warm_each = {}, cull_cold_each = {};
};

struct GroupSamples {
  // In the order of methods_of(); of a grid that follows what frames need, after them the same in the grid that does
  // not.
  std::vector<MethodSamples> methods;
  Disturbance disturbance = {};
  // Of such a grid, of each round: finding what is needed and making the grid, per frame.
  std::vector<double> follow_ns = {};
};

}  // namespace clusterbench::run
