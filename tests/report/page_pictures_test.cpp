#include "report/page/page_pictures.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/error.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::string k_png_start = "\x89PNG\r\n\x1a\n";

// A folder of pictures with this index.
class PictureFolder {
 public:
  explicit PictureFolder(const std::string& index) {
    std::string name = (fs::temp_directory_path() / "clusterbench.XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
    write("pictures.json", index);
  }
  ~PictureFolder() { fs::remove_all(path_); }
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Json picture_entry(const std::string& file, const std::string& case_id) {
  return {{"file", file}, {"kind", "lights"}, {"frame", 3}, {"cases", {case_id}}, {"text", "Lights per pixel."}};
}

std::vector<NamedResult> results_with_case(const std::string& id) {
  result::Result result;
  result.cases.emplace_back().id = id;
  return {{"result.json", result}};
}

const std::vector<NamedResult> k_one_case = results_with_case("a1");

std::string refusal_of_pictures(const fs::path& folder) {
  try {
    page_pictures(folder, k_one_case);
  } catch (const Error& error) {
    return error.what();
  }
  return "taken";
}

TEST(PagePictures, are_those_of_the_cases_with_their_bytes_in_them) {
  const Json index{{"pictures", {picture_entry("mine.png", "a1"), picture_entry("others.png", "b2")}}};
  const PictureFolder folder(index.dump());
  folder.write("mine.png", k_png_start + "..");
  const std::vector<PagePicture> pictures = page_pictures(folder.path(), k_one_case);
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_EQ(pictures.front().kind, "lights");
  EXPECT_EQ(pictures.front().frame, 3);
  EXPECT_EQ(pictures.front().text, "Lights per pixel.");
  EXPECT_EQ(pictures.front().url, "data:image/png;base64,iVBORw0KGgouLg==");
  folder.write("mine.png", k_png_start + "...");
  EXPECT_EQ(page_pictures(folder.path(), k_one_case).front().url, "data:image/png;base64,iVBORw0KGgouLi4=");
  folder.write("mine.png", k_png_start + "....");
  EXPECT_EQ(page_pictures(folder.path(), k_one_case).front().url, "data:image/png;base64,iVBORw0KGgouLi4u");
}

TEST(PagePictures, come_from_their_folder_only) {
  for (const char* file : {"../secret.png", "/etc/passwd", "a/../../b.png", ""}) {
    const PictureFolder folder(Json{{"pictures", {picture_entry(file, "a1")}}}.dump());
    EXPECT_NE(refusal_of_pictures(folder.path()).find("is not below the folder of pictures"), std::string::npos)
        << file;
  }
  const PictureFolder folder(Json{{"pictures", {picture_entry("text.png", "a1")}}}.dump());
  EXPECT_NE(refusal_of_pictures(folder.path()).find("text.png: cannot be read"), std::string::npos);
  folder.write("text.png", "not a picture");
  EXPECT_NE(refusal_of_pictures(folder.path()).find("text.png: is no PNG file"), std::string::npos);
}

TEST(PagePictures, a_folder_without_an_index_is_refused) {
  for (const char* index : {"", "[]", "{}", R"({"pictures": 1})", R"({"pictures": [{"file": "a.png"}]})"})
    EXPECT_NE(refusal_of_pictures(PictureFolder(index).path()).find("is no list of pictures"), std::string::npos)
        << index;
  EXPECT_NE(refusal_of_pictures("/nowhere").find("/nowhere/pictures.json: cannot be read"), std::string::npos);
}

TEST(PagePictures, too_many_bytes_are_refused) {
  const PictureFolder folder(Json{{"pictures", {picture_entry("a.png", "a1"), picture_entry("a.png", "a1")}}}.dump());
  folder.write("a.png", k_png_start + std::string(30 << 20, '.'));
  EXPECT_NE(refusal_of_pictures(folder.path()).find("are too many for a page"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::report
