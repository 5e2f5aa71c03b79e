#pragma once
// Oriented boxes (decals, probes) of a setting of the random search.

#include <cstdint>

#include "stress/trial.h"

namespace clusterbench::stress {

// Adds a few to one setting in ten, behind its lights: laid against cells' faces, edges and corners, on a lattice of
// steps of step_m, and anywhere out to far_m; flat, sheared and mirrored ones, too. From a source of their own, so that
// all else of a seed's setting is what it was without. Throws Error where the camera can have no grid.
void add_random_boxes(Trial& trial, double far_m, double step_m, std::uint64_t seed);

}  // namespace clusterbench::stress
