#pragma once
// Cases with what they cost, for a choice among those that see the same.

#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "measure/statistics/frame_cost.h"
#include "report/cases/case_costs.h"
#include "report/cases/contender.h"
#include "result/result.h"
#include "run/findings/gate.h"

namespace clusterbench::report {

// A case with what it is ranked by.
struct WeighedCase {
  const result::Case* result_case = nullptr;
  run::Contender contender;  // whose times hold what is modelled
  measure::FrameCost cost;
  bool is_modelled = false, has_random_depths = false, is_on_front = false;
  bool has_no_triangles = false;  // where surfaces are asked for

  bool is_timed() const { return cost.assign_ns.has_value(); }
  double bytes() const { return static_cast<double>(result_case->buffers.bytes.high_water); }
  double ns() const { return cost.assign_ns.value_or(0.0) + cost.gpu_ns(); }
  double weight() const { return is_timed() || is_modelled ? ns() : bytes(); }
  // The cheapest first; of equal ones that nobody timed what is known to be faster.
  auto order() const { return std::tuple(weight(), !is_timed() && !has_simd(), is_timed() ? 0 : slowness()); }
  double unlit() const { return unlit_at_samples(*result_case).value_or(0.0); }
  int slowness() const { return slowness_of(*result_case); }
  bool has_simd() const { return slowness() == 1; }
  // Of cases that cost alike the least is taken.
  auto rank() const {
    return std::tuple(unlit() > 0.0, is_at_surfaces(method()), !is_on_front, bytes(), !has_simd(), slowness());
  }
  const std::string& method() const { return result_case->assigner.name; }
};

// What is compared with each other: cases that see the same.
struct SceneView {
  std::string scene, camera;
  result::Counts2 viewport{};
  std::vector<WeighedCase> sound{}, searched{};  // the cheapest first
  std::size_t unsampled = 0;                     // cases of which nothing says what they cost, or what they leave unlit
  std::vector<const result::Case*> cases{};
};

// Of a result's cases that are of no preset. `config`: by which they were measured.
std::vector<SceneView> scene_views(const result::Result& result, const result::Json& config);

// The same lists in the same cells and storage: of other methods, of which nothing but times is to be told.
bool has_lists_of(const WeighedCase& a, const WeighedCase& b);

}  // namespace clusterbench::report
