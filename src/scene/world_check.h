#pragma once
// Valid numbers of nodes can multiply to infinity down the tree.

#include <optional>

#include "scene/scene.h"

namespace clusterbench::scene {

// The first node whose world transform at the first moment is not finite. Needs less memory than all transforms.
std::optional<std::size_t> first_node_without_place(const Scene& scene);

}  // namespace clusterbench::scene
