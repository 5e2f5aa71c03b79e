#pragma once
// The scenes, one function each; `lights` is the number to make.

#include "scene/generators/stage.h"

namespace clusterbench::scene {

void build_hall(Stage& stage, int lights, double range_m);
void build_open_world(Stage& stage, int lights);
void build_street(Stage& stage, int lights);
void build_jam(Stage& stage, int lights);
void build_mirror(Stage& stage, int lights);
void build_outlier(Stage& stage, int lights);
void build_steps(Stage& stage, int lights);
void build_slope(Stage& stage, int lights);
void build_mix(Stage& stage, int lights);
void build_rooms(Stage& stage, int lights);                      // and boxes
void build_lattice(Stage& stage, int lights, const Vec3d& off);  // off: offset of all lights

}  // namespace clusterbench::scene
