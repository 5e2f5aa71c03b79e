#pragma once
// An instance of a method, called as clusterbench_plugin.h says and without the program's care: with any memory for its
// lists.

#include <array>
#include <string>
#include <vector>

#include "plugin/plugin_method.h"

namespace clusterbench::acceptance {

class BareMethod {
 public:
  explicit BareMethod(const plugin::MethodFacts& method);
  ~BareMethod();
  BareMethod(const BareMethod&) = delete;
  BareMethod& operator=(const BareMethod&) = delete;

  // Until it succeeds there is no instance, and the other functions are not to be called.
  clusterbench_status create(const std::vector<clusterbench_value>& values);
  // With the default values.
  clusterbench_status create();
  clusterbench_status build(const clusterbench_grid& grid, std::uint32_t light_types);
  clusterbench_status assign(const clusterbench_frame& frame, const clusterbench_lights& lights,
                             clusterbench_lists& lists);
  void destroy();

  // "status 1: no tiles": of the last call.
  std::string outcome() const;

 private:
  // A call, noted as those of the program are. Throws MethodError if an exception left it.
  template <class Function>
  void noted(os::CallStep step, const char* doing, const Function& function);
  void clear();

  const plugin::MethodFacts& method_;
  os::Caller caller_;
  std::array<char, 1024> text_{};
  clusterbench_error error_{};
  void* instance_ = nullptr;
  bool is_there_ = false;
  clusterbench_status last_ = CLUSTERBENCH_OK;
};

}  // namespace clusterbench::acceptance
