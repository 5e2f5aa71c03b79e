#include "core/wildcards.h"

#include <cstddef>

namespace clusterbench {
namespace {

unsigned char byte_at(std::string_view text, std::size_t at) {
  return static_cast<unsigned char>(text[at]);
}

// One element of a pattern, and what it says of a byte.
struct Element {
  std::size_t length = 1;
  bool matches = false;
};

// The literal at `at`, which a backslash may make one; moves behind it.
unsigned char next_literal(std::string_view pattern, std::size_t& at) {
  if (pattern[at] == '\\' && at + 1 < pattern.size()) ++at;
  return byte_at(pattern, at++);
}

// What stands between brackets; length 0 if they do not end.
Element bracket(std::string_view pattern, unsigned char byte) {
  std::size_t at = 1;
  const bool is_negated = at < pattern.size() && (pattern[at] == '!' || pattern[at] == '^');
  if (is_negated) ++at;
  bool is_among = false;
  for (const std::size_t first = at; at < pattern.size();) {
    if (pattern[at] == ']' && at > first) return {at + 1, is_among != is_negated};
    const unsigned char low = next_literal(pattern, at);
    const bool is_range = at + 1 < pattern.size() && pattern[at] == '-' && pattern[at + 1] != ']';
    if (is_range) ++at;
    const unsigned char high = is_range ? next_literal(pattern, at) : low;
    is_among |= low <= byte && byte <= high;
  }
  return {0, false};
}

// The first element of a pattern that does not begin with '*'.
Element first_element(std::string_view pattern, unsigned char byte) {
  if (pattern.front() == '?') return {1, true};
  if (pattern.front() == '[')
    if (const Element set = bracket(pattern, byte); set.length > 0) return set;
  std::size_t at = 0;
  const unsigned char literal = next_literal(pattern, at);
  return {at, literal == byte};
}

}  // namespace

// After a mismatch the last '*' takes one byte more: what the stars before it took need no change.
bool matches_wildcards(std::string_view pattern, std::string_view text) {
  constexpr std::size_t k_none = std::string_view::npos;
  std::size_t at = 0, read = 0, behind_star = k_none, taken_to = 0;
  while (read < text.size()) {
    if (at < pattern.size() && pattern[at] == '*') {
      behind_star = ++at;
      taken_to = read;
      continue;
    }
    const Element element = at < pattern.size() ? first_element(pattern.substr(at), byte_at(text, read)) : Element{};
    if (element.matches) {
      at += element.length;
      ++read;
      continue;
    }
    if (behind_star == k_none) return false;
    at = behind_star;
    read = ++taken_to;
  }
  return pattern.find_first_not_of('*', at) == k_none;
}

}  // namespace clusterbench
