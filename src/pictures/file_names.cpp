#include "pictures/file_names.h"

#include <algorithm>
#include <vector>

namespace clusterbench::pictures {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> parts_of(const std::string& case_name) {
  std::vector<std::string> parts(1);
  for (const char c : case_name)
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

fs::path folder_of(const std::string& case_name, std::size_t most_parts) {
  fs::path folder;
  const std::vector<std::string> parts = parts_of(case_name);
  for (std::size_t i = 0; i < std::min(most_parts, parts.size()); ++i) folder /= file_part(parts[i]);
  return folder;
}

bool is_plain(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || byte >= 0x80 ||
         std::string_view("._+=").find(c) != std::string_view::npos;
}

}  // namespace

std::string file_part(std::string_view text) {
  constexpr std::size_t k_longest = 80;
  std::string out;
  for (const char c : text) {
    if (is_plain(c) && !(out.empty() && c == '.'))
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  std::size_t end = std::min(out.size(), k_longest);
  while (end < out.size() && end > 0 && (static_cast<unsigned char>(out[end]) & 0xc0) == 0x80) --end;
  out.resize(end);
  while (!out.empty() && out.back() == '-') out.pop_back();
  return out.empty() ? "_" : out;
}

fs::path FileNames::unique(const std::string& case_name, const std::string& begin) {
  std::string name = begin;
  const std::vector<std::string> parts = parts_of(case_name);
  for (std::size_t i = 3; i < parts.size(); ++i) name += "-" + file_part(parts[i]);
  return unique(folder_of(case_name, 3) / name);
}

fs::path FileNames::unique(const fs::path& stem) {
  const std::string path = stem.string();
  std::string candidate = path;
  for (int number = 2; !used_.insert(candidate).second; ++number) candidate = path + "-" + std::to_string(number);
  return candidate + ".png";
}

fs::path FileNames::of_case(const std::string& case_name, Kind kind, int frame) {
  return unique(case_name, std::string(name_of(kind)) + "-frame-" + std::to_string(frame));
}

fs::path FileNames::of_strip(const std::string& case_name) {
  return unique(case_name, name_of(Kind::strip));
}

fs::path FileNames::of_depth(const std::string& case_name, const std::string& viewport, int frame) {
  return unique(folder_of(case_name, 2) /
                (std::string(name_of(Kind::depth)) + "-frame-" + std::to_string(frame) + viewport));
}

}  // namespace clusterbench::pictures
