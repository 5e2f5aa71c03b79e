#pragma once
// What people give to select names: a part of a name as it stands, or a regular expression. The time of a match is
// linear in its text, whatever the expression is, which is what RE2 is for: std::regex takes exponential time for
// "(a+)+$".

#include <memory>
#include <string>
#include <string_view>

namespace re2 {  // the library's own name
class RE2;
}

namespace clusterbench {

class Pattern {
 public:
  Pattern() = default;  // is everywhere
  // Throws Error with `option` as its location.
  Pattern(const std::string& text, const std::string& option);

  // As it stands, or as a regular expression: a name that was copied has parentheses, points and the like.
  bool is_in(std::string_view text) const;
  bool is_all_of(std::string_view text) const;
  // Not as a regular expression.
  bool is_literally_in(std::string_view text) const;
  bool is(std::string_view text) const;

 private:
  std::string text_;
  std::shared_ptr<const re2::RE2> expression_;
};

// What a message that nothing matches adds: ", neither as it stands nor as a regular expression, in which \ makes ( )
// plain characters", of those that are in the text; "" where there are none.
std::string pattern_hint(std::string_view text);

}  // namespace clusterbench
