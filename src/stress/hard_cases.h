#pragma once
// The hard cases for numerical stability, H1 to H35 (H31, the search, has a file of its own). Each is a set of trials
// on which a conservative assigner must lose nothing, and of checks of the tool itself.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stress/trial.h"

namespace clusterbench::stress {

inline constexpr double k_degree = 3.14159265358979323846 / 180.0;  // in radians

// A check of the tool that does not depend on the assigner.
struct ToolCheck {
  std::string what;
  bool passed = false;
  std::string detail;  // figures
};

struct HardCase {
  const char* id;
  const char* title;
  std::vector<Trial> (*trials)(std::uint64_t seed);      // nullptr: none
  std::vector<ToolCheck> (*checks)(std::uint64_t seed);  // nullptr: none
};

std::span<const HardCase> hard_cases();

// The methods that such checks look at: all that run on the processor. A device may be slow, or not there.
std::vector<const assign::AssignerDescriptor*> checked_methods();

// By theme, each in its own file.
std::vector<HardCase> depth_cases();       // H1 to H9
std::vector<HardCase> projection_cases();  // H10 to H18
std::vector<HardCase> shape_cases();       // H19 to H22, H27, H28, H30, H32
std::vector<HardCase> list_cases();        // H23 to H26, H29
std::vector<HardCase> map_cases();         // H33 to H35

}  // namespace clusterbench::stress
