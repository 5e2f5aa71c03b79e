#pragma once
// Regular expressions without a library, for builds without RE2: the same syntax and answers, but for classes of
// Unicode (\pL), and the flag i for letters beyond ASCII, which are refused.
//
// A match takes time in proportion to the length of the text times that of the expression, whatever they are: all
// states are followed at once (Thompson 1968), none is tried again.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clusterbench {

class RegularExpression {
 public:
  static constexpr int k_most_repetitions = 1000;       // of nested ones the product, as in RE2
  static constexpr int k_deepest = 250;                 // groups within groups
  static constexpr std::size_t k_most_steps = 100'000;  // of the program, repetitions written out

  // Throws Error, with the reason alone as its message: "missing ): (a".
  explicit RegularExpression(std::string_view text);

  bool is_in(std::string_view text) const;
  bool is_all_of(std::string_view text) const;

  // Ranges of characters, first and last, ascending.
  using Characters = std::vector<std::pair<char32_t, char32_t>>;
  enum class Op : std::uint8_t {
    characters,
    split,
    jump,
    text_begin,
    text_end,
    line_begin,
    line_end,
    word_edge,
    no_word_edge,
    match
  };
  struct Step {
    Op op;
    std::uint32_t to = 0, or_to = 0;  // split goes to both, jump to the first, the others to the next step
    std::uint32_t characters = 0;     // index
  };

 private:
  bool matches(std::string_view text, bool whole) const;

  std::vector<Step> steps_;
  std::vector<Characters> characters_;
};

}  // namespace clusterbench
