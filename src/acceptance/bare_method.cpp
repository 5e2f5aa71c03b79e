#include "acceptance/bare_method.h"

#include <cstring>

#include "assign/contract/method_error.h"
#include "core/text.h"
#include "plugin/plugin_call.h"

namespace clusterbench::acceptance {

template <class Function>
void BareMethod::noted(os::CallStep step, const char* doing, const Function& function) {
  struct Checked {
    ~Checked() { os::end_if_files_are_lost(); }
  };
  plugin::CallEnd end;
  {
    const os::ForeignCall call(caller_, step);
    const Checked checked;
    if (step == os::CallStep::destroy)
      plugin::expect_return(doing, function);
    else
      plugin::returned(end, function);
  }
  if (!end.exception.empty())
    throw assign::MethodError("", method_.descriptor.name,
                              "an exception left " + std::string(doing) + ": " + end.exception);
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
  noted(os::CallStep::create, "create()", [&] {
    const auto count = static_cast<std::uint32_t>(values.size());
    last_ = method_.table.create(method_.own, values.data(), count, &instance_, &error_);
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
  noted(os::CallStep::build, "build()", [&] { last_ = method_.table.build(instance_, &grid, light_types, &error_); });
  return last_;
}

clusterbench_status BareMethod::assign(const clusterbench_frame& frame, const clusterbench_lights& lights,
                                       clusterbench_lists& lists) {
  clear();
  noted(os::CallStep::assign, "assign()",
        [&] { last_ = method_.table.assign(instance_, &frame, &lights, &lists, &error_); });
  return last_;
}

void BareMethod::destroy() {
  if (is_there_) noted(os::CallStep::destroy, "destroy()", [&] { method_.table.destroy(instance_); });
  is_there_ = false;
}

std::string BareMethod::outcome() const {
  const std::string text(text_.data(), strnlen(text_.data(), text_.size()));
  return "status " + std::to_string(last_) + (text.empty() ? "" : ": " + printable(text));
}

}  // namespace clusterbench::acceptance
