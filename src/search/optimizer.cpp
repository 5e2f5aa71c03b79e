#include "search/optimizer.h"

#include <nlopt.h>

#include <exception>
#include <limits>
#include <memory>

namespace clusterbench::search {
namespace {

// The callback of NLopt. No exception may pass through its C code.
struct Calls {
  const Objective& objective;
  const std::atomic<bool>& stop;
  int most;
  nlopt_opt optimizer = nullptr;
  int done = 0;
  std::exception_ptr thrown = nullptr;

  double call(unsigned dimensions, const double* point) {
    if (stop || thrown || done >= most) {
      nlopt_force_stop(optimizer);
      return -std::numeric_limits<double>::max();
    }
    try {
      ++done;
      return objective({point, point + dimensions});
    } catch (...) {
      thrown = std::current_exception();
      nlopt_force_stop(optimizer);
      return -std::numeric_limits<double>::max();
    }
  }
};

double called(unsigned dimensions, const double* point, double* /*gradient*/, void* calls) {
  return static_cast<Calls*>(calls)->call(dimensions, point);
}

struct Destroy {
  void operator()(nlopt_opt optimizer) const { nlopt_destroy(optimizer); }
};
using Optimizer = std::unique_ptr<nlopt_opt_s, Destroy>;

Optimizer make_optimizer(nlopt_algorithm algorithm, std::size_t dimensions, Calls& calls) {
  Optimizer optimizer(nlopt_create(algorithm, static_cast<unsigned>(dimensions)));
  if (!optimizer) throw std::bad_alloc();
  calls.optimizer = optimizer.get();
  nlopt_set_lower_bounds1(optimizer.get(), 0.0);
  nlopt_set_upper_bounds1(optimizer.get(), 1.0);
  nlopt_set_max_objective(optimizer.get(), called, &calls);
  nlopt_set_maxeval(optimizer.get(), calls.most);
  return optimizer;
}

int optimised(const Optimizer& optimizer, std::vector<double>& start, const Calls& calls) {
  double best = 0.0;
  nlopt_optimize(optimizer.get(), start.data(), &best);
  if (calls.thrown) std::rethrow_exception(calls.thrown);
  return calls.done;
}

}  // namespace

int maximise_globally(std::vector<double> start, int evaluations, std::uint64_t seed, const Objective& objective,
                      const std::atomic<bool>& stop) {
  if (evaluations < 1) return 0;
  Calls calls{objective, stop, evaluations};
  const Optimizer optimizer = make_optimizer(NLOPT_GN_CRS2_LM, start.size(), calls);
  nlopt_srand(static_cast<unsigned long>(seed));  // of this thread
  return optimised(optimizer, start, calls);
}

int maximise_locally(std::vector<double> start, double step, int evaluations, const Objective& objective,
                     const std::atomic<bool>& stop) {
  if (evaluations < 1) return 0;
  Calls calls{objective, stop, evaluations};
  const Optimizer optimizer = make_optimizer(NLOPT_LN_SBPLX, start.size(), calls);
  constexpr double k_least_step = 1e-6;
  nlopt_set_initial_step1(optimizer.get(), step);
  nlopt_set_xtol_abs1(optimizer.get(), k_least_step);
  return optimised(optimizer, start, calls);
}

}  // namespace clusterbench::search
