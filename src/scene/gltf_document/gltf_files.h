#pragma once
// Files that a glTF document names: buffers and images beside it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::scene {

// "a%20b" as "a b".
std::string percent_decoded(const std::string& uri);

// A scheme such as "http:" stands before any slash.
bool has_scheme(const std::string& uri);

// Of all uris that name files, whether they are there or not, and read or not: who writes over one has lost a part of
// the scene.
std::vector<std::filesystem::path> files_named(const nlohmann::json& document, const std::filesystem::path& path);
// The same of the document in a file.
std::vector<std::filesystem::path> files_named_in(const std::filesystem::path& path);

}  // namespace clusterbench::scene
