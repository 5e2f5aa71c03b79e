#pragma once
// Files that a glTF document names: buffers and images beside it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace clusterbench::scene {

// "a%20b" as "a b".
std::string percent_decoded(const std::string& uri);

// Whether it has a scheme such as "http:" before any slash.
bool has_scheme(const std::string& uri);

// All URIs that name files, whether they exist and are read or not: overwriting one of them would lose a part of the
// scene.
std::vector<std::filesystem::path> files_named(const nlohmann::json& document, const std::filesystem::path& path);
// The same for the document in a file.
std::vector<std::filesystem::path> files_named_in(const std::filesystem::path& path);

}  // namespace clusterbench::scene
