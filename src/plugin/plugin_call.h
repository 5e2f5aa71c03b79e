#pragma once
// A call of a plug-in's function: noted, with the mode of floating-point numbers as it was before, and left neither by
// an exception nor by the end of the thread.

#include <cfenv>
#include <cstdint>
#include <string>

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
    asm volatile("fnclex\n\tfldcw %0" : : "m"(old_));  // nothing of the call traps here
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

// Whether registers of the x87 hold numbers. Between calls they are empty; code of MMX without `emms` leaves all of
// them in use, and then each operation of the x87 gives NaN.
#if defined(__x86_64__) && defined(__GNUC__)
inline bool has_x87_numbers() {
  constexpr std::uint16_t k_class = 0x4500, k_empty = 0x4100;
  std::uint16_t status = 0;
  asm volatile("fxam\n\tfnstsw %0" : "=a"(status));
  return (status & k_class) != k_empty;
}
inline void empty_x87() {
  std::uint16_t mode = 0;
  asm volatile("fnstcw %0\n\tfninit\n\tfldcw %0" : "+m"(mode));
}
#else
inline bool has_x87_numbers() {
  return false;
}
inline void empty_x87() {}
#endif

// How a call left its thread, which is set back.
struct CallEnd {
  bool keeps_mode = true;       // of floating-point numbers
  bool empties_numbers = true;  // the registers of the x87
  std::string exception;        // that left it, in words; "" if none did
};

// The exception that is being handled, in words of one line. May call its code: within the call.
std::string exception_text();
// Prints it, and aborts.
[[noreturn]] void end_as_left(const char* doing, const std::string& exception);

// Runs a function of a plug-in. False if an exception left it, which `end` then has. All functions of plug-ins are
// called through this one: nothing else expects exceptions that mean nothing here.
template <class Function>
bool returned(CallEnd& end, const Function& function) {
  try {
    function();
    return true;
#ifdef __GLIBCXX__
  } catch (const abi::__forced_unwind&) {  // the end of the thread
    throw;
#endif
  } catch (...) {
    end.exception = exception_text();
    return false;
  }
}

// The same for what cannot fail, as destroy(): ends the process, within the call, which is then the one that crashed.
template <class Function>
void expect_return(const char* doing, const Function& function) {
  CallEnd end;
  if (!returned(end, function)) end_as_left(doing, end.exception);
}

// Calls `function`, which calls a plug-in; its own errors pass. A plug-in that ends the thread (pthread_exit) ends the
// process here, as in a crash of this call.
template <class Function>
auto called(const os::Caller& caller, os::CallStep step, int frame, CallEnd& end, const Function& function) {
  struct Restored {
    CallEnd& end;
    FloatMode before;
    ~Restored() {
      end.keeps_mode = FloatMode() == before;
      if (!end.keeps_mode) before.set();
      end.empties_numbers = !has_x87_numbers();
      if (!end.empties_numbers) empty_x87();
    }
  };
  const os::ForeignCall call(caller, step, frame);
  const Restored restored{end, {}};
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
