#pragma once
// Cases with their costs, for a choice among those of one view.

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "measure/statistics/frame_cost.h"
#include "report/cases/case_costs.h"
#include "report/cases/contender.h"
#include "result/figures/case_figure.h"
#include "result/result.h"
#include "run/findings/gate.h"

namespace clusterbench::report {

// Why samples are at random depths: no surfaces were requested, the scene has none, or the program that made the
// result lacks Embree.
enum class UnseenSurfaces : std::uint8_t { not_requested, no_triangles, no_embree };
UnseenSurfaces unseen_surfaces(const result::Result& result, const result::Json& config);

// A case with the costs that rank it.
struct WeighedCase {
  const result::Case* result_case = nullptr;
  run::Contender contender;  // its times include modelled costs
  measure::FrameCost cost;
  bool is_modelled = false, has_random_depths = false, is_on_front = false;
  UnseenSurfaces unseen = UnseenSurfaces::not_requested;  // if it has random depths

  bool is_timed() const { return cost.assign_ns.has_value(); }
  double bytes() const { return static_cast<double>(result_case->buffers.bytes.high_water); }
  double ns() const { return cost.assign_ns.value_or(0.0) + cost.gpu_ns(); }
  double weight() const { return is_timed() || is_modelled ? ns() : bytes(); }
  // The cheapest first; among equal untimed ones the one known to be faster.
  auto order() const { return std::tuple(weight(), !is_timed() && !has_simd(), is_timed() ? 0 : slowness()); }
  double unlit() const { return unlit_at_samples(*result_case).value_or(0.0); }
  double device_ns() const { return figure_of(*result_case, "device_us").value_or(0.0) * 1e3; }
  int slowness() const { return slowness_of(*result_case); }
  bool has_simd() const { return slowness() == 1; }
  // Among cases of equal cost the smallest is recommended.
  auto rank() const {
    return std::tuple(unlit() > 0.0, is_at_surfaces(method()), !is_on_front, bytes(), !has_simd(), slowness());
  }
  const std::string& method() const { return result_case->assigner.name; }
};

// Cases that are compared with each other: those of one view, and if times are of several machines, of one machine.
struct SceneView {
  std::string scene, camera;
  result::Counts2 viewport{};
  std::optional<std::string> machine{};
  std::vector<WeighedCase> sound{}, searched{};  // the cheapest first
  std::vector<WeighedCase> on_device{};          // the fastest by the device's clock first
  std::size_t unsampled = 0;                     // cases with unknown cost or losses
  std::vector<const result::Case*> cases{};
};

// The views of a result's cases without presets. `config`: of the run that measured them.
std::vector<SceneView> scene_views(const result::Result& result, const result::Json& config);

// Whether both have the same lists in the same cells and storage: made by different methods, so only their times
// differ.
bool has_lists_of(const WeighedCase& a, const WeighedCase& b);

}  // namespace clusterbench::report
