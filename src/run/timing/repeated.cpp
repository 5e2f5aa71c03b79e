#include "run/timing/repeated.h"

#include <time.h>

#include <algorithm>
#include <cmath>

namespace clusterbench::run {

double thread_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

double Repeated::sample() {
  if (repeats_ == 0) calibrate();
  const double start = now_ns_();
  for (int i = 0; i < repeats_; ++i) once_();
  return (now_ns_() - start) / repeats_;
}

void Repeated::warm_up() {
  if (repeats_ == 0) calibrate();
  for (int i = 0; i < repeats_; ++i) once_();
}

void Repeated::calibrate() {
  const auto time_once = [this] {
    const double start = now_ns_();
    once_();
    return std::max(1.0, now_ns_() - start);
  };
  double one_ns = time_once();
  if (one_ns < 4.0 * min_ns_) one_ns = time_once();  // the first run may have to allocate memory
  repeats_ = static_cast<int>(std::clamp(std::ceil(min_ns_ / one_ns), 1.0, 1e6));
}

}  // namespace clusterbench::run
