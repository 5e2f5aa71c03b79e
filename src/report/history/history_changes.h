#pragma once
// What an entry of a history has that the entries before it have not: lights, scenes, camera paths.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "report/history/history.h"

namespace clusterbench::report {

// nullptr if the entry has no such scene.
const HistoryLights* lights_of_scene(const HistoryEntry& entry, const std::string& scene);

// Scenes that a result of another commit has beside those of `entry`, and no result of this commit has: a missing scene
// cannot become worse. A job that adds one result per level has one scene in each, and misses none.
std::vector<std::string> missing_scenes(std::span<const HistoryEntry> before, std::span<const HistoryEntry> all,
                                        const HistoryEntry& entry);

// Changes of lights by `entry`, compared with the last results of each of its scenes before it.
std::vector<std::string> changed_lights(std::span<const HistoryEntry> before, const HistoryEntry& entry);

using EntryAt = std::function<const HistoryEntry&(std::size_t)>;

// Changes of paths by `entry`, compared with the last results of each of its cameras among the `before` entries before
// it. `heads` need no cases; only the entries that have a camera's scene are asked for as a whole.
std::vector<std::string> changed_paths(std::size_t before, const EntryAt& heads, const EntryAt& whole,
                                       const HistoryEntry& entry);

}  // namespace clusterbench::report
