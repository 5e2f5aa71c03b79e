#pragma once
// A small result with round figures, as the runner would hand it over.

#include <limits>
#include <string>
#include <vector>

#include "run/findings/gate.h"
#include "run/findings/run_result.h"

namespace clusterbench::report::testing {

// 20 and 40 indices of a byte in the two frames, and a header for each of the 24 cells.
inline void add_buffers(run::CaseResult& case_result) {
  measure::BufferHighWater indices;
  indices.name = "indices";
  indices.element_bytes = 1;
  indices.high_water = 40;
  indices.theoretical_max = 480;
  indices.worst_frame = 1;
  indices.worst_cell = 23;  // x 3, y 2, z 1
  for (const std::uint64_t elements : {20u, 40u}) indices.along_path.add_frame(elements);
  measure::BufferHighWater headers;
  headers.name = "headers";
  headers.element_bytes = 8;
  headers.high_water = headers.theoretical_max = 24;
  headers.worst_cell = 5;  // x 1, y 1, z 0
  for (int frame = 0; frame < 2; ++frame) headers.along_path.add_frame(24);
  case_result.buffers.each = {indices, headers};
}

inline run::CaseResult case_by_hand(const std::string& id, const std::string& assigner, double assign_ns) {
  run::CaseResult case_result;
  case_result.id = id;
  case_result.settings = "settings of " + assigner;
  case_result.name = "hall/walk/frustum 64px/" + assigner + "/packed";
  case_result.scene = "hall";
  case_result.camera = "walk";
  case_result.viewport = {1920, 1080};
  case_result.frames = 2;
  case_result.grid = {{"kind", "frustum"}, {"name", "frustum 64px"}, {"cells", {4, 3, 2}}};
  case_result.assigner = case_result.assigner_label = assigner;
  case_result.assigner_params = nlohmann::json::object();
  case_result.storage_label = "packed";
  case_result.lights = 10;
  std::vector<bool> lit(10, true), seen = lit;
  seen.back() = false;
  case_result.lights_in_view = {.frames = 2,
                                .sum = 15,
                                .most = 8,
                                .frames_with_most = 1,
                                .worst_frame = 1,
                                .most_of_type = {7, 1, 0},
                                .is_lit = lit,
                                .is_seen = seen};
  case_result.occupancy.emplace();
  case_result.occupancy->pairs = {30.0, 20.0, 40.0, 40.0, 40.0};
  case_result.occupancy->lights_per_cell = {1.25, 1.0, 3.0, 7.0, 7.0};
  case_result.occupancy->histogram = {10, 20, 18};
  case_result.occupancy->worst_frame = 1;
  case_result.occupancy->worst_cell = 17;  // x 1, y 1, z 1 of 4 x 3 x 2
  case_result.occupancy->worst_count = 7;
  for (const std::uint64_t pairs : {20u, 40u}) case_result.occupancy->pairs_along_path.add_frame(pairs);
  for (const std::uint64_t longest : {5u, 7u}) case_result.occupancy->longest_along_path.add_frame(longest);
  for (const std::uint64_t bytes : {212u, 232u}) case_result.buffers.bytes_along_path.add_frame(bytes);
  case_result.buffers.index_entries = {40, 480, 80};
  case_result.buffers.bytes = {232, 672, 272};
  case_result.buffers.index_bits = 8;
  case_result.buffers.header_bytes = 192;
  case_result.buffers.worst_frame = 1;
  case_result.buffers.worst_cell = 23;  // x 3, y 2, z 1
  add_buffers(case_result);
  measure::ErrorCounts error;
  error.true_pairs = 48;
  error.reported_pairs = 60;
  error.false_positives = 12;
  error.frames_checked = 2;
  case_result.error = error;
  measure::ShadingCounts shading;
  shading.samples = 100;
  shading.evaluated = 300;
  shading.needed = 200;
  case_result.shading = shading;
  run::TimingResult timing;
  const auto time = [](double ns) { return measure::TimeStats{ns, 1.0, ns, ns, {ns, ns}, std::vector<double>(6, ns)}; };
  timing.assign_ns = time(assign_ns);
  timing.convert_ns = time(500.0);
  timing.frame_ns = time(assign_ns + 500.0);
  timing.worst = {1, 1.2 * (assign_ns + 500.0), {assign_ns, 2.0 * assign_ns}, 40};
  timing.pairs_mean = 25.0;
  timing.pairs_max = 40;
  timing.ns_per_pair = (assign_ns + 500.0) / 25.0;
  timing.write_floor_ns = 100.0;
  timing.floor_ratio = assign_ns / 100.0;
  timing.frames_timed = 2;
  case_result.timing = timing;
  return case_result;
}

// 20 changes and 3 flickers of the method beside 16 and 2 of the truth.
inline void add_stability(run::CaseResult& case_result) {
  run::StabilityResult stability;
  stability.method = {.steps = 10, .changes = 20, .most_changes = 9, .flickers = 3};
  stability.truth = {.steps = 10, .changes = 16, .most_changes = 4, .flickers = 2};
  stability.window = 8;
  stability.step_m = 1e-3;
  stability.step_deg = 0.01;
  stability.from_frame = 1;
  stability.path = "10 steps from frame 1, where the camera moves most";
  stability.grids = 1;
  case_result.stability = stability;
}

// Lights in half, off by 1 mm on average and 20 mm at most; growing by up to 80 mm is enough.
inline void add_precision(run::CaseResult& case_result, const std::string& packing = "float32", bool inflate = false) {
  run::PrecisionResult precision{packing, packing + (inflate ? "+inflate" : ""), inflate, {}};
  constexpr double k_nothing = std::numeric_limits<double>::quiet_NaN();
  if (packing != "float32")
    precision.loss = {.position_error_m = {1e-3, 2e-2},
                      .range_error_m = {5e-3, 1e-2},
                      .axis_error_rad = {k_nothing, k_nothing},
                      .angle_error_rad = {k_nothing, k_nothing},
                      .safe_inflation_m = {4e-3, 8e-2}};
  case_result.precision = precision;
  if (packing == "float32") return;
  case_result.id += " " + precision.label;
  case_result.name += "/" + precision.label;
}

// 20,000 instructions a frame, on 2 frames.
inline void add_count(run::CaseResult& case_result) {
  case_result.count = run::CountResult{"callgrind", "AVX2", 2, {700, {}}, {40000, {}}, run::Counted{3001, {}}};
}

inline void lose_a_light(run::CaseResult& case_result) {
  case_result.error->false_negatives = 3;
  case_result.error->deepest = measure::Miss{.frame = 5, .cell = 17, .light = 8, .rig_index = 9, .depth = 0.125};
  case_result.error->deepest_miss = 0.125;
  case_result.deepest_miss_light = "torch";
}

// As the runner does it.
inline run::Result judged(run::Result result, const config::LimitsRequest& limits = {}) {
  for (run::CaseResult& case_result : result.cases) case_result.failures = run::failures_of(case_result, limits);
  return result;
}

inline run::Result result_by_hand() {
  run::Result result;
  result.config_name = "by hand";
  result.tool = {"1.2.3", "abc", "g++ 12", "-O3", "Release", "scalar", {{"glm", "0.9.9"}}};
  result.machine = {"a processor", "Linux", 2, 1u << 30, "6", "85", "7", {{"l1d", 32768}, {"l2", 1 << 20}}, {}, {}, ""};
  result.config = {{"allocation", {{"margin", 2.0}, {"warn_at", 0.9}}}};
  run::SceneResult scene;
  scene.name = "hall";
  scene.sha256 = std::string(64, 'a');
  scene.points = 9;
  scene.spots = 1;
  scene.light_digest = std::string(16, 'b');
  scene.frames = 2;
  scene.range_rule = {{"cutoff_lux", 0.05}, {"max_range", 100.0}, {"given", 10}, {"from_intensity", 0}, {"clamped", 0}};
  result.scenes = {scene};
  result.cases = {case_by_hand("slow", "brute-force", 9000.0), case_by_hand("fast", "aabb", 3000.0)};
  result.skipped = {{"hall/walk/world/aabb", "aabb takes frustum grids, not world"}};
  result.planned_ids = {"slow", "fast"};
  return result;
}

}  // namespace clusterbench::report::testing
