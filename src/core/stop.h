#pragma once
// Whether work is to end early: a signal, or a failure of other work that makes this work useless.

#include <atomic>

namespace clusterbench {

class Stop {
 public:
  // The flags must outlive this object.
  Stop(const std::atomic<bool>& signal) : signal_(&signal) {}
  Stop(const Stop& outer, const std::atomic<bool>& failed) : signal_(outer.signal_), failed_(&failed) {}

  operator bool() const { return *signal_ || (failed_ != nullptr && *failed_); }

 private:
  const std::atomic<bool>* signal_;
  const std::atomic<bool>* failed_ = nullptr;
};

}  // namespace clusterbench
