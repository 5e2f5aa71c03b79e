#pragma once
// Runs a method in one of its result forms: measures use this to treat all methods alike.

#include <memory>
#include <optional>
#include <utility>

#include "assign/contract/assigner.h"

namespace clusterbench::assign {

class AssignerRun {
 public:
  // The descriptor must support this form.
  AssignerRun(const AssignerDescriptor& descriptor, const Params& params, Answer answer);

  void build(const grid::Grid& grid, const LightKinds& kinds) { assigner().build(grid, kinds); }
  void build(const grid::Grid& grid) { assigner().build(grid); }
  void assign(const FrameInput& input);

  // The lists as the method filled them; null if it makes its own structure.
  const Lists* filled_lists() const { return lists_assigner_ ? &lists_ : nullptr; }
  // Its own structure; null if it fills lists.
  const LightStructure* structure() const { return structure_.get(); }
  bool has_cells() const { return !structure_ || structure_->has_cells(); }
  bool has_occupied_cells() const { return structure_ && structure_->has_occupied_cells(); }
  // The lights that each cell's samples loop over. Only with cells. Not timed.
  const Lists& cell_lists(ListOrder order = ListOrder::ascending) const;
  // Of a method that fills lists: the memory that it fills next. And moves its lists of this frame into `filled` and,
  // if cell_lists(order) are others, those into `ascending`, whose memory is used again.
  void use_memory_of(Lists lists) { lists_ = std::move(lists); }
  void hand_over(ListOrder order, Lists& filled, std::optional<Lists>& ascending);

  std::uint64_t tests_done() const { return assigner().tests_done(); }
  std::uint64_t fallbacks() const { return assigner().fallbacks(); }
  std::size_t scratch_bytes() const { return assigner().scratch_bytes(); }
  // Whether several instances that share the frames of a path have the same figures as one; with `counts_scratch`, that
  // of the scratch memory, too.
  bool shares_frames(bool counts_scratch) const;

 private:
  Assigner& assigner() const;

  std::unique_ptr<ListAssigner> lists_assigner_;
  std::unique_ptr<StructureAssigner> structure_assigner_;  // one of the two is set
  Lists lists_;
  std::unique_ptr<LightStructure> structure_;
  mutable Lists ascending_;  // made on request by cell_lists(); in the order that was requested
};

// The result forms of a method whose lists per cell can be compared with the truth.
std::vector<Answer> answers_with_cells(const AssignerDescriptor& descriptor, const Params& params);

}  // namespace clusterbench::assign
