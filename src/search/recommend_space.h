#pragma once
// What `recommend` searches where a configuration names no grids, assigners or storages of its own.

#include <nlohmann/json.hpp>

namespace clusterbench::search {

// Members of a configuration (config::load_config's `defaults`): grids of all kinds over the tile sizes, slicings and
// slice counts that engines use, with coarser and finer ones around them; the conservative methods that run where
// nothing is named, the fast form alone of those that have one, since its lists are the same; and all storages.
nlohmann::json recommend_space();

}  // namespace clusterbench::search
