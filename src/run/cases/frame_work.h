#pragma once
// How much work one frame of a scene is, and so how many frames a run takes where it was asked for no more work than
// so much. Everything follows from counts, never from times: a run takes the same frames on every machine.

#include <cstdint>
#include <span>
#include <vector>

#include "scene/camera_path.h"
#include "scene/scene.h"

namespace clusterbench::run {

// Lights that reach a point of the view, on average over some points of some of the path's frames. True pairs grow with
// it times the number of cells, and what samples loop over grows with it times their number.
double lights_at_a_point(const scene::Scene& scene, const scene::CameraPath& path, Vec2i viewport, std::uint64_t seed);

// Frames of each path: `most`, or fewer, so that all paths' frames times the lights that reach a point in them are at
// most `most_lights`; but a few in any case. Paths of one frame have one.
int frames_within(int most, double most_lights, std::span<const scene::CameraPath> paths,
                  std::span<const double> lights_at_points);

// About how many true pairs a frame has: in each cell the lights that reach a point, and the cell itself.
std::uint64_t true_pairs_about(std::uint64_t cells, double lights_at_a_point);

}  // namespace clusterbench::run
