#pragma once
// The long form of a configuration: without short forms and patterns, with all defaults.

#include <nlohmann/json.hpp>

#include "config/schema/json_text.h"

namespace clusterbench::config {

// Whether it names grids, assigners or storages: a product of its own, beside presets.
bool names_own_clusterings(const nlohmann::json& document);
void drop_own_clusterings(nlohmann::json& document);

// Fills in defaults and expands short forms, those of the defaults as well. Presets alone have no default clusterings
// beside them. Throws Error.
nlohmann::json filled(const JsonText& text);

}  // namespace clusterbench::config
