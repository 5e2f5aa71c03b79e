#include "measure/samples/coherence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace clusterbench::measure {
namespace {

constexpr int k_block = 8;

using List = std::vector<std::uint32_t>;

double quotient(double above, double below) {
  return below > 0.0 ? above / below : std::numeric_limits<double>::quiet_NaN();
}

// Counts the distinct lights of all lists that were added since the last start().
class Union {
 public:
  void start() { ++now_; }
  std::uint64_t add(const List& list) {
    std::uint64_t added = 0;
    for (const std::uint32_t light : list) {
      if (light >= seen_.size()) seen_.resize(light + std::size_t{1}, 0);
      added += seen_[light] == now_ ? 0 : 1;
      seen_[light] = now_;
    }
    return added;
  }

 private:
  std::vector<std::uint64_t> seen_;
  std::uint64_t now_ = 0;
};

void add_wave(WaveCounts& counts, std::vector<const List*>& lanes, Union& lights) {
  if (lanes.empty()) return;
  std::uint64_t entries = 0, longest = 0;
  lights.start();
  for (const List* list : lanes) {
    entries += list->size();
    longest = std::max<std::uint64_t>(longest, list->size());
    counts.united += lights.add(*list);
  }
  std::ranges::sort(lanes, [](const List* a, const List* b) { return *a < *b; });
  std::uint64_t distinct = 1;
  for (std::size_t i = 1; i < lanes.size(); ++i) distinct += *lanes[i] == *lanes[i - 1] ? 0 : 1;
  ++counts.waves;
  counts.distinct_lists += distinct;
  counts.most_distinct = std::max(counts.most_distinct, distinct);
  counts.longest += longest;
  counts.mean += static_cast<double>(entries) / static_cast<double>(lanes.size());
}

// Index of the sample of each pixel; k_none for a pixel without a surface.
constexpr std::uint32_t k_none = std::numeric_limits<std::uint32_t>::max();
std::vector<std::uint32_t> samples_of_pixels(const depth::DepthImage& image) {
  std::vector<std::uint32_t> out;
  out.reserve(image.nearest.size());
  std::uint32_t next = 0;
  for (const float depth : image.nearest) out.push_back(std::isfinite(depth) ? next++ : k_none);
  return out;
}

}  // namespace

double WaveCounts::divergence() const {
  return quotient(static_cast<double>(longest), mean);
}

double WaveCounts::scalarised() const {
  return quotient(static_cast<double>(united), mean);
}

double WaveCounts::mean_distinct() const {
  return quotient(static_cast<double>(distinct_lists), static_cast<double>(waves));
}

void add_frame(Coherence& coherence, const depth::DepthImage& image, std::span<const grid::Sample> samples,
               const assign::LightStructure& structure) {
  const Vec2i size = image.pixels.size;
  const std::vector<std::uint32_t> sample_of_pixel = samples_of_pixels(image);
  std::array<List, k_block * k_block> lists;
  std::array<bool, k_block * k_block> shows{};
  std::vector<const List*> lanes;
  Union lights;
  for (int top = 0; top < size.y; top += k_block) {
    for (int left = 0; left < size.x; left += k_block) {
      for (int lane = 0; lane < k_block * k_block; ++lane) {
        const int x = left + lane % k_block, y = top + lane / k_block;
        const bool is_inside = x < size.x && y < size.y;
        const std::uint32_t sample =
            is_inside ? sample_of_pixel[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                                        static_cast<std::size_t>(x)]
                      : k_none;
        const auto at = static_cast<std::size_t>(lane);
        shows[at] = sample != k_none;
        if (shows[at]) structure.lights_at(samples[sample], grid::Log2::rounded, lists[at]);
      }
      for (WaveCounts& counts : coherence.sizes) {
        const auto lanes_of_wave = static_cast<std::size_t>(counts.lanes());
        for (std::size_t first = 0; first < lists.size(); first += lanes_of_wave) {
          lanes.clear();
          for (std::size_t at = first; at < first + lanes_of_wave; ++at)
            if (shows[at]) lanes.push_back(&lists[at]);
          add_wave(counts, lanes, lights);
        }
      }
    }
  }
}

}  // namespace clusterbench::measure
