#include "gpu/reading/cost_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clusterbench::gpu {
namespace {

constexpr std::size_t k_constants = 3;
using Row = std::array<double, k_constants>;  // of an observation: what a nanosecond of each constant adds, relative to
                                              // its time
using Constants = std::array<double, k_constants>;

bool is_usable(const CostObservation& one) {
  return one.ns > 0.0 && one.work.lights + one.work.reads > 0;
}

Row row_of(const CostObservation& one) {
  const double factor = one.work.divergence / one.ns;
  return {static_cast<double>(one.work.lights) * factor, static_cast<double>(one.work.reads) * factor,
          static_cast<double>(one.work.read_bytes) * factor};
}

// The constants of `used` that bring the sum of their columns nearest to `target`; the others are 0. By Gram and
// Schmidt, which needs no squares of small differences.
Constants solve(const std::vector<Row>& rows, const std::vector<double>& target, unsigned used) {
  std::vector<std::vector<double>> directions;
  std::array<Constants, k_constants> in_columns{};  // each direction as a sum of columns
  std::vector<double> left = target;
  Constants found{};
  for (std::size_t column = 0; column < k_constants; ++column) {
    if ((used >> column & 1u) == 0) continue;
    std::vector<double> direction;
    double size = 0.0;
    for (const Row& row : rows) {
      direction.push_back(row[column]);
      size += row[column] * row[column];
    }
    Constants sum{};
    sum[column] = 1.0;
    for (int again = 0; again < 2; ++again)
      for (std::size_t d = 0; d < directions.size(); ++d) {
        double along = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i) along += direction[i] * directions[d][i];
        for (std::size_t i = 0; i < rows.size(); ++i) direction[i] -= along * directions[d][i];
        for (std::size_t c = 0; c < k_constants; ++c) sum[c] -= along * in_columns[d][c];
      }
    double rest = 0.0;
    for (const double value : direction) rest += value * value;
    if (!(rest > 1e-20 * size)) continue;  // nothing of its own
    const double length = std::sqrt(rest);
    double along = 0.0;
    for (std::size_t i = 0; i < rows.size(); ++i) along += left[i] * (direction[i] /= length);
    for (std::size_t i = 0; i < rows.size(); ++i) left[i] -= along * direction[i];
    for (std::size_t c = 0; c < k_constants; ++c) found[c] += along * (sum[c] /= length);
    in_columns[directions.size()] = sum;
    directions.push_back(std::move(direction));
  }
  return found;
}

double squares_of(const std::vector<Row>& rows, const std::vector<double>& target, const Constants& constants) {
  double squares = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double rest = -target[i];
    for (std::size_t c = 0; c < k_constants; ++c) rest += rows[i][c] * constants[c];
    squares += rest * rest;
  }
  return squares;
}

// The best constants of which none is negative: of all choices of constants that are not 0.
Constants best_constants(const std::vector<Row>& rows) {
  const std::vector<double> target(rows.size(), 1.0);
  Constants best{};
  double least = squares_of(rows, target, best);
  for (unsigned used = 1; used < 1u << k_constants; ++used) {
    const Constants found = solve(rows, target, used);
    if (std::ranges::any_of(found, [](double value) { return !(value >= 0.0); })) continue;
    const double squares = squares_of(rows, target, found);
    if (squares < least) {
      least = squares;
      best = found;
    }
  }
  return best;
}

double own_share_of(const std::vector<Row>& rows, std::size_t column) {
  std::vector<double> target;
  for (const Row& row : rows) target.push_back(row[column]);
  const double all = squares_of(rows, target, {});
  if (!(all > 0.0)) return 0.0;
  return std::sqrt(squares_of(rows, target, solve(rows, target, 7u & ~(1u << column))) / all);
}

}  // namespace

ReadingWork work_of(const assign::LightStructure& structure, const ReadingSamples& samples, std::uint32_t lanes) {
  ReadingWork work;
  std::vector<std::uint32_t> lights;
  double longest_sum = 0.0, mean_sum = 0.0;
  for (std::uint32_t first = 0; first < samples.invocations(); first += lanes) {
    std::uint64_t longest = 0, sum = 0, count = 0;
    for (std::uint32_t i = first; i < std::min(first + lanes, samples.invocations()); ++i) {
      const grid::Sample* sample = samples.sample_of(i);
      if (sample == nullptr) continue;
      lights.clear();
      structure.lights_at(*sample, grid::Log2::rounded, lights);
      const assign::Reads reads = structure.reads_at(*sample, grid::Log2::rounded);
      work.reads += reads.elements;
      work.read_bytes += reads.bytes;
      longest = std::max<std::uint64_t>(longest, lights.size());
      sum += lights.size();
      ++count;
    }
    if (count == 0) continue;
    work.samples += count;
    work.lights += sum;
    longest_sum += static_cast<double>(longest);
    mean_sum += static_cast<double>(sum) / static_cast<double>(count);
  }
  if (mean_sum > 0.0) work.divergence = longest_sum / mean_sum;
  return work;
}

double CostFit::read_gb_per_s() const {
  return ns_per_byte.value > 0.0 ? 1.0 / ns_per_byte.value : std::numeric_limits<double>::infinity();
}

bool CostFit::is_determined() const {
  return residuals.size() >= k_constants && ns_per_light.is_determined() && ns_per_read.is_determined() &&
         ns_per_byte.is_determined();
}

CostFit fit_cost(std::span<const CostObservation> observations) {
  std::vector<Row> rows;
  for (const CostObservation& one : observations)
    if (is_usable(one)) rows.push_back(row_of(one));
  const Constants constants = best_constants(rows);
  CostFit fit;
  FittedConstant* fitted[k_constants] = {&fit.ns_per_light, &fit.ns_per_read, &fit.ns_per_byte};
  for (std::size_t c = 0; c < k_constants; ++c) *fitted[c] = {constants[c], own_share_of(rows, c)};
  double squares = 0.0;
  for (const CostObservation& one : observations) {
    double model = 0.0;
    if (is_usable(one))
      for (std::size_t c = 0; c < k_constants; ++c) model += row_of(one)[c] * constants[c];
    fit.residuals.push_back(is_usable(one) ? model - 1.0 : 0.0);
    squares += fit.residuals.back() * fit.residuals.back();
  }
  if (!rows.empty()) fit.residual_rms = std::sqrt(squares / static_cast<double>(rows.size()));
  return fit;
}

}  // namespace clusterbench::gpu
