#pragma once
// Small helpers for messages to people.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace clusterbench {

// The candidate nearest to `word` by edit distance (insert, delete, replace, swap), or "" if none is close enough for a
// likely typing error.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

// " (did you mean 'aabb'?)" or "", ready to append to an error message.
std::string did_you_mean(std::string_view word, std::span<const std::string> candidates);

// "a, b, c".
std::string joined(std::span<const std::string> words, std::string_view separator = ", ");

// Appends a line unless it is already among them.
void add_once(const std::string& line, std::vector<std::string>& lines);

// "1 light", "2 lights", "0 lights": a word whose plural has an s.
std::string number_of(std::uint64_t count, std::string_view word);
// The number that the whole text is, as "-12.5e3"; none for any other text, blanks, infinities and hexadecimal digits
// included.
std::optional<double> decimal_number(std::string_view text);

// The words quoted for a shell: "run 'a b.json'".
std::string shell_command(std::span<const std::string> words);

// Text from a file or a name, safe to print on a terminal: every control character (C0, DEL, C1), every character that
// turns or breaks a line (U+061C, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069) and every byte that is no UTF-8
// becomes '?'. All printed text from outside must pass through this function or, if it has lines, through
// printable_lines().
std::string printable(std::string_view text);
// The same, but line feeds stay.
std::string printable_lines(std::string_view text);
// JSON with such characters in its strings as \\uXXXX: the same document, safe to print. Control characters below
// U+0020 are escaped in any JSON.
std::string printable_json(std::string_view json);

// Whether every byte belongs to a UTF-8 character.
bool is_utf8(std::string_view text);

// The bytes of base64 text, with or without padding; nullopt if it is invalid or cut off.
std::optional<std::string> base64_decoded(std::string_view text);

// Lower-case hexadecimal SHA-256 of the bytes.
std::string sha256_hex(std::string_view bytes);

}  // namespace clusterbench
