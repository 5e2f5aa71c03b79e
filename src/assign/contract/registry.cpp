#include <algorithm>
#include <atomic>

#include "assign/contract/assigner.h"
#include "core/error.h"

namespace clusterbench::assign {

#define CLUSTERBENCH_ASSIGNER(file) extern const AssignerDescriptor file##_descriptor;
#include "assign/contract/registry.inc"
#undef CLUSTERBENCH_ASSIGNER

namespace {

std::atomic<std::uint64_t> changes{0};  // of the registry

std::vector<const AssignerDescriptor*>& registry() {
#define CLUSTERBENCH_ASSIGNER(file) &file##_descriptor,
  static std::vector<const AssignerDescriptor*> all{
#include "assign/contract/registry.inc"
  };
#undef CLUSTERBENCH_ASSIGNER
  return all;
}

}  // namespace

bool AssignerDescriptor::takes(grid::Kind kind) const {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool AssignerDescriptor::answers(Answer answer) const {
  return answer == Answer::lists ? make != nullptr : make_own != nullptr;
}

bool is_conservative(const AssignerDescriptor& descriptor, const Params& params) {
  return descriptor.conservative &&
         std::none_of(descriptor.params.begin(), descriptor.params.end(), [&](const ParamSpec& spec) {
           return std::holds_alternative<double>(spec.default_value) &&
                  params.number(spec.name) < spec.conservative_from;
         });
}

int thread_count(const AssignerDescriptor& descriptor, const Params& params) {
  for (const ParamSpec& spec : descriptor.params)
    if (spec.is_thread_count) return static_cast<int>(params.number(spec.name));
  return 1;
}

std::string unavailability(const AssignerDescriptor& descriptor, const Params& params) {
  return descriptor.unavailable == nullptr ? "" : descriptor.unavailable(params);
}

std::span<const AssignerDescriptor* const> assigner_descriptors() {
  return registry();
}

AssignerRegistration::AssignerRegistration(AssignerDescriptor descriptor) : descriptor_(std::move(descriptor)) {
  if (find_assigner(descriptor_.name) != nullptr)
    throw Error("", descriptor_.name, "is the name of an assigner that is there already");
  registry().push_back(&descriptor_);
  ++changes;
}

AssignerRegistration::~AssignerRegistration() {
  std::erase(registry(), &descriptor_);
  ++changes;
}

std::uint64_t registry_version() {
  return changes;
}

const AssignerDescriptor* find_assigner(const std::string& name) {
  for (const AssignerDescriptor* descriptor : assigner_descriptors())
    if (descriptor->name == name) return descriptor;
  return nullptr;
}

int slowness_of(const std::string& name) {
  const AssignerDescriptor* assigner = find_assigner(name);
  if (assigner != nullptr && assigner->all_pairs) return 3;
  if (find_assigner(name + "-fast") != nullptr) return 2;
  return name.ends_with("-fast") ? 1 : 0;
}

std::vector<std::string> assigner_names() {
  std::vector<std::string> names;
  for (const AssignerDescriptor* descriptor : assigner_descriptors()) names.push_back(descriptor->name);
  return names;
}

std::vector<std::string> default_assigner_names() {
  std::vector<std::string> names;
  for (const AssignerDescriptor* descriptor : assigner_descriptors())
    if (descriptor->is_default()) names.push_back(descriptor->name);
  return names;
}

}  // namespace clusterbench::assign
