#include "assign/contract/assigner_run.h"

#include <utility>

namespace clusterbench::assign {

AssignerRun::AssignerRun(const AssignerDescriptor& descriptor, const Params& params, Answer answer) {
  if (answer == Answer::lists) {
    lists_assigner_ = descriptor.make(params);
    return;
  }
  structure_assigner_ = descriptor.make_own(params);
  structure_ = structure_assigner_->make_structure();
}

Assigner& AssignerRun::assigner() const {
  if (lists_assigner_) return *lists_assigner_;
  return *structure_assigner_;
}

void AssignerRun::assign(const FrameInput& input) {
  if (lists_assigner_) {
    lists_assigner_->assign(input, lists_);
    lists_assigner_->check(lists_, input.lights);
  } else {
    structure_assigner_->assign(input, *structure_);
  }
}

const Lists& AssignerRun::cell_lists(ListOrder order) const {
  if (lists_assigner_) {
    if (order == ListOrder::any || are_ascending(lists_)) return lists_;
    ascending_ = lists_;
  } else {
    structure_->expand(ascending_);
  }
  if (order == ListOrder::ascending) make_ascending(ascending_);
  return ascending_;
}

bool AssignerRun::shares_frames(bool counts_scratch) const {
  const EarlierFrames earlier = assigner().earlier_frames();
  return earlier == EarlierFrames::do_not_matter || (earlier == EarlierFrames::matter_to_scratch && !counts_scratch);
}

void AssignerRun::hand_over(ListOrder order, Lists& filled, std::optional<Lists>& ascending) {
  if (&cell_lists(order) == &lists_) {
    ascending.reset();
  } else {
    if (!ascending) ascending.emplace();
    std::swap(*ascending, ascending_);
  }
  filled = std::move(lists_);
}

std::vector<Answer> answers_with_cells(const AssignerDescriptor& descriptor, const Params& params) {
  std::vector<Answer> answers;
  for (const Answer answer : {Answer::lists, Answer::structure})
    if (descriptor.answers(answer) && AssignerRun(descriptor, params, answer).has_cells()) answers.push_back(answer);
  return answers;
}

}  // namespace clusterbench::assign
