#include "dump/our_methods.h"

#include <algorithm>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "core/error.h"
#include "core/text.h"
#include "dump/lost_lights.h"

namespace clusterbench::dump {
namespace {

constexpr const char* k_flag = "--methods";

// Fills lists of this grid on this machine's processor.
bool runs_on(const assign::AssignerDescriptor& method, const assign::Params& params, const DumpFrame& frame) {
  return !method.on_device && method.takes(frame.grid.kind()) && method.answers(assign::Answer::lists) &&
         !method.needs.depth && (method.orthographic || !frame.frame.projection.orthographic) &&
         assign::unavailability(method, params).empty();
}

// Without those that try all pairs or have a faster form with the same lists.
bool is_compared(const assign::AssignerDescriptor& method) {
  constexpr int k_has_a_faster_form = 2;
  return method.is_default() && assign::slowness_of(method.name) != k_has_a_faster_form && !method.all_pairs;
}

std::uint64_t packed_bytes(const assign::Lists& lists, const DumpFrame& frame) {
  const assign::StorageDescriptor& packed = *assign::find_storage("packed");
  const auto storage = packed.make(assign::Params(packed.params));
  storage->start(lists.cell_count(), frame.frame.ranges());
  storage->store(lists);
  const assign::StructureUse use = storage->use();
  return use.index_bytes + use.header_bytes;
}

result::CheckedMethod checked_method(const assign::AssignerDescriptor& method, const DumpFrame& frame,
                                     const assign::Lists& truth) {
  const view::LightArrays lights = view::lights_in(frame.frame, grid::space_of(frame.grid, frame.frame));
  assign::AssignerRun run(method, assign::Params(method.params), assign::Answer::lists);
  run.build(frame.grid, assign::kinds_of(lights));
  run.assign({frame.frame, lights});
  const assign::Lists& listed = run.cell_lists();
  const LostLights lost = find_lost(frame.frame, frame.grid, truth, listed, {});
  return {method.name, listed.pair_count(), lost.false_positives, lost.lost_pairs, packed_bytes(listed, frame)};
}

using Descriptors = std::vector<const assign::AssignerDescriptor*>;

[[noreturn]] void refuse_method(const std::string& name, const DumpFrame& frame) {
  std::vector<std::string> allowed;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (runs_on(*method, assign::Params(method->params), frame)) allowed.push_back(method->name);
  throw Error("", k_flag,
              "names '" + name + "', which makes no lists of this dump's grid on a processor; allowed: " +
                  (allowed.empty() ? std::string("none") : joined(allowed)));
}

Descriptors named_methods(const DumpFrame& frame, const std::vector<std::string>& names) {
  Descriptors out;
  for (const std::string& name : names) {
    out.push_back(assign::find_assigner(name));
    if (!runs_on(*out.back(), assign::Params(out.back()->params), frame)) refuse_method(name, frame);
  }
  return out;
}

Descriptors compared_methods(const DumpFrame& frame) {
  Descriptors out;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (is_compared(*method) && runs_on(*method, assign::Params(method->params), frame)) out.push_back(method);
  return out;
}

}  // namespace

MethodChoice method_choice(const std::string& text) {
  using Which = MethodChoice::Which;
  for (const auto& [word, which] : {std::pair("none", Which::none), {"quick", Which::quick}, {"all", Which::all}})
    if (text == word) return {which, {}};
  MethodChoice out{Which::named, {}};
  const std::vector<std::string> known = assign::assigner_names();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    if (std::ranges::find(out.names, name) != out.names.end())
      throw Error("", k_flag, "names '" + name + "' twice; allowed: each method once");
    out.names.push_back(name);
    if (assign::find_assigner(out.names.back()) == nullptr)
      throw Error("", k_flag,
                  "found '" + out.names.back() + "'" + did_you_mean(out.names.back(), known) +
                      ", allowed: none, quick, all, or names of `clusterbench list assigners`");
    begin = end + 1;
  }
  return out;
}

void add_methods(const DumpFrame& frame, const assign::Lists& truth, const MethodChoice& choice,
                 result::CheckedDump& out) {
  using Which = MethodChoice::Which;
  if (choice.which == Which::none) return;
  const Descriptors methods =
      choice.which == Which::named ? named_methods(frame, choice.names) : compared_methods(frame);
  const bool is_too_much =
      choice.which == Which::quick && frame.grid.cell_count() + truth.pair_count() > k_most_quick_steps;
  for (const assign::AssignerDescriptor* method : methods)
    if (is_too_much)
      out.methods_left_out.push_back(method->name);
    else
      out.methods.push_back(checked_method(*method, frame, truth));
}

}  // namespace clusterbench::dump
