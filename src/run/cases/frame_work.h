#pragma once
// How much work one frame of a scene is, and therefore how many frames a run measures if its work is limited.
// Everything follows from counts, never from times: a run measures the same frames on every machine.

#include <cstdint>
#include <span>
#include <vector>

#include "run/cases/path_frames.h"
#include "scene/camera_path.h"

namespace clusterbench::run {

// Number of lights that reach a point of the view: mean over some points of some of the path's frames. True pairs grow
// with it times the number of cells; the light loops of samples grow with it times the number of samples.
double lights_at_a_point(const PathFrames& path, std::uint64_t seed);

// Frames of each path: `most`, or fewer, so that all paths' frames times the lights that reach a point in them are at
// most `most_lights`, with a small minimum. Paths with one frame keep one.
int frames_within(int most, double most_lights, std::span<const scene::CameraPath> paths,
                  std::span<const double> lights_at_points);

// Approximate number of true pairs of a frame: per cell the lights that reach a point, plus one for the cell itself.
std::uint64_t true_pairs_about(std::uint64_t cells, double lights_at_a_point);

}  // namespace clusterbench::run
