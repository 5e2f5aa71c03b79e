#include "core/regular_expression_parser.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace clusterbench {
namespace {

using Characters = RegularExpression::Characters;
using Kind = RegularTree::Kind;

constexpr char32_t k_last = 0x10FFFF;

[[noreturn]] void refuse_expression(const std::string& reason, std::string_view at) {
  throw Error("", "", at.empty() ? reason : reason + ": " + std::string(at));
}

// Sorted, without overlaps.
Characters united(Characters ranges) {
  std::ranges::sort(ranges);
  Characters out;
  for (const auto& range : ranges)
    if (!out.empty() && range.first <= out.back().second + 1)
      out.back().second = std::max(out.back().second, range.second);
    else
      out.push_back(range);
  return out;
}

Characters all_but(const Characters& ranges) {
  Characters out;
  char32_t from = 0;
  for (const auto& [first, last] : united(ranges)) {
    if (first > from) out.push_back({from, first - 1});
    from = last + 1;
  }
  if (from <= k_last) out.push_back({from, k_last});
  return out;
}

struct NamedCharacters {
  std::string_view name;
  Characters characters;
};

const std::array<NamedCharacters, 14>& posix_classes() {
  static const std::array<NamedCharacters, 14> k_classes = {{
      {"alnum", {{'0', '9'}, {'A', 'Z'}, {'a', 'z'}}},
      {"alpha", {{'A', 'Z'}, {'a', 'z'}}},
      {"ascii", {{0, 0x7F}}},
      {"blank", {{'\t', '\t'}, {' ', ' '}}},
      {"cntrl", {{0, 0x1F}, {0x7F, 0x7F}}},
      {"digit", {{'0', '9'}}},
      {"graph", {{'!', '~'}}},
      {"lower", {{'a', 'z'}}},
      {"print", {{' ', '~'}}},
      {"punct", {{'!', '/'}, {':', '@'}, {'[', '`'}, {'{', '~'}}},
      {"space", {{'\t', '\r'}, {' ', ' '}}},
      {"upper", {{'A', 'Z'}}},
      {"word", {{'0', '9'}, {'A', 'Z'}, {'_', '_'}, {'a', 'z'}}},
      {"xdigit", {{'0', '9'}, {'A', 'F'}, {'a', 'f'}}},
  }};
  return k_classes;
}

std::optional<Characters> perl_class(char32_t letter) {
  switch (letter) {
    case 'd':
      return Characters{{'0', '9'}};
    case 's':
      return Characters{{'\t', '\n'}, {'\f', '\r'}, {' ', ' '}};
    case 'w':
      return Characters{{'0', '9'}, {'A', 'Z'}, {'_', '_'}, {'a', 'z'}};
    case 'D':
    case 'S':
    case 'W':
      return all_but(*perl_class(letter - U'A' + U'a'));
    default:
      return {};
  }
}

std::optional<char32_t> control_character(char32_t letter) {
  constexpr std::pair<char, char> k_controls[] = {{'a', '\a'}, {'f', '\f'}, {'n', '\n'},
                                                  {'r', '\r'}, {'t', '\t'}, {'v', '\v'}};
  for (const auto& [name, character] : k_controls)
    if (letter == static_cast<unsigned char>(name)) return static_cast<unsigned char>(character);
  return {};
}

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

bool is_letter_or_digit(char32_t c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// Reads an expression by its grammar: choice = sequence {"|" sequence}, sequence = {repetition}, repetition =
// atom {"*" | "+" | "?" | "{n,m}"}.
class Parser {
 public:
  explicit Parser(std::string_view text) : whole_(text), rest_(text) {}

  RegularTree parse() {
    if (!is_utf8(whole_)) refuse_expression("invalid UTF-8", "");
    RegularTree tree = choice();
    if (!rest_.empty()) refuse_expression("unexpected )", whole_);
    return tree;
  }

 private:
  struct Flags {
    bool ignores_case = false, dot_takes_line_ends = false, by_lines = false;
  };

  bool is_next(std::string_view text) const { return rest_.starts_with(text); }
  bool take(std::string_view text) {
    if (!is_next(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  // What was read since then.
  std::string_view since(std::string_view then) const { return then.substr(0, then.size() - rest_.size()); }

  RegularTree choice() {
    if (++depth_ > RegularExpression::k_deepest) refuse_expression("expression nests too deeply", "");
    RegularTree out{.kind = Kind::choice};
    do out.parts.push_back(sequence());
    while (take("|"));
    --depth_;
    if (out.parts.size() > 1) return out;
    RegularTree only = std::move(out.parts.front());
    return only;
  }

  RegularTree sequence() {
    RegularTree out{.kind = Kind::sequence};
    while (!rest_.empty() && !is_next("|") && !is_next(")")) {
      if (take("\\Q")) {
        quote(out);
        continue;
      }
      RegularTree part = atom();
      if (part.kind != Kind::nothing) out.parts.push_back(std::move(part));
      repeat_last(out);  // of flags alone it is what stands before them
    }
    return out;
  }

  void quote(RegularTree& to) {
    while (!rest_.empty() && !take("\\E")) to.parts.push_back(character(next_character(rest_)));
    repeat_last(to);
  }
  void repeat_last(RegularTree& sequence) {
    if (sequence.parts.empty()) return refuse_repetition();
    RegularTree last = std::move(sequence.parts.back());
    sequence.parts.back() = repeated(std::move(last));
  }

  // {n}, {n,}, {n,m}; other text in braces is literal.
  bool take_counts(int& least, int& most) {
    const std::string_view before = rest_;
    if (take("{") && number(least)) {
      most = least;
      if (take(",")) {
        most = -1;
        if (!is_next("}") && !number(most)) most = -2;
      }
      if (most != -2 && take("}")) {
        const int largest = std::max(least, most);
        if (largest > RegularExpression::k_most_repetitions || (most >= 0 && most < least))
          refuse_expression("invalid repetition size", since(before));
        return true;
      }
    }
    rest_ = before;
    return false;
  }
  // Without leading zeros, and below 100 million, as RE2 reads them; else it is no number.
  bool number(int& out) {
    constexpr std::size_t k_most_digits = 8;
    std::size_t digits = 0;
    int value = 0;
    constexpr int k_too_many = RegularExpression::k_most_repetitions + 1;
    while (digits < rest_.size() && rest_[digits] >= '0' && rest_[digits] <= '9')
      value = std::min(k_too_many, 10 * value + (rest_[digits++] - '0'));
    if (digits > k_most_digits || (digits > 1 && rest_.front() == '0')) return false;
    rest_.remove_prefix(digits);
    out = value;
    return digits > 0;
  }
  bool take_repetition(int& least, int& most) {
    const bool is_star = take("*"), is_plus = !is_star && take("+"), is_mark = !is_star && !is_plus && take("?");
    least = is_plus ? 1 : 0;
    most = is_mark ? 1 : -1;
    return is_star || is_plus || is_mark || take_counts(least, most);
  }

  void refuse_repetition() {
    const std::string_view from = rest_;
    int least = 0, most = 0;
    if (!take_repetition(least, most)) return;
    take("?");
    refuse_expression("no argument for repetition operator", since(from));
  }
  RegularTree repeated(RegularTree part) {
    int least = 0, most = 0;
    const std::string_view operator_at = rest_;
    if (!take_repetition(least, most)) return part;
    take("?");  // it prefers fewer, which changes no answer
    const int largest = std::max({1, least, most});
    if (largest_in(part) * largest > RegularExpression::k_most_repetitions)
      refuse_expression("invalid repetition size", since(operator_at));
    int again_least = 0, again_most = 0;
    if (take_repetition(again_least, again_most)) {
      take("?");
      refuse_expression("bad repetition operator", since(operator_at));
    }
    RegularTree out{.kind = Kind::repetition, .least = least, .most = most};
    out.parts.push_back(std::move(part));
    return out;
  }

  // The greatest product of repetitions within each other.
  static int largest_in(const RegularTree& tree) {
    int largest = 1;
    for (const RegularTree& part : tree.parts) largest = std::max(largest, largest_in(part));
    return tree.kind == Kind::repetition ? largest * std::max({1, tree.least, tree.most}) : largest;
  }

  RegularTree character(char32_t c) const { return of({{c, c}}); }
  RegularTree of(Characters characters) const {
    if (flags_.ignores_case) add_other_case(characters);
    return {.kind = Kind::characters, .characters = united(std::move(characters))};
  }
  static void add_other_case(Characters& characters) {
    const Characters given = characters;
    for (const auto& [first, last] : given) {
      if (last > 0x7F && last != k_last)
        refuse_expression("(?i) with letters beyond ASCII needs RE2, and this clusterbench was built without it", "");
      for (char32_t c = first; c <= std::min<char32_t>(last, 'z'); ++c)
        if (is_letter_or_digit(c) && c > '9') characters.push_back({c ^ 0x20U, c ^ 0x20U});
    }
  }

  RegularTree atom() {
    const std::string_view from = rest_;
    if (take("(")) return group(from);
    if (take("[")) return of(bracket(from));
    if (take(".")) return of(flags_.dot_takes_line_ends ? Characters{{0, k_last}} : all_but({{'\n', '\n'}}));
    if (take("^")) return {.kind = flags_.by_lines ? Kind::line_begin : Kind::text_begin};
    if (take("$")) return {.kind = flags_.by_lines ? Kind::line_end : Kind::text_end};
    if (is_next("\\")) return escaped();
    refuse_repetition();
    return character(next_character(rest_));
  }

  RegularTree group(std::string_view from) {
    const Flags outside = flags_;
    if (take("?") && !take_name(from) && !take_flags(from)) return {};  // (?i) is for the rest of the group around it
    RegularTree inside = choice();
    if (!take(")")) refuse_expression("missing )", whole_);
    flags_ = outside;
    return inside;
  }
  // (?P<name>...)
  bool take_name(std::string_view from) {
    if (!take("P<") && !take("<")) return false;
    std::size_t size = 0;
    while (size < rest_.size() && (is_letter_or_digit(static_cast<unsigned char>(rest_[size])) || rest_[size] == '_'))
      ++size;
    rest_.remove_prefix(size);
    if (size == 0 || !take(">")) refuse_expression("invalid named capture group", since(from));
    return true;
  }
  // Whether a group follows, as in (?i:a).
  bool take_flags(std::string_view from) {
    bool on = true, lacks_flag = false;
    while (!rest_.empty()) {
      if (!lacks_flag && take(":")) return true;
      if (!lacks_flag && take(")")) return false;
      lacks_flag = on && is_next("-");
      if (take("i"))
        flags_.ignores_case = on;
      else if (take("s"))
        flags_.dot_takes_line_ends = on;
      else if (take("m"))
        flags_.by_lines = on;
      else if (on && take("-"))
        on = false;
      else if (!take("U")) {
        next_character(rest_);
        refuse_expression("invalid perl operator", since(from));
      }
    }
    refuse_expression("missing )", whole_);
  }

  RegularTree escaped() {
    const std::string_view from = rest_;
    if (take("\\b")) return {.kind = Kind::word_edge};
    if (take("\\B")) return {.kind = Kind::no_word_edge};
    if (take("\\A")) return {.kind = Kind::text_begin};
    if (take("\\z")) return {.kind = Kind::text_end};
    if (std::optional<Characters> characters = take_class(from)) return of(std::move(*characters));
    return character(escape(from));
  }
  // \d and the like.
  std::optional<Characters> take_class(std::string_view from) {
    if (is_next("\\p") || is_next("\\P"))
      refuse_expression("a class of Unicode needs RE2, and this clusterbench was built without it", from.substr(0, 2));
    if (rest_.size() < 2 || rest_[0] != '\\') return {};
    std::optional<Characters> characters = perl_class(static_cast<unsigned char>(rest_[1]));
    if (characters) rest_.remove_prefix(2);
    return characters;
  }
  char32_t escape(std::string_view from) {
    take("\\");
    if (rest_.empty()) refuse_expression("trailing \\", "");
    if (take("x")) return hexadecimal(from);
    const char32_t letter = next_character(rest_);
    if (letter < 0x80 && !is_letter_or_digit(letter)) return letter;  // an underscore, too
    if (letter == '0') return octal();
    if (letter >= '1' && letter <= '7' && !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '7') {
      rest_ = from.substr(1);
      return octal();
    }
    const std::optional<char32_t> control = control_character(letter);
    if (!control) refuse_expression("invalid escape sequence", since(from));
    return *control;
  }
  // Up to three digits.
  char32_t octal() {
    char32_t value = 0;
    for (int i = 0; i < 3 && !rest_.empty() && rest_[0] >= '0' && rest_[0] <= '7'; ++i) {
      value = value * 8 + static_cast<char32_t>(rest_[0] - '0');
      rest_.remove_prefix(1);
    }
    return value;
  }
  // Two digits, or any number in braces.
  char32_t hexadecimal(std::string_view from) {
    const bool in_braces = take("{");
    char32_t value = 0;
    std::size_t digits = 0;
    while (!rest_.empty() && (in_braces || digits < 2) && hexadecimal_digit(rest_[0]) >= 0 && value <= k_last) {
      value = value * 16 + static_cast<char32_t>(hexadecimal_digit(rest_[0]));
      rest_.remove_prefix(1);
      ++digits;
    }
    if (digits == 0 || (!in_braces && digits != 2) || value > k_last || (in_braces && !take("}")))
      refuse_expression("invalid escape sequence", since(from));
    return value;
  }

  Characters bracket(std::string_view from) {
    const bool is_negated = take("^");
    Characters out;
    for (bool is_first = true; is_first || !take("]"); is_first = false) {
      if (rest_.empty()) refuse_expression("missing ]", from);
      const Characters part = bracket_part(from);
      out.insert(out.end(), part.begin(), part.end());
    }
    return is_negated ? negated(out) : united(out);
  }
  Characters bracket_part(std::string_view from) {
    if (std::optional<Characters> named = take_named()) return *named;
    if (std::optional<Characters> perl = take_class(rest_)) return *perl;
    const std::string_view range_from = rest_;
    const char32_t first = bracket_character(from);
    char32_t last = first;
    if (rest_.size() > 1 && rest_[0] == '-' && rest_[1] != ']') {
      take("-");
      last = bracket_character(from);
    }
    if (last < first) refuse_expression("invalid character class range", since(range_from));
    return {{first, last}};
  }
  Characters negated(Characters characters) const {
    if (flags_.ignores_case) add_other_case(characters);
    return all_but(characters);
  }
  char32_t bracket_character(std::string_view from) {
    if (rest_.empty()) refuse_expression("missing ]", from);
    return is_next("\\") ? escape(rest_) : next_character(rest_);
  }
  // [:alpha:] and [:^alpha:].
  std::optional<Characters> take_named() {
    if (!is_next("[:")) return {};
    const std::size_t end = rest_.find(":]", 2);
    if (end == std::string_view::npos) return {};
    std::string_view name = rest_.substr(2, end - 2);
    const bool is_negated = name.starts_with('^');
    if (is_negated) name.remove_prefix(1);
    for (const NamedCharacters& row : posix_classes())
      if (row.name == name) {
        rest_.remove_prefix(end + 2);
        return is_negated ? all_but(row.characters) : row.characters;
      }
    refuse_expression("invalid character class range", rest_.substr(0, end + 2));
  }

  std::string_view whole_, rest_;
  Flags flags_;
  int depth_ = 0;
};

// The length that a first byte announces; 0 for one that begins no character.
int announced_length(unsigned char first) {
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  return first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

}  // namespace

char32_t next_character(std::string_view& text) {
  const auto length = static_cast<std::size_t>(announced_length(static_cast<unsigned char>(text.front())));
  if (length == 0 || length > text.size() || !is_utf8(text.substr(0, length))) {
    text.remove_prefix(1);
    return k_no_character;
  }
  constexpr unsigned char k_first_bits[] = {0, 0x7F, 0x1F, 0x0F, 0x07};
  char32_t value = static_cast<unsigned char>(text[0]) & k_first_bits[length];
  for (std::size_t i = 1; i < length; ++i) value = value << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
  text.remove_prefix(length);
  return value;
}

RegularTree parsed_expression(std::string_view text) {
  return Parser(text).parse();
}

}  // namespace clusterbench
