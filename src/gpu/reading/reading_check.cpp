#include "gpu/reading/reading_check.h"

#include <array>

namespace clusterbench::gpu {
namespace {

// As read.glsl has it.
std::uint32_t mixed_bits(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

struct WalkedLights {
  std::uint32_t count = 0, hash = 0;

  friend bool operator==(const WalkedLights&, const WalkedLights&) = default;
};

WalkedLights walked(const std::vector<std::uint32_t>& lights) {
  WalkedLights all;
  for (const std::uint32_t light : lights) {
    ++all.count;
    all.hash += mixed_bits(light + 1);
  }
  return all;
}

std::string place_text(const grid::Sample* sample, std::uint32_t invocation) {
  if (sample == nullptr) return "invocation " + std::to_string(invocation) + ", which has no sample,";
  return "the sample at pixel (" + std::to_string(sample->pixel_x) + ", " + std::to_string(sample->pixel_y) +
         "), depth " + std::to_string(-sample->view.z) + " m,";
}

std::vector<std::int32_t> cells_of_host(const ReadingStructure& structure, const ReadingSamples& samples) {
  std::vector<std::int32_t> cells;
  for (std::uint32_t i = 0; i < samples.invocations(); ++i) {
    const grid::Sample* sample = samples.sample_of(i);
    cells.push_back(sample == nullptr
                        ? -1
                        : static_cast<std::int32_t>(cell_on_host(structure.grid(), structure.looked_up(), *sample)));
  }
  return cells;
}

std::vector<std::int32_t> cells_of_device(ReadingStructure& structure, ReadingSamples& samples) {
  const std::vector<std::uint32_t> found = results_of({&structure, Walking::by_lane, ReadingOutput::cells}, samples);
  return {found.begin(), found.end()};
}

// Compares the invocations for which `is_compared` is true.
template <class IsCompared>
ReadingCheck compare(const ReadingStructure& structure, const ReadingSamples& samples,
                     const std::vector<std::uint32_t>& results, const IsCompared& is_compared) {
  ReadingCheck check;
  std::vector<std::uint32_t> lights;
  for (std::uint32_t i = 0; i < samples.invocations(); ++i) {
    if (!is_compared(i)) continue;
    const grid::Sample* sample = samples.sample_of(i);
    lights.clear();
    if (sample != nullptr) structure.on_host().lights_at(*sample, grid::Log2::rounded, lights);
    const WalkedLights expected = walked(lights), found{results[2 * std::size_t{i}], results[2 * std::size_t{i} + 1]};
    check.samples += sample != nullptr ? 1 : 0;
    check.lights += found.count;
    if (found == expected) continue;
    if (check.differing++ == 0)
      check.first = place_text(sample, i) + " walks " + std::to_string(found.count) + " lights; the structure has " +
                    std::to_string(expected.count) + (found.count == expected.count ? ", and they are others" : "");
  }
  return check;
}

}  // namespace

ReadingCheck check_walk(ReadingStructure& structure, ReadingSamples& samples, Walking walking) {
  // Where samples look up nothing there is no cell to be given, but an invocation without a sample must know it.
  samples.give_cells(cells_of_host(structure, samples));
  const auto results = results_of({&structure, walking, ReadingOutput::check}, samples, true);
  return compare(structure, samples, results, [](std::uint32_t) { return true; });
}

ReadingCheck check_own_lookup(ReadingStructure& structure, ReadingSamples& samples, Walking walking) {
  const std::vector<std::int32_t> on_host = cells_of_host(structure, samples);
  const std::vector<std::int32_t> on_device = cells_of_device(structure, samples);
  const auto results = results_of({&structure, walking, ReadingOutput::check}, samples);
  return compare(structure, samples, results, [&](std::uint32_t i) { return on_host[i] == on_device[i]; });
}

LookupDifferences check_lookup(ReadingStructure& structure, ReadingSamples& samples) {
  const std::vector<std::int32_t> on_host = cells_of_host(structure, samples);
  const std::vector<std::int32_t> on_device = cells_of_device(structure, samples);
  LookupDifferences all;
  for (std::uint32_t i = 0; i < samples.invocations(); ++i) {
    const grid::Sample* sample = samples.sample_of(i);
    all.samples += sample != nullptr ? 1 : 0;
    if (on_host[i] == on_device[i]) continue;
    ++all.differing;
    if (sample != nullptr &&
        may_find(structure.grid(), structure.looked_up(), *sample, on_device[i], device().facts().rounds_to_nearest))
      continue;
    if (all.unexplained++ == 0)
      all.first = place_text(sample, i) + " finds cell " + std::to_string(on_device[i]) + "; the host finds " +
                  std::to_string(on_host[i]);
  }
  return all;
}

}  // namespace clusterbench::gpu
