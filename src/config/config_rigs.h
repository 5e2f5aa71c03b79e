#pragma once
// Rigs of a configuration: axes expanded into their product.

#include <nlohmann/json.hpp>
#include <vector>

#include "scene/rig.h"

namespace clusterbench::config {

// `rig` has its defaults filled in.
std::vector<scene::RigSpec> rig_specs(const nlohmann::json& rig);

}  // namespace clusterbench::config
