#pragma once
// What a search for the best clustering chooses among: the candidates of a scene in a viewport.

#include <cstdint>
#include <string>
#include <vector>

#include "run/cases/plan.h"

namespace clusterbench::search {

// A grid with a method and a storage: one case on each camera of a scene, in one viewport.
struct Candidate {
  std::string name;  // the case's, without scene and camera
  std::size_t grid = 0;
  std::uint64_t cells = 0;                  // of the grid; set when it is measured
  std::vector<const run::CasePlan*> cases;  // in the order of the cameras
  // Samples search its structure, whose cost comes only from a model: it competes with its kind, and is never chosen
  // while there are others.
  bool is_apart = false;
};

// One search: a scene in a viewport, with all its cameras.
struct View {
  std::size_t scene = 0, viewport = 0;
  std::vector<std::size_t> cameras;
  std::vector<std::size_t> blind;     // cameras that are left out: none of their frames has a shining light in view
  std::size_t frames = 0;             // of all cameras together
  std::vector<Candidate> candidates;  // by grid, known cost of the method without times, and name
  std::size_t incomplete = 0;         // left out, since not every camera can have their grid
};
// Refers to the plan.
std::vector<View> views_of(const config::Config& config, const run::Plan& plan);

}  // namespace clusterbench::search
