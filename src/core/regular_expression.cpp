#include "core/regular_expression.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/error.h"
#include "core/regular_expression_parser.h"

namespace clusterbench {
namespace {

using Op = RegularExpression::Op;
using Step = RegularExpression::Step;
using Kind = RegularTree::Kind;

// Writes a tree as steps.
class Compiler {
 public:
  Compiler(std::vector<Step>& steps, std::vector<RegularExpression::Characters>& characters)
      : steps_(steps), characters_(characters) {}

  void write(const RegularTree& tree) {
    switch (tree.kind) {
      case Kind::nothing:
        return;
      case Kind::characters:
        return write_characters(tree.characters);
      case Kind::text_begin:
        return void(add({Op::text_begin}));
      case Kind::text_end:
        return void(add({Op::text_end}));
      case Kind::line_begin:
        return void(add({Op::line_begin}));
      case Kind::line_end:
        return void(add({Op::line_end}));
      case Kind::word_edge:
        return void(add({Op::word_edge}));
      case Kind::no_word_edge:
        return void(add({Op::no_word_edge}));
      case Kind::sequence:
        for (const RegularTree& part : tree.parts) write(part);
        return;
      case Kind::choice:
        return write_choice(tree);
      case Kind::repetition:
        return write_repetition(tree);
    }
  }
  std::uint32_t add(Step step) {
    if (steps_.size() >= RegularExpression::k_most_steps) throw Error("", "", "pattern too large - compile failed");
    steps_.push_back(step);
    return static_cast<std::uint32_t>(steps_.size() - 1);
  }

 private:
  std::uint32_t next() const { return static_cast<std::uint32_t>(steps_.size()); }

  void write_characters(const RegularExpression::Characters& characters) {
    auto known = std::ranges::find(characters_, characters);
    const auto index = static_cast<std::uint32_t>(known - characters_.begin());
    if (known == characters_.end()) characters_.push_back(characters);
    add({.op = Op::characters, .characters = index});
  }
  void write_choice(const RegularTree& tree) {
    std::vector<std::uint32_t> jumps;
    for (std::size_t i = 0; i + 1 < tree.parts.size(); ++i) {
      const std::uint32_t split = add({Op::split});
      steps_[split].to = next();
      write(tree.parts[i]);
      jumps.push_back(add({Op::jump}));
      steps_[split].or_to = next();
    }
    write(tree.parts.back());
    for (const std::uint32_t jump : jumps) steps_[jump].to = next();
  }
  void write_repetition(const RegularTree& tree) {
    const RegularTree& part = tree.parts.front();
    for (int i = 0; i < tree.least; ++i) write(part);
    if (tree.most < 0) return write_any_number(part);
    std::vector<std::uint32_t> ends;
    for (int i = tree.least; i < tree.most; ++i) {
      ends.push_back(add({Op::split}));
      steps_[ends.back()].to = next();
      write(part);
    }
    for (const std::uint32_t split : ends) steps_[split].or_to = next();
  }
  void write_any_number(const RegularTree& part) {
    const std::uint32_t split = add({Op::split});
    steps_[split].to = next();
    write(part);
    steps_[add({Op::jump})].to = split;
    steps_[split].or_to = next();
  }

  std::vector<Step>& steps_;
  std::vector<RegularExpression::Characters>& characters_;
};

bool is_word(char32_t c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool contains(const RegularExpression::Characters& ranges, char32_t c) {
  const auto after = std::ranges::upper_bound(ranges, c, {}, [](const auto& range) { return range.first; });
  return after != ranges.begin() && c <= std::prev(after)->second;
}

// A place between two characters.
struct Place {
  bool is_begin = false, is_end = false;
  char32_t before = k_no_character, after = k_no_character;

  bool is_word_edge() const { return is_word(before) != is_word(after); }
};

// The steps that are reached at a place, each once.
class ReachedSteps {
 public:
  explicit ReachedSteps(const std::vector<Step>& steps) : steps_(steps), seen_at_(steps.size(), 0) {}

  void begin_place() {
    waiting_.clear();
    ++place_;
    matched_ = false;
  }
  // And all that can be reached from it without a character.
  void add(std::uint32_t first, const Place& place) {
    stack_.push_back(first);
    while (!stack_.empty()) {
      const std::uint32_t index = stack_.back();
      stack_.pop_back();
      if (std::exchange(seen_at_[index], place_) != place_) follow(index, place);
    }
  }
  const std::vector<std::uint32_t>& waiting() const { return waiting_; }  // for a character
  bool matched() const { return matched_; }

 private:
  void follow(std::uint32_t index, const Place& place) {
    const Step& step = steps_[index];
    const auto go_on_if = [&](bool holds) {
      if (holds) stack_.push_back(index + 1);
    };
    switch (step.op) {
      case Op::characters:
        return waiting_.push_back(index);
      case Op::split:
        stack_.push_back(step.or_to);
        [[fallthrough]];
      case Op::jump:
        return stack_.push_back(step.to);
      case Op::text_begin:
        return go_on_if(place.is_begin);
      case Op::text_end:
        return go_on_if(place.is_end);
      case Op::line_begin:
        return go_on_if(place.is_begin || place.before == '\n');
      case Op::line_end:
        return go_on_if(place.is_end || place.after == '\n');
      case Op::word_edge:
        return go_on_if(place.is_word_edge());
      case Op::no_word_edge:
        return go_on_if(!place.is_word_edge());
      case Op::match:
        matched_ = true;
        return;
    }
  }

  const std::vector<Step>& steps_;
  std::vector<std::uint64_t> seen_at_;
  std::vector<std::uint32_t> waiting_, stack_;
  std::uint64_t place_ = 0;
  bool matched_ = false;
};

}  // namespace

RegularExpression::RegularExpression(std::string_view text) {
  Compiler compiler(steps_, characters_);
  compiler.write(parsed_expression(text));
  compiler.add({Op::match});
}

bool RegularExpression::is_in(std::string_view text) const {
  return matches(text, false);
}

bool RegularExpression::is_all_of(std::string_view text) const {
  return matches(text, true);
}

bool RegularExpression::matches(std::string_view text, bool whole) const {
  ReachedSteps now(steps_);
  Place place{.is_begin = true};
  char32_t character = k_no_character;
  std::vector<std::uint32_t> arrived = {0};
  for (bool is_end = false; !is_end; place.is_begin = false) {
    is_end = text.empty();
    place.before = character;
    place.is_end = is_end;
    place.after = character = is_end ? k_no_character : next_character(text);
    now.begin_place();
    for (const std::uint32_t step : arrived) now.add(step, place);
    if (!whole) now.add(0, place);
    if (now.matched() && (is_end || !whole)) return true;
    arrived.clear();
    for (const std::uint32_t step : now.waiting())
      if (!is_end && contains(characters_[steps_[step].characters], character)) arrived.push_back(step + 1);
    if (arrived.empty() && whole) return false;
  }
  return false;
}

}  // namespace clusterbench
