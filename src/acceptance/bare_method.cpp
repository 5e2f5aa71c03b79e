#include "acceptance/bare_method.h"

#include <cstring>

#include "core/text.h"

namespace clusterbench::acceptance {

template <class Function>
auto BareMethod::noted(os::CallStep step, const Function& function) {
  struct Checked {
    ~Checked() { os::end_if_files_are_lost(); }
  };
  const os::ForeignCall call(caller_, step);
  const Checked checked;
  return function();
}

BareMethod::BareMethod(const plugin::MethodFacts& method)
    : method_(method), caller_{os::note_code(method.descriptor.plugin), 0} {
  error_ = {sizeof error_, static_cast<std::uint32_t>(text_.size()), text_.data()};
}

BareMethod::~BareMethod() {
  destroy();
}

void BareMethod::clear() {
  text_.front() = '\0';
}

clusterbench_status BareMethod::create(const std::vector<clusterbench_value>& values) {
  clear();
  last_ = noted(os::CallStep::create, [&] {
    return method_.table.create(method_.own, values.data(), static_cast<std::uint32_t>(values.size()), &instance_,
                                &error_);
  });
  is_there_ = last_ == CLUSTERBENCH_OK;
  return last_;
}

clusterbench_status BareMethod::create() {
  const assign::Params params(method_.descriptor.params);
  return create(plugin::values_of(method_.descriptor.params, params));
}

clusterbench_status BareMethod::build(const clusterbench_grid& grid, std::uint32_t light_types) {
  clear();
  return last_ =
             noted(os::CallStep::build, [&] { return method_.table.build(instance_, &grid, light_types, &error_); });
}

clusterbench_status BareMethod::assign(const clusterbench_frame& frame, const clusterbench_lights& lights,
                                       clusterbench_lists& lists) {
  clear();
  return last_ = noted(os::CallStep::assign,
                       [&] { return method_.table.assign(instance_, &frame, &lights, &lists, &error_); });
}

void BareMethod::destroy() {
  if (is_there_) noted(os::CallStep::destroy, [&] { method_.table.destroy(instance_); });
  is_there_ = false;
}

std::string BareMethod::outcome() const {
  const std::string text(text_.data(), strnlen(text_.data(), text_.size()));
  return "status " + std::to_string(last_) + (text.empty() ? "" : ": " + printable(text));
}

}  // namespace clusterbench::acceptance
