#pragma once
// The pictures of a plan's cases: the lights that pixels get from the light structures of chosen frames.

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pictures/map_figures.h"
#include "run/cases/plan.h"

namespace clusterbench::pictures {

inline constexpr int k_longest_side = 960;  // of a map, if no divisor is requested
inline constexpr std::uint64_t k_most_pictures = 2000;

struct Request {
  enum class Frames : std::uint8_t { worst, first, listed };
  Frames frames = Frames::worst;     // the one with the longest list of the grid's cases
  std::vector<int> listed;           // ascending, each once
  std::vector<Kind> kinds;           // in the order of k_kind_names
  int divisor = 0;                   // one pixel per block of this many squared; 0: the smallest for k_longest_side
  std::optional<double> plane_m;     // pixels are at this depth instead of on visible surfaces
  std::optional<std::uint32_t> top;  // of the scale of lights

  bool wants(Kind kind) const;
};

// For a case: the length of its longest list, and the frame with it. Without cells 0, and the frame with most memory.
struct LongestList {
  std::uint64_t lights = 0;
  int frame = 0;
};
using LongestLists = std::map<std::string, LongestList>;  // by the case's id

// The triangles of scenes that are measured without them, for pictures of surfaces. For a scene whose meshes cannot be
// read it has a warning, and no triangle.
using Geometries = std::vector<std::optional<scene::Geometry>>;
Geometries load_geometries(const config::Config& config, const run::Plan& plan, const Request& request);

// Upper bound of the number of pictures. Throws Error (with the option) for frames that no path has.
std::uint64_t picture_count(const run::Plan& plan, const Request& request);

struct Picture {
  std::filesystem::path file;  // below the folder of pictures
  std::string png;
  Kind kind = Kind::lights;
  std::optional<int> frame;           // none: several
  std::vector<std::string> case_ids;  // the pictured cases
  std::string text;                   // its title and numbers
};

struct Listener {
  std::function<void(const Picture&)> on_picture;
  std::function<void(const std::string& group, double share)> on_progress;  // share of all pictures that are done
  std::function<void(const std::string& name, const std::string& reason)> on_skipped;
};

// All of them, group by group. The same for any number of threads. `stop` is checked between pictures.
void draw_pictures(const config::Config& config, const run::Plan& plan, const Geometries& geometries,
                   const Request& request, const LongestLists& longest, const Listener& listener,
                   const std::atomic<bool>& stop);

}  // namespace clusterbench::pictures
