// Names and command lines of Windows, which are UTF-16.

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "os/shared_library.h"
#include "os/windows/command_words.h"
#include "os/windows/windows_api.h"

namespace clusterbench::os {
namespace {

namespace fs = std::filesystem;

std::string utf8_of(char32_t code) {
  std::u32string text(1, code);
  const fs::path path(text);
  return narrow(path.wstring());
}

TEST(WindowsNames, a_narrow_name_is_utf_8) {
  for (char32_t code = 1; code < 0x110000; code += code < 0x3000 ? 1 : 37) {
    if (code >= 0xD800 && code < 0xE000) continue;
    const std::string name = utf8_of(code);
    ASSERT_EQ(fs::path(name).wstring(), wide(name)) << static_cast<unsigned>(code);
    ASSERT_EQ(fs::path(name).string(), name) << static_cast<unsigned>(code);
  }
}

TEST(WindowsNames, what_is_no_utf_8_is_no_name) {
  for (const char* name :
       {"\x80", "\xC3", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE3\x81", "\xF0\x8F\xBF\xBF", "a\xFF"})
    EXPECT_THROW(fs::path(std::string(name)), fs::filesystem_error) << name;
}

TEST(WindowsNames, words_come_back_from_a_command_line) {
  std::mt19937 random(1);
  const std::string letters = "ab \"\\\t";
  for (int i = 0; i < 20'000; ++i) {
    std::vector<std::string> words{"program"};
    for (int k = static_cast<int>(random() % 4); k > 0; --k) {
      std::string word;
      for (int j = static_cast<int>(random() % 7); j > 0; --j) word += letters[random() % letters.size()];
      words.push_back(word);
    }
    ASSERT_EQ(words_of(command_text(words)), words) << narrow(command_text(words));
  }
}

TEST(WindowsNames, long_paths_get_the_prefix_that_lifts_the_limit) {
  EXPECT_EQ(long_path("short.json"), L"short.json");
  const std::wstring name(300, L'x');
  EXPECT_TRUE(long_path(L"C:\\folder/" + name).starts_with(L"\\\\?\\C:\\folder\\x"));
  EXPECT_TRUE(long_path(L"\\\\server\\share\\" + name).starts_with(L"\\\\?\\UNC\\server\\share\\x"));
}

TEST(WindowsNames, a_program_is_no_library) {
  EXPECT_EQ(library_obstacle(""), "is no shared library (DLL)");
  EXPECT_EQ(library_obstacle("\x7f"
                             "ELF"),
            "is no shared library (DLL)");
  EXPECT_EQ(library_obstacle("MZ"), "is a shared library that was cut off");
}

}  // namespace
}  // namespace clusterbench::os
