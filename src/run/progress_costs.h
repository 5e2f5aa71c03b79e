#pragma once
// Estimates of work in nanoseconds, for nothing but the remaining time that is shown.

#include <array>
#include <map>
#include <span>

#include "config/config.h"
#include "run/cases/plan.h"
#include "run/runner.h"

namespace clusterbench::run {

// The costs of a group, or of some of its cases, by what was measured (run/estimate.h), else by rough constants.
class ProgressCosts {
 public:
  // `measured`: of the plan's groups, or empty. The configuration and the plan must outlive this object.
  ProgressCosts(const config::Config& config, const Plan& plan, std::span<const GroupCost> measured);

  double counting(const GroupPlan& group) const;  // truth and counts
  double stability(const GroupPlan& group) const;
  double details(const GroupPlan& group) const;
  double device(const GroupPlan& group) const;
  double reading(const GroupPlan& group) const;
  double timing(const GroupPlan& group) const;
  double all(const GroupPlan& group) const;

 private:
  using Key = std::array<std::size_t, 4>;
  static Key key_of(const GroupPlan& group) { return {group.scene, group.camera, group.viewport, group.grid}; }
  const GroupCost* measured_of(const GroupPlan& group) const;
  std::size_t frames_of(const GroupPlan& group) const;
  // Truth, samples and lists of so many frames.
  double of_lists(const GroupPlan& group, double frames, double samples_per_frame) const;

  const config::Config& config_;
  const Plan& plan_;
  std::map<Key, GroupCost> measured_;
};

}  // namespace clusterbench::run
