#pragma once
// Oriented boxes (decals, probes) of a setting of the random search.

#include <cstdint>

#include "stress/trial.h"

namespace clusterbench::stress {

// Adds a few boxes to one setting in ten, after its lights: against cells' faces, edges and corners, on a lattice of
// steps of step_m, and anywhere out to far_m; also flat, sheared and mirrored ones. Uses a random source of its own, so
// that the rest of a seed's setting does not change. Throws Error if the camera can have no grid.
void add_random_boxes(Trial& trial, double far_m, double step_m, std::uint64_t seed);

}  // namespace clusterbench::stress
