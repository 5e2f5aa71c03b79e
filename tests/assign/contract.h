#pragma once
// What holds for every assigner, given its row: checked for the registered ones, and for those that a test defines.

#include <string>
#include <vector>

#include "assign/assigner.h"
#include "grid/grid.h"
#include "view/frame.h"

namespace clusterbench::assign::testing {

// A grid with the frame that it is seen in; the frame's lights are what the contract is checked with.
struct Setting {
  struct Touch {
    std::uint32_t cell, light;
  };

  std::string name;
  view::Frame frame;
  grid::Grid grid;
  std::vector<Touch> touches;  // true pairs by a hair
};

// Every grid kind that the row takes, in perspective, off-centre and (where the row allows it) orthographic views, with
// random lights, lights that touch cells from outside by a hair, the eye in lights, lights behind the eye, lights
// without volume and without end.
std::vector<Setting> settings_for(const AssignerRow& row, std::uint64_t seed);

// The row's defaults, and each choice of each text parameter.
std::vector<Params> params_of(const AssignerRow& row);

// Sentences about what is broken; none: the contract holds. Checked: the form of the lists, holes, lights without
// volume, that nothing depends on what came before, that no light is lost (if the row says so), and that a steady frame
// does not allocate.
std::vector<std::string> contract_faults(const AssignerRow& row, const Params& params, const Setting& setting);

}  // namespace clusterbench::assign::testing
