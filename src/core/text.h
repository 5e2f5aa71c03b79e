#pragma once
// Small helpers for messages to people.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace clusterbench {

// The candidate nearest to `word` by edit distance (insert, delete, replace, swap), or "" if none is near enough to be
// a likely typing error.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

// " (did you mean 'aabb'?)" or "", ready to append to an error message.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

// "a, b, c".
std::string joined(std::span<const std::string> words, std::string_view separator = ", ");

// Lower-case hexadecimal SHA-256 of the bytes.
std::string sha256_hex(std::string_view bytes);

}  // namespace clusterbench
