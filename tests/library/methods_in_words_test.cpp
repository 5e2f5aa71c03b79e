#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "core/text.h"
#include "library/assign.h"
#include "library/cases.h"
#include "places.h"

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::FrameForMethod;
using testing::frustum_grid;
using testing::grid_for;
using testing::settings_for;

// The names between two texts of a file, without signs of comments and code.
std::vector<std::string> names_between(const std::string& from, const std::string& to, const std::string& path) {
  std::ifstream file(test::source_dir() + path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = text.find(from), end = text.find(to, begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::vector<std::string> names;
  std::string name;
  for (const char c : text.substr(begin + from.size(), end - begin - from.size()) + ",") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.') name += c;
    if (c == ',') names.push_back(std::exchange(name, ""));
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> names_in_header(const std::string& from, const std::string& to) {
  return names_between(from, to, "/src/library/assign.h");
}

TEST(LightLists, have_buffers_and_take_storages_as_the_header_lists_the_methods) {
  std::vector<std::string> shown, unshown;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors()) {
    const FrameForMethod frame(*method);
    Settings settings = settings_for(grid_for(*method), method->name);
    LightLists lists;
    ASSERT_TRUE(lists.start(settings)) << method->name << " " << lists.error();
    ASSERT_TRUE(lists.update(frame.engine.view, frame.engine.lights())) << method->name << " " << lists.error();
    const bool has_lists = !lists.begins().empty(), has_buffers = !lists.buffers().empty();
    if (!has_lists) (has_buffers ? shown : unshown).push_back(method->name);
    settings.storage = "packed";
    EXPECT_EQ(lists.start(settings), has_lists) << method->name;
    if (!has_lists) continue;
    EXPECT_FALSE(has_buffers) << method->name;
    ASSERT_TRUE(lists.update(frame.engine.view, frame.engine.lights())) << method->name << " " << lists.error();
    EXPECT_EQ(lists.buffers().size(), 2u) << method->name;
  }
  std::ranges::sort(shown);
  std::ranges::sort(unshown);
  EXPECT_EQ(names_in_header("in buffers():", ";"), shown);
  EXPECT_EQ(names_in_header("without buffers:", ".\n"), unshown);
}

// Of the header, and of docs/embedding.md.
TEST(Methods, take_boxes_depths_and_cameras_as_the_header_and_the_page_say) {
  std::vector<std::string> boxes, depths, perspective;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors()) {
    EXPECT_TRUE(method->points || method->boxes) << method->name;
    if (method->boxes) boxes.push_back(method->name);
    if (method->needs.depth) depths.push_back(method->name);
    if (!method->orthographic) perspective.push_back(method->name);
  }
  for (std::vector<std::string>* names : {&boxes, &depths, &perspective}) std::ranges::sort(*names);
  EXPECT_EQ(names_in_header("Taken by", "alone"), boxes);
  EXPECT_EQ(names_in_header("Needed by", ";"), depths);
  const std::string page = "/docs/embedding.md";
  EXPECT_EQ(names_between("Boxes are taken by", "alone", page), boxes);
  EXPECT_EQ(names_between("Methods that need a depth buffer (", ")", page), depths);
  EXPECT_EQ(names_between("Perspective cameras alone are taken by", "and by", page), perspective);
}

TEST(Methods, that_take_boxes_are_in_the_error_of_one_that_does_not) {
  const EngineFrame frame = engine_frame(20, 5, true);
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast"))) << lists.error();
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  std::vector<std::string> takers;
  for (const assign::AssignerDescriptor* method : assign::assigner_descriptors())
    if (method->boxes) takers.push_back(method->name);
  EXPECT_EQ(lists.error(),
            "lights.boxes: are given, and exact-fast takes none; methods on a frustum grid that do: " + joined(takers));
}

}  // namespace
}  // namespace clusterbench::library
