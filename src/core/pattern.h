#pragma once
// User input that selects names: a literal part of a name, or a regular expression. The time of a match is linear in
// its text for every expression, thanks to RE2 or, where that is missing, to regular_expression.h: std::regex needs
// exponential time for "(a+)+$".

#include <memory>
#include <string>
#include <string_view>

namespace clusterbench {

class Pattern {
 public:
  Pattern() = default;  // matches everything
  // Throws Error with `option` as its location.
  Pattern(const std::string& text, const std::string& option);

  // Literally, or as a regular expression: a copied name contains parentheses, points and similar characters.
  bool is_in(std::string_view text) const;
  bool is_all_of(std::string_view text) const;
  // Not as a regular expression.
  bool is_literally_in(std::string_view text) const;
  bool is(std::string_view text) const;

 private:
  struct Expression;
  static std::shared_ptr<const Expression> compiled(const std::string& text, const std::string& option);

  std::string text_;
  std::shared_ptr<const Expression> expression_;  // null: of every text
};

// The regular expression that matches this text alone.
std::string literal_expression(std::string_view text);

// Text to append to a message that nothing matches, which names the special characters of the text: ", neither as it
// stands nor as a regular expression, in which \ makes ( ) plain characters"; "" if it has none.
std::string pattern_hint(std::string_view text);

}  // namespace clusterbench
