#pragma once
// H31: a search for lights that touch a cell and are not listed.

#include <atomic>
#include <memory>

#include "stress/stress_run.h"

namespace clusterbench::stress {

// The search of one method: hill-climbs lights, projections and grids towards a light that touches a cell and is not
// listed.
class LostLightSearch {
 public:
  virtual ~LostLightSearch() = default;

  // Whether it has its tries, or its seconds within climb(), or has failed.
  virtual bool is_over() const = 0;
  virtual bool has_failed() const = 0;  // the method has, or its device
  virtual double done() const = 0;      // the part of its tries, or of its seconds if that is more; from 0 to 1
  // The next world, with a population of lights; ends early on `stop`.
  virtual void climb(const std::atomic<bool>& stop) = 0;
  virtual SearchResult result() const = 0;  // of what has been searched so far
};

// `method` and `request` must outlive it.
std::unique_ptr<LostLightSearch> lost_light_search(const StressMethod& method, const StressRequest& request);

}  // namespace clusterbench::stress
