#pragma once
// The cases of a plan, listed and measured one by one on request: one side of a measurement beside another program
// (paired_rounds.h).

#include <memory>
#include <string>
#include <vector>

#include "run/cases/plan.h"
#include "run/timing/paired_rounds.h"

namespace clusterbench::run {

class ServedCases : public Program {
 public:
  // Both must outlive this object.
  ServedCases(const config::Config& config, const Plan& plan);
  ~ServedCases() override;

  std::vector<std::string> case_ids() override;
  std::vector<ListDigest> list_digests(const std::string& id) override;
  FrameLists frame_lists(const std::string& id, int frame) override;
  double assign_ns(const std::string& id) override;

 private:
  struct PlannedCase {
    const GroupPlan& group;
    const CasePlan& case_plan;
  };
  class OpenGroup;  // a group whose methods are ready to be measured; one at a time

  // Throws Error for an id that is not in the plan.
  PlannedCase find(const std::string& id) const;

  const config::Config& config_;
  const Plan& plan_;
  std::unique_ptr<OpenGroup> open_;
};

}  // namespace clusterbench::run
