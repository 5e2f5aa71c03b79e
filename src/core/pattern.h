#pragma once
// Regular expressions that people give to select names. The time of a match is linear in its text, whatever the
// expression is, which is what RE2 is for: std::regex takes exponential time for "(a+)+$".

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

  bool is_in(std::string_view text) const;
  bool is_all_of(std::string_view text) const;

 private:
  std::shared_ptr<const re2::RE2> expression_;
};

}  // namespace clusterbench
