#include "assign/contract/assigner_run.h"

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

const Lists& AssignerRun::cell_lists() const {
  if (lists_assigner_) {
    if (are_ascending(lists_)) return lists_;
    ascending_ = lists_;
  } else {
    structure_->expand(ascending_);
  }
  make_ascending(ascending_);
  return ascending_;
}

std::vector<Answer> answers_with_cells(const AssignerDescriptor& descriptor, const Params& params) {
  std::vector<Answer> answers;
  for (const Answer answer : {Answer::lists, Answer::structure})
    if (descriptor.answers(answer) && AssignerRun(descriptor, params, answer).has_cells()) answers.push_back(answer);
  return answers;
}

}  // namespace clusterbench::assign
