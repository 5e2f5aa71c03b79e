#pragma once
// --images DIR: pictures of a run's cases, as files.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line/command.h"
#include "cli/output/output_folder.h"
#include "cli/output/progress_line.h"
#include "os/terminal.h"
#include "pictures/pictures.h"
#include "result/result.h"

namespace clusterbench::cli {

struct ImageFlags {
  std::string folder;  // "": no pictures
  std::string frames = "worst";
  std::vector<std::string> kinds;
  int divisor = 0;
  double plane_m = 0.0;     // 0: visible surfaces
  std::uint64_t scale = 0;  // 0: derived from the counts
};

void add_image_options(Command& command, ImageFlags& flags);

// The requested pictures, checked before anything is measured.
class PictureFiles {
 public:
  // Throws Error for an unknown frame or kind, for more pictures than pictures::k_most_pictures, for a folder that
  // cannot be created or written to, and for triangles that cannot be read. `inputs`: files that no picture may
  // replace.
  PictureFiles(const ImageFlags& flags, const config::Config& config, const run::Plan& plan,
               std::vector<std::string> inputs);

  // The file that lists the pictures.
  static std::string index_path(const std::string& folder);

  // Makes the pictures of the run's result. A picture of the same name is replaced. False if stopped before the end.
  bool write(const result::Result& result, os::Terminal screen, bool quiet, const std::atomic<bool>& stop) const;

 private:
  void write_picture(const std::filesystem::path& file, const std::string& bytes) const;

  const config::Config& config_;
  const run::Plan& plan_;
  std::string folder_;
  std::optional<OutputFolder> made_;
  std::vector<std::string> inputs_;
  pictures::Request request_;
  pictures::Geometries geometries_;
};

}  // namespace clusterbench::cli
