#pragma once
// Results that have every figure: of small runs, with what a run here cannot measure put in by hand.

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "assign/contract/assigner.h"
#include "config/config.h"
#include "places.h"
#include "report/cases/device_frames.h"
#include "report/results/result_record.h"
#include "run/runner.h"

namespace clusterbench::report::recount {

// Counts of instructions and cycles by hand: a run takes them from another program.
inline run::CountResult count_by_hand(bool converts) {
  run::CountResult count{"perf", "AVX2", 4, {700, 900}, {40000, 52000}, {}};
  if (converts) count.convert = run::Counted{3001, 4001};
  return count;
}

inline result::Result measured(const std::string& text) {
  const config::Config config = config::parse_config(text, test::source_dir() + "/configs/c.json");
  run::Plan plan = run::make_plan(config, "");
  const std::atomic<bool> stop{false};
  run::Result result = run::run_plan(config, plan, {}, {}, stop);
  for (run::CaseResult& one : result.cases) one.count = count_by_hand(one.timing && one.timing->convert_ns);
  return record_of(result, {});
}

constexpr const char* k_street = R"({"name": "street", "scenes": [{"path": "../scenes/street.glb", "frames": 4}],
    "viewports": [[320, 180], [192, 108]],
    "grids": [{"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 8}},
              {"kind": "world", "cells": [16, 4, 16]},
              {"kind": "cascades", "levels": 2, "cells": [8, 8, 8], "finest": 0.5}],
    "assigners": ["exact-fast", "aabb-fast", {"name": "naive-bounds", "flaw": "tile-division"}, "world-grid-fast",
                  "cascades-fast", "z-binning", "on-a-device"],
    "storages": ["packed", {"name": "fixed", "cap": 4}, "bitfield"],
    "precision": ["float32", "half"], "stability": {"steps": 60},
    "samples": {"opaque": {"divisor": 4, "ground": "lowest"}, "fog": {"froxels": [16, 9, 8]}},
    "cost": {"weights": {"fog": 2}}, "shading": {"samples": 256},
    "timing": {"sweep_mib": 4, "rounds": 3, "launches": 1, "min_time_ms": 0.05, "frames": 4}})";

// The lists of aabb; of the rounds the device takes less and less.
class OnADevice final : public assign::ListAssigner {
 public:
  explicit OnADevice(const assign::Params& params) : aabb_(assign::find_assigner("aabb")->make(params)) {}
  void build(const grid::Grid& grid, const assign::LightKinds& kinds) override { aabb_->build(grid, kinds); }
  void assign(const assign::FrameInput& input, assign::Lists& out) override {
    aabb_->assign(input, out);
    spans_ = {0.9 * spans_.upload_ns, 0.8 * spans_.run_ns, 0.7 * spans_.readback_ns, 3, 64};
  }
  std::uint64_t tests_done() const override { return aabb_->tests_done(); }
  const assign::DeviceSpans* device_spans() const override { return &spans_; }
  double device_floor_ns() override { return 0.5 * spans_.run_ns + 10.0; }
  std::optional<double> device_build_ns() override { return 0.25 * spans_.run_ns; }
  std::size_t scratch_bytes() const override { return aabb_->scratch_bytes(); }

 private:
  std::unique_ptr<assign::ListAssigner> aabb_;
  assign::DeviceSpans spans_{1e4, 1e6, 1e5, 3, 64};
};

inline assign::AssignerDescriptor on_a_device() {
  assign::AssignerDescriptor descriptor = *assign::find_assigner("aabb");
  descriptor.name = "on-a-device";
  descriptor.on_device = true;
  descriptor.make = assign::make_list_assigner<OnADevice>;
  return descriptor;
}

constexpr const char* k_mix = R"({"name": "mix", "scenes": [{"path": "../scenes/mix.glb", "frames": 2}],
    "viewport": [192, 108],
    "grids": [{"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 4}}],
    "assigners": ["deferred", "exact-fast", "bvh"], "storages": ["packed"],
    "samples": {"opaque": {"divisor": 1}, "anywhere": {"count": 300}}, "shading": {"samples": 256},
    "timing": {"measure": false}})";

constexpr const char* k_few_samples = R"({"name": "few", "scenes": [{"path": "../scenes/street.glb", "frames": 1}],
    "viewport": [64, 36],
    "grids": [{"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 4}}],
    "assigners": ["exact-fast", "naive-bounds"], "storages": ["packed"], "shading": {"samples": 20},
    "timing": {"measure": false}})";

// No pixel sees the floor; surfaces have a price or none.
inline std::string blind(const std::string& weights) {
  return R"({"name": "blind", "scenes": [{"path": "../scenes/street.glb", "frames": 1}], "viewport": [64, 36],
    "grids": [{"kind": "frustum", "tiles": {"pixels": 32}, "slices": {"scheme": "exponential", "count": 4}}],
    "assigners": ["exact-fast"], "storages": ["packed"], "shading": {"samples": 0},
    "samples": {"opaque": {"divisor": 4, "ground": 1e6}}, "timing": {"measure": false},
    "cost": {"weights": {"opaque": )" +
         weights + "}}}";
}

inline result::Time time_by_hand(double ns) {
  const std::vector<double> rounds{1.1 * ns, ns, 0.7 * ns};
  return {ns, 0.0, 0.7 * ns, 1.1 * ns, {}, rounds};
}

// Readings by hand, since there may be no device: of every second case, without exact lists of every third. And the
// clock that a device tells.
inline result::Result with_readings(result::Result result) {
  result.config["reading"] = {{"async", 0.5}};
  for (std::size_t i = 0; i < result.cases.size(); i += 2) {
    const double ns = 1e4 * static_cast<double>(i + 2);
    result::WalkReading walk;
    walk.walk = "lane";
    walk.read_ns = time_by_hand(ns);
    if (i % 3 != 0) {
      walk.exact_ns = time_by_hand(ns / 1.5);
      walk.exact_ratio = 1.5;
    }
    walk.nothing_ratio = 2.0;
    result::SetReading set;
    set.set = "opaque";
    set.nothing_ns = time_by_hand(ns / 2.0);
    set.walks = {walk, walk};
    result::Reading& reading = result.cases[i].reading.emplace();
    reading.sets = {set};
    reading.set = "opaque";
    reading.walk = "lane";
  }
  add_device_frames(result.cases, result.config);
  for (result::Case& result_case : result.cases)
    if (result_case.device) result_case.device->clock_mhz = {1500.0, 1490.0, 1520.0, {1520.0, 1490.0, 1500.0}};
  return result;
}

}  // namespace clusterbench::report::recount
