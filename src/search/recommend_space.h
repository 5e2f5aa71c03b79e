#pragma once
// The search space of `recommend` for a configuration that names no grids, assigners or storages.

#include <nlohmann/json.hpp>

namespace clusterbench::search {

// Members of a configuration (config::load_config's `defaults`): grids of all kinds over the tile sizes, slicings and
// slice counts that engines use, with coarser and finer ones around them; the conservative methods that run by default,
// only in their fast form if there is one, since its lists are the same; and all storages.
nlohmann::json recommend_space();

}  // namespace clusterbench::search
