#pragma once
// Constants of the cost model (`cost` of a configuration, result::SetCost) from measured readings.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "assign/contract/light_structure.h"
#include "gpu/reading/reading_samples.h"

namespace clusterbench::gpu {

// What the samples of one reading do, by the structure on the host.
struct ReadingWork {
  std::uint64_t samples = 0, lights = 0, reads = 0, read_bytes = 0;
  // How much longer a wave takes whose lanes all wait for the longest list among them: the sum over the waves of their
  // longest list / that of their mean list; 1 without lights.
  double divergence = 1.0;
};
// `lanes`: invocations of a wave; 1: none waits for another.
ReadingWork work_of(const assign::LightStructure& structure, const ReadingSamples& samples, std::uint32_t lanes);

// A measured reading by lane: its time without that of reading nothing.
struct CostObservation {
  double ns = 0.0;
  ReadingWork work;
};

// One constant of the model.
struct FittedConstant {
  double value = 0.0;
  // How much of its column no combination of the other constants can explain: 0 .. 1. Near 0 the observations do not
  // tell it from the others, as where all structures read one index per light.
  double own_share = 0.0;

  static constexpr double k_least_share = 1e-3;
  bool is_determined() const { return own_share >= k_least_share; }
};

// The model: ns = divergence x (lights x ns_per_light + reads x ns_per_read + read_bytes x ns_per_byte), over all
// samples.
struct CostFit {
  FittedConstant ns_per_light, ns_per_read, ns_per_byte;  // none is negative
  std::vector<double> residuals;                          // (model - measured) / measured, in the observations' order
  double residual_rms = 0.0;

  // What `cost.read_gb_per_s` takes; +inf where bytes cost nothing.
  double read_gb_per_s() const;
  // Do the constants say something? False with fewer than three observations, or one that is not determined.
  bool is_determined() const;
};

// Least squares of the relative residuals, so that no large scene outweighs the others. Observations without time or
// lights are left out, with a residual of 0.
CostFit fit_cost(std::span<const CostObservation> observations);

}  // namespace clusterbench::gpu
