#include "os/guarded_memory.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "core/error.h"
#include "os/memory_pages.h"

namespace clusterbench::os {
namespace {

// What the handler reads. It may not allocate, lock or format with the standard library.
struct GuardedRange {
  std::uintptr_t pages_begin = 0, pages_end = 0;  // the guards included; 0: a free place
  std::uintptr_t data_begin = 0, data_end = 0;
  std::array<char, 48> name{};
};
std::array<GuardedRange, 128> guarded_ranges;

class SignalText {
 public:
  SignalText& operator<<(const char* text) {
    while (*text != '\0' && size_ < text_.size()) text_[size_++] = *text++;
    return *this;
  }
  SignalText& operator<<(std::uintptr_t number) {
    std::array<char, 24> digits{};
    std::size_t first = digits.size() - 1;
    do digits[--first] = static_cast<char>('0' + number % 10);
    while ((number /= 10) > 0);
    return *this << digits.data() + first;
  }
  void print() const { print_on_error(text_.data(), size_); }

 private:
  std::array<char, 256> text_{};
  std::size_t size_ = 0;
};

void describe(const GuardedRange& range, std::uintptr_t address) {
  SignalText text;
  if (address >= range.data_end)
    text << "touched memory " << address - range.data_end << " bytes behind the end of `" << range.name.data() << "`\n";
  else if (address < range.data_begin)
    text << "touched memory " << range.data_begin - address << " bytes before the begin of `" << range.name.data()
         << "`\n";
  else
    text << "wrote to `" << range.name.data() << "`, which is to be read only\n";
  text.print();
}

void describe_access(std::uintptr_t address) {
  for (const GuardedRange& range : guarded_ranges)
    if (address >= range.pages_begin && address < range.pages_end) describe(range, address);
}

std::size_t free_place() {
  const auto* found = std::ranges::find(guarded_ranges, std::uintptr_t{0}, &GuardedRange::pages_end);
  if (found == guarded_ranges.end()) throw Error("", "memory", "has too many guarded parts", ExitCode::internal);
  return static_cast<std::size_t>(found - guarded_ranges.begin());
}

}  // namespace

GuardedMemory::GuardedMemory(const std::string& name, std::size_t bytes, Guard guard)
    : bytes_(bytes), place_(free_place()) {
  const std::size_t page = os::page_bytes();
  const std::size_t inner = (bytes + page - 1) / page * page;
  page_bytes_ = inner + 2 * page;
  pages_ = reserve_pages(page_bytes_);
  if (pages_ == nullptr || (inner > 0 && !allow_writing(pages_ + page, inner)))
    throw Error("", "memory", errno_text("cannot be had"));
  data_ = pages_ + page + (guard == Guard::behind ? inner - bytes : 0);
  GuardedRange& range = guarded_ranges[place_];
  range.pages_begin = reinterpret_cast<std::uintptr_t>(pages_);
  range.pages_end = range.pages_begin + page_bytes_;
  range.data_begin = reinterpret_cast<std::uintptr_t>(data_);
  range.data_end = range.data_begin + bytes;
  range.name = {};
  std::memcpy(range.name.data(), name.data(), std::min(name.size(), range.name.size() - 1));
}

GuardedMemory::~GuardedMemory() {
  guarded_ranges[place_] = {};
  release_pages(pages_, page_bytes_);
}

void GuardedMemory::forbid_writing() const {
  if (bytes_ == 0) return;
  const std::size_t page = os::page_bytes();
  if (!allow_reading_alone(pages_ + page, page_bytes_ - 2 * page))
    throw Error("", "memory", errno_text("cannot be protected"));
}

void report_guards() {
  watch_accesses(describe_access);
}

}  // namespace clusterbench::os
