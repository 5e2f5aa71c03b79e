#pragma once
// The sections of a configuration that have the same keys for every method and grid.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/config_keys.h"
#include "config/schema/json_text.h"
#include "core/memory.h"
#include "measure/samples/samples.h"

namespace clusterbench::config {

// The format of the lights that assigners get. The truth always uses the scene's own lights.
struct PrecisionRequest {
  RECORD(PrecisionRequest);
  KEY(view::Packing, packing, view::Packing::float32);
  KEY(bool, inflate, false);  // grow each light by the largest error of its format
  END_RECORD;

  bool is_lossy() const { return packing != view::Packing::float32; }
  std::string label() const;  // "float32", "half", "half+inflate"

  friend bool operator==(const PrecisionRequest&, const PrecisionRequest&) = default;
};

struct AccuracyRequest {
  RECORD(AccuracyRequest);
  KEY(bool, check, true);
  // Limit on the estimated pairs of a frame's grid up to which cases are compared with the truth; null: no limit.
  KEY(result::Nullable<std::uint64_t>, most_pairs, {});
  END_RECORD;
};

struct TimingRequest {
  RECORD(TimingRequest);
  KEY(bool, measure, true);
  KEY(int, rounds, 31);
  KEY(double, min_time_ms, 20.0);  // of one round of one case
  KEY(int, frames, 8);             // evenly spaced timed frames; 0 = all
  KEY(int, launches, 5);           // processes that share the rounds, if the caller can start some
  KEY(bool, cold, true);           // empties the caches before each frame; these times are the ones reported first
  KEY(std::optional<int>, sweep_mib, {});  // written to empty them; none: by the caches (run/timing/cache_sweep.h)
  END_RECORD;
};

// Changes of lists along a finely sampled piece of the path.
struct StabilityRequest {
  RECORD(StabilityRequest);
  KEY(int, steps, 200);
  KEY(double, step_mm, 1.0);    // largest move of the eye in a step
  KEY(double, step_deg, 0.01);  // largest turn of the view in a step
  KEY(int, window, 8);          // a pair that changes back within this many steps flickers
  END_RECORD;
};

// Tests of a shader's lookup on samples.
struct LookupRequest {
  RECORD(LookupRequest);
  KEY(int, samples, 4096);  // per frame
  KEY(std::vector<measure::Logarithm>, logarithms,
      {measure::Logarithm::rounded, measure::Logarithm::glsl, measure::Logarithm::fast});
  KEY(std::vector<measure::DepthRead>, depths,
      {measure::DepthRead::given, measure::DepthRead::d32f, measure::DepthRead::d24});
  END_RECORD;

  std::vector<measure::LookupWay> ways() const;  // every logarithm with every depth
};

// A horizontal floor, for scenes without triangles.
struct GroundRequest {
  bool is_lowest = false;  // below all lights and eyes of the scene
  double height_m = 0.0;   // along the world's y, unless is_lowest
};

// Points where frames are shaded. Members that the set has no keys for keep their defaults.
struct SampleSetRequest {
  RECORD(SampleSetRequest);
  measure::SampleSet set = measure::SampleSet::volume;
  KEY(int, count, 1024);                          // volume, mirror, anywhere: per frame
  KEY(int, divisor, 8);                           // opaque, transparent: one ray per block of so many pixels squared
  KEY(int, layers, 4);                            // transparent: maximum per ray
  KEY(Vec3i, froxels, {160, 90, 64});             // fog
  KEY(std::optional<GroundRequest>, ground, {});  // opaque
  END_RECORD;

  bool needs_bounds() const { return set == measure::SampleSet::mirror || set == measure::SampleSet::anywhere; }
  bool needs_triangles() const { return set == measure::SampleSet::opaque || set == measure::SampleSet::transparent; }
  double most_samples(Vec2i viewport) const;  // in a frame; of surfaces one for each ray
};

// What samples pay for their lights on the device.
struct ReadingRequest {
  RECORD(ReadingRequest);
  KEY(std::vector<measure::SampleSet>, sets, {measure::SampleSet::opaque});  // figures are those of the first
  KEY(std::vector<gpu::Walking>, walks, {gpu::Walking::by_lane});            // likewise
  KEY(int, divisor, 1);                                                      // of the sets of surfaces
  KEY(int, frames, 2);                                                       // evenly spaced over the path
  KEY(int, rounds, 9);
  // Share of the assignment that runs beside other work of the frame. None: methods of the processor have no time of a
  // frame with its reading.
  KEY_AS("async", std::optional<double>, overlap, {});
  END_RECORD;
};

struct ShadingRequest {
  RECORD(ShadingRequest);
  KEY(int, samples, 1024);  // of the set `volume`, per frame; 0: no such set
  END_RECORD;
};

// A step after the lists: removes pairs whose cell is completely in the light's shadow.
struct ShadowCullRequest {
  RECORD(ShadowCullRequest);
  KEY(int, resolution, 64);
  KEY(depth::TexelBound, texels, depth::TexelBound::proven);
  KEY(double, near_m, 0.05);
  KEY(double, bias_m, 0.01);  // a point within this distance behind a surface still counts as lit
  END_RECORD;

