// Room for lists, and memory beside arrays.

#include <algorithm>

#include "acceptance/acceptance_test.h"
#include "acceptance/bare_method.h"
#include "acceptance/guarded_inputs.h"
#include "core/error.h"
#include "os/call_notes.h"

namespace clusterbench::acceptance {
namespace {

using Guard = os::GuardedMemory::Guard;

// Lists in guarded memory, with room for `capacity` numbers.
class GuardedLists {
 public:
  GuardedLists(std::uint32_t cell_count, std::uint64_t capacity, Guard guard)
      : begin_("lists.begin", (cell_count + std::size_t{1}) * sizeof(std::uint32_t), guard),
        lights_("lists.lights", capacity * sizeof(std::uint32_t), guard) {
    constexpr std::byte k_left_over{0xa5};  // arrays hold whatever was there before
    for (const os::GuardedMemory* memory : {&begin_, &lights_})
      std::fill_n(memory->data(), memory->size(), k_left_over);
    lists_ = {sizeof lists_,
              cell_count,
              reinterpret_cast<std::uint32_t*>(begin_.data()),
              reinterpret_cast<std::uint32_t*>(lights_.data()),
              capacity,
              0,
              0,
              0,
              0};
  }

  clusterbench_lists& lists() { return lists_; }
  // Ascending within each cell. Only of lists without a fault.
  assign::Lists taken() const {
    assign::Lists out;
    out.begin.assign(lists_.begin, lists_.begin + lists_.cell_count + 1);
    out.lights.assign(lists_.lights, lists_.lights + std::min(lists_.count, lists_.capacity));
    return out;
  }

 private:
  os::GuardedMemory begin_, lights_;
  clusterbench_lists lists_{};
};

// An instance that is built for guarded inputs.
class GuardedCall {
 public:
  GuardedCall(const Subject& subject, const SubjectFrame& frame, Guard guard)
      : frame_(frame), guard_(guard), inputs_(frame, guard), method_(*subject.method) {
    os::note_setting(frame.label);
    if (method_.create() != CLUSTERBENCH_OK || method_.build(inputs_.grid(), inputs_.light_types()) != CLUSTERBENCH_OK)
      throw Error("", frame.label, "create() or build() gave " + method_.outcome());
  }

  std::uint64_t most() const { return std::uint64_t{frame_.grid.cell_count()} * frame_.lights.size(); }

  // A call with room for `capacity` numbers. Returns its status; `asked`: lists.count.
  clusterbench_status call(std::uint64_t capacity, std::uint64_t& asked) {
    GuardedLists out(frame_.grid.cell_count(), capacity, guard_);
    const clusterbench_status status = method_.assign(inputs_.frame(), inputs_.lights(), out.lists());
    asked = out.lists().count;
    if (status == CLUSTERBENCH_OK) lists_ = out.taken();
    return status;
  }

  // Its lists of the last call that succeeded, ascending. Throws if they are none.
  assign::Lists lists() {
    const std::string fault = assign::lists_fault(lists_, frame_.grid.cell_count(), frame_.lights);
    if (!fault.empty()) throw Error("", frame_.label, "what it gave are no lists: " + fault);
    assign::make_ascending(lists_);
    return lists_;
  }
  std::string outcome() const { return method_.outcome(); }

 private:
  const SubjectFrame& frame_;
  Guard guard_;
  GuardedInputs inputs_;
  BareMethod method_;
  assign::Lists lists_;
};

void stay_within_arrays(const Subject& subject, Findings& findings) {
  os::report_guards();
  const std::vector<SubjectFrame> frames = frames_for(subject, 8);
  for (const SubjectFrame& frame : frames)
    for (const Guard guard : {Guard::behind, Guard::before}) {
      GuardedCall guarded(subject, frame, guard);
      std::uint64_t asked = 0;
      if (guarded.call(guarded.most(), asked) != CLUSTERBENCH_OK)
        findings.fault(frame.label + ": assign() with room for every light in every cell gave " + guarded.outcome());
      else if (guarded.lists() != lists_of(subject, frame))
        findings.fault(frame.label + ": the lists depend on where the arrays lie");
    }
  findings.detail = frames_text(2 * frames.size());
}

// From no room at all on, always as much as was asked for.
void grow(const Subject& subject, const SubjectFrame& frame, Findings& findings) {
  GuardedCall guarded(subject, frame, Guard::behind);
  std::uint64_t capacity = 0, asked = 0;
  for (int calls = 0; calls < 64; ++calls) {
    const clusterbench_status status = guarded.call(capacity, asked);
    if (status == CLUSTERBENCH_OK) {
      if (asked > capacity)
        findings.fault(frame.label + ": says that it wrote " + std::to_string(asked) + " pairs with room for " +
                       std::to_string(capacity));
      else if (guarded.lists() != lists_of(subject, frame))
        findings.fault(frame.label + ": the lists depend on how much room there was before");
      return;
    }
    if (status != CLUSTERBENCH_MORE)
      return findings.fault(frame.label + ": assign() with room for " + std::to_string(capacity) + " pairs gave " +
                            guarded.outcome() + "; it has to give status 4 and the room that it needs");
    if (asked <= capacity || asked > guarded.most())
      return findings.fault(frame.label + ": asks for room for " + std::to_string(asked) +
                            " pairs where it has room for " + std::to_string(capacity) +
                            ", and all lights in all cells are " + std::to_string(guarded.most()));
    capacity = asked;
  }
  findings.fault(frame.label + ": has asked for more room 64 times");
}

void ask_for_room(const Subject& subject, Findings& findings) {
  os::report_guards();
  const std::vector<SubjectFrame> frames = frames_for(subject, 8);
  for (const SubjectFrame& frame : frames) grow(subject, frame, findings);
  findings.detail = frames_text(frames.size());
}

}  // namespace

std::vector<AcceptanceTest> memory_tests() {
  return {
      {"guards", "touches no memory beside its arrays, and writes to none of its inputs", false, stay_within_arrays},
      {"capacity", "asks for room where there is too little, and is content with what it asked for", false,
       ask_for_room},
  };
}

}  // namespace clusterbench::acceptance
