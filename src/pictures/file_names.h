#pragma once
// Paths of a case's pictures: SCENE/CAMERA/GRID/KIND-frame-NUMBER-METHOD-STORAGE.png, so that a folder shows methods
// side by side.

#include <filesystem>
#include <set>
#include <string>

#include "pictures/map_figures.h"

namespace clusterbench::pictures {

// A part of a case's name as a file name: characters with a meaning in a shell or file system become '-', and it has at
// most 80 bytes.
std::string file_part(std::string_view text);

class FileNames {
 public:
  // A case is "scene/camera/grid/method/storage", and the precision if it is not float32. All paths differ.
  std::filesystem::path of_case(const std::string& case_name, Kind kind, int frame);
  std::filesystem::path of_strip(const std::string& case_name);
  // For all cases with this camera; `viewport`: "" or "-1920x1080" if there are several.
  std::filesystem::path of_depth(const std::string& case_name, const std::string& viewport, int frame);

 private:
  std::filesystem::path unique(const std::string& case_name, const std::string& begin);
  std::filesystem::path unique(const std::filesystem::path& stem);

  std::set<std::string> used_;
};

}  // namespace clusterbench::pictures
