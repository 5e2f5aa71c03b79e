// With mingw's libstdc++ on msvcrt.dll, std::filesystem::path reads narrow names through the C library's mbrtowc(), and
// that library has no UTF-8. So for this program these functions are here, and always read UTF-8. Other C libraries of
// Windows have it: the manifest asks for it.

#if defined(__MINGW32__) && !defined(_UCRT)

#include <cerrno>
#include <cstdint>
#include <cwchar>

namespace {

// UTF-16 has two units for a character beyond U+FFFF. The first is known after three of its four bytes, and is given
// then; the state keeps what the second one needs.
constexpr std::uint32_t k_first_of_pair = 0xD800, k_second_of_pair = 0xDC00;

struct Sequence {
  std::size_t bytes = 0;  // 0: none begins like this
  std::uint32_t value = 0, least = 0;
};

Sequence begun_with(unsigned char first) {
  if (first < 0x80) return {1, first, 0};
  if (first >= 0xC2 && first < 0xE0) return {2, first & 0x1FU, 0x80};
  if (first >= 0xE0 && first < 0xF0) return {3, first & 0x0FU, 0x800};
  if (first >= 0xF0 && first < 0xF5) return {4, first & 0x07U, 0x1000};  // of its first three bytes
  return {};
}

std::size_t refused() {
  errno = EILSEQ;
  return static_cast<std::size_t>(-1);
}

bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

std::size_t second_of_pair(wchar_t* to, char byte, std::mbstate_t& state) {
  if (!continues(byte)) return refused();
  const auto kept = static_cast<std::uint32_t>(state) - 1;
  state = 0;
  if (to != nullptr)
    *to = static_cast<wchar_t>(k_second_of_pair | kept << 6 | (static_cast<unsigned char>(byte) & 0x3FU));
  return 1;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the C library's

extern "C" size_t mbrtowc(wchar_t* to, const char* from, size_t count, mbstate_t* state) {
  static thread_local mbstate_t own_state = 0;
  if (state == nullptr) state = &own_state;
  if (from == nullptr) {
    *state = 0;
    return 0;
  }
  if (count == 0) return static_cast<size_t>(-2);
  if (*state != 0) return second_of_pair(to, *from, *state);
  const Sequence begun = begun_with(static_cast<unsigned char>(*from));
  if (begun.bytes == 0) return refused();
  const size_t taken = begun.bytes == 4 ? 3 : begun.bytes;
  std::uint32_t value = begun.value;
  for (size_t i = 1; i < taken; ++i) {
    if (i == count) return static_cast<size_t>(-2);
    if (!continues(from[i])) return refused();
    value = value << 6 | (static_cast<unsigned char>(from[i]) & 0x3FU);
  }
  const bool is_half_of_pair = begun.bytes == 3 && value >= 0xD800 && value < 0xE000;
  // Four bytes: 15 bits so far, of U+10000 to U+10FFFF without their last six.
  const bool is_beyond = begun.bytes == 4 && (value < 0x10000 >> 6 || value >= 0x110000 >> 6);
  if (is_half_of_pair || is_beyond || (begun.bytes < 4 && value < begun.least)) return refused();
  if (begun.bytes == 4) {
    const std::uint32_t above = value - (0x10000 >> 6);
    *state = static_cast<mbstate_t>((above & 0xF) + 1);
    value = k_first_of_pair | above >> 4;
  }
  if (to != nullptr) *to = static_cast<wchar_t>(value);
  return value == 0 ? 0 : taken;
}

extern "C" size_t mbrlen(const char* from, size_t count, mbstate_t* state) {
  return mbrtowc(nullptr, from, count, state);
}

extern "C" size_t mbsrtowcs(wchar_t* to, const char** from, size_t count, mbstate_t* state) {
  mbstate_t begun = 0;
  if (state == nullptr) state = &begun;
  const char* at = *from;
  for (size_t made = 0; to == nullptr || made < count; ++made) {
    wchar_t unit = 0;
    const size_t taken = mbrtowc(&unit, at, 4, state);
    if (taken > 4) return static_cast<size_t>(-1);
    if (to != nullptr) to[made] = unit;
    if (taken == 0) {
      if (to != nullptr) *from = nullptr;
      return made;
    }
    at += taken;
    if (to != nullptr) *from = at;
  }
  return count;
}

// NOLINTEND(readability-identifier-naming)

#endif
