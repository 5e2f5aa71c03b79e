#pragma once
// The camera of a dump, from an engine's matrices with their conventions.

#include <string>
#include <vector>

#include "result/documents/dump.h"
#include "view/frame.h"

namespace clusterbench::dump {

struct Camera {
  view::Space view_space;
  view::Projection projection;
  // The engine's world or view space is left-handed. Then z of all that is in the world changes its sign, so that
  // view_space stays a rotation.
  bool is_world_mirrored = false;
};

// Whether a dump's camera has numbers of its own; otherwise it is one of a scene.
bool has_matrices(const result::DumpCamera& camera);

// `lights_in_view_space`: then the world is view space, and no view matrix is needed. Throws Error ("", JSON pointer)
// for a singular or scaled view matrix, a projection that is none, and for what is missing; where other words on the
// same numbers give a camera, it names them.
Camera camera_of(const result::DumpCamera& camera, bool lights_in_view_space);

// --- Parts of it, for other words on the same numbers (camera_words.cpp) ---

// The same, without looking for other words.
Camera bare_camera_of(const result::DumpCamera& camera, bool lights_in_view_space);

// The numbers of a camera under other words: order, depth, forward, clip_y, or with one matrix alone transposed.
struct CameraWords {
  result::DumpCamera camera;
  std::vector<std::string> changes;  // "camera.order 'rows'"
  bool is_transposed = false;        // a matrix is read the other way round
};

// All under which they are another camera, those with the fewest changes first. None gives a camera twice, or that of
// the given words.
std::vector<CameraWords> other_camera_words(const result::DumpCamera& camera, bool lights_in_view_space);

}  // namespace clusterbench::dump
