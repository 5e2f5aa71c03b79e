#include "report/page/page_pictures.h"

#include <algorithm>
#include <set>

#include "core/error.h"
#include "core/file_text.h"
#include "core/json_document.h"

namespace clusterbench::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t k_most_picture_bytes = 48 << 20;

std::string base64_of(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) {
      return i + at < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i + at])} : 0u;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t digit = 0; digit < 4; ++digit)
      out += i + digit > bytes.size() ? '=' : k_digits[three >> (18 - 6 * digit) & 63];
  }
  return out;
}

std::set<std::string> case_ids_of(const std::vector<NamedResult>& results) {
  std::set<std::string> ids;
  for (const NamedResult& named : results)
    for (const result::Case& one : named.result.cases) ids.insert(one.id);
  return ids;
}

// A page may be published: it includes only pictures of the folder.
std::string picture_in(const fs::path& folder, const fs::path& index, const std::string& file) {
  const fs::path path = fs::path(file).lexically_normal();
  if (path.is_absolute() || path.empty() || *path.begin() == "..")
    throw Error(index.string(), file, "is not below the folder of pictures");
  std::string bytes = file_text(folder / path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) throw Error((folder / path).string(), "", "is no PNG file");
  return bytes;
}

PagePicture picture_of(const Json& entry) {
  PagePicture picture;
  picture.kind = entry.at("kind").get<std::string>();
  if (!entry.at("frame").is_null()) picture.frame.emplace(entry.at("frame").get<int>());
  picture.case_ids = entry.at("cases").get<std::vector<std::string>>();
  picture.text = entry.at("text").get<std::string>();
  return picture;
}

}  // namespace

std::vector<PagePicture> page_pictures(const fs::path& folder, const std::vector<NamedResult>& results) {
  const fs::path index = folder / "pictures.json";
  const Json document = json_or_discarded<Json>(file_text(index));
  const std::set<std::string> ids = case_ids_of(results);
  std::vector<PagePicture> pictures;
  std::uint64_t bytes = 0;
  try {
    for (const Json& entry : document.at("pictures")) {
      PagePicture picture = picture_of(entry);
      if (std::ranges::none_of(picture.case_ids, [&](const std::string& id) { return ids.contains(id); })) continue;
      const std::string png = picture_in(folder, index, entry.at("file").get<std::string>());
      bytes += png.size();
      if (bytes > k_most_picture_bytes)
        throw Error("", "--images",
                    "more than " + std::to_string(k_most_picture_bytes >> 20) +
                        " MiB of pictures are too many for a page; make fewer (run --filter, --image-kinds)");
      picture.url = "data:image/png;base64," + base64_of(png);
      pictures.push_back(std::move(picture));
    }
  } catch (const Json::exception&) {
    throw Error(index.string(), "", "is no list of pictures as `clusterbench run --images` writes it");
  }
  return pictures;
}

}  // namespace clusterbench::report
