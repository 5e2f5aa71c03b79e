#pragma once
// A regular expression's text as a tree.

#include <memory>
#include <string_view>
#include <vector>

#include "core/regular_expression.h"

namespace clusterbench {

struct RegularTree {
  enum class Kind : std::uint8_t {
    nothing,
    characters,
    text_begin,
    text_end,
    line_begin,
    line_end,
    word_edge,
    no_word_edge,
    sequence,
    choice,
    repetition
  };
  Kind kind = Kind::nothing;
  RegularExpression::Characters characters = {};
  std::vector<RegularTree> parts = {};
  int least = 0, most = 0;  // of a repetition; most -1: any number
};

// Throws Error, with the reason alone as its message.
RegularTree parsed_expression(std::string_view text);

// The character at the front of UTF-8 text, which is removed; k_no_character for a byte that is part of none.
inline constexpr char32_t k_no_character = 0x110000;
char32_t next_character(std::string_view& text);

}  // namespace clusterbench
