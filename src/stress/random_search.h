#pragma once
// `stress --random`: settings drawn from seeds, on which every method is checked against the truth, every SIMD variant
// against its reference, and the truth against pair-by-pair decisions. Faults are reduced to a setting that a person
// can read.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stress/trial.h"

namespace clusterbench::stress {

struct StressMethod;

enum class FaultKind : std::uint8_t {
  truth,         // the true lists differ from the pair's own decision, or from a point in both
  loss,          // a conservative method lacks a true pair
  extra,         // an exact method has a pair that is not true
  simd_variant,  // a fast method's lists differ from its reference's
  lists,         // not ascending, not one per cell, or different on a second call
  error,         // it threw
  // A pair that is neither proven nor refuted: a fault may hide behind it.
  undecided,
  shading  // a point that a conservative method's light clearly reaches is looked up in a cell without the light
};
inline constexpr int k_fault_kinds = 8;
const char* fault_kind_name(FaultKind kind);

// A fault of one setting: the first pair that shows it.
struct SettingFault {
  FaultKind kind = FaultKind::truth;
  std::string method;  // label; empty: the truth
  std::string detail;  // a sentence
  std::uint32_t cell = 0, light = 0;
  scene::LightType type = scene::LightType::point;  // of the light
  bool is_of_device = false;                        // the device failed, which no smaller setting explains
};

struct SettingCounts {
  std::uint64_t settings = 0, refused = 0;  // refused: the grid is impossible, or has too many pairs for one setting
  std::array<std::uint64_t, grid::k_kind_count> by_kind{};
  std::uint64_t points = 0, spots = 0, boxes = 0, pairs = 0, true_pairs = 0;  // pairs: cells x lights
  std::uint64_t compared_pairs = 0;                                           // listed by methods
  std::uint64_t decisions = 0, sampled = 0, undecided = 0;                    // by exact decisions
  std::uint64_t shaded = 0;  // lights that clearly reach points in the view

  void add(const SettingCounts& other);
};

// A setting with more pairs (for example, tiles of a pixel, which can follow from a tile's aspect) would take minutes.
inline constexpr std::uint64_t k_most_setting_pairs = std::uint64_t{1} << 24;

struct SettingReport {
  SettingCounts counts;
  std::vector<SettingFault> faults;  // one per kind, method and type of light
};

// "point", "spot", "box".
const char* type_name(scene::LightType type);

// Settings that no method supports are only counted, except those with boxes: their truth is checked on all kinds of
// grids, since few methods support boxes.
SettingReport check_setting(const Trial& trial, std::span<const StressMethod> methods);

// The method of the fault and the reference of its simd_variant; for a fault of the truth all methods, since it shows
// where they list pairs that the truth lacks.
std::vector<StressMethod> methods_that_show(const SettingFault& fault, std::span<const StressMethod> methods);

// A smaller setting with the same fault (kind, method, type of light): fewer lights and cells, rounder numbers.
Trial shrunk(const Trial& trial, const SettingFault& fault, std::span<const StressMethod> methods);

// A fault as reported by the search: faults of one kind, method, grid and type of light are one.
struct RandomFault {
  SettingFault fault;  // of the shrunk setting
  grid::Kind grid = grid::Kind::frustum;
  bool orthographic = false;
  std::uint64_t settings = 0;        // number of settings that show it
  std::vector<std::uint64_t> seeds;  // the first of these
  Trial scene;                       // shrunk

  std::string name() const;  // of files: "truth-distance-spot"
};

struct RandomSearch {
  std::uint64_t first_seed = 0;
  SettingCounts counts;
  std::vector<RandomFault> faults;
};

}  // namespace clusterbench::stress
