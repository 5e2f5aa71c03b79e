#include "core/turns.h"

#include <chrono>

namespace clusterbench {

void InOrder::ready(std::size_t i) {
  std::unique_lock lock(mutex_);
  is_ready_[i] = true;
  if (is_delivering_) return;
  is_delivering_ = true;
  for (; next_ < is_ready_.size() && is_ready_[next_]; ++next_) {
    lock.unlock();
    deliver_(next_);  // if it throws, is_delivering_ stays
    lock.lock();
  }
  is_delivering_ = false;
}

bool Budget::take(double share, const Stop& stop) {
  constexpr std::chrono::milliseconds k_look_for_stop{50};
  std::unique_lock lock(mutex_);
  while (users_ > 0 && used_ + share > all_) {
    if (stop) return false;
    freed_.wait_for(lock, k_look_for_stop);
  }
  ++users_;
  used_ += share;
  return true;
}

void Budget::give_back(double share) {
  {
    const std::lock_guard lock(mutex_);
    --users_;
    used_ -= share;
  }
  freed_.notify_all();
}

}  // namespace clusterbench
