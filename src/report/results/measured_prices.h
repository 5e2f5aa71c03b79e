#pragma once
// Prices for the cost model (config.cost) from the readings of a result.

#include <string>

#include "result/result.h"

namespace clusterbench::report {

struct MeasuredPrices {
  double ns_per_light = 0.0, ns_per_read = 0.0, read_gb_per_s = 0.0;
  std::string device;
  std::size_t readings = 0;  // that the prices are fitted to
  double error_rms = 0.0;    // of the model at these readings, relative

  std::string text() const;  // one line
};

// Throws Error, with `path` as its file, for a result without readings lane by lane, with those of several devices or
// of a software device, and where the readings do not tell the three prices apart.
MeasuredPrices measured_prices(const result::Result& result, const std::string& path);

}  // namespace clusterbench::report
