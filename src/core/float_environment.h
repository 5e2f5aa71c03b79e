#pragma once
// The rounding of floating point, as all error bounds assume it.

#include <cfenv>

namespace clusterbench {

// Rounds to nearest and keeps denormal numbers on this thread until its end, whatever its caller set: a program linked
// with -ffast-math flushes them to zero from its start.
class NearestRoundingScope {
 public:
  NearestRoundingScope() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~NearestRoundingScope() { std::fesetenv(&before_); }
  NearestRoundingScope(const NearestRoundingScope&) = delete;
  NearestRoundingScope& operator=(const NearestRoundingScope&) = delete;

 private:
  std::fenv_t before_{};
};

}  // namespace clusterbench
