#pragma once
// A call of a plug-in's function: noted, with the mode of floating-point numbers as it was before, and never left by
// the end of the thread.

#include <cfenv>
#include <cstdint>

#ifdef __GLIBCXX__
#include <cxxabi.h>
#endif
#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

#include "os/call_notes.h"

namespace clusterbench::plugin {

// How numbers are computed in this thread: rounding, denormals, traps; without the flags of what has happened.
class FloatMode {
 public:
  bool operator==(const FloatMode&) const = default;

#if defined(__x86_64__) || defined(_M_X64)
  FloatMode() : vector_(_mm_getcsr() & k_modes) {
#ifdef __GNUC__
    asm volatile("fnstcw %0" : "=m"(old_));
#endif
  }
  void set() const {
    _mm_setcsr((_mm_getcsr() & ~k_modes) | vector_);
#ifdef __GNUC__
    asm volatile("fldcw %0" : : "m"(old_));
#endif
  }

 private:
  static constexpr std::uint32_t k_modes = 0xffc0;
  std::uint32_t vector_ = 0;
  std::uint16_t old_ = 0;  // of the x87, which Microsoft's compiler does not use
#else
  FloatMode() : rounding_(std::fegetround()) {}
  void set() const {
    std::fesetround(rounding_);
  }

 private:
  int rounding_;
#endif
};

// Calls `function`. `keeps_mode` says whether it left the mode of numbers alone, which is set
// back. A plug-in that ends the thread (pthread_exit) ends the process here, as in a crash of this call.
template <class Function>
auto called(const os::Caller& caller, os::CallStep step, int frame, bool& keeps_mode, const Function& function) {
  struct Restored {
    bool& is_kept;
    FloatMode before;
    ~Restored() {
      is_kept = FloatMode() == before;
      if (!is_kept) before.set();
    }
  };
  const os::ForeignCall call(caller, step, frame);
  const Restored restored{keeps_mode, {}};
#ifdef __GLIBCXX__
  try {
    return function();
  } catch (const abi::__forced_unwind&) {
    os::end_as_ended_thread();
  }
#else  // no exception tells it
  return function();
#endif
}

}  // namespace clusterbench::plugin
