#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

const std::string k_small = "run " + source_file("scenes/mix.glb") +
                            " --grid frustum --tiles 64 --assigner aabb-fast --viewport 320x180 --no-timing -q"
                            " --set scenes.0.frames=4 --filter 'x 16 ' -o ";

TEST(RunImages, are_written_for_each_case_and_replaced_by_the_next_run) {
  const Folder folder;
  const std::filesystem::path pictures = folder / "new" / "pictures";
  const Outcome done = tool(k_small + (folder / "result.json").string() + " --images " + pictures.string());
  ASSERT_EQ(done.code, 0) << done.err;
  const Json result = Json::parse(file_text(folder / "result.json"));
  const std::string worst = result["cases"][0]["occupancy"]["worst_frame"].dump();
  const std::filesystem::path grid = pictures / "mix" / "walk" / "frustum-64px-x-16-exponential-first-first-5";
  const std::filesystem::path heat_map = grid / ("lights-frame-" + worst + "-aabb-fast-packed.png");
  const std::string bytes = file_text(heat_map);
  ASSERT_EQ(bytes.substr(1, 3), "PNG") << heat_map;
  EXPECT_TRUE(exists(pictures / "mix" / "walk" / ("depth-frame-" + worst + ".png")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(grid), {}), 7);

  std::ofstream(heat_map) << "old";
  std::ofstream(grid / "mine.txt") << "kept";
  const Outcome again = tool(k_small + (folder / "same.json").string() + " --threads 3 --images " + pictures.string());
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(file_text(heat_map), bytes);
  EXPECT_EQ(file_text(grid / "mine.txt"), "kept");
}

TEST(RunImages, change_nothing_in_the_result) {
  const Folder folder;
  ASSERT_EQ(tool(k_small + (folder / "a.json").string()).code, 0);
  ASSERT_EQ(tool(k_small + (folder / "b.json").string() + " --images " + folder.path().string()).code, 0);
  EXPECT_EQ(file_text(folder / "a.json"), file_text(folder / "b.json"));
}

TEST(RunImages, can_be_chosen) {
  const Folder folder;
  const Outcome done = tool(k_small + (folder / "result.json").string() + " --images " + folder.path().string() +
                            " --image-frames 3,0,3 --image-kinds missed,depth --image-divisor 2 --image-scale 9");
  ASSERT_EQ(done.code, 0) << done.err;
  const std::filesystem::path grid = folder / "mix" / "walk" / "frustum-64px-x-16-exponential-first-first-5";
  EXPECT_TRUE(exists(grid / "missed-frame-0-aabb-fast-packed.png"));
  EXPECT_TRUE(exists(grid / "missed-frame-3-aabb-fast-packed.png"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(grid), {}), 2);
  EXPECT_TRUE(exists(folder / "mix" / "walk" / "depth-frame-3.png"));
}

// What a run says that is refused, and that it measures nothing.
std::string refusal_of_images(const std::string& arguments) {
  const Folder folder;
  const Outcome refused = tool(k_small + (folder / "result.json").string() + " " + arguments);
  EXPECT_EQ(refused.code, 2) << arguments;
  EXPECT_FALSE(exists(folder / "result.json"));
  EXPECT_FALSE(exists(folder / "result.json.partial"));
  return refused.err;
}

TEST(RunImages, what_cannot_be_is_known_before_anything_is_measured) {
  const Folder folder;
  const std::string file = folder.write("file", "").string(), images = "--images " + folder.path().string();
  const auto expect = [](const std::string& arguments, const std::string& message) {
    const std::string said = refusal_of_images(arguments);
    EXPECT_NE(said.find(message), std::string::npos) << said;
  };
  expect("--images " + file, "file: no folder can be made there");
  expect("--images " + file + "/below", "no folder can be made there");
  expect("--images /proc/nothing", "/proc/nothing: no folder can be made there");
  expect(images + " --image-kinds xyz", "'xyz' is no kind of picture; there are lights, levels");
  expect(images + " --image-kinds mised", "did you mean 'missed'?");
  expect(images + " --image-frames last", "takes worst, first, or numbers of frames");
  expect(images + " --image-frames 1,-2", "not '-2'");
  expect(images + " --image-frames 4", "4 is on no path: the longest has frames 0 to 3");
  expect(images + " --image-divisor 0", "from 1 to 64");
  expect(images + " --image-scale 0", "of at least 1");
  expect(images + " --image-depth -1", "from 1e-15 to 1e+15");
  expect("--image-kinds missed", "--images");
}

TEST(RunImages, too_many_are_refused_with_their_number) {
  const Folder folder;
  std::string frames = "0";
  for (int frame = 1; frame < 60; ++frame) frames += "," + std::to_string(frame);
  const Outcome refused = tool("run " + source_file("scenes/mix.glb") + " --set scenes.0.frames=60 --images " +
                               folder.path().string() + " --image-frames " + frames);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("pictures are more than 2000: choose cases (--filter)"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace clusterbench::test
