#pragma once
// Lists to store, and what stores them.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "assign/contract/storage.h"
#include "core/random.h"

namespace clusterbench::assign {

using Ids = std::vector<std::uint32_t>;

inline Lists lists_from(const std::vector<Ids>& cells) {
  Lists lists;
  lists.begin.push_back(0);
  for (const Ids& cell : cells) {
    lists.lights.insert(lists.lights.end(), cell.begin(), cell.end());
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

inline Lists random_lists(std::uint32_t cells, std::uint32_t lights, double share, std::uint64_t seed) {
  SplitMix64 random(seed);
  std::vector<Ids> all(cells);
  for (Ids& cell : all)
    for (std::uint32_t light = 0; light < lights; ++light)
      if (random.unit() < share) cell.push_back(light);
  return lists_from(all);
}

inline std::unique_ptr<Storage> storage(const std::string& name, const std::map<std::string, ParamValue>& params = {}) {
  const StorageDescriptor* row = find_storage(name);
  return row->make(Params(row->params, params));
}

// Points before spots, each type's lights in any order.
inline Lists shuffled(Lists lists, std::uint32_t points, std::uint64_t seed) {
  SplitMix64 random(seed);
  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
    for (std::uint32_t i = lists.begin[cell]; i < lists.begin[cell + 1]; ++i) {
      const std::uint32_t other = i + static_cast<std::uint32_t>(random.below(lists.begin[cell + 1] - i));
      if ((lists.lights[i] < points) == (lists.lights[other] < points)) std::swap(lists.lights[i], lists.lights[other]);
    }
  return lists;
}

}  // namespace clusterbench::assign
