#include "run/counters/machine_load.h"

#include <algorithm>

#include "run/timing/repeated.h"

namespace clusterbench::run {

LoadWatch::LoadWatch() : start_(now()) {}

LoadWatch::Now LoadWatch::now() {
  return {1e-9 * wall_ns(), os::own_processor_s(), os::processor_time_now(), os::throttle_events()};
}

Disturbance LoadWatch::so_far() const {
  const Now end = now();
  const double own_s = end.own_s - start_.own_s;
  return {end.wall_s - start_.wall_s, std::max(0.0, end.all.busy_s - start_.all.busy_s - own_s),
          std::max(0.0, end.all.stolen_s - start_.all.stolen_s),
          end.throttled >= start_.throttled ? end.throttled - start_.throttled : 0};
}

}  // namespace clusterbench::run
