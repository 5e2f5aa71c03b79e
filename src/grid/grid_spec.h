#pragma once
// The configuration of a grid, and the further inputs from which it is made.

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "grid/reaction.h"
#include "grid/slicing.h"
#include "grid/tiling.h"
#include "view/frame.h"

namespace clusterbench::grid {

enum class Kind : std::uint8_t { frustum, distance, cascades, world };
inline constexpr int k_kind_count = 4;
const char* kind_name(Kind kind);
// The keys of a kind's request in a configuration.
std::span<const char* const> kind_keys(Kind kind);

// The object that the box of a world grid follows from frame to frame. camera: the eye, in whole cells (Just Cause 2).
// lights: the box around the lights in view (PlayCanvas).
enum class Follow : std::uint8_t { nothing, camera, lights };
// "camera", "lights"; "" for nothing.
const char* name_of(Follow follow);

// The fields of one kind are used.
struct GridSpec {
  Kind kind = Kind::frustum;
  Tiling tiles;             // frustum, distance
  Slicing slices;           // frustum, distance
  Vec3i cells{64, 16, 64};  // world, cascades
  int levels = 5;           // cascades
  double finest_m = 0.5;    // cascades
  bool has_bounds = false;  // world; without: the box around all lights' balls over the path
  Vec3d bounds_lo_m{0.0}, bounds_hi_m{0.0};
  Follow follow = Follow::nothing;  // world
  // world that follows the camera; 0: does not along this axis, which uses the bounds
  Vec3d cell_size_m{4.0, 0.0, 4.0};
  std::optional<Reaction> reaction = {};  // frustum, distance

  // Whether its cells are tiles of the picture, cut by depth or distance; otherwise they are boxes.
  bool has_tiles() const { return kind == Kind::frustum || kind == Kind::distance; }
  // Whether its number of cells depends on the projection: tiles from slices, or slices from tiles.
  bool has_cell_shape() const {
    return has_tiles() &&
           (tiles.aspect > 0.0 || slices.scheme == Scheme::cubical || slices.scheme == Scheme::cubical_first);
  }
  // The same grid with slices that do not follow the needed span.
  GridSpec unfitted() const;
  // The same grid with the requested tiles in all frames.
  GridSpec unreacting() const;
  bool follows_camera(int axis) const { return follow == Follow::camera && cell_size_m[axis] > 0.0; }
  // "frustum 64px x 16 exponential-first 0.1..5..500": unique among specs that differ, used in case names.
  std::string name() const;
};

// A grid is rebuilt only when these change; `fit` slices and a far that is not given depend on the lights in view.
struct GridInputs {
  view::Projection projection;
  Vec2i viewport{0, 0};
  double light_near_m = 0.0, light_far_m = 0.0;  // reach of the lights in view of this frame, as depth (or distance)
  // box around the bounded lights over the whole path, or around those that the grid follows
  Vec3d rig_lo_m{0.0}, rig_hi_m{0.0};
  Vec3d camera_cell{0.0};  // whole numbers: the cell that contains the eye, for cells that follow the camera
  Span needed;             // for slices with `fit`
  // Of the path's first frame, if the number of cells depends on it: so the number is the same in every frame.
  std::optional<view::Projection> shape = {};
  // For tiles that react: the tiles of this frame.
  std::optional<Tiling> tiles = {};

  friend bool operator==(const GridInputs&, const GridInputs&) = default;
};

// The sources of a frame's inputs.
struct FrameReach {
  const view::Frame& frame;
  double path_far_m;                          // the farthest light reach over the whole path (used if no far is given)
  Vec3d rig_lo_m, rig_hi_m;                   // box around the bounded lights over the whole path
  const depth::DepthImage* depths = nullptr;  // for a fit to surfaces
};

// The shortest text for names that identifies the number.
std::string number_name(double value);
// For messages: "0.1 m", "1e+300 m".
std::string metres(double value);
// "64x16x64"
std::string cells_name(Vec3i cells);

}  // namespace clusterbench::grid
