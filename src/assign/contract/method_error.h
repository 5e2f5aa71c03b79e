#pragma once
// A method that fails, or whose lists are none: a fault of the method, not of its input. It costs the method's cases,
// and not those of other methods.

#include "core/error.h"

namespace clusterbench::assign {

class MethodError : public Error {
 public:
  // `file`: where the method's code is. `method`: its name. `message`: what it did, with the method as its subject.
  MethodError(const std::string& file, const std::string& method, const std::string& message)
      : Error(file, method, message, ExitCode::gate_failed), method_(method) {}

  const std::string& method() const { return method_; }

 private:
  std::string method_;
};

}  // namespace clusterbench::assign
