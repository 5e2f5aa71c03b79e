#include "pictures/pixel_maps.h"

#include <algorithm>
#include <map>
#include <span>

#include "core/memory.h"
#include "core/parallel.h"

namespace clusterbench::pictures {
namespace {

// As in a shader's lookup: see measure::add_samples.
bool sorted_lights_at(const assign::LightStructure& structure, const grid::Sample& sample,
                      std::vector<std::uint32_t>& given) {
  const bool is_answered = structure.lights_at(sample, grid::Log2::rounded, given);
  if (!std::is_sorted(given.begin(), given.end())) std::sort(given.begin(), given.end());
  return is_answered;
}

class Filler {
 public:
  Filler(const Surface& surface, const NeededAt& needed, std::uint32_t first_spot,
         const assign::LightStructure& structure, PixelMaps& maps)
      : surface_(surface), needed_(needed), first_spot_(first_spot), structure_(structure), maps_(maps) {}

  void fill_part(std::size_t part) {
    const assign::Lists& needed = needed_.part(part);
    for (std::uint32_t i = 0; i < needed.cell_count(); ++i) fill(part * NeededAt::k_part + i, needed.of(i));
  }

 private:
  void fill(std::size_t sample, std::span<const std::uint32_t> needed) {
    const std::size_t pixel = surface_.pixel_of_sample[sample];
    const bool is_answered = sorted_lights_at(structure_, surface_.samples[sample], given_);
    maps_.state[pixel] = is_answered ? PixelMaps::State::answered : PixelMaps::State::no_answer;
    std::uint32_t found = 0;
    for (const std::uint32_t light : needed) found += std::binary_search(given_.begin(), given_.end(), light) ? 1 : 0;
    const auto all = static_cast<std::uint32_t>(given_.size());
    const auto points =
        static_cast<std::uint32_t>(std::lower_bound(given_.begin(), given_.end(), first_spot_) - given_.begin());
    maps_.points[pixel] = points;
    maps_.spots[pixel] = all - points;
    maps_.false_positives[pixel] = all - found;
    maps_.missed[pixel] = static_cast<std::uint32_t>(needed.size()) - found;
  }

  const Surface& surface_;
  const NeededAt& needed_;
  std::uint32_t first_spot_;
  const assign::LightStructure& structure_;
  PixelMaps& maps_;
  std::vector<std::uint32_t> given_;
};

void add_totals(PixelMaps& maps) {
  for (std::size_t i = 0; i < maps.state.size(); ++i) {
    if (maps.state[i] == PixelMaps::State::no_surface) continue;
    ++maps.surfaces;
    maps.unanswered += maps.state[i] == PixelMaps::State::no_answer ? 1 : 0;
    maps.points_total += maps.points[i];
    maps.spots_total += maps.spots[i];
    maps.lights_total.add(i, maps.lights(i));
    maps.false_positives_total.add(i, maps.false_positives[i]);
    maps.missed_total.add(i, maps.missed[i]);
  }
}

}  // namespace

void MapTotals::add(std::size_t pixel, std::uint32_t count) {
  sum += count;
  pixels += count > 0 ? 1 : 0;
  if (count <= most) return;
  most = count;
  most_at = pixel;
}

std::uint32_t usual_most(const PixelMaps& maps, const std::function<std::uint32_t(std::size_t pixel)>& count) {
  constexpr std::size_t k_exceeded_by_one_of = 100;
  constexpr std::uint32_t k_least_share = 3;
  std::vector<std::uint32_t> counts;
  counts.reserve(maps.surfaces);
  for (std::size_t i = 0; i < maps.state.size(); ++i)
    if (maps.state[i] != PixelMaps::State::no_surface) counts.push_back(count(i));
  if (counts.empty()) return 0;
  const std::uint32_t most = *std::max_element(counts.begin(), counts.end());
  const auto at = counts.end() - 1 - static_cast<std::ptrdiff_t>(counts.size() / k_exceeded_by_one_of);
  std::nth_element(counts.begin(), at, counts.end());
  return std::max(*at, (most + k_least_share - 1) / k_least_share);
}

PixelMaps pixel_maps(const Surface& surface, const NeededAt& needed, std::uint32_t first_spot,
                     const assign::LightStructure& structure, int threads) {
  const std::size_t pixels = surface.image.nearest.size();
  check_memory("pixels of a picture", pixels, 4 * sizeof(std::uint32_t), k_smaller_picture);
  PixelMaps maps;
  maps.state.resize(pixels, PixelMaps::State::no_surface);
  for (std::vector<std::uint32_t>* map : {&maps.points, &maps.spots, &maps.false_positives, &maps.missed})
    map->resize(pixels, 0);
  parallel_ranges(needed.parts(), threads, [&](std::size_t begin, std::size_t end) {
    Filler filler(surface, needed, first_spot, structure, maps);
    for (std::size_t part = begin; part < end; ++part) filler.fill_part(part);
  });
  add_totals(maps);
  return maps;
}

ListMap list_map(const Surface& surface, const assign::LightStructure& structure) {
  ListMap out;
  out.list.resize(surface.image.nearest.size(), 0);
  std::map<std::vector<std::uint32_t>, std::uint32_t> numbers;
  std::vector<std::uint64_t> pixels{0};
  std::vector<std::uint32_t> given, before;
  std::uint32_t number = 0;
  std::uint64_t entries = 0;
  for (std::size_t i = 0; i < surface.samples.size(); ++i) {
    sorted_lights_at(structure, surface.samples[i], given);
    if (given != before || i == 0) {
      before = given;
      number = 0;
      if (!given.empty()) {
        const auto [found, is_new] = numbers.try_emplace(given, static_cast<std::uint32_t>(pixels.size()));
        number = found->second;
        if (is_new) {
          pixels.push_back(0);
          entries += given.size();
          check_memory("lights of distinct lists", entries, sizeof(std::uint32_t), k_smaller_picture);
        }
      }
    }
    out.list[surface.pixel_of_sample[i]] = number;
    ++pixels[number];
  }
  out.lists = static_cast<std::uint32_t>(pixels.size() - 1);
  pixels[0] = 0;
  out.most_pixels = *std::max_element(pixels.begin(), pixels.end());
  return out;
}

}  // namespace clusterbench::pictures