  depth::ShadowMapRequest map() const { return {resolution, texels, near_m}; }

  friend bool operator==(const ShadowCullRequest&, const ShadowCullRequest&) = default;
};

// Which spots may share a shadow map.
struct SharedFrustaRequest {
  RECORD(SharedFrustaRequest);
  KEY(double, apart_m, 2.0);
  KEY(double, turned_deg, 15.0);
  KEY(double, growth, 1.5);
  END_RECORD;
};

struct DetailsFrames {
  // worst: the one with the case's longest list; evenly: `count` of them; listed: `list`
  enum class Choice : std::uint8_t { worst, evenly, listed };
  Choice choice = Choice::worst;
  int count = 0;
  std::vector<int> list = {};  // ascending, each once
};

// Frames that a result contains cell by cell.
struct DetailsRequest {
  RECORD(DetailsRequest);
  KEY(DetailsFrames, frames, {});
  KEY(bool, lists, true);  // with the lights of each cell
  KEY(std::size_t, max_bytes, 2'000'000);
  END_RECORD;
};

// Cases above all_pairs are skipped, with the reason. Cases above the memory limit are skipped if that is known in
// advance; otherwise the run ends with an error.
struct LimitsRequest {
  RECORD(LimitsRequest);
  // Lights x cells of methods that test every light against every cell; null: no limit.
  KEY(result::Nullable<std::uint64_t>, all_pairs, {});
  KEY(std::uint64_t, memory_mib, k_default_memory_limit >> 20);        // of one list, buffer or table: core/memory.h
  KEY(std::vector<LimitRule>, fail_if, {});                            // budgets that fail the run
  KEY(std::filesystem::path, baseline, {});                            // a result, for relative budgets; "" without
  KEY_AS("allow_no_lights", bool, allows_no_lights, false);            // budgets pass even if no light was measured
  KEY_AS("allow_changed_lights", bool, allows_changed_lights, false);  // the lights may differ from the baseline's
  // Pairs that a case's storage may drop over all frames before the run fails; null: no limit.
  KEY(result::Nullable<std::uint64_t>, dropped_pairs, 0);
  END_RECORD;
};

// Keys and sections of the top level that are members as they are; the others have readers of their own.
struct Sections {
  RECORD(Sections);
  KEY_AS("threads", result::Nullable<int>, threads_asked, {});  // null: as many as there are processors
  KEY(std::string, device, {});  // of methods that run on one: gpu::chosen_device(); "": the best
  KEY(std::uint64_t, seed, 1);
  KEY(AccuracyRequest, accuracy, {});
  KEY(result::Nullable<LookupRequest>, lookup, {});                                // null: not measured
  KEY(result::Nullable<ReadingRequest>, reading, {});                              // null: not measured
  KEY(result::Nullable<StabilityRequest>, stability, {});                          // null: not measured
  KEY(result::Nullable<DetailsRequest>, details, {});                              // null: no details
  KEY_AS("shadow_frusta", std::optional<SharedFrustaRequest>, shared_frusta, {});  // none: not measured
  KEY(TimingRequest, timing, {});
  KEY(LimitsRequest, limits, {});
  KEY(measure::AllocationRule, allocation, {});
  END_RECORD;
};

// The following read a document with its defaults filled in. `text`: for the positions of errors, which they throw.
Sections read_sections(const nlohmann::json& document, const JsonText& text);
std::vector<PrecisionRequest> precisions(const nlohmann::json& document, const JsonText& text);
std::vector<ShadowCullRequest> shadow_culls(const nlohmann::json& document, const JsonText& text);
// In the order of measure::SampleSet.
std::vector<SampleSetRequest> sample_sets(const nlohmann::json& document);
// The sets of a reading in its order: with the keys that `sets` gives them, else with defaults that any scene has.
std::vector<SampleSetRequest> reading_sets(const ReadingRequest& reading, const std::vector<SampleSetRequest>& sets);

}  // namespace clusterbench::config

namespace clusterbench::result {

KEY_TYPE(config::GroundRequest);  // a number, or "lowest"
KEY_TYPE(config::DetailsFrames);  // "worst", a number, or a list

}  // namespace clusterbench::result
