#pragma once
// A segment of a camera path in steps so small that hardly anything changes from one to the next.

#include "scene/camera_path.h"

namespace clusterbench::scene {

// The largest allowed step; all above 0.
struct FineSteps {
  int count = 1;
  double largest_move_m = 1e-3;    // of the eye
  double largest_turn_rad = 1e-4;  // of the view
};

struct FinePath {
  CameraPath path;        // one shot more than it has steps; `how` describes their source
  int from_shot = 0;      // index in the refined path
  bool is_drift = false;  // the camera stands still: it was moved artificially
  double move_m = 0.0;    // largest move of the eye in one step; 0 if only rounding moves it
  double turn_rad = 0.0;  // largest turn of the view in one step
};

// Begins at the shot after which the camera moves most, in terms of the two limits, and follows the path from there:
// between two shots position and time change evenly, the view turns evenly along the shortest arc. Ends after
// steps.count steps, or earlier if the path ends or the camera stands still. A camera that never moves drifts forward
// and turns to its right by both limits in every step, at the time of its first shot. The path has at least one shot.
FinePath fine_path(const CameraPath& path, const FineSteps& steps);

}  // namespace clusterbench::scene
