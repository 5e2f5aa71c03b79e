#pragma once
// --images DIR: pictures of a run's cases, as files.

#include <atomic>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/command.h"
#include "cli/terminal.h"
#include "pictures/pictures.h"

namespace clusterbench::cli {

struct ImageFlags {
  std::string folder;  // "": no pictures
  std::string frames = "worst";
  std::vector<std::string> kinds;
  int divisor = 0;
  double plane_m = 0.0;     // 0: what is visible
  std::uint64_t scale = 0;  // 0: by the counts
};

void add_image_options(Command& command, ImageFlags& flags);

// Pictures that are asked for, checked before anything is measured.
class PictureFiles {
 public:
  // Throws Error for what is no frame or kind, for more pictures than pictures::k_most_pictures, for a folder that
  // cannot be made or written to, and for triangles that cannot be read.
  PictureFiles(const ImageFlags& flags, const config::Config& config, const run::Plan& plan);

  // Makes them, of what the run has found. A picture of the same name is replaced. False if stopped before the end.
  bool write(const nlohmann::ordered_json& result, Terminal screen, bool quiet, const std::atomic<bool>& stop) const;

 private:
  const config::Config& config_;
  const run::Plan& plan_;
  std::string folder_;
  pictures::Request request_;
  pictures::Geometries geometries_;
};

}  // namespace clusterbench::cli
