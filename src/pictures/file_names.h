#pragma once
// Where the pictures of a case go: SCENE/CAMERA/GRID/KIND-frame-NUMBER-METHOD-STORAGE.png, so that a folder shows
// methods side by side.

#include <filesystem>
#include <set>
#include <string>

#include "pictures/map_figures.h"

namespace clusterbench::pictures {

// A part of a case's name as a file's: what a shell or a file system would read otherwise becomes '-', and no more than
// 80 bytes of it.
std::string file_part(std::string_view text);

class FileNames {
 public:
  // A case is "scene/camera/grid/method/storage", and the precision where it is not float32. No two are equal.
  std::filesystem::path of_case(const std::string& case_name, Kind kind, int frame);
  std::filesystem::path of_strip(const std::string& case_name);
  // Of all cases with this camera; `viewport`: "" or "-1920x1080" where there are several.
  std::filesystem::path of_depth(const std::string& case_name, const std::string& viewport, int frame);

 private:
  std::filesystem::path unique(const std::string& case_name, const std::string& begin);
  std::filesystem::path unique(const std::filesystem::path& stem);

  std::set<std::string> taken_;
};

}  // namespace clusterbench::pictures
